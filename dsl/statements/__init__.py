"""Statements: equations, `when`, connections, `world`, `experiment`, `initial`."""
