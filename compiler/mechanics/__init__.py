"""Bodies, liaisons and forces to equations of motion in reduced coordinates."""
