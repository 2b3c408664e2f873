"""What is told to the author of a text: places, diagnostics, the registry of their codes."""
