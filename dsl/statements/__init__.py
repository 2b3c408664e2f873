"""Statements: equations, events, connections, and what is said of a run.

`equations` and `when`; `connect`, `connections` and `open_flows`; `settings` are `world`,
`experiment` and `initial`.
"""
