"""Analyses of expressions and their patterns without knowing what these stand for."""
