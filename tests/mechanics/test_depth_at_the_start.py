"""How far figures are put into each other at the start, where the place of a body is stated."""

from __future__ import annotations

import math
import re

import pytest

import frot

DISC = """planar model Inside
  body b: disc(mass = {mass} kg, radius = 0.1 m);
  curve l on ground: line(through = (0, 0) m, direction = ({c!r}, {s!r}));
  liaison contact: contact_ponctuel({places});
initial
  b.position = ({x!r}, {y!r}) m;
end Inside;
"""
BOX = """{kind}model Inside
  body b: box(mass = 1 kg, size = {size} m);
  liaison contact: appui_faces(b.bottom, {floor});
initial
  b.position = {place} m;
  {angle}
end Inside;
"""


def depth(text: str) -> float:
    """The depth that the error names, in m."""
    with pytest.raises(frot.FrotError, match=r"E0601.*puts the bodies into each other") as told:
        frot.compile(text).simulate()
    found = re.search(r"by ([-+.e\d]+) m\)", str(told.value))
    assert found is not None
    return float(found[1])


@pytest.mark.parametrize("places", ["l, b.rim", "b.rim, l"])
@pytest.mark.parametrize("mass", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize(("angle", "deep"), [(0, 0.04), (30, 0.07), (-77, 1e-6)])
def test_of_a_disc_and_a_line_turned(angle: float, deep: float, mass: float, places: str) -> None:
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    x, y = -s * (0.1 - deep), c * (0.1 - deep)
    text = DISC.format(c=c, s=s, x=x, y=y, mass=mass, places=places)
    assert depth(text) == pytest.approx(deep, rel=5e-3)


def test_where_one_component_is_stated() -> None:
    text = DISC.format(c=1.0, s=0.0, x=0.0, y=0.03, mass=1, places="l, b.rim")
    text = re.sub(r"b.position = .*;", "b.position.y = 0.03 m;", text)
    assert depth(text) == pytest.approx(0.07, rel=5e-3)


def test_of_the_corner_of_a_box_that_is_tilted() -> None:
    """Of two corners the deeper one alone is inside."""
    turned = math.radians(10)
    height = 0.5 * math.sin(turned) + 0.25 * math.cos(turned) - 0.05
    text = BOX.format(
        kind="planar ",
        size="(1, 0.5)",
        floor="ground.line",
        place=f"(0, {height!r})",
        angle="b.angle = 10 deg;",
    )
    assert depth(text) == pytest.approx(0.05, rel=5e-3)
