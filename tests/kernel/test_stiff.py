"""Stiff equations: the implicit method and the choice between it and the explicit one.

Reference values: F. Mazzia, C. Magherini, Test Set for Initial Value Problem Solvers, 2008
(Robertson, HIRES, van der Pol); closed forms; SciPy at the end of its accuracy.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from frot.runtime.engine import OK, Engine, Run
from records import IMPLICIT, records
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import frot

MODELS = Path(__file__).parents[2] / "models"

NUMBERS = """  constant AngularVelocity one = 1 s^-1;
"""


def text(
    declarations: str, initial: str, equations: str, method: str = "auto", stop: float = 1.0
) -> str:
    return (
        f"planar model Stiff\n{NUMBERS}{declarations}\ninitial\n{initial}\n"
        f"equation\n{equations}\n  experiment(stop = {stop!r} s, method = {method});\nend Stiff;\n"
    )


def engine(source: str, tolerance: float) -> Engine:
    made = Engine(frot.compile(source).program())
    assert made.start(0.0, tolerance, "rest") == OK, made.fault_text
    return made


def run(made: Engine, stop: float) -> Run:
    done = made.advance(stop)
    assert done.status == OK, made.fault_text
    return done


def values(made: Engine, done: Run, times: object) -> np.ndarray:
    return made.sample(done.record, np.asarray(times, dtype=float))


def solved(source: str, tolerance: float, times: object) -> tuple[np.ndarray, Engine]:
    made = engine(source, tolerance)
    done = run(made, float(np.max(times)))
    return values(made, done, times), made


def robertson(method: str, stop: float) -> str:
    return text(
        "  Real a; Real b; Real c;",
        "  a = 1; b = 0; c = 0;",
        "  der(a) = one*(-0.04*a + 1e4*b*c);\n"
        "  der(b) = one*(0.04*a - 1e4*b*c - 3e7*b^2);\n"
        "  der(c) = one*3e7*b^2;",
        method,
        stop,
    )


def van_der_pol(mu: float, method: str, stop: float) -> str:
    return text(
        f"  parameter Real mu = {mu!r};\n  Real x; Real y;",
        "  x = 2; y = 0;",
        "  der(x) = one*y;\n  der(y) = one*(mu*(1 - x^2)*y - x);",
        method,
        stop,
    )


def relaxing(method: str, rate: float = 1e4, start: float = 0.0, stop: float = 10.0) -> str:
    """x follows cos t, which is exact but for exp(-rate t)."""
    return text(
        f"  parameter Real rate = {rate!r};\n  Real x;",
        f"  x = {start!r};",
        "  der(x) = -one*(rate*(x - cos(one*time)) + sin(one*time));",
        method,
        stop,
    )


@pytest.mark.parametrize("method", ["auto", "implicit"])
@pytest.mark.parametrize("tolerance", [1e-5, 1e-8, 1e-11])
def test_robertson_to_the_end_of_the_reaction(method: str, tolerance: float) -> None:
    end = np.array([0.2083340149701255e-7, 0.8333360770334713e-13, 0.9999999791665050])
    found, made = solved(robertson(method, 1e11), tolerance, [1e11])
    assert np.all(np.abs(found[0] - end) <= tolerance * end)  # each by itself, small as it is
    assert made.statistics.steps < 45 * tolerance ** (-1 / 5)


def test_hires() -> None:
    """Eight reactions of a morphogen in light."""
    rates = [
        "-1.71*y[1] + 0.43*y[2] + 8.32*y[3] + 0.0007",
        "1.71*y[1] - 8.75*y[2]",
        "-10.03*y[3] + 0.43*y[4] + 0.035*y[5]",
        "8.32*y[2] + 1.71*y[3] - 1.12*y[4]",
        "-1.745*y[5] + 0.43*y[6] + 0.43*y[7]",
        "-280*y[6]*y[8] + 0.69*y[4] + 1.71*y[5] - 0.43*y[6] + 0.69*y[7]",
        "280*y[6]*y[8] - 1.81*y[7]",
        "-280*y[6]*y[8] + 1.81*y[7]",
    ]
    source = text(
        "  Real y[8];",
        "  y[1] = 1; y[8] = 0.0057;" + "".join(f" y[{k}] = 0;" for k in range(2, 8)),
        "\n".join(f"  der(y[{k}]) = one*({rate});" for k, rate in enumerate(rates, 1)),
        "auto",
        321.8122,
    )
    end = [
        *(0.7371312573325668e-3, 0.1442485726316185e-3, 0.5888729740967575e-4),
        *(0.1175651343283149e-2, 0.2386356198831331e-2, 0.6238968252742796e-2),
        *(0.2849998395185769e-2, 0.2850001604814231e-2),
    ]
    found, made = solved(source, 1e-9, [321.8122])
    assert np.abs(found[0] - end).max() <= 1e-9
    assert 0 < made.statistics.implicit_steps < made.statistics.steps


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_van_der_pol_goes_from_one_method_to_the_other_and_back(tolerance: float) -> None:
    end = [0.1706167732170483e1, -0.8928097010247975e-3]
    made = engine(van_der_pol(1e3, "auto", 2000.0), tolerance)
    done = run(made, 2000.0)
    found = values(made, done, [2000.0])
    assert np.abs(found[0] - end)[0] <= 10 * tolerance
    assert np.abs(found[0] - end)[1] <= 10 * tolerance * 1.4e3
    # the dense output of an implicit step is recorded, whose last three vectors are zero
    steps = records(done.segments)
    implicit = np.array([step[2] == IMPLICIT for step in steps])
    assert np.count_nonzero(implicit) == made.statistics.implicit_steps
    assert not implicit[0]
    changes = np.count_nonzero(implicit[1:] != implicit[:-1])
    assert changes >= 5  # into the slow branch, and twice out of one and into the next


def test_what_is_started_again_runs_as_at_first() -> None:
    """A rate of the run before is none of this one's."""
    made = engine(robertson("auto", 1e11), 1e-4)
    first = run(made, 1e11)
    assert made.start(0.0, 1e-4, "rest") == OK
    assert np.array_equal(run(made, 1e11).segments, first.segments)


