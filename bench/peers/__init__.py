"""One adapter a code: each builds the scenes of `work_precision` with that code's public API."""
