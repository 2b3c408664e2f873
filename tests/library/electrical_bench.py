"""Parts of `Electrical`, each in a circuit of its own with a closed form."""

from __future__ import annotations

import numpy as np
from reference import Bench, Reference, Signal

TEXT = """
model ElectricalBench
  import Electrical.*;
  import Rotational;
  Ground earth;

  // a battery charges a leaking capacitor
  ConstantVoltage battery(V = 5.3 V);
  Resistor r(R = 0.7 Ohm);
  Capacitor c(C = 0.9 F);
  Conductor leak(G = 0.31);
  CurrentSensor charging;
  VoltageSensor charged;

  // a coil on an alternating voltage
  VoltageSource mains;
  Resistor r_coil(R = 1.3 Ohm);
  Inductor coil(L = 0.8 H);

  // a switch between a battery and a resistor
  Switch key(closed_resistance = 0.2 Ohm, open_resistance = 900 Ohm);
  Resistor r_key(R = 3.1 Ohm);

  // a diode on an alternating voltage
  Diode diode(forward = 0.45 V, on_resistance = 0.6 Ohm, off_resistance = 800 Ohm);
  Resistor r_diode(R = 2.2 Ohm);

  // a machine that runs up
  Resistor r_machine(R = 1.9 Ohm);
  Emf machine(k = 0.77);
  Rotational.Inertia rotor(J = 0.46 kg.m^2);

  // a current into a capacitor
  CurrentSource pump;
  Capacitor filled(C = 1.6 F);

  // a transformer with a loaded second winding
  IdealTransformer transformer(ratio = 2.7);
  Resistor r_load(R = 1.15 Ohm);

  // an amplifier that inverts and integrates
  OpAmp amplifier;
  Resistor r_in(R = 1.7 Ohm);
  Capacitor feedback(C = 0.52 F);
  Resistor r_out(R = 4 Ohm);

initial
  c.v = -0.8 V;
  coil.i = 0.6 A;
  rotor.angle = 0 rad;
  rotor.speed = -0.9 rad/s;
  filled.v = 0.25 V;
  feedback.v = 0.35 V;

equation
  connect(battery.n, earth.p);
  connect(battery.p, r.p);        connect(r.n, charging.p);      connect(charging.n, c.p);
  connect(c.n, earth.p);          connect(leak.p, c.p);          connect(leak.n, earth.p);
  connect(charged.p, c.p);        connect(charged.n, earth.p);

  mains.voltage = 2.4 V*sin(3.1 rad/s*time);
  connect(mains.n, earth.p);
  connect(mains.p, r_coil.p);     connect(r_coil.n, coil.p);     connect(coil.n, earth.p);

  key.closed = time > 0.7 s and time < 1.9 s;
  connect(battery.p, key.p);      connect(key.n, r_key.p);       connect(r_key.n, earth.p);

  connect(mains.p, diode.p);      connect(diode.n, r_diode.p);   connect(r_diode.n, earth.p);

  connect(battery.p, r_machine.p); connect(r_machine.n, machine.p); connect(machine.n, earth.p);
  connect(machine.shaft, rotor.a);

  pump.current = 0.6 A/s*time;
  connect(pump.p, earth.p);       connect(pump.n, filled.p);     connect(filled.n, earth.p);

  connect(mains.p, transformer.p1); connect(transformer.n1, earth.p);
  connect(transformer.p2, r_load.p); connect(r_load.n, earth.p);
  connect(transformer.n2, earth.p);

  connect(mains.p, r_in.p);       connect(r_in.n, amplifier.in_n);
  connect(amplifier.in_p, earth.p);
  connect(feedback.p, amplifier.in_n); connect(feedback.n, amplifier.out);
  connect(r_out.p, amplifier.out); connect(r_out.n, earth.p);

  experiment(stop = 2.5 s, tolerance = 1e-11);
end ElectricalBench;
"""

# The leaking capacitor: the voltage goes to that of the divider, with the conductance of both.
DIVIDED = 5.3 / (1 + 0.7 * 0.31)
CHARGING = (1 / 0.7 + 0.31) / 0.9


def charged(t: Signal) -> Signal:
    return DIVIDED + (-0.8 - DIVIDED) * np.exp(-CHARGING * t)


def mains(t: Signal) -> Signal:
    return 2.4 * np.sin(3.1 * t)


def coil_current(t: Signal) -> Signal:
    r, x = 1.3, 3.1 * 0.8
    swing = 2.4 / (r**2 + x**2)
    forced = swing * (r * np.sin(3.1 * t) - x * np.cos(3.1 * t))
    return forced + (0.6 + swing * x) * np.exp(-1.3 / 0.8 * t)


def key_current(t: Signal) -> Signal:
    return 5.3 / (3.1 + np.where((t > 0.7) & (t < 1.9), 0.2, 900.0))


def diode_current(t: Signal) -> Signal:
    """Two straight lines: the bend is where the drop of the diode is its forward voltage."""
    bend = 0.45 * (1 + 2.2 / 800)
    conducting = (mains(t) - 0.45 + 0.45 * 0.6 / 800) / (2.2 + 0.6)
    return np.where(mains(t) > bend, conducting, mains(t) / (2.2 + 800))


RUNNING = 5.3 / 0.77
GAIN = 0.77**2 / (1.9 * 0.46)


def rotor_speed(t: Signal) -> Signal:
    return RUNNING + (-0.9 - RUNNING) * np.exp(-GAIN * t)


def amplified(t: Signal) -> Signal:
    """The output is the drop of the capacitor below zero, which integrates the current of r_in."""
    return -0.35 - 2.4 / 3.1 * (1 - np.cos(3.1 * t)) / (1.7 * 0.52)


BENCH = Bench(
    "Electrical",
    TEXT,
    {
        "Ground": (Reference("earth.p.v", lambda t: 0.0, bound=1e-15),),
        "ConstantVoltage": (Reference("battery.v", lambda t: 5.3, bound=1e-14),),
        "Resistor": (Reference("r.i", lambda t: (5.3 - charged(t)) / 0.7),),
        "Capacitor": (Reference("c.v", charged),),
        "Conductor": (Reference("leak.i", lambda t: 0.31 * charged(t)),),
        "CurrentSensor": (Reference("charging.y", lambda t: (5.3 - charged(t)) / 0.7),),
        "VoltageSensor": (Reference("charged.y", charged),),
        "VoltageSource": (Reference("mains.p.v", mains, bound=1e-12),),
        "Inductor": (Reference("coil.i", coil_current),),
        "Switch": (Reference("key.i", key_current, bound=1e-12, jumps=(0.7, 1.9)),),
        "Diode": (Reference("diode.i", diode_current),),
        "Emf": (
            Reference("rotor.speed", rotor_speed),
            Reference("machine.i", lambda t: (5.3 - 0.77 * rotor_speed(t)) / 1.9),
        ),
        "CurrentSource": (Reference("filled.v", lambda t: 0.25 + 0.3 * t**2 / 1.6),),
        "IdealTransformer": (
            Reference("r_load.v", lambda t: mains(t) / 2.7),
            Reference("transformer.p1.i", lambda t: mains(t) / 2.7**2 / 1.15),
        ),
        "OpAmp": (
            Reference("r_out.v", amplified),
            Reference("amplifier.out.i", lambda t: mains(t) / 1.7 - amplified(t) / 4),
        ),
    },
)
