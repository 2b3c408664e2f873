"""The equations of a text: index, order, blocks, core."""
