"""The formatter: the usual form of a text."""
