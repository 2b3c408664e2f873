"""The library and the worked examples, as `.frot` files."""
