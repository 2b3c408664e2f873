"""Bytes to tree: `parsing` is the door, `tree` what comes out, `walk` the way through expressions.

`lex` and `grammar` give words and tables, `build` and `build_expressions` the nodes.
"""
