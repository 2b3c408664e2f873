"""What `frot check` says of a mechanism: its mobility, relations, first integrals, paradoxes."""
