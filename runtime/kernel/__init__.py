"""The C kernel: its sources, to be compiled with every model."""