@pytest.mark.parametrize("mu", [1e4, 1e6])
def test_van_der_pol_on_its_slow_branch(mu: float) -> None:
    """There log x - x^2/2 = t/mu + const to the second order in 1/mu."""
    start = np.log(2) - 2
    times = mu * np.linspace(0.05, 0.75, 8)
    exact = [brentq(lambda x, t=t: np.log(x) - x * x / 2 - start - t / mu, 1.0, 2.0) for t in times]
    found, made = solved(van_der_pol(mu, "auto", 0.75 * mu), 1e-7, times)
    assert np.abs(found[:, 0] - exact).max() <= 1e-7 + 10 / mu**2
    assert made.statistics.steps < 400


def test_a_linear_system_with_rates_from_1_to_1e6() -> None:
    rates = np.array([-1.0, -1e3, -1e6])
    # a matrix far from normal: its eigenvectors are nearly parallel
    vectors = np.array([[1.0, 1.0, 1.0], [1.0, 1.1, 1.3], [1.0, 0.9, 1.2]])
    matrix = vectors @ np.diag(rates) @ np.linalg.inv(vectors)
    equations = "\n".join(
        f"  der(x[{i + 1}]) = one*("
        + " + ".join(f"({float(matrix[i, j])!r})*x[{j + 1}]" for j in range(3))
        + ");"
        for i in range(3)
    )
    start = vectors @ np.ones(3)
    source = text(
        "  Real x[3];",
        " ".join(f" x[{i + 1}] = {float(x)!r};" for i, x in enumerate(start)),
        equations,
        "auto",
        5.0,
    )
    times = np.concatenate([[1e-6, 1e-4, 1e-2], np.linspace(0.1, 5, 21)])
    found, made = solved(source, 1e-9, times)
    exact = np.exp(np.outer(times, rates)) @ vectors.T
    # rounding of the matrix times its condition is 1e-9 of the fast parts
    assert np.abs(found - exact).max() <= 5e-8
    assert made.statistics.steps < 2000


TOLERANCES = 10.0 ** -np.arange(4, 12)


def order_of(errors: list[float]) -> float:
    """Decades of the error for a decade of the tolerance."""
    return float(np.polyfit(np.log10(TOLERANCES), np.log10(errors), 1)[0])


@pytest.mark.parametrize("small", [1.0, 1e-2, 1e-4])
def test_the_error_follows_the_tolerance_in_a_stiff_problem(small: float) -> None:
    """P. Kaps: x = exp(-2 t), y = exp(-t) whatever the stiffness 1/small."""
    source = text(
        f"  parameter Real small = {small!r};\n  Real x; Real y;",
        "  x = 1; y = 1;",
        "  der(x) = one*(-(1/small + 2)*x + y^2/small);\n  der(y) = one*(x - y - y^2);",
        "implicit",
        2.0,
    )
    times = np.linspace(0, 2, 41)
    exact = np.exp(-np.outer(times, [2, 1]))
    errors = [float(np.abs(solved(source, t, times)[0] - exact).max()) for t in TOLERANCES]
    assert 0.85 < order_of(errors) < 1.2
    assert max(np.array(errors) / TOLERANCES) < 5


