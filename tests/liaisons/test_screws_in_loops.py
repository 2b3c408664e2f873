"""A screw that closes a loop starts in any turn: its way tells which."""

from __future__ import annotations

import numpy as np
import pytest

import frot

# what is stated of each spindle, the angle of the screw that follows; pitch 20 mm
STARTS = {
    "a.displacement = 9 mm": 0.9 * np.pi,
    "a.displacement = 11 mm": 1.1 * np.pi,
    "a.displacement = 100 mm": 10 * np.pi,
    "c.angle = 31": 31.0,
    "guess(n.position = (0, 0, -0.24) m)": -24 * np.pi,
}


def test_nuts_on_spindles_start_and_move() -> None:
    """The nut's weight turns the spindle: (m + J (2 pi/p)^2) z'' = -m g."""
    parts, begins = "", ""
    for k, stated in enumerate(STARTS):
        parts += f"""
  body n{k}: box(mass = 1 kg, size = (0.1, 0.2, 0.3) m);
  body s{k}: cylinder(mass = 1 kg, radius = 0.01 m, length = 0.4 m);
  liaison a{k}: prismatique(ground, n{k}, axis = z);
  liaison b{k}: rotoide(ground, s{k}, axis = z);
  liaison c{k}: helicoidale(s{k}, n{k}, axis = z, pitch = 20 mm);"""
        for name in ("a.", "c.", "n."):
            stated = stated.replace(name, f"{name[0]}{k}.")
        begins += f"\n  {stated};"
    result = frot.compile(f"""
model Spindles "Nuts guided by slides"{parts}
initial{begins}
  experiment(stop = 0.5 s, tolerance = 1e-10);
end Spindles;
""").simulate()
    falls = 9.81 / (1 + 0.5e-4 * (2 * np.pi / 0.02) ** 2)
    for k, angle in enumerate(STARTS.values()):
        assert result.at(0.0)[f"c{k}.angle"] == pytest.approx(angle, abs=1e-9)
        z = result[f"a{k}.displacement"]
        assert z[0] == pytest.approx(0.02 * angle / (2 * np.pi), abs=1e-12)
        assert z[-1] - z[0] == pytest.approx(-falls * 0.5**2 / 2, rel=1e-9)
        assert result[f"c{k}.angle"] == pytest.approx(2 * np.pi * z / 0.02, abs=1e-9)
