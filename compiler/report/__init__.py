"""The report of a mechanism: mobility, relations, first integrals, paradoxes."""
