"""Families of scenes with impacts."""

from __future__ import annotations

from judge.collisions import plane, space
from judge.family import Family

FAMILIES = (
    Family(
        "impacts", plane.impacts, 2, 10, "bodies that bounce, chains, cords, stops in the plane"
    ),
    Family("impacts_space", space.impacts, 2, 10, "the same in space"),
)
