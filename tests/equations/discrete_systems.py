"""Random systems of conditions and `when`s, and what Modelica makes of them.

Modelica Language Specification 3.6, sect. 8.6 and appendix B: at an event all equations are
solved in an order in which each comes after what it reads, with the values before it; where they
differ from these, they become the values before, and all is solved again. All instants are eighths
of a second, so that nothing is rounded.
"""

from __future__ import annotations

import random

Node = tuple  # an operation and its operands
Values = dict[str, float]
Course = list[tuple[float, Values]]  # the values from each instant on
ROUNDS = 60
WORDS = {"and": "({} and {})", "or": "({} or {})", "not": "(not {})", "now": "{}", "+": "{} + {}"}
WORDS |= {"pre": "pre({})", ">": "{} > {}", "due": "time/(1 s) >= {}", "time": "time/(1 s)"}


class System:
    """Booleans that equations give, and numbers that `when`s set, in a random order."""

    def __init__(self, seed: int) -> None:
        self.draw = random.Random(seed)
        self.flags = [f"b{seed}_{k}" for k in range(self.draw.randint(3, 6))]
        self.numbers = [f"x{seed}_{k}" for k in range(self.draw.randint(2, 4))]
        self.lines: list[tuple[str, list[Node]]] = []
        names = [*self.flags, *self.numbers]
        self.draw.shuffle(names)
        for k, name in enumerate(names):
            self.known = names[:k]
            if name in self.flags:
                self.lines.append((name, [self._condition(2)]))
            else:
                count = self.draw.choice((1, 2))
                parts = [(self._condition(1), self._number()) for _ in range(count)]
                self.lines.append((name, [node for part in parts for node in part]))

    def _eighths(self, low: int, high: int) -> float:
        return self.draw.randint(low, high) / 8

    def _read(self) -> Node:
        name = self.draw.choice(self.numbers)
        return ("now" if name in self.known and self.draw.random() < 0.7 else "pre", name)

    def _condition(self, depth: int) -> Node:
        known = [x for x in self.known if x in self.flags]
        kind = self.draw.choice(("and", "or", "not", "now", "pre", "due", "due", ">"))
        if kind in ("and", "or", "not") and depth:
            parts = 1 if kind == "not" else 2
            return (kind, *(self._condition(depth - 1) for _ in range(parts)))
        if kind == "now" and known:
            return ("now", self.draw.choice(known))
        if kind == "due":
            late = ("+", self._read(), self._eighths(1, 8))
            return ("due", self.draw.choice((late, self._eighths(1, 24))))
        if kind == ">":
            return (">", self._read(), self._eighths(0, 20) + 1 / 16)
        return ("pre", self.draw.choice(self.flags))

    def _number(self) -> Node:
        late = ("+", self._read(), self._eighths(1, 4))
        return self.draw.choice((("time",), ("time",), late, self._eighths(0, 16)))

    def text(self) -> tuple[str, str]:
        """Declarations and equations."""
        equations = []
        for name, parts in self.lines:
            words = [_write(node) for node in parts]
            if name in self.flags:
                equations.append(f"{name} = {words[0]};")
                continue
            acts = [f"when {c} then {name} = {v};" for c, v in zip(*[iter(words)] * 2, strict=True)]
            equations.append(" else".join(acts) + " end when;")
        flags = ", ".join(f"{x}(start = false)" for x in self.flags)
        numbers = ", ".join(f"{x}(start = 0)" for x in self.numbers)
        return f"Boolean {flags}; Real {numbers};", "\n".join(equations)

    def run(self, stop: float) -> Course | None:
        """The values from each instant on; None where they do not settle."""
        self.before = dict.fromkeys([*self.flags, *self.numbers], 0.0)
        self.held: dict[tuple[str, int], float] = {}
        t, found = 0.0, []
        while t <= stop:
            if not self._settle(t):
                return None
            found.append((t, dict(self.before)))
            t = min((x for x in self._instants() if x > t), default=stop + 1)
        return found

    def _settle(self, t: float) -> bool:
        for number in range(ROUNDS):
            now = dict(self.before)
            held = {}
            for name, parts in self.lines:
                if name in self.flags:
                    now[name] = _value(parts[0], t, now, self.before)
                    continue
                fires = []
                for k in range(0, len(parts), 2):
                    held[name, k] = _value(parts[k], t, now, self.before)
                    rises = held[name, k] and not self.held.get((name, k))
                    if rises and (t > 0 or number > 0):
                        fires.append(_value(parts[k + 1], t, now, self.before))
                now[name] = fires[0] if fires else now[name]
            same, self.before, self.held = now == self.before, now, held
            if same and (t > 0 or number > 0):
                return True
        return False

    def _instants(self) -> list[float]:
        found: list[float] = []
        nodes = [node for _, parts in self.lines for node in parts]
        while nodes:
            node = nodes.pop()
            if isinstance(node, tuple):
                nodes.extend(node[1:])
                if node[0] == "due":
                    found.append(_value(node[1], 0, self.before, self.before))
        return found


def _write(node: Node | float | str) -> str:
    if not isinstance(node, tuple):
        return str(node)
    return WORDS[node[0]].format(*map(_write, node[1:]))


def _value(node: Node | float, t: float, now: Values, before: Values) -> float:
    if not isinstance(node, tuple):
        return node
    kind, *parts = node
    if kind in ("now", "pre", "time"):
        return t if kind == "time" else (now if kind == "now" else before)[parts[0]]
    values = [_value(part, t, now, before) for part in parts]
    match kind:
        case "not":
            return not values[0]
        case "and" | "or":
            return (all if kind == "and" else any)(values)
        case "due":
            return t >= values[0]
    return values[0] + values[1] if kind == "+" else values[0] > values[1]


def settling(count: int, stop: float) -> tuple[str, list[tuple[System, Course]]]:
    """One text of the first systems that settle, at four instants or more; what they become."""
    found = []
    for seed in range(10 * count):
        system = System(seed)
        values = system.run(stop)
        if values is not None and len(values) > 3 and len(found) < count:
            found.append((system, values))
    parts = [system.text() for system, _ in found]
    declared, equations = ("\n".join(p[k] for p in parts) for k in (0, 1))
    text = f"model Many\n{declared}\nequation\n{equations}\nexperiment(stop = {stop} s);\nend Many;"
    return text, found
