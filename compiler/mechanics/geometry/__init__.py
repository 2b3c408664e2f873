"""Figures, curves and surfaces of bodies, and where they touch."""
