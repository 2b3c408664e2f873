"""The language room: text to a checked model."""
