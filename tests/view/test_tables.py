"""Every shape, curve, surface and liaison of the language has a row in the tables of pictures."""

from __future__ import annotations

import numpy as np
import pytest
from frot.dsl.catalogue import LIAISONS, SHAPES

from frot.view import bodies, figures, symbols
from frot.view.bodies import Look

GIVEN = {
    "radius": np.array(0.3),
    "length": np.array(2.0),
    "a": np.array(0.5),
    "b": np.array(0.2),
    "semi_axes": np.array((0.5, 0.3, 0.2)),
    "vertices": np.array(((0, 0), (2, 0), (2, 1), (1, 0.2), (0, 1)), dtype=float),
    "com": np.array((0.1, 0.0, 0.0)),
}
# Half of the extent along x, y, z; of what is slender along its length alone.
HALVES = {
    ("box", False): (1.0, 0.5, 0.25),
    ("box", True): (1.0, 0.5, 0.0),
    ("cylinder", False): (0.3, 0.3, 1.0),
    ("disc", True): (0.3, 0.3, 0.0),
    ("disc", False): (0.3, 0.3, 0.0),
    ("ellipse", True): (0.5, 0.2, 0.0),
    ("ellipsoid", False): (0.5, 0.3, 0.2),
    ("ring", True): (0.3, 0.3, 0.0),
    ("rod", True): (1.0, None, None),
    ("rod", False): (1.0, None, None),
    ("shell", False): (0.3, 0.3, 0.3),
    ("sphere", False): (0.3, 0.3, 0.3),
}


def test_every_shape_has_a_row() -> None:
    assert set(bodies.SHAPES) == set(SHAPES)


def test_every_liaison_has_a_symbol() -> None:
    assert set(symbols.LIAISONS) == set(LIAISONS)


def test_every_curve_and_surface_has_a_row() -> None:
    from frot.dsl.declarations import geometry

    french = {"droite", "cercle", "plan", "ellipsoide"}
    assert set(figures.CURVES) == {*geometry._CURVES, "parametric"} - french
    assert set(figures.SURFACES) == {*geometry._SURFACES, "parametric", "implicit"} - french


@pytest.mark.parametrize(("shape", "planar"), HALVES)
def test_a_body_is_as_large_as_its_shape(shape: str, planar: bool) -> None:
    size = np.array((2.0, 1.0)) if planar else np.array((2.0, 1.0, 0.5))
    outline = bodies.outline_of(shape, {**GIVEN, "size": size}, Look(planar, 0.01))
    reach = np.abs(outline.points).max(axis=0)
    for found, half in zip(reach, HALVES[shape, planar], strict=True):
        if half is not None:
            assert found == pytest.approx(half, abs=0.006)
    for line in outline.lines:
        assert np.all(np.abs(line).max(axis=0) <= reach + 1e-9)


def test_the_area_of_a_hollow_polygon_is_that_of_its_corners() -> None:
    """The sides enclose 2*1 less the triangle on top: shoelace formula; G is the centroid."""
    outline = bodies.outline_of("polygon", GIVEN, Look(True, 0.01))
    corners = outline.points[outline.faces][:, :, :2]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    parts = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / 2
    x, y = GIVEN["vertices"].T
    area = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
    assert parts.sum() == pytest.approx(area, rel=1e-12)
    assert (parts[:, None] * corners.mean(axis=1)).sum(axis=0) == pytest.approx((0, 0), abs=1e-12)


@pytest.mark.parametrize("kind", symbols.LIAISONS)
@pytest.mark.parametrize("planar", [True, False])
def test_a_symbol_is_about_one_across(kind: str, planar: bool) -> None:
    axes = {name: np.array((0.6, 0.8, 0.0)) for name in ("axis", "axis_a", "axis_b", "normal")}
    outline = symbols.LIAISONS[kind](axes, planar)
    points = np.vstack((outline.points, *outline.lines))
    if len(points):
        assert 0.15 < np.linalg.norm(points, axis=1).max() < 1.1


@pytest.mark.parametrize("kind", symbols.JOINING)
def test_what_joins_two_points_goes_from_one_to_the_other(kind: str) -> None:
    outline = symbols.JOINING[kind](0.1)
    along = np.vstack((outline.points, *outline.lines))[:, 2]
    assert (along.min(), along.max()) == (0.0, 1.0)
