"""Expressions of the tree to checked ones: names bound, literals in SI, types agreed.

`expression` is the door; what each kind of expression is stands in `rules`, by way of `names`,
`literals`, `operators` and `calls`. `structure` and `known` are values needed before the run.
"""
