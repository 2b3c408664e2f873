"""Planar scenes with friction written in space agree with their planar twins."""

from __future__ import annotations

import textwrap

import numpy as np
import pytest

import frot

SLIDER = """
    {model} Slider
      body b: particle(mass = 1 kg);
      {line}
      liaison c: {liaison} with coulomb(0.2);
      force f: on(b, value = {force});
    initial
      b.position = {zero};
      b.velocity = {velocity};
      experiment(stop = 4 s, tolerance = 1e-11);
    end Slider;
    """

FALLING = """
    {model} Falling
      body b: rod(mass = 2 kg, length = 1 m);
      liaison c: contact_ponctuel(b.start, {ground}) with coulomb({mu});
    initial
      b.start.position = {zero};
      b.tip.position = {tip};
      b.velocity.x = {v} m/s;
      {still}
      experiment(stop = 0.35 s, tolerance = 1e-11);
    end Falling;
    """

STACK = """
    {model} Stack
      body low: box(mass = 2 kg, size = {low});
      body high: box(mass = 1 kg, size = {high});
      {top}
      liaison c: appui_faces(low.bottom, {ground}) with coulomb(0.1);
      liaison d: appui_faces(high.bottom, {face}) with coulomb(0.3);
    initial
      low.position = {at};
      high.position = {above};
      high.velocity = {velocity};
      low.velocity = {zero};
      experiment(stop = 1 s, tolerance = 1e-11);
    end Stack;
    """


def run(text: str, **values: object) -> frot.Result:
    return frot.compile(textwrap.dedent(text).format(**values)).simulate()


def modes(result: frot.Result) -> list[float]:
    """Times at which contacts begin or cease to slide, without reversals."""
    found = [e.time for e in result.events if "revers" not in e.kind and "sides" not in e.text]
    return sorted({round(t, 9) for t in found})


def agree(plane: frot.Result, space: frot.Result, names: dict[str, str], bound: float) -> None:
    assert modes(space) == pytest.approx(modes(plane), abs=1e-9)
    times = np.linspace(0, float(plane.time[-1]), 41)[1:-1]
    one, other = plane.at(times), space.at(times)
    for planar, spatial in names.items():
        assert np.max(np.abs(one[planar] - other[spatial])) < bound


@pytest.mark.parametrize("speed", [0, 4, -2])
def test_a_bilateral_contact_whose_normal_reaction_changes_sign(speed: float) -> None:
    """It slides along a line at 0.3 rad, and its normal force swings between both sides."""
    plane = run(
        SLIDER,
        model="planar model",
        line="curve l on ground: line(through = (0, 0) m, direction = (cos(0.3), sin(0.3)));",
        liaison="point_courbe(b, l)",
        force="(2 N, 30 N*sin(5 1/s*time))",
        zero="(0, 0) m",
        velocity=f"{speed}*(cos(0.3), sin(0.3)) m/s",
    )
    space = run(
        SLIDER,
        model="model",
        line="surface l on ground: plane((0, 0, 0) m, normal = (-sin(0.3), 0, cos(0.3)));",
        liaison="point_surface(b, l)",
        force="(2 N, 0 N, 30 N*sin(5 1/s*time))",
        zero="(0, 0, 0) m",
        velocity=f"{speed}*(cos(0.3), 0, sin(0.3)) m/s",
    )
    names = {"b.position.x": "b.position.x", "b.velocity.x": "b.velocity.x",
             "c.normal_force": "c.normal_force"}  # fmt: skip
    agree(plane, space, names, 1e-9)


@pytest.mark.parametrize(
    ("mu", "angle", "v"), [(0.3, 1.2, 0), (0.3, 1.0, 1), (0.6, 1.2, -1), (0.2, 0.8, -0.3)]
)
def test_a_rod_that_topples_on_its_rough_end(mu: float, angle: float, v: float) -> None:
    plane = run(
        FALLING,
        model="planar model",
        ground="ground.line",
        mu=mu,
        v=v,
        zero="(0, 0) m",
        tip=f"(cos({angle}), sin({angle})) m",
        still="b.angular_velocity = 0 rad/s;",
    )
    space = run(
        FALLING,
        model="model",
        ground="ground.plane",
        mu=mu,
        v=v,
        zero="(0, 0, 0) m",
        tip=f"(cos({angle}), 0, sin({angle})) m",
        still="b.velocity.y = 0 m/s; b.velocity.z = 0 m/s; b.angular_velocity = (0, 0, 0) rad/s;",
    )
    names = {"b.position.x": "b.position.x", "b.position.y": "b.position.z",
             "b.velocity.x": "b.velocity.x"}  # fmt: skip
    agree(plane, space, names, 1e-9)


def test_a_box_slides_on_a_box_until_it_rests() -> None:
    plane = run(
        STACK,
        model="planar model",
        low="(0.6, 0.2) m",
        high="(0.3, 0.2) m",
        top="",
        ground="ground.line",
        face="low.top",
        at="(0, 0.1) m",
        above="(0, 0.3) m",
        velocity="(0.5, 0) m/s",
        zero="(0, 0) m/s",
    )
    space = run(
        STACK,
        model="model",
        low="(0.6, 0.3, 0.2) m",
        high="(0.3, 0.3, 0.2) m",
        top="surface top on low: plane(through = (0, 0, 0.1) m, normal = (0, 0, 1));",
        ground="ground.plane",
        face="top",
        at="(0, 0, 0.1) m",
        above="(0, 0, 0.3) m",
        velocity="(0.5, 0, 0) m/s",
        zero="(0, 0, 0) m/s",
    )
    agree(plane, space, {"high.position.x": "high.position.x"}, 1e-10)


def test_a_table_on_four_legs_stops() -> None:
    """Its deceleration is mu g, whatever each leg bears."""
    result = run("""
        model Table
          body b: box(mass = 2 kg, size = (0.4, 0.3, 0.1) m);
          liaison c: appui_faces(b.bottom, ground.plane) with coulomb(0.3);
        initial
          b.position = (0, 0, 0.05) m;
          b.velocity = (0.6, 0.8, 0) m/s;
          experiment(stop = 1 s, tolerance = 1e-11);
        end Table;
        """)
    stops = [event.time for event in result.events]
    assert stops == pytest.approx([0.339789330615018688] * 4, abs=1e-10)
    way = 0.169894665307509344
    place = [float(result[f"b.position.{axis}"][-1]) for axis in "xy"]
    assert place == pytest.approx([0.6 * way, 0.8 * way], abs=1e-9)
    total = sum(float(result[f"c[{k}].normal_force"][-1]) for k in range(1, 5))
    assert total == pytest.approx(2 * 9.81, rel=1e-12)
