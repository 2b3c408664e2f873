"""Expressions of a text as CasADi expressions, before anything is known of mechanics."""
