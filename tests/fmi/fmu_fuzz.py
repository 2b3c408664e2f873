"""Random calls on instances, in a process of its own: it must end by itself, with status 0.

Usage: fmu_fuzz.py LIBRARY VERSION SEED SEQUENCES [THREADS [TOKEN [VARIABLES]]]

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
from typing import Any

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


CALLS = 60  # of one sequence


class Fuzz:
    """One sequence of calls."""

    def __init__(
        self, library: Path, version: int, chance: random.Random, token: bytes, variables: int
    ) -> None:
        self.chance, self.variables = chance, variables
        options: dict[str, Any] = {
            name: chance.random() < 0.5 for name in ("logging", "event_mode", "early")
        }
        if version == 3 and chance.random() < 0.5:
            chosen = [chance.randrange(variables) for _ in range(chance.randrange(4))]
            options |= {"update": self.update, "required": chosen}
        self.host = Host(library, version, token=token, kind=chance.randrange(2), **options)
        if self.host.instance is None:  # without model exchange
            self.host = Host(library, version, token=token, **options)
        self.states: list[ctypes.c_void_p] = []
        self.bytes: list[bytes] = [b""]
        self.calls: tuple[Callable[[], object], ...] = (
            self.plain, self.setup, self.setup, self.initialize, self.step, self.step, self.step,
            self.get, self.get, self.set, self.set, self.nulls, self.save, self.restore,
            self.drop, self.serialize, self.deserialize, self.log, self.events, self.events,
            self.derive, self.rates, self.exchange,
        )  # fmt: skip

    def number(self) -> float:
        return self.chance.choice((self.chance.choice(NUMBERS), self.chance.uniform(-2.0, 5.0)))

    def reference(self) -> int:
        some = self.chance.randrange(self.variables)
        return self.chance.choice((some, some, some, self.chance.randrange(2**32)))

    def references(self) -> tuple[ctypes.c_size_t, Any, Any]:
        """Their number, references, and as many numbers."""
        count = self.chance.randrange(4)
        found = (ctypes.c_uint32 * 4)(*(self.reference() for _ in range(4)))
        return ctypes.c_size_t(count), found, (ctypes.c_double * 4)(*(self.number(),) * 4)

    def derive(self) -> None:
        n, unknowns, numbers = self.references()
        k, knowns, seed = self.references()
        answer = (n,) if self.host.version == 3 else ()
        seeds = (seed, k) if self.host.version == 3 else (seed,)
        args = (unknowns, n, knowns, k)
        if self.host.version == 3 and self.chance.random() < 0.5:
            self.host.call("GetAdjointDerivative", *args, seed, n, numbers, k)
            return
        self.host.call("GetDirectionalDerivative", *args, *seeds, numbers, *answer)

    def rates(self) -> None:
        n, references, numbers = self.references()
        orders = (ctypes.c_int32 * 4)(*(self.chance.choice((1, 1, 2, 0)) for _ in range(4)))
        if self.host.version == 3:
            self.host.call("GetOutputDerivatives", references, n, orders, numbers, n)
            return
        name = self.chance.choice(("SetRealInputDerivatives", "GetRealOutputDerivatives"))
        self.host.call(name, references, n, orders, numbers)

    def exchange(self) -> None:
        """Calls of model exchange, with a number of values that is right for some."""
        count = self.chance.choice((0, 1, 4, 6))
        values = (ctypes.c_double * 8)(*(self.number() for _ in range(8)))
        name = self.chance.choice(("SetContinuousStates", "GetContinuousStates", "Derivatives",
                                   "GetEventIndicators", "SetTime", "Completed"))  # fmt: skip
        if name == "SetTime":
            self.host.call(name, ctypes.c_double(self.number()))
        elif name == "Completed":
            flags = [ctypes.byref(ctypes.c_int()) for _ in range(2)]
            flag = ctypes.c_int(1) if self.host.version == 2 else ctypes.c_bool(True)
            self.host.call("CompletedIntegratorStep", flag, *flags)
        else:
            rates = "GetDerivatives" if self.host.version == 2 else "GetContinuousStateDerivatives"
            called = rates if name == "Derivatives" else name
            self.host.call(called, values, ctypes.c_size_t(count))

    def update(
        self, _env: object, _t: float, _asks: bool, _shows: bool, _done: bool, _may: bool,
        ends: Any, when: Any,
    ) -> None:  # fmt: skip
        """Called inside a step, where most calls must be refused."""
        if self.chance.random() < 0.3:
            self.chance.choice((self.get, self.set, self.plain, self.restore, self.derive))()
        ends[0], when[0] = self.chance.random() < 0.1, self.number()

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
        ways = (("Event", "Step"), ("Step",), ("Event",), ("Event", "ContinuousTime"))
        for name in self.chance.choice(ways):
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
    token = sys.argv[6].encode() if len(sys.argv) > 6 else b"hand-model-key"
    variables = int(sys.argv[7]) if len(sys.argv) > 7 else 15

    def work(first: int) -> None:
        for i in range(first, sequences, threads):
            Fuzz(library, version, random.Random(1000 * seed + i), token, variables).run(CALLS)

    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(work, range(threads)))


if __name__ == "__main__":
    main()
