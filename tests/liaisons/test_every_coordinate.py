"""Every coordinate of every liaison: driven, bounded, read in the text and in the result.

Each is obeyed or refused by a message. What a coordinate is follows here from the places of bodies
alone, by plain geometry.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import pytest
from frot.dsl.catalogue import LIAISONS, coordinates_of
from frot.dsl.catalogue.laws import STOPPED

import frot
from tests.liaisons.table import JOINTS
from tests.space.newton_euler import axes, orientation, vector

R = 0.2  # radius (m) of balls and discs; half of the height of boxes
WIDE = 2.0  # radius (m) of the circle
REFUSED = {
    (False, "spherique", "orientation"),
    (False, "libre", "orientation"),
}
UNITS = {"angle": "1", "angle_a": "1", "angle_b": "1", "u": "1", "speed_angle": "1 rad/s"}
SWING = "(0.3 + 0.2*sin(time/(1 s)))"
BOX = {
    True: "box(mass = 1 kg, size = (0.3, 0.4) m)",
    False: "box(mass = 1 kg, size = (0.2, 0.3, 0.4) m)",
}
ROUND = {True: "disc(mass = 1 kg, radius = 0.2 m)", False: "sphere(mass = 1 kg, radius = 0.2 m)"}
FRAMES = {
    True: "frame f on ground at (0.1, 0.2) m rotated(angle = 0.4);",
    False: "frame f on ground at (0.1, 0.2, 0.3) m rotated(axis = (1, 2, 3), angle = 0.4);",
}
TILT = np.array([1, 2, 3]) / np.sqrt(14)
LOCAL = {True: "(0.05, 0.1)", False: "(0.05, 0.1, 0.15)"}
OPTIONS = {"tige": ", length = 0.3 m", "fil": ", length = 0.3 m", "helicoidale": ", pitch = 0.1 m"}


def cases(planar: bool) -> Iterator[tuple[str, str]]:
    """All kinds with all their coordinates."""
    for kind in LIAISONS.values():
        if not planar or kind.relations_planar is not None:
            yield from ((kind.name, name) for name in coordinates_of(kind, planar))


def value(kind: str, name: str) -> str:
    """What a coordinate is driven to be."""
    if name == "angular_velocity":
        return f"(0.5, {SWING}, 1)*(1 rad/s)"
    if name == "speed":
        return f"{SWING}*({'1 m/s' if 'displacement' in LIAISONS[kind].coordinates else '1 rad/s'})"
    return f"{SWING}*({UNITS.get(name, '1 m')})"


def places(planar: bool, kind: str, name: str) -> tuple[str, str]:
    """The body of a scene, and what its liaison joins."""
    ground = "ground.line" if planar else "ground.plane"
    match kind:
        case "contact_ponctuel":
            return ROUND[planar], f"{ground}, b_{name}.{'rim' if planar else 'surface'}"
        case "appui_faces":
            return BOX[planar], f"b_{name}.bottom, {ground}"
        case "point_courbe":
            return BOX[planar], f"g_{name}, wide"
    return BOX[planar], f"f, g_{name}{OPTIONS.get(kind, '')}"


def scene(planar: bool, kind: str, name: str, after: str, start: str = "") -> str:
    """A body with a frame, and its liaison."""
    own = f"{kind}_{name}".rstrip("_")
    body, joined = places(planar, kind, own)
    return f"""
  body b_{own}: {body};
  frame g_{own} on b_{own} at {LOCAL[planar]} m;
  liaison k_{own}: {kind}({joined}){after};{start}"""


def model(planar: bool, parts: str, initial: str = "") -> str:
    word = "planar " if planar else ""
    return f"""
{word}model M
  {FRAMES[planar]}
  curve wide on ground: circle(radius = {WIDE} m);{parts}
initial{initial}
  experiment(stop = 0.5 s, tolerance = 1e-10);
