"""A stage of the compiler is a value: no later pass changes it."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import casadi as ca
import pytest
from frot.compiler import driver
from frot.compiler.mechanics.kinematics import Kinematics
from frot.compiler.mechanics.variables import Variables
from frot.compiler.translate.derivative_chains import Chains
from frot.dsl import Log, compile_text, load

MODELS = Path(__file__).parents[2] / "models"
# Events, conditions of every kind, friction of the text that holds, two `reinit`s of one state.
SWITCHES = """model Switches
  Length x(start = 1 m);
  Velocity v;
  Force f;
  Integer n(start = 0);
equation
  der(x) = v;
  2 kg * der(v) = -3 N/m * x + f + (if time > 0.5 s then 1 N else 0 N);
  f = friction(v, 0.2 N, 0.3 N);
  when x < 0.3 m then
    n = pre(n) + 1;
    reinit(v, 0.1 m/s);
  end when;
  when sample(0.1 s, 0.25 s) then
    reinit(v, 0.2 m/s);
  end when;
end Switches;
"""
# Values that a stage makes when they are first asked for.
CACHES = {Kinematics: {"_moving"}, Variables: {"_inertias"}}


def snapshot(value: Any, seen: dict[int, Any]) -> Any:
    """The value as nested tuples of what it holds; functions and parts of the text by identity."""
    if isinstance(value, ca.SX):
        return value.shape, tuple(x.element_hash() for x in value.nonzeros())
    if value is None or isinstance(value, str | int | float):
        return value
    if id(value) in seen:
        return id(value)
    seen[id(value)] = value
    if isinstance(value, Chains):  # derivatives get their symbols when they are first needed
        return tuple((c.name, c.fixed, c.symbols[0].element_hash()) for c in value.items)
    if isinstance(value, list | tuple):
        return tuple(snapshot(x, seen) for x in value)
    if isinstance(value, Mapping):
        return tuple((id(k), snapshot(x, seen)) for k, x in value.items())
    if type(value).__module__.startswith("frot.dsl"):
        return id(value)
    if dataclasses.is_dataclass(value):
        names = [f.name for f in dataclasses.fields(value)]
    elif isinstance(value, Kinematics):
        names = sorted(vars(value))
    else:
        return id(value)
    left_out = CACHES.get(type(value), set())
    return tuple((n, snapshot(getattr(value, n), seen)) for n in names if n not in left_out)


def _passes(model: Any) -> list[tuple[str, Any]]:
    """Each stage with what it held when it was made, all made from one mechanism."""
    log = Log()
    mechanism = driver.mechanism_of(model, log)
    assert mechanism is not None
    made: list[tuple[str, Any]] = [("mechanism", mechanism)]
    before = [snapshot(mechanism, {})]
    for name, make in (
        ("reduced", driver.reduce),
        ("assembled", driver.assemble),
        ("lowered", driver.lower_system),
    ):
        stage = make(made[-1][1], log)  # type: ignore[operator]
        assert stage is not None and not log.failed
        made.append((name, stage))
        before.append(snapshot(stage, {}))
    lowered = made[-1][1]
    assert driver.text_of(lowered, "")
    return [(name, stage, was) for (name, stage), was in zip(made, before, strict=True)]


def test_a_growing_list_is_detected() -> None:
    held = [ca.SX.sym("x")]
    before = snapshot((held,), {})
    held.append(ca.SX.sym("y"))
    assert snapshot((held,), {}) != before


@pytest.mark.parametrize(
    "name",
    [
        "switches",
        "clutch_engagement",
        "coulomb_oscillator",
        "dry_pendulum",
        "half_wave_rectifier",
        "inclined_block",
        "slider_crank",
        "speed_drive",
        "two_hoops",
        "wheel_channel",
    ],
)
def test_no_pass_changes_an_earlier_stage(name: str) -> None:
    log = Log()
    if name == "switches":
        model = compile_text(SWITCHES, log)
    else:
        model = load(MODELS / f"{name}.frot", log)
    assert model is not None, log.diagnostics
    for stage, value, was in _passes(model):
        assert snapshot(value, {}) == was, stage
