"""What a compiled model is made into: C, a DAE, a report, text."""
