"""Inputs over time: the run is that of the same function in the text, to rounding."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from in_process import Done, command

import frot

SLED = """
planar model Sled "A sled pushed on a rough floor"
  input Force F(start = 0 N);
  body sled: particle(mass = 2 kg);
  liaison floor: contact_ponctuel(sled, ground.line) with coulomb(0.3);
  force push: on(sled, value = ({F}, 0 N));
  output Force f = {F};
initial
  sled.position = (0, 0) m;
  experiment(stop = 3 s, tolerance = {tolerance});
end Sled;
"""
TIMES, VALUES = [0, 1, 2, 3], [0, 10, -10, 15]
WRITTEN = (
    "(if time < 1 s then time*(10 N/s) elseif time < 2 s then 10 N - (time - 1 s)*(20 N/s)"
    " else -10 N + (time - 2 s)*(25 N/s))"
)


def sled(force: str = "F", tolerance: float = 1e-10) -> frot.Model:
    return frot.compile(SLED.replace("{F}", force).replace("{tolerance}", repr(tolerance)))


def mechanical(result: frot.Result) -> list[tuple[str, float]]:
    """The events of liaisons, without those of the conditions of the text."""
    return [(e.kind, e.time) for e in result.events if e.kind != "condition"]


@pytest.mark.parametrize("tolerance", [1e-6, 1e-12])
def test_a_table_is_the_same_function_in_the_text(tolerance: float) -> None:
    """Steps, evaluations and events are the same; the knots are instants that steps end at."""
    one = sled(tolerance=tolerance).simulate(inputs={"F": (TIMES, VALUES)})
    two = sled(WRITTEN, tolerance).simulate()
    assert one.figures.steps == two.figures.steps
    assert one.figures.evaluations == two.figures.evaluations
    assert len(mechanical(one)) == 5
    for (kind, time), (other, there) in zip(mechanical(one), mechanical(two), strict=True):
        assert kind == other
        assert time == pytest.approx(there, abs=1e-13)
    for name in ("sled.position.x", "sled.velocity.x", "f", "floor.tangential_force"):
        assert one[name] == pytest.approx(two[name], abs=1e-12)
    assert one.balance.relative < 1e-12


def test_breakaway_is_where_the_force_is_the_bound() -> None:
    """F = 10 t reaches mu m g = 5.886 N at t = 0.5886 s."""
    result = sled().simulate(inputs={"F": (TIMES, VALUES)})
    assert result.events[0].time == pytest.approx(0.3 * 2 * 9.81 / 10, abs=1e-14)


def test_values_anywhere_have_the_force_of_that_time() -> None:
    """At any time, at knots, and in another order."""
    result = sled().simulate(inputs={"F": (TIMES, VALUES)})
    times = np.array([2.7, 0.0, 1.0, np.nextafter(1.0, 0), 2.0, 3.0, 0.3])
    assert result.at(times)["f"] == pytest.approx(np.interp(times, TIMES, VALUES), abs=1e-12)
    moving = result.at(np.linspace(0.6, 0.99, 7))
    push = np.linspace(6, 9.9, 7) - 0.3 * 2 * 9.81
    assert moving["sled.acceleration.x"] == pytest.approx(push / 2, abs=1e-11)


def test_a_jump_is_an_event_at_its_time() -> None:
    """From 0 to 8 N at t = 0.7 s: the sled slips from there on, x = (a/2) (t - 0.7)^2."""
    table = ([0, 0.7, 0.7, 3], [0, 0, 8, 8])
    result = sled().simulate(inputs={"F": table})
    (event,) = result.events
    assert (event.kind, event.time) == ("slip", 0.7)
    a = (8 - 0.3 * 2 * 9.81) / 2
    assert result["sled.position.x"][-1] == pytest.approx(a / 2 * 2.3**2, rel=1e-13)


def test_held_values_are_steps() -> None:
    """8 N for a second, then nothing: it slips on for as long as friction needs to stop it."""
    result = sled().simulate(inputs={"F": ([0, 1], [8, 0], "held")})
    a, b = (8 - 0.3 * 2 * 9.81) / 2, 0.3 * 9.81
    assert [e.kind for e in result.events] == ["stick"]
    assert result.events[0].time == pytest.approx(1 + a / b, rel=1e-13)
    assert result.at(np.array([0.5, 1.0, 1.5]))["f"] == pytest.approx([8, 0, 0], abs=0)


def test_a_cubic_spline_gives_back_a_cubic() -> None:
    t = np.linspace(0, 3, 7)
    result = sled().simulate(inputs={"F": (t, 2 * t**3 - 9 * t**2 + 10 * t, "cubic")})
    fine = result.time
    exact = 2 * fine**3 - 9 * fine**2 + 10 * fine
    assert result["f"] == pytest.approx(exact, abs=1e-12)


def test_a_function_is_followed_as_in_the_text() -> None:
    one = sled().simulate(inputs={"F": lambda t: 20 * np.sin(5 * t)})
    two = sled("20 N*sin(5*time/(1 s))").simulate()
    assert one["sled.position.x"] == pytest.approx(two["sled.position.x"], abs=1e-8)
    assert [e.kind for e in one.events] == [e.kind for e in two.events]
    for mine, other in zip(one.events, two.events, strict=True):
        assert mine.time == pytest.approx(other.time, abs=1e-8)


def test_a_function_may_jump() -> None:
    result = sled().simulate(inputs={"F": lambda t: 8.0 if t >= 0.7 else 0.0})
    assert result.events[0].time == pytest.approx(0.7, abs=1e-12)


class Series:
    """As pandas has it: values by an index."""

    def __init__(self, index: list[float], values: list[float]) -> None:
        self.index, self._values = index, values

    def to_numpy(self) -> np.ndarray:
        return np.array(self._values)

    def __iter__(self) -> Any:
        return iter(self._values)


def test_arrays_and_series_are_tables_too() -> None:
    by_lists = sled().simulate(inputs={"F": (TIMES, VALUES)})
    for given in (np.column_stack((TIMES, VALUES)), Series(TIMES, VALUES)):  # type: ignore[arg-type]
        other = sled().simulate(inputs={"F": given})
        assert np.array_equal(other["sled.position.x"], by_lists["sled.position.x"])


DRIVEN = """
planar model Driven "A stick turned as it is told"
  input Angle turn(start = 0);
  body stick: rod(mass = 3 kg, length = 2 m);
  liaison pin: rotoide(ground, stick.start) driven(angle = {turn});
  output Torque couple = pin.torque;