def test_the_error_follows_the_tolerance_where_errors_grow() -> None:
    """Van der Pol with mu = 5, whose jumps turn an error into a delay 40 times as large."""
    times = np.linspace(0, 20, 41)
    exact = solve_ivp(
        lambda t, x: [x[1], 5 * (1 - x[0] ** 2) * x[1] - x[0]],
        (0, 20),
        [2.0, 0.0],
        method="DOP853",
        rtol=3e-14,
        atol=1e-15,
        t_eval=times,
    ).y.T[:, 0]
    source = van_der_pol(5.0, "implicit", 20.0)
    errors = [float(np.abs(solved(source, t, times)[0][:, 0] - exact).max()) for t in TOLERANCES]
    assert 0.8 < order_of(errors) < 1.2
    assert max(np.array(errors) / TOLERANCES) < 100


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10, 1e-12])
@pytest.mark.parametrize("method", ["auto", "implicit"])
def test_a_fast_state_that_follows_a_slow_one(method: str, tolerance: float) -> None:
    """A. Prothero, A. Robinson, 1974. Between the steps the dense output is as exact."""
    times = np.linspace(0, 10, 1009)
    found, made = solved(relaxing(method), tolerance, times)
    exact = np.cos(times) - np.exp(-1e4 * times)
    assert np.abs(found[:, 0] - exact).max() <= 20 * tolerance
    assert made.statistics.steps < 3000


def test_a_threshold_inside_a_long_implicit_step() -> None:
    source = text(
        "  Real x; Real y;",
        "  x = 0; y = 0;",
        "  der(x) = -one*(1e5*(x - cos(one*time)) + sin(one*time));\n"
        "  der(y) = if x > 0.5 then one else -2*one;",
        "implicit",
        1000.0,
    )
    tolerance = 1e-9
    made = engine(source, tolerance)
    done = run(made, 10.0)
    first = np.arccos(0.5)
    # x passes 0.5 upwards at the start, in the fast transient
    expected = [np.log(2) / 1e5, first, 2 * np.pi - first, 2 * np.pi + first]
    times = [e.t for e in done.events if e.t > 0]
    assert times == pytest.approx(expected, abs=100 * tolerance)
    assert made.statistics.implicit_steps == made.statistics.steps
    up = first - expected[0]
    y = values(made, done, [1.0, first + 1.0, 6.0])[:, 1]
    y1 = -2 * expected[0] + (1.0 - expected[0])
    y2 = -2 * expected[0] + up - 2.0
    y3 = -2 * expected[0] + up - 2 * (2 * np.pi - 2 * first) + (6.0 - (2 * np.pi - first))
    assert y == pytest.approx([y1, y2, y3], abs=100 * tolerance)


def test_a_short_dip_below_a_threshold_is_not_stepped_over() -> None:
    """While the fast state rests, nothing but the guard asks for short steps."""
    source = text(
        "  Real x; Real y;",
        "  x = 1; y = 0;",
        "  der(x) = -one*1e5*(x - 1);\n  der(y) = if sin(one*time) < 0.999 then one else -one;",
        "implicit",
        100.0,
    )
    made = engine(source, 1e-6)
    times = [e.t for e in run(made, 100.0).events if e.t > 0]
    edge = np.arcsin(0.999)
    expected = [2 * np.pi * k + t for k in range(16) for t in (edge, np.pi - edge)]
    assert times == pytest.approx(expected, abs=1e-9)


def test_a_ladder_against_its_eigenvectors() -> None:
    n = 60
    source = text(
        f"  constant Integer n = {n};\n  Real u[n];",
        "",
        "  der(u[1]) = one*(1 - 2*u[1] + u[2]);\n"
        "  for i in 2:n - 1 loop\n    der(u[i]) = one*(u[i - 1] - 2*u[i] + u[i + 1]);\n"
        "  end for;\n  der(u[n]) = one*(u[n - 1] - u[n]);",
        "auto",
        2e4,
    ).replace("\ninitial\n\n", "\n")
    times = np.array([1.0, 10.0, 100.0, 1e3, 1e4, 2e4])
    matrix = np.diag([-2.0] * n) + np.diag([1.0] * (n - 1), 1) + np.diag([1.0] * (n - 1), -1)
    matrix[-1, -1] = -1
    rates, vectors = np.linalg.eigh(matrix)
    start = vectors.T @ -np.ones(n)
    exact = np.array([1 + vectors @ (np.exp(rates * t) * start) for t in times])
    for tolerance in (1e-6, 1e-9, 1e-12):
        found, made = solved(source, tolerance, times)
        assert np.abs(found - exact).max() <= 50 * tolerance
        assert made.statistics.implicit_steps > 0


