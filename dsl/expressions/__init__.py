"""Expressions of the tree to checked ones: names bound, literals in SI, types agreed."""
