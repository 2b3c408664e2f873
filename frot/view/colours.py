"""The colours of pictures: of bodies, of what is drawn beside them, of modes and reactions."""

from __future__ import annotations

from collections.abc import Mapping

# For the colour-blind: after M. Okabe, K. Ito (2008), lighter.
BODIES = ("#5aa9dc", "#e7b54a", "#59b89a", "#d98bb5", "#a9b8c6", "#e08a5b", "#8f86d6", "#9dbb5a")
KINDS: Mapping[str, str] = {
    "curve": "#3f4d5a",
    "frame": "#7b8b9a",
    "joining": "#5b6b7b",
    "liaison": "#33414f",
    "surface": "#b9c6d2",
}
MODES: Mapping[str, str] = {"open": "#c3ced8", "stick": "#2c6fb0", "slip": "#e9962c"}
NORMAL = "#1f8a4c"
ALONG = "#c62828"
