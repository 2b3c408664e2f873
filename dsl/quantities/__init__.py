"""Dimensions and the types of expressions, units, and rates that only their words tell apart."""
