"""Bytes to tree: words, grammar, and the tree with the place of every part."""
