"""Products of a compiled model: C, a DAE, a description, text."""
