"""Random models with equations against references of their own.

    python bench/fuzz_equations.py --count 100 --seed 1 --kind circuits

Every model is well posed by its making: a message, a traceback or a wrong value is a fault.
"""

from __future__ import annotations

import argparse
import random
import time
import traceback
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg

import frot

HEAD = "  experiment(stop = 3 s, interval = 0.1 s, tolerance = 1e-10);\n"


@dataclass(frozen=True, slots=True)
class Case:
    """A text, and how far its result is from the reference, over the size of the values."""

    text: str
    error: Callable[[frot.Result], float]


@dataclass(frozen=True, slots=True)
class Wave:
    """a sin(w t + f) + c."""

    a: float
    w: float
    f: float
    c: float

    def text(self, order: int = 0) -> str:
        """The derivative of this order in the language, a number."""
        shift = self.f + order * np.pi / 2
        offset = f" + ({self.c!r})" if order == 0 else ""
        size = self.a * self.w**order
        return f"(({size!r})*sin({self.w!r}*time/(1 s) + ({shift!r})){offset})"

    def value(self, t: np.ndarray, order: int = 0) -> np.ndarray:
        """The derivative of this order at times t."""
        swing = self.a * self.w**order * np.sin(self.w * t + self.f + order * np.pi / 2)
        return swing + (self.c if order == 0 else 0.0)


def draw_wave(draw: random.Random) -> Wave:
    """A wave of size and frequency about one."""
    a = round(draw.uniform(0.3, 1.5), 3) * draw.choice((1, -1))
    w, f, c = draw.uniform(0.5, 3), draw.uniform(-3, 3), draw.uniform(-1, 1)
    return Wave(a, round(w, 3), round(f, 3), round(c, 3))


def solve_linear(
    e: np.ndarray, a: np.ndarray, b: np.ndarray, u: Wave, t: np.ndarray, start: np.ndarray
) -> np.ndarray:
    """Z(t) of E z' + A z = b u(t), shape (n, len(t)), for any index: phasor and modes.

    The modes are those that `start` needs; a start off the solutions shows as an error at t = 0.
    """
    swing = np.linalg.solve(1j * u.w * e + a, b * u.a * np.exp(1j * u.f))
    constant = np.linalg.lstsq(a, b * u.c, rcond=None)[0]
    forced = (swing[:, None] * np.exp(1j * u.w * t)).imag + constant[:, None]
    (alpha, beta), vectors = scipy.linalg.eig(-a, e, homogeneous_eigvals=True)
    finite = np.abs(beta) > 1e-4 * np.hypot(np.abs(alpha), np.abs(beta))
    rates, modes = alpha[finite] / beta[finite], vectors[:, finite]
    sizes = np.linalg.lstsq(modes, start - forced[:, 0], rcond=None)[0]
    return forced + (modes @ (sizes[:, None] * np.exp(np.outer(rates, t)))).real


def linear_case(
    text: str, e: np.ndarray, a: np.ndarray, b: np.ndarray, u: Wave, names: Sequence[str]
) -> Case | None:
    """A case of a linear system of which `names` are the unknowns; None if it has a hidden fault.

    `-name` stands for the unknown with its sign turned.
    """
    if np.linalg.cond(0.7 * e + a) > 1e6 or np.linalg.cond(a) > 1e8:
        return None

    def error(result: frot.Result) -> float:
        found = np.array([-result[n[1:]] if n[0] == "-" else result[n] for n in names])
        exact = solve_linear(e, a, b, u, result.time, found[:, 0])
        return float(np.abs(found - exact).max() / max(1.0, np.abs(exact).max()))

    return Case(text, error)