initial
  experiment(stop = 2 s);
end Driven;
"""


def test_an_input_over_time_drives_with_its_rates() -> None:
    """angle = t^3/6 - t^2/4: the couple is I (t - 1/2) + m g l/2 cos(angle), I = m l^2/3."""
    text = DRIVEN.replace("{turn}", "turn")
    try:
        model = frot.compile(text)
        t = np.linspace(0, 2, 5)
        result = model.simulate(inputs={"turn": (t, t**3 / 6 - t**2 / 4, "cubic")})
    except frot.FrotError as error:
        pytest.fail(str(error))
    fine = result.time
    angle = fine**3 / 6 - fine**2 / 4
    assert result["stick.angle"] == pytest.approx(angle, abs=1e-9)
    couple = 3 * 4 / 3 * (fine - 0.5) + 3 * 9.81 * np.cos(angle)
    assert result["couple"] == pytest.approx(couple, abs=1e-7)


def test_a_corner_in_what_is_driven_ends_the_run_by_name() -> None:
    """A straight ramp that begins at once would give the stick its speed in no time."""
    model = frot.compile(DRIVEN.replace("{turn}", "turn"))
    with pytest.raises(frot.SimulationError) as told:
        model.simulate(inputs={"turn": ([0, 1, 2], [0, 0, 1])})
    assert told.value.result is not None
    assert told.value.result.time[-1] == pytest.approx(1.0, abs=1e-12)


def test_the_number_of_points_does_not_grow_the_program() -> None:
    model = sled()
    first = model.simulate(inputs={"F": (TIMES, VALUES)}).program
    t = np.linspace(0, 3, 500)
    second = model.simulate(inputs={"F": (t, np.sin(t))}).program
    assert first.key == second.key


def test_pictures_of_such_a_run_are_drawn(tmp_path: Path) -> None:
    result = sled().simulate(inputs={"F": (TIMES, VALUES)})
    result.view(tmp_path / "sled.png", at=1.5)
    assert (tmp_path / "sled.png").stat().st_size > 1000


BAD = [
    ({"F": ([0, 1, 0.5], [0, 1, 2])}, "go back"),
    ({"F": ([0, 1], [0, float("nan")])}, r"point 2 is \(1 s, nan\)"),
    ({"F": ([0, 1, 3], [0, 1])}, "3 times and 2 values"),
    ({"F": ([0, 1, 1, 1, 3], [0, 1, 2, 3, 4])}, "three values at t = 1 s"),
    ({"F": ([0, 1], [0, 1])}, "from 0 s to 1 s, and the run goes from 0 s to 3 s"),
    ({"F": ([0, 3], [0, 1], "square")}, "the way 'square' is not known"),
    ({"F": np.zeros((4, 3))}, "an array of 3 columns"),
    ({"F": lambda t: 1 / (t - 1.5)}, "gives no number at t = 1.5 s"),
    ({"F": ([0, 3], ["a", "b"])}, "could not convert"),
    ({"G": ([0, 3], [0, 1])}, "no input 'G'"),
]


@pytest.mark.parametrize(("inputs", "words"), BAD, ids=[words for _, words in BAD])
def test_what_is_no_function_of_time_is_refused(inputs: dict[str, object], words: str) -> None:
    with pytest.raises(frot.FrotError, match=words):
        sled().simulate(inputs=inputs)


def simulate(folder: Path, *words: str) -> Done:
    (folder / "sled.frot").write_text(
        SLED.replace("{F}", "F").replace("{tolerance}", "1e-10"), encoding="utf-8"
    )
    return command(folder, "simulate", "sled.frot", *words)


def test_the_shell_takes_a_column_of_a_file_with_its_units(tmp_path: Path) -> None:
    """The same table in ms and kN, its columns in another order."""
    rows = [f"{1000 * t},{v / 1000},x" for t, v in zip(TIMES, VALUES, strict=True)]
    (tmp_path / "force.csv").write_text("time (ms),push [kN],note\n" + "\n".join(rows) + "\n")
    done = simulate(tmp_path, "--input", "F=force.csv:push")
    assert done.returncode == 0, done.stderr
    assert "floor: stick -> slip at t = 0.5886" in done.stdout


@pytest.mark.parametrize(
    ("content", "asked", "words"),
    [
        ("time,F\n0,1\n3,2\n", "force.csv:f", "no column 'f'"),
        ("time,F\n0,1\n3,\n", "force.csv:F", "force.csv:3: column 2 has nothing"),
        ("time,F\n0,1\n3,NaN\n", "force.csv:F", "'NaN', which is no number"),
        ("time,F (kg)\n0,1\n3,2\n", "force.csv:F", "the unit 'kg'"),
        ("time,F\n3,1\n0,2\n", "force.csv:F", "the times go back"),
        ("", "force.csv:F", "is empty"),
        ("time,F\n0,1\n", "none.csv:F", "cannot be read"),
    ],
)
def test_what_is_wrong_in_a_file_is_told(
    tmp_path: Path, content: str, asked: str, words: str
) -> None:
    (tmp_path / "force.csv").write_text(content, encoding="utf-8")
    done = simulate(tmp_path, "--input", f"F={asked}")
    assert done.returncode == 1
    assert words in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("value", [1.0, -1e-3])
def test_an_input_turns_no_driven_stick_at_once(value: float) -> None:
    """Inputs set from outside: what they prescribe would jump, and the old value stays."""
    from frot.runtime.engine import Engine

    program = frot.compile(DRIVEN.replace("{turn}", "turn")).program()
    engine = Engine(program)
    engine.settle_parameters()
    assert engine.start(0.0, 1e-8, "rest") == 0
    engine.advance(1.0)
    engine.set_input(0, value)
    with pytest.raises(frot.FrotError, match="the change of parameters or inputs is refused"):
        engine.settle()
    names = [v.name for v in program.variables]
    assert engine.now()[names.index("stick.angle")] == 0.0
