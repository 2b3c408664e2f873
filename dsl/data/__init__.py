"""Data classes of all folders: `classes`."""