def circuits(draw: random.Random) -> Case | None:
    """R, L, C and a source between random nodes: loops of capacitors, cut sets of inductors."""
    nodes = draw.randint(1, 5)
    pairs = [(k, draw.choice([-1, *range(k)])) for k in range(nodes)]
    for _ in range(draw.randint(1, 6)):
        p, q = draw.sample(range(-1, nodes), 2)
        pairs.append((p, q))
    parts = [(draw.choice("RRCCLL"), p, q, round(draw.uniform(0.3, 3), 3)) for p, q in pairs]
    coils = [k for k, part in enumerate(parts) if part[0] == "L"]
    voltage, into, u = draw.random() < 0.5, draw.randrange(nodes), draw_wave(draw)
    n = nodes + len(coils) + voltage
    e, a, b = np.zeros((n + 1, n + 1)), np.zeros((n + 1, n + 1)), np.zeros(n + 1)
    names = [""] * n
    lines, links = [], []
    where = {-1: "earth.p"}
    for k, (kind, p, q, value) in enumerate(parts):
        model = {"R": "Resistor", "C": "Capacitor", "L": "Inductor"}[kind]
        unit = {"R": "Ohm", "C": "F", "L": "H"}[kind]
        lines.append(f"  {model} e{k}({kind} = {value} {unit});")
        for node, pin in ((p, f"e{k}.p"), (q, f"e{k}.n")):
            if node in where:
                links.append(f"  connect({', '.join(draw.sample([where[node], pin], 2))});")
            if node >= 0:
                where[node] = pin
                names[node] = f"{pin}.v"
        if kind == "L":
            at = nodes + coils.index(k)
            names[at] = f"e{k}.i"
            a[p, at], a[q, at], e[at, at] = 1, -1, value
            a[at, p], a[at, q] = -1, 1
        else:
            matrix, size = (a, 1 / value) if kind == "R" else (e, value)
            for i, j, sign in ((p, p, 1), (q, q, 1), (p, q, -1), (q, p, -1)):
                matrix[i, j] += sign * size
    e, a, b = e[:-1, :-1], a[:-1, :-1], b[:-1]
    what, unit = ("voltage", "V") if voltage else ("current", "A")
    lines.append(f"  {what.capitalize()}Source source; Ground earth;")
    links += [f"  connect(source.p, {where[into]});", "  connect(source.n, earth.p);"]
    links.append(f"  source.{what} = (1 {unit})*{u.text()};")
    if voltage:
        a[into, n - 1], a[n - 1, into], b[n - 1] = 1, 1, 1
        names[n - 1] = "source.i"
    else:
        b[into] = -1
    draw.shuffle(links)
    body = "\n".join([*lines, "equation", *links])
    text = f"model Circuit\n  import Electrical.*;\n{body}\n{HEAD}end Circuit;\n"
    return linear_case(text, e, a, b, u, names)


