"""Mechanisms in space without friction, judged by Newton-Euler in plain numpy.

`scene` describes bodies, frames, joints and forces and writes their text; `rows` derives relations
and their rates; `families` draws mechanisms; `check` holds results against the equations.
"""
