"""Declarations: `instantiate` makes a class a component, whose names wait for `settle`.

A value is declared in `components`, bodies and places in `geometry`, the rest in `mechanism`.
"""
