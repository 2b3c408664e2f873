"""Random calls on instances, in a process of its own: it must end by itself, with status 0.

Usage: fmu_fuzz.py LIBRARY VERSION SEED SEQUENCES [THREADS]

With threads, each has instances and sequences of its own, in one library, all at once.
"""

from __future__ import annotations

import ctypes
import math
import random
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from fmu_host import ERROR, OK, Host

NUMBERS = (0.0, 1.0, -1.0, 0.5, 1e-9, 1e9, 1e300, -1e300, 5e-324, math.nan, math.inf, -math.inf)
KINDS = {2: ("Real", "Integer", "Boolean", "String"),
         3: ("Float64", "Int32", "Int64", "Boolean", "Float32")}  # fmt: skip
PLAIN = {
    2: [
        "EnterInitializationMode",
        "ExitInitializationMode",
        "Terminate",
        "Reset",
        "EnterEventMode",
        "CancelStep",
        "EnterContinuousTimeMode",
    ],
    3: [
        "ExitInitializationMode",
        "Terminate",
        "Reset",
        "EnterEventMode",
        "EnterStepMode",
        "EnterConfigurationMode",
        "ExitConfigurationMode",
        "EvaluateDiscreteStates",
        "EnterContinuousTimeMode",
    ],
}


class Fuzz:
    """One sequence of calls."""

    def __init__(self, library: Path, version: int, chance: random.Random) -> None:
        self.chance = chance
        options = {name: chance.random() < 0.5 for name in ("logging", "event_mode", "early")}
        self.host = Host(library, version, **options)
        self.states: list[ctypes.c_void_p] = []
        self.bytes: list[bytes] = [b""]
        self.calls: tuple[Callable[[], object], ...] = (
            self.plain, self.setup, self.setup, self.initialize, self.step, self.step, self.step,
            self.get, self.get, self.set, self.set, self.nulls, self.save, self.restore,
            self.drop, self.serialize, self.deserialize, self.log, self.events, self.events,
        )  # fmt: skip

    def number(self) -> float:
        return self.chance.choice((self.chance.choice(NUMBERS), self.chance.uniform(-2.0, 5.0)))

    def reference(self) -> int:
        return self.chance.choice((self.chance.randrange(15), self.chance.randrange(2**32)))

    def plain(self) -> None:
        self.host.call(self.chance.choice(PLAIN[self.host.version]))

    def setup(self) -> None:
        stop = self.chance.choice((None, self.number()))
        tolerance = self.chance.choice((None, 1e-6, self.number()))
        self.host.setup(self.chance.choice((0.0, self.number())), stop, tolerance)

    def initialize(self) -> None:
        self.host.call("ExitInitializationMode")

    def step(self) -> None:
        status, t = self.host.try_get(0)
        assert status == OK
        h = self.chance.choice((0.1, 1.0, self.number()))
        self.host.step(self.chance.choice((t, t, t, self.number())), h)

    def events(self) -> None:
        """Into event mode and out of it, for the most part in order."""
        if self.host.version == 2:
            return
        for name in self.chance.choice((("Event", "Step"), ("Step",), ("Event",))):
            self.host.call(f"Enter{name}Mode")
            flags = [ctypes.c_bool() for _ in range(5)]
            self.host.call("UpdateDiscreteStates", *map(ctypes.byref, flags), ctypes.byref(
                ctypes.c_double()))  # fmt: skip

    def get(self) -> None:
        self.host.try_get(self.reference(), self.chance.choice(KINDS[self.host.version][:3]))

    def set(self) -> None:
        kind = self.chance.choice(KINDS[self.host.version][:3])
        value: float | int | bool = self.number()
        if kind in ("Integer", "Int32", "Int64"):
            value = self.chance.randrange(-(2**31), 2**31)
        elif kind == "Boolean":
            value = self.chance.random() < 0.5
        self.host.set(self.reference(), value, kind)

    def nulls(self) -> None:
        kind = self.chance.choice(KINDS[self.host.version])
        count = ctypes.c_size_t(self.chance.choice((0, 1, 7)))
        way = self.chance.choice(("Get", "Set"))
        self.host.call(f"{way}{kind}", None, count, None, count)

    def handle(self) -> ctypes.c_void_p:
        if self.states and self.chance.random() < 0.7:
            return self.chance.choice(self.states)
        return ctypes.c_void_p(self.chance.choice((None, 8, self.chance.randrange(2**48))))

    def save(self) -> None:
        self.states.append(self.host.save())

    def restore(self) -> None:
        self.host.restore(self.handle())

    def drop(self) -> None:
        handle = self.handle()
        if self.host.drop(handle) == OK:
            self.states = [s for s in self.states if s.value is not None]

    def serialize(self) -> None:
        if self.states:
            self.bytes.append(self.host.serialize(self.chance.choice(self.states)))

    def deserialize(self) -> None:
        data = bytearray(self.chance.choice(self.bytes))
        damaged = self.chance.random() < 0.7
        if damaged and data:
            data[self.chance.randrange(len(data))] ^= self.chance.randrange(1, 256)
        elif damaged:
            data = bytearray(self.chance.randbytes(self.chance.randrange(4000)))
        status, state = self.host.deserialize(bytes(data))
        if status == OK:
            assert not damaged
            self.states.append(state)
        else:
            assert status == ERROR

    def log(self) -> None:
        names = (b"logEvents", b"logAll", b"logStatusError", b"%s%n", b"")
        chosen = self.chance.choices(names, k=self.chance.randrange(3))
        self.host.log(self.chance.random() < 0.5, *chosen)

    def run(self, count: int) -> None:
        """Call and end the instance."""
        for _ in range(count):
            self.chance.choice(self.calls)()
        self.host.free()


def main() -> None:
    """Run the sequences the command line asks for."""
    library, version, seed, sequences = Path(sys.argv[1]), *map(int, sys.argv[2:5])
    threads = int(sys.argv[5]) if len(sys.argv) > 5 else 1

    def work(first: int) -> None:
        for i in range(first, sequences, threads):
            Fuzz(library, version, random.Random(1000 * seed + i)).run(60)

    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(work, range(threads)))


if __name__ == "__main__":
    main()
