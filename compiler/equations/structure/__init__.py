"""The structure of the equations: incidence, index, order, elimination, tearing."""