def test_equations_that_no_formula_solves_are_condensed() -> None:
    """y + y^3 = x feeds back on x; an index-1 system of differential and algebraic equations."""
    source = text(
        "  Real x; Real y; Real z;",
        "  x = 2; z = 0; guess(y = 1);",
        "  der(x) = -one*1e4*(y - cos(one*time));\n  y + y^3 = x + 0.1*sin(y);\n"
        "  der(z) = one*(y - z);",
        "implicit",
        3.0,
    )

    def solve(x: float) -> float:
        return float(brentq(lambda y: y + y**3 - x - 0.1 * np.sin(y), -5, 5, xtol=1e-15))

    times = np.array([1e-4, 1e-3, 0.5, 1.5, 3.0])
    exact = solve_ivp(
        lambda t, s: [-1e4 * (solve(s[0]) - np.cos(t)), solve(s[0]) - s[1]],
        (0, 3.0),
        [2.0, 0.0],
        method="Radau",
        rtol=1e-11,
        atol=1e-12,
        t_eval=times,
    ).y.T
    found, made = solved(source, 1e-8, times)
    names = [v.name for v in made.program.variables]
    both = found[:, [names.index("x"), names.index("z")]]
    assert np.abs(both - exact).max() <= 1e-7
    assert made.statistics.implicit_steps == made.statistics.steps < 1000


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize(
    ("declarations", "initial", "equations"),
    [
        ("  Real x; Real y;", "  x = 1.2; y = 0.7;",
         "  der(x) = one*x*(1 - y);\n  der(y) = one*y*(x - 1);"),
        ("  Real x; Real y;", "  x = 1; y = 0;", "  der(x) = one*y;\n  der(y) = -one*x;"),
        ("  Real x; Real y; Real z;", "  x = 1; y = 1; z = 1;",
         "  der(x) = one*10*(y - x);\n  der(y) = one*(x*(28 - z) - y);\n"
         "  der(z) = one*(x*y - 8*z/3);"),
        ("  Real x;", "  x = 1;", "  der(x) = -one*x;"),
    ],
    ids=["prey", "oscillator", "lorenz", "decay"],
)  # fmt: skip
def test_what_is_not_stiff_pays_nothing(
    declarations: str, initial: str, equations: str, tolerance: float
) -> None:
    made = engine(text(declarations, initial, equations, "auto", 20.0), tolerance)
    run(made, 20.0)
    assert made.statistics.jacobians == made.statistics.implicit_steps == 0


def test_what_stiff_springs_move_is_not_slower_than_by_the_explicit_method() -> None:
    """A flexible slider crank vibrates as fast as explicit steps are stable: longer ones err."""
    text = (MODELS / "flexible_slider_crank.frot").read_text()
    given = text.replace("experiment(", "experiment(method = explicit, ")
    slow, found = (frot.compile(x).simulate(tolerance=1e-6).figures for x in (given, text))
    assert found.steps + found.rejected < 1.1 * (slow.steps + slow.rejected)


@pytest.mark.parametrize("method", ["auto", "implicit"])
def test_a_restored_instance_goes_on_to_the_same_bits(method: str) -> None:
    """Just before, in the middle of and after the changes of method."""
    source = van_der_pol(1e3, method, 2000.0)
    whole = engine(source, 1e-7)
    expected = run(whole, 2000.0).segments
    for t in (1e-3, 1.0, 400.0, 806.0, 807.5, 1500.0):
        made = engine(source, 1e-7)
        made.advance(t)
        saved = made.save()
        first = made.advance(2000.0).segments
        other = Engine(made.program)
        other.restore(saved)
        second = other.advance(2000.0).segments
        assert np.array_equal(first.view(np.uint64), second.view(np.uint64))
        assert np.array_equal(first[-1].view(np.uint64), expected[-1].view(np.uint64))


def test_a_run_in_pieces_is_the_whole_run_to_the_last_bit() -> None:
    source = van_der_pol(1e3, "auto", 2000.0)
    expected = run(engine(source, 1e-7), 2000.0).segments
    pieces = engine(source, 1e-7)
    found = np.concatenate([pieces.advance(t).segments for t in np.linspace(0, 2000, 301)[1:]])
    assert np.array_equal(found.view(np.uint64), expected.view(np.uint64))


def test_the_text_gives_the_method() -> None:
    explicit = engine(relaxing("explicit", 1e3), 1e-6)
    run(explicit, 1.0)
    assert explicit.statistics.implicit_steps == explicit.statistics.jacobians == 0
    assert "frot_jacobian_at" not in explicit.program.source.read_text(encoding="utf-8")
    implicit = engine(relaxing("implicit", 1e3), 1e-6)
    run(implicit, 1.0)
    assert implicit.statistics.implicit_steps == implicit.statistics.steps > 0


def test_what_cannot_be_stiff_has_no_jacobian() -> None:
    program = frot.compile(
        "planar model Block\n  body block: particle(mass = 1 kg);\n"
        "  experiment(stop = 1 s);\nend Block;\n"
    ).program()
    assert "frot_jacobian_at" not in program.source.read_text(encoding="utf-8")
