"""What an adapter gives: a list of settings for each scene, each of which can be run and timed.

An adapter is a module `with_NAME` with
`NAME`, `version() -> str`, `NOTES: dict[scene, str]` (how the scene is put to this code, or why it
cannot be) and `settings(scene) -> list[Setting]`, empty if the code cannot do the scene.
Adapters run in the Python that has the peer; they import nothing but the peer, numpy and
`closed_forms`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

SCENES = ("block", "oscillator", "hoop")


@dataclass(frozen=True, slots=True)
class Outcome:
    """One run: end positions as `closed_forms.exact`, largest end speed, solving time (s), work."""

    positions: tuple[float, ...]
    speed: float
    wall: float
    work: int
    kernel: float | None = None


@dataclass(frozen=True, slots=True)
class Setting:
    """A way to run a scene; settings with one `method` make a curve. `unit`: what work counts."""

    method: str
    label: str
    unit: str
    run: Callable[[], Outcome]