end M;
"""


def guessed(planar: bool, scenes: Sequence[tuple[str, str]]) -> str:
    """Bodies that touch planes begin above them: gaps count on the side where these are."""
    place = "(0.1, 0.5)" if planar else "(0.1, 0.1, 0.5)"
    near = [x for x in scenes if "gap" in LIAISONS[x[0]].coordinates]
    return "".join(f"\n  guess(b_{kind}_{name}.position = {place} m);" for kind, name in near)


def measured(at: object, planar: bool, kind: str, name: str, own: str = "") -> float | np.ndarray:
    """A coordinate by the places and velocities of the body."""
    own = own or f"b_{kind}_{name}"
    if planar:
        tilt, turn = 0.4, at[f"{own}.angle"]  # type: ignore[index]
        there = np.array([at[f"{own}.position.{c}"] for c in "xy"])  # type: ignore[index]
        speed = np.array([at[f"{own}.velocity.{c}"] for c in "xy"])  # type: ignore[index]
        rate = at[f"{own}.angular_velocity"]  # type: ignore[index]
        c, s = np.cos(turn), np.sin(turn)
        arm = np.array([[c, -s], [s, c]]) @ (0.05, 0.1)
        first = np.array([[np.cos(tilt), -np.sin(tilt)], [np.sin(tilt), np.cos(tilt)]])
        moves = first.T @ (speed + rate * np.array([-arm[1], arm[0]]))
        apart, angle, height = first.T @ (there + arm - (0.1, 0.2)), turn - tilt, there[1]
        about: float | np.ndarray = rate
        relative = np.eye(3)
    else:
        own_axes = axes(orientation(at, own))
        first = axes(np.array([np.cos(0.2), *(np.sin(0.2) * TILT)]))
        there, arm = vector(at, f"{own}.position"), own_axes @ (0.05, 0.1, 0.15)
        spin = vector(at, f"{own}.angular_velocity")
        moves = first.T @ (vector(at, f"{own}.velocity") + np.cross(spin, arm))
        apart, relative = first.T @ (there + arm - (0.1, 0.2, 0.3)), first.T @ own_axes
        angle = np.arctan2(relative[1, 0], relative[0, 0])
        height, about = there[2], (first.T @ spin)[2]
        if name == "angular_velocity":
            return spin
    slide = 2 if kind == "verrou" else 0
    match name:
        case "angle_a":
            return float(np.arctan2(-relative[0, 1], relative[1, 1]))
        case "angle_b":
            return float(np.arctan2(-relative[2, 0], relative[2, 2]))
        case "displacement":
            return float(apart[slide])
        case "speed" if "displacement" in LIAISONS[kind].coordinates:
            return float(moves[slide])
        case "speed" | "speed_angle":
            return about
        case "x" | "y" | "z":
            return float(apart["xyz".index(name)])
        case "length":
            return float(np.linalg.norm(apart))
        case "gap":
            return float(height - R)
        case "u" | "abscissa":
            on_circle = there + arm
            u = float(np.arctan2(on_circle[1], on_circle[0]))
            return u if name == "u" else WIDE * u
    return float(angle)


@pytest.mark.parametrize("planar", [True, False])
def test_a_driven_coordinate_is_obeyed_or_refused(planar: bool) -> None:
    """At each instant it has the value that is prescribed. `test_table.py` tries the others."""
    known = () if planar else [(kind, name) for kind, row in JOINTS.items() for name in row.driven]
    obeyed = [x for x in cases(planar) if (planar, *x) not in REFUSED and x not in known]
    parts = "".join(
        scene(planar, kind, name, f" driven({name} = {value(kind, name)})") for kind, name in obeyed
    )
    run = frot.compile(model(planar, parts, guessed(planar, obeyed))).simulate()
    for t in (0.0, 0.5):
        at, told = run.at(t), 0.3 + 0.2 * np.sin(t)
        for kind, name in obeyed:
            want = np.array([0.5, told, 1.0]) if name == "angular_velocity" else told
            got = measured(at, planar, kind, name)
            assert got == pytest.approx(want, abs=1e-8), (kind, name, t)
    for _, kind, name in (x for x in REFUSED if x[0] == planar):
        text = model(planar, scene(planar, kind, name, f" driven({name} = (1, 0, 0, 0))"))
        with pytest.raises(frot.FrotError, match="cannot be driven"):
            frot.compile(text).report()


TYPES = {"x": "Length", "y": "Length", "z": "Length", "speed_angle": "AngularVelocity"}
TYPES |= dict.fromkeys(("length", "gap", "displacement", "abscissa"), "Length")
TYPES["angular_velocity"] = "AngularVelocity"


def declared(kind: str, name: str) -> str:
    """An output that reads a coordinate."""
    slides = "displacement" in LIAISONS[kind].coordinates
    of = ("Velocity" if slides else "AngularVelocity") if name == "speed" else TYPES.get(name)
    size = "[4]" if name == "orientation" else ""
    return f"\n  output {of or 'Real'} o_{kind}_{name}{size} = k_{kind}.{name};"


@pytest.mark.parametrize("planar", [True, False])
def test_a_coordinate_reads_alike_in_text_and_result(planar: bool) -> None:
    """And as the body stands that falls, by its place and its velocities."""
    parts, initial = "", ""
    for kind in dict.fromkeys(kind for kind, _ in cases(planar)):
        parts += scene(planar, kind, "", "")
        initial += (
            f"\n  guess(b_{kind}.position = {'(0.1, 0.5)' if planar else '(0.1, 0.1, 0.5)'} m);"
        )
    parts += "".join(declared(kind, name) for kind, name in cases(planar))
    run = frot.compile(model(planar, parts, initial)).simulate()
    at = run.at(0.5)
    for kind, name in cases(planar):
        tails = {"orientation": [f"[{k}]" for k in (1, 2, 3, 4)]}.get(name, [""])
        tails = [".x", ".y", ".z"] if name == "angular_velocity" else tails
        for tail in tails:
            assert np.array_equal(run[f"k_{kind}.{name}{tail}"], run[f"o_{kind}_{name}{tail}"])
        got = np.array([at[f"o_{kind}_{name}{tail}"] for tail in tails])
        if name == "orientation":
            first = axes(np.array([np.cos(0.2), *(np.sin(0.2) * TILT)]))
            assert first @ axes(got) == pytest.approx(axes(orientation(at, f"b_{kind}")), abs=1e-12)
        else:
            want = np.atleast_1d(measured(at, planar, kind, name, f"b_{kind}"))
            turns = 2 * np.pi if name.startswith("angle") and name != "angular_velocity" else np.inf
            off = got - want if turns == np.inf else (got - want + np.pi) % turns - np.pi
            assert np.abs(off).max() < 1e-10, (kind, name)


@pytest.mark.parametrize("planar", [True, False])
def test_stops_of_a_coordinate_hold_or_are_refused(planar: bool) -> None:
    """What is pushed stops at its bound; what is kept, or is no place, is refused."""
    refused = [x for x in cases(planar) if x[1] not in STOPPED or x == ("tige", "length")]
    obeyed = [x for x in cases(planar) if x not in refused and x[1] != "gap"]
    parts, initial = "", ""
    for kind, name in obeyed:
        unit = UNITS.get(name, "m").removeprefix("1 ").replace("1", "")
        law = f" with stops(min = 0.1 {unit}, max = 0.2 {unit}, coordinate = {name})"
        parts += scene(planar, kind, name, law)
        initial += f"\n  k_{kind}_{name}.{name} = 0.15 {unit};"
    run = frot.compile(model(planar, parts, initial)).simulate()
    met = 0
    for kind, name in obeyed:
        values = [measured(run.at(t), planar, kind, name) for t in run.time[::25]]
        assert min(values) > 0.1 - 1e-8, (kind, name)
        assert max(values) < 0.2 + 1e-8, (kind, name)
        met += any(abs(x - 0.1) < 1e-8 or abs(x - 0.2) < 1e-8 for x in values)
    assert met > 0.6 * len(obeyed)
    for kind, name in refused:
        unit = "" if UNITS.get(name) == "1" else "m"
        law = f" with stops(min = 0.1 {unit}, max = 0.2 {unit}, coordinate = {name})"
        with pytest.raises(frot.FrotError, match=r"E0404|E0301|E0511"):
            frot.compile(model(planar, scene(planar, kind, name, law))).report()
