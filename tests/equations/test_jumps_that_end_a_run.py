"""A jump of the text at the instant that ends the run is no part of the balance of the motion."""

from __future__ import annotations

import pytest

import frot

TEXT = """planar model Thrown
  parameter Mass m = 1 kg;
  Integer n(start = 0);
  body ball: particle(mass = m);
initial
  ball.position = (0, 1) m;
equation
  {events}
  experiment(stop = {stop} s);
end Thrown;
"""
# Text of the events, end of the run, kinetic energy of 1 kg there (J), potential one.
ENDS = {
    "caught": (
        "when ball.position.y < 0.2 m then reinit(ball.velocity.y, 0 m/s); n = 1;"
        ' terminate("caught"); end when;',
        2.0, 0.0, 9.81 * 0.2,
    ),
    "by another condition": (
        "when ball.position.y < 0.2 m then reinit(ball.velocity.y, 0 m/s); n = 1; end when;"
        ' when ball.position.y < 0.2 m then terminate("caught"); end when;',
        2.0, 0.0, 9.81 * 0.2,
    ),
    "five bounces": (
        "when ball.position.y < 0 m then reinit(ball.velocity.y, -0.8*pre(ball.velocity.y));"
        ' n = pre(n) + 1; end when; when n >= 5 then terminate("five bounces"); end when;',
        20.0, 9.81 * 0.64**5, 0.0,
    ),
    "put elsewhere": (
        "when ball.position.y < 0.2 m then reinit(ball.position.y, 5 m); n = 1;"
        ' terminate("put"); end when;',
        2.0, 9.81 * 0.8, 9.81 * 5,
    ),
    "at the stop time": (
        "when time >= 0.25 s then reinit(ball.velocity.y, 3 m/s); n = 1; end when;",
        0.25, 4.5, 9.81 * (1 - 9.81 * 0.25**2 / 2),
    ),
}  # fmt: skip


@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("mass", [1.0, 1e6])
def test_energy_is_kept_but_for_the_jump_that_ends_the_run(end: str, mass: float) -> None:
    events, stop, kinetic, potential = ENDS[end]
    model = frot.compile(TEXT.format(events=events, stop=stop))
    result = model.simulate(parameters={"m": mass})
    assert result["ball.kinetic_energy"][-1] == pytest.approx(mass * kinetic, rel=1e-9, abs=1e-12)
    assert result.balance.mechanical == pytest.approx(mass * (kinetic + potential), rel=1e-9)
    assert abs(result.balance.relative) < 1e-12
    assert "energy is not kept" not in result.summary()
