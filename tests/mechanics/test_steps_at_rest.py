"""While all rests, steps follow what the forces do, whatever the scale of time."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

import frot

BOUND = 0.3 * 9.81
TEXT = """planar model Loaded
  parameter Time T = 1 s;
  parameter Time centre = 0.5 s;
  parameter Time width = 0.1 s;
  parameter Force peak = 5 N;
  body b: particle(mass = 1 kg);
  liaison c: contact_ponctuel(b, ground.line) with coulomb(0.3);
  force f: on(b, value = ({load}, 0 N));
  {experiment}
end Loaded;
"""
LOADS = {
    "bell": "peak*exp(-((time - centre)/width)^2)",
    "sech": "peak/cosh((time - centre)/width)^2",
    "hill": "peak/(1 + ((time - centre)/width)^4)",
    "sine": "peak*sin(time/width)",
    "growing": "peak*(exp(time/width) - 1)",
    "cubic": "peak*(time/width)^3",
}
SCALES = [1e-9, 1e-3, 1.0, 100.0, 1e9]


@functools.lru_cache(maxsize=16)
def loaded(load: str, experiment: str = "experiment(stop = T);") -> frot.Model:
    return frot.compile(TEXT.format(load=LOADS[load], experiment=experiment))


def breakaway(load: str, at: float, width: float, peak: float) -> float:
    """When the load reaches mu m g."""
    part = BOUND / peak
    return {
        "bell": lambda: at - width * math.sqrt(-math.log(part)),
        "sech": lambda: at - width * math.acosh(1 / math.sqrt(part)),
        "hill": lambda: at - width * (1 / part - 1) ** 0.25,
        "sine": lambda: width * math.asin(part),
        "growing": lambda: width * math.log1p(part),
        "cubic": lambda: width * part ** (1 / 3),
    }[load]()


def first_slip(result: frot.Result) -> float:
    slips = [e.time for e in result.events if e.kind == "slip"]
    assert slips, "the load was passed over"
    return float(slips[0])


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("load", ["bell", "sech", "hill"])
@pytest.mark.parametrize("part", [1e-4, 1e-3, 1e-2])
def test_a_load_of_a_ten_thousandth_of_the_run_is_found_wherever_it_lies(
    scale: float, load: str, part: float
) -> None:
    width = part * scale
    for k in range(12):
        at = scale * (0.03 + 0.9 * (k * 0.6180339887 % 1))
        result = loaded(load).simulate(
            parameters={"T": scale, "centre": at, "width": width}, tolerance=1e-9
        )
        assert abs(first_slip(result) - breakaway(load, at, width, 5)) < 1e-8 * width + 1e-14 * at
        assert result.figures.evaluations < 5000


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-5])
def test_a_short_load_that_barely_reaches_the_bound_is_followed_at_any_tolerance(
    tolerance: float,
) -> None:
    """The stages of one step may all lie beside its top, where their errors seem to be none."""
    for k in range(80, 170):
        at, width = 0.1 + 0.8 * (k * 0.6180339887 % 1), 10 ** (-3 + 2 * (k * 0.7548776662 % 1))
        peak = BOUND * (1.02, 1.15)[k % 2]
        result = loaded("bell").simulate(
            parameters={"T": 1, "centre": at, "width": width, "peak": peak}, tolerance=tolerance
        )
        assert abs(first_slip(result) - breakaway("bell", at, width, peak)) < 1e-2 * width


def test_a_bell_of_10_ms_in_100_s_that_barely_reaches_the_bound() -> None:
    peak = BOUND * (1 + 1e-6)
    result = loaded("bell").simulate(
        parameters={"T": 100, "centre": 37.123, "width": 5e-3, "peak": peak}, tolerance=1e-12
    )
    assert first_slip(result) == pytest.approx(breakaway("bell", 37.123, 5e-3, peak), abs=1e-7)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("load", ["sine", "growing", "cubic"])
@pytest.mark.parametrize("part", [1e-3, 0.1, 0.5])
def test_sines_and_growing_loads_break_away_in_time(scale: float, load: str, part: float) -> None:
    width = part * scale
    exact = breakaway(load, 0, width, 5)
    result = loaded(load).simulate(
        stop=2 * exact, parameters={"T": scale, "width": width}, tolerance=1e-9
    )
    assert abs(first_slip(result) - exact) < 1e-8 * exact


@pytest.mark.parametrize("part", [2e-3, 0.1, 3.0])
def test_steps_are_of_the_order_of_a_part_of_the_period(part: float) -> None:
    """A sine that never breaks away, over a thousandth of the run to more than all of it."""
    result = loaded("sine").simulate(
        stop=1000.0, parameters={"T": 1000, "width": 1000 * part / (2 * math.pi), "peak": 1}
    )
    assert not result.events
    assert result.figures.steps < 150 + 60 / part


@pytest.mark.parametrize("stop", [1e-9, 1.0, 1e3, 1e9])
@pytest.mark.parametrize("load", ["bell", "sine"])
def test_without_an_experiment_the_scale_is_that_of_what_has_been_run(
    stop: float, load: str
) -> None:
    """The text is silent: steps start below every scale of time and grow with the run."""
    at, width = 0.4 * stop, {"bell": 1e-3, "sine": 0.3}[load] * stop
    result = loaded(load, "").simulate(stop=stop, parameters={"centre": at, "width": width})
    assert abs(first_slip(result) - breakaway(load, at, width, 5)) < 1e-6 * width
    assert result.figures.evaluations < 10_000


def test_a_run_beyond_the_experiment_keeps_its_scale() -> None:
    model = loaded("bell")
    result = model.simulate(stop=1000.0, parameters={"T": 1, "centre": 777.7, "width": 0.2})
    assert first_slip(result) == pytest.approx(breakaway("bell", 777.7, 0.2, 5), abs=1e-7)
    quiet = model.simulate(
        stop=1000.0, parameters={"T": 1, "centre": 777.7, "width": 0.2, "peak": 1}
    )
    assert not quiet.events and quiet.figures.evaluations < 5000


def test_what_is_shorter_than_any_sampling_is_found_with_max_step() -> None:
    """A millionth of the run."""
    model = loaded("bell", "experiment(stop = 1 s, max_step = 20 us);")
    result = model.simulate(parameters={"centre": 0.0123456, "width": 1e-6}, stop=0.02)
    assert first_slip(result) == pytest.approx(breakaway("bell", 0.0123456, 1e-6, 5), rel=1e-9)


def test_max_step_bounds_every_step_and_must_be_positive() -> None:
    at_rest = TEXT.format(load="0 N", experiment="experiment(stop = 1 s, max_step = 10 ms);")
    assert frot.compile(at_rest).simulate().figures.steps >= 100
    with pytest.raises(frot.FrotError, match="max_step"):
        frot.compile(TEXT.format(load="0 N", experiment="experiment(max_step = 0 s);")).simulate()


def test_a_block_that_glides_meets_a_short_load_too() -> None:
    """No friction: a bell of 20 ms in 100 s gives it the impulse F w sqrt(pi)."""
    model = frot.compile(
        "planar model Gliding\n  body b: particle(mass = 2 kg);\n"
        "  liaison c: point_courbe(b, ground.line);\n"
        "  force f: on(b, value = (30 N*exp(-((time - 61.7 s)/(10 ms))^2), 0 N));\n"
        "initial\n  b.velocity = (1, 0) m/s;\n  experiment(stop = 100 s);\nend Gliding;\n"
    )
    speed = 1 + 30 * 0.01 * math.sqrt(math.pi) / 2
    assert model.simulate().at(100.0)["b.velocity.x"] == pytest.approx(speed, rel=1e-7)


@pytest.mark.parametrize("method", ["auto", "explicit", "implicit"])
def test_a_state_of_equations_meets_a_short_load_too(method: str) -> None:
    model = frot.compile(
        "model Filtered\n  Real x;\ninitial\n  x = 0;\nequation\n"
        "  der(x)*(10 s) = -x + 5*exp(-((time - 43.21 s)/(10 ms))^2);\n"
        f"  experiment(stop = 100 s, method = {method});\nend Filtered;\n"
    )
    x = model.simulate().at(50.0)["x"]
    kick = 5 * 0.01 * math.sqrt(math.pi) / 10 * math.exp((0.01 / 10) ** 2 / 4)
    assert x == pytest.approx(kick * math.exp(-(50 - 43.21) / 10), rel=1e-5)


def test_a_run_in_pieces_has_the_bits_of_the_whole_run() -> None:
    from frot.runtime.engine import Engine

    program = loaded("bell").program()
    runs = []
    for times in ([1.0], np.linspace(0, 1, 77)[1:]):
        engine = Engine(program)
        engine.start(0.0, 1e-8, "rest")
        runs.append(np.concatenate([engine.advance(t).segments for t in times]))
    assert np.array_equal(runs[0].view(np.uint64), runs[1].view(np.uint64))


@pytest.mark.parametrize("start", [-1.0, -5.0, 1.0, 1e6])
def test_a_run_may_start_anywhere_without_an_experiment(start: float) -> None:
    model = loaded("sine", "")
    result = model.simulate(start=start, stop=start + 1, parameters={"peak": 2.0})
    assert not result.events
    assert result.figures.steps < 500
    moving = model.simulate(start=start, stop=start + 1)
    assert moving.events[0].time == pytest.approx(
        start + (0.1 * math.asin(BOUND / 5) - start) % (0.1 * math.pi),
        abs=1e-6 + 1e-12 * abs(start),
    )


def test_what_no_time_moves_needs_no_more_steps_in_a_run_that_no_text_tells() -> None:
    model = frot.compile("""planar model Slides
  body b: particle(mass = 1 kg);
  liaison c: contact_ponctuel(b, ground.line) with coulomb(0.2);
initial
  b.velocity.x = 2e5 m/s;
end Slides;
""")
    result = model.simulate(stop=2e5)
    assert result.figures.steps < 200
    assert result.events[0].time == pytest.approx(2e5 / (0.2 * 9.81), rel=1e-6)
