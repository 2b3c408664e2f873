"""Equations to the CasADi functions of the kernel's contract, with their tables."""
