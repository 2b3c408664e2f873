"""Entities by their names, in classes (`classes`, `imports`, `types`) and components (`scope`).

`entities` are what a name can stand for, `build` what one check shares, `modifiers` what is said of
names from outside, `members` and `constants` what is named by way of others.
"""