def drives(draw: random.Random) -> Case | None:
    """Inertias with springs, dampers, gears and planetary gears; a couple or a given angle."""
    n = draw.randint(2, 7)
    inertias = [round(draw.uniform(0.2, 3), 3) if draw.random() < 0.8 else 0.0 for _ in range(n)]
    mass, k, c = np.diag(inertias), np.zeros((n, n)), np.zeros((n, n))
    rows: list[np.ndarray] = []
    torques: list[str] = []
    lines = [f"  Inertia w{i}(J = {j} kg.m^2);" for i, j in enumerate(inertias) if j]
    where = [f"w{i}.{draw.choice('ab')}" if j else "" for i, j in enumerate(inertias)]
    links: list[str] = []

    def join(node: int, flange: str) -> None:
        if where[node]:
            links.append(f"  connect({where[node]}, {flange});")
        if not where[node] or draw.random() < 0.5:
            where[node] = flange

    def ratio() -> float:
        return round(draw.uniform(0.4, 3), 2) * draw.choice((1, -1))

    for i in range(1, n + draw.randint(0, 2)):
        p, q = (i, draw.randrange(i)) if i < n else draw.sample(range(n), 2)
        kind = draw.choice(("spring", "damper", "both", "gear", "planetary"))
        if i >= n and kind in ("gear", "planetary"):
            kind = "both"
        if kind == "planetary" and (i < 2 or n < 3):
            kind = "gear"
        d = np.zeros(n)
        if kind == "gear":
            r = ratio()
            lines.append(f"  Gear g{i}(ratio = {r});")
            d[p], d[q] = 1, -r
            join(p, f"g{i}.a"), join(q, f"g{i}.b")
            rows.append(d)
            torques.append(f"g{i}.a.torque")
        elif kind == "planetary":
            q, s = draw.sample(range(i), 2)
            r = abs(ratio())
            lines.append(f"  Planetary g{i}(ratio = {r});")
            d[p], d[q], d[s] = -1, 1 + r, -r
            join(p, f"g{i}.sun"), join(q, f"g{i}.carrier"), join(s, f"g{i}.ring")
            rows.append(d)
            torques.append(f"-g{i}.sun.torque")
        else:
            kk = 0.0 if kind == "damper" else round(draw.uniform(0.5, 5), 2)
            cc = 0.0 if kind == "spring" else round(draw.uniform(0.1, 2), 2)
            lines.append(f"  SpringDamper s{i}(k = {kk} N.m, c = {cc} N.m.s);")
            d[p], d[q] = 1, -1
            k += kk * np.outer(d, d)
            c += cc * np.outer(d, d)
            join(p, f"s{i}.a"), join(q, f"s{i}.b")
    for i in range(n):  # every shaft has somewhere to rest: no modes that grow or coincide
        d = np.zeros(n)
        d[i] = 1
        kk, cc = round(draw.uniform(0.2, 2), 3), round(draw.uniform(0.05, 1), 3)
        lines.append(f"  SpringDamper h{i}(k = {kk} N.m, c = {cc} N.m.s);")
        links.append(f"  connect(h{i}.b, wall.a);")
        join(i, f"h{i}.a")
        k += kk * np.outer(d, d)
        c += cc * np.outer(d, d)
    u, at, given = draw_wave(draw), draw.randrange(n), draw.random() < 0.4
    lines.append("  Fixed wall;")
    if given:
        d = np.zeros(n)
        d[at] = 1
        rows.append(d)
        lines.append("  AngleSource source;")
        links.append(f"  source.angle = {u.text()};")
        torques.append("source.a.torque")
    else:
        lines.append("  TorqueSource source;")
        links.append(f"  source.torque = (1 N.m)*{u.text()};")
    join(at, "source.a")
    g = np.array(rows).reshape(-1, n)
    m = len(g)
    zero, one = np.zeros((n, n)), np.eye(n)
    e = scipy.linalg.block_diag(one, mass, np.zeros((m, m)))
    a = np.block(
        [[zero, -one, np.zeros((n, m))], [k, c, g.T], [g, np.zeros((m, n)), np.zeros((m, m))]]
    )
    b = np.zeros(2 * n + m)
    b[(2 * n + m - 1) if given else n + at] = 1
    draw.shuffle(links)
    shafts = [f"  Angle q{i}; AngularVelocity v{i};" for i in range(n)]
    seen = [f"  q{i} = h{i}.a.angle; v{i} = der(q{i});" for i in range(n)]
    body = "\n".join([*lines, *shafts, "equation", *links, *seen])
    text = f"model Drive\n  import Rotational.*;\n{body}\n{HEAD}end Drive;\n"
    names = [*(f"q{i}" for i in range(n)), *(f"v{i}" for i in range(n)), *torques]
    return linear_case(text, e, a, b, u, names)


def systems(draw: random.Random) -> Case | None:
    """A x' + B x = f(t) with a chosen x(t), triangular in blocks: index one to three, and loops."""
    n = draw.randint(2, 6)
    waves = [draw_wave(draw) for _ in range(n)]
    order = draw.sample(range(n), n)
    rows = []
    for place, i in enumerate(order):
        entries: dict[tuple[int, int], float] = {}
        hidden = draw.random() < 0.4
        # what is solved for: the unknown itself, or its rate
        entries[i, 0 if hidden else 1] = round(draw.uniform(0.5, 2), 2) * draw.choice((1, -1))
        for j in order[:place]:
            if draw.random() < 0.5:
                entries[j, draw.choice((0, 1))] = round(draw.uniform(-1, 1), 2)
        if not hidden:
            entries[i, 0] = round(draw.uniform(0.1, 1), 2) * (1 if entries[i, 1] > 0 else -1)
            for j in order[place + 1 :]:
                if draw.random() < 0.3:
                    entries[j, 0] = round(draw.uniform(-0.3, 0.3), 2)
        rows.append(entries)
    equations = []
    for entries in rows:
        left = [
            f"({size!r})*" + (f"x{j}" if order == 0 else f"der(x{j})*(1 s)")
            for (j, order), size in entries.items()
        ]
        right = [f"({s!r})*{waves[j].text(order)}" for (j, order), s in entries.items()]
        equations.append(f"  {' + '.join(left)} = {' + '.join(right)};")
    draw.shuffle(equations)
    lines = [f"  Real x{j};" for j in range(n)]
    start = [f"  x{j} = {float(w.value(np.zeros(1))[0])!r};" for j, w in enumerate(waves)]
    body = "\n".join([*lines, "initial", *start, "equation", *equations])
    text = f"model System\n{body}\n{HEAD}end System;\n"

    def error(result: frot.Result) -> float:
        return max(
            float(np.abs(result[f"x{j}"] - w.value(result.time)).max()) for j, w in enumerate(waves)
        )

    return Case(text, error)


