"""Applied forces: one file a kind, and their sum along the speeds."""
