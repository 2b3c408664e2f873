"""Names of types: each is a dimension (`Length`), or a base type (`Boolean`)."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl.quantities.dimensions import (
    BOOLEAN,
    INTEGER,
    REAL,
    STRING,
    Enumeration,
    Type,
    dimension,
)


def _type(m: int = 0, kg: int = 0, s: int = 0, A: int = 0, K: int = 0) -> Type:
    return Type(dimension=dimension(m, kg, s, A, K))


ACCELERATION = _type(m=1, s=-2)
ANGULAR_ACCELERATION = _type(s=-2)
ANGULAR_MOMENTUM = _type(m=2, kg=1, s=-1)
ANGULAR_VELOCITY = _type(s=-1)
DAMPING = _type(kg=1, s=-1)
ENERGY = _type(m=2, kg=1, s=-2)
FORCE = _type(m=1, kg=1, s=-2)
INERTIA = _type(m=2, kg=1)
LENGTH = _type(m=1)
MASS = _type(kg=1)
MOMENTUM = _type(m=1, kg=1, s=-1)
POWER = _type(m=2, kg=1, s=-3)
ROTATIONAL_DAMPING = _type(m=2, kg=1, s=-1)
STIFFNESS = _type(kg=1, s=-2)
TIME = _type(s=1)
TORQUE = ENERGY
VELOCITY = _type(m=1, s=-1)

TYPES: Mapping[str, Type] = {
    "Real": REAL,
    "Integer": INTEGER,
    "Boolean": BOOLEAN,
    "String": STRING,
    "Length": LENGTH,
    "Angle": REAL,
    "Mass": MASS,
    "Time": TIME,
    "Velocity": VELOCITY,
    "AngularVelocity": ANGULAR_VELOCITY,
    "Acceleration": ACCELERATION,
    "AngularAcceleration": ANGULAR_ACCELERATION,
    "Force": FORCE,
    "Torque": TORQUE,
    "Inertia": INERTIA,
    "Energy": ENERGY,
    "Power": POWER,
    "Stiffness": STIFFNESS,
    "Damping": DAMPING,
    "RotationalStiffness": TORQUE,
    "RotationalDamping": ROTATIONAL_DAMPING,
    "Momentum": MOMENTUM,
    "AngularMomentum": ANGULAR_MOMENTUM,
    "Frequency": ANGULAR_VELOCITY,
    "Area": _type(m=2),
    "Volume": _type(m=3),
    "Density": _type(m=-3, kg=1),
    "Pressure": _type(m=-1, kg=1, s=-2),
    "Curvature": _type(m=-1),
    "Temperature": _type(K=1),
    "Current": _type(A=1),
    "Charge": _type(A=1, s=1),
    "Voltage": _type(m=2, kg=1, s=-3, A=-1),
    "Resistance": _type(m=2, kg=1, s=-3, A=-2),
    "Inductance": _type(m=2, kg=1, s=-2, A=-2),
    "Capacitance": _type(m=-2, kg=-1, s=4, A=2),
}

# One word for a dimension in messages, where a name exists.
MODES = ("open", "stick", "slip")
MODE = Type("integer", enumeration=Enumeration("Mode", MODES))

WORDS: Mapping[Type, str] = {
    REAL: "number",
    LENGTH: "length",
    MASS: "mass",
    TIME: "time",
    VELOCITY: "velocity",
    ANGULAR_VELOCITY: "rate",
    ACCELERATION: "acceleration",
    ANGULAR_ACCELERATION: "angular acceleration",
    FORCE: "force",
    TORQUE: "torque or energy",
    INERTIA: "moment of inertia",
    POWER: "power",
    STIFFNESS: "stiffness",
    DAMPING: "damping",
    ROTATIONAL_DAMPING: "rotational damping",
    MOMENTUM: "momentum",
    _type(m=2): "area",
    _type(m=3): "volume",
    _type(m=-3, kg=1): "density",
    _type(m=-1, kg=1, s=-2): "pressure",
    _type(K=1): "temperature",
    _type(A=1, s=1): "charge",
    _type(A=1): "current",
    _type(m=2, kg=1, s=-3, A=-1): "voltage",
    _type(m=2, kg=1, s=-3, A=-2): "resistance",
    _type(m=2, kg=1, s=-2, A=-2): "inductance",
    _type(m=-2, kg=-1, s=4, A=2): "capacitance",
}
