"""Messages to the author of a text.

`source` has places in a text, `diagnostics` what is reported of them and the log that collects it,
`errors` the exception, `codes` the registry, `rendering` and `diagnostic_data` the forms of output.
"""
