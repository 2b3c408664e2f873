"""The formatter: `formatting` is the door.

`pieces` are words and comments, which come to stand in `blocks` and `columns` with their `spacing`.
"""
