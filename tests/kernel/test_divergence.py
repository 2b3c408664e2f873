"""What the message says where a state cannot be followed, and what `auto` does before."""

from __future__ import annotations

import math

import pytest

import frot


def run(equations: str, method: str = "auto") -> None:
    frot.compile(
        "model Diverging\n  constant AngularVelocity k = 1 s^-1;\n  Real calm; Real x;\n"
        f"initial\n  calm = 1; x = 1;\nequation\n{equations}"
        f"  experiment(stop = 3 s, tolerance = 1e-8, method = {method});\nend Diverging;\n"
    ).simulate()


@pytest.mark.parametrize("method", ["auto", "explicit", "implicit"])
def test_the_state_that_grows_without_bound_is_named(method: str) -> None:
    """x = 1/(1 - t)."""
    with pytest.raises(frot.FrotError) as caught:
        run("  der(calm) = -k*calm;\n  der(x) = k*x^2;\n", method)
    fault = caught.value.diagnostics[0]
    assert fault.code == "E0901"
    assert "'x' cannot be followed beyond t = " in fault.message
    assert "jamming" not in fault.message
    assert float(fault.message.split("t = ")[1].split(":")[0]) == pytest.approx(1, abs=1e-6)
    assert fault.notes == ("at <text>:3:19",)
    assert fault.help is not None and "a denominator, a root" in fault.help


def test_auto_runs_where_only_the_implicit_method_does() -> None:
    """At rates of 1e18 no explicit step is long enough to be told from the time it starts at."""
    text = """model Fast
  constant AngularVelocity k = 1 s^-1;
  Real x; Real y;
initial
  x = cos(1); y = 0;
equation
  der(x) = -1e18*k*(x - cos(k*time));
  der(y) = k*x;
  experiment(start = 1 s, stop = 3 s, tolerance = 1e-6);
end Fast;
"""
    result = frot.compile(text).simulate()
    assert result.at(3.0)["x"] == pytest.approx(math.cos(3), abs=1e-5)
    assert result.at(3.0)["y"] == pytest.approx(math.sin(3) - math.sin(1), abs=1e-5)
