"""Dimensions, the types of expressions, and units."""
