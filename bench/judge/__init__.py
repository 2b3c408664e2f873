"""A judge of runs that shares nothing with the compiler: Newton-Euler in plain numpy.

A random scene is described once (`scene`); `write` makes its text, `mechanics` its equations in
three coordinates a body, `motions` all its admissible motions at an instant. `check` reads a
result through the names of its variables only. Mechanisms in space are in `space`.
"""
