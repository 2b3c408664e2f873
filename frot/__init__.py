"""Frot."""
