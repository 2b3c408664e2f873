"""Files: what is read, what is written, and what a text imports.

`reading` has texts, `writing` results that come whole or not at all; `import_scan` finds the files
that a text reads without the grammar.
"""