def formulas(draw: random.Random) -> Case | None:
    """Nonlinear equations that chosen waves satisfy, with aliases, signs and parameters."""
    n = draw.randint(2, 5)
    waves = [draw_wave(draw) for _ in range(n)]
    lines, equations, start = [], [], []
    for j in range(n):
        lines.append(f"  Real x{j};")
        start.append(f"  guess(x{j} = {float(waves[j].value(np.zeros(1))[0])!r});")

    def name(j: int) -> str:
        """The unknown, or an alias of it, with the sign and the scale taken back."""
        if draw.random() < 0.5:
            return f"x{j}"
        k = len(lines)
        scale = round(draw.uniform(0.4, 2), 2) * draw.choice((1, -1))
        lines.append(f"  Real y{k}; parameter Real p{k} = {scale!r};")
        equations.append(
            draw.choice(
                (f"  y{k} = p{k}*x{j};", f"  0 = x{j} - y{k}/p{k};", f"  -y{k} = -p{k}*x{j};")
            )
        )
        return f"(y{k}/p{k})"

    for j in range(n):
        others = draw.sample(range(n), draw.randint(0, min(2, n - 1)))
        left, right = [], []
        for i in others:
            form = draw.choice(("sin({})", "{}^2", "cos(2*{})", "exp(-{}^2)", "{}/(2 + {}^2)"))
            size = round(draw.uniform(-0.3, 0.3), 2)
            one = name(i)
            left.append(f"({size!r})*" + form.replace("{}", one))
            right.append(f"({size!r})*" + form.replace("{}", waves[i].text()))
        kind = draw.choice(("rate", "cube", "second"))
        own, w = name(j), waves[j]
        if kind == "rate":
            left.append(f"(1 s)*der(x{j}) + {own}")
            right.append(f"{w.text(1)} + {w.text()}")
        elif kind == "second":
            v = len(lines)
            lines.append(f"  Real v{v};")
            start.append(f"  guess(v{v} = {float(w.value(np.zeros(1), 1)[0])!r});")
            equations.append(f"  v{v} = (1 s)*der(x{j});")
            left.append(f"(1 s)*der(v{v}) + v{v} + {own}")
            right.append(f"{w.text(2)} + {w.text(1)} + {w.text()}")
        else:
            left.append(f"3*{own} + {own}^3")
            right.append(f"3*{w.text()} + {w.text()}^3")
        both = [" + ".join(left), " + ".join(right)]
        draw.shuffle(both)
        equations.append(f"  {both[0]} = {both[1]};")
    draw.shuffle(equations)
    body = "\n".join([*lines, "initial", *start, "equation", *equations])
    text = f"model Formulas\n{body}\n{HEAD}end Formulas;\n"

    def error(result: frot.Result) -> float:
        return max(
            float(np.abs(result[f"x{j}"] - w.value(result.time)).max()) for j, w in enumerate(waves)
        )

    return Case(text, error)


KINDS: dict[str, Callable[[random.Random], Case | None]] = {
    "circuits": circuits,
    "drives": drives,
    "systems": systems,
    "formulas": formulas,
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", choices=[*KINDS, "all"], default="all")
    parser.add_argument("--show", action="store_true", help="print the texts that fail")
    options = parser.parse_args()
    faults, worst, began = 0, 0.0, time.perf_counter()
    kinds = list(KINDS) if options.kind == "all" else [options.kind]
    for number in range(options.count):
        kind = kinds[number % len(kinds)]
        seed = options.seed * 1_000_003 + number
        case = next(c for k in range(100) if (c := KINDS[kind](random.Random(seed + k * 7919))))
        try:
            error = case.error(frot.compile(case.text).simulate())
            told = "" if error < 1e-6 else f"error {error:.2g}"
            worst = max(worst, error) if not told else worst
        except frot.FrotError as fault:
            told = str(fault)
        except Exception:
            told = traceback.format_exc()
        if told:
            faults += 1
            print(f"--- {kind} {seed}: {told}")
            if options.show:
                print(case.text)
    seconds = time.perf_counter() - began
    print(f"{options.count} models, {faults} faults, worst {worst:.2g}, {seconds:.0f} s")
    return 1 if faults else 0


if __name__ == "__main__":
    raise SystemExit(main())
