"""A light body between heavy ones: what rounding of inertias may do to it is told."""

from __future__ import annotations

import pytest

import frot


def chain(masses: list[float], turned: bool = False) -> frot.Result:
    lines, before = [f"{'' if turned else 'planar '}model Chain"], "ground"
    for i, mass in enumerate(masses):
        lines.append(f"  body b{i}: rod(mass = {mass!r} kg, length = 1 m);")
        lines.append(f"  liaison p{i}: rotoide({before}, b{i}.start{', axis = z' * turned});")
        before = f"b{i}.tip"
    lines += ["initial", *(f"  p{i}.angle = {0.3 + 0.4 * (i % 2)!r};" for i in range(len(masses)))]
    return frot.compile("\n".join([*lines, "end Chain;"])).simulate(stop=0.01)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("unit", [1.0, 1e6])
def test_what_rounding_of_inertias_may_do_is_told(unit: float, turned: bool) -> None:
    """About the ratio of the masses times the resolution of numbers, in any unit of mass."""
    result = chain([unit * m for m in (1, 1e-8, 1e-8, 1e-8, 1)], turned)
    assert 2.2e-16 * 1e7 < result.figures.masked < 2.2e-16 * 1e10
    assert "warning: rounding may make" in result.summary()


@pytest.mark.parametrize("masses", [[1.0] * 30, [1e-8, 1.0], [1.0, 1e-8], [1.0, 1e-3, 1e-3, 1.0]])
def test_of_usual_chains_there_is_nothing_to_tell(masses: list[float]) -> None:
    result = chain(masses)
    assert result.figures.masked < 1e-11
    assert "rounding" not in result.summary()
