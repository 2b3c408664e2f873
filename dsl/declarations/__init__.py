"""Declarations: values, components, bodies, liaisons, forces."""
