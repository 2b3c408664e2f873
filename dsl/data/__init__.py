"""What values of all rooms are made with: `classes`."""
