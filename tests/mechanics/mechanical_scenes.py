"""The scenes of these tests as texts, compiled when first asked for, and what is common to runs."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

import frot

REFERENCE = Path(__file__).parents[1] / "reference" / "mechanics.json"

# Gravity is a force on G so that it can have any direction; `turn` is its angle with the x axis.
_WEIGHT = """
  world(gravity = 0 m/s^2);
  force weight: on({body}, value = (m*g*cos(turn), m*g*sin(turn)));
"""
_DOWN = "  world(gravity = g, down = {down});\n"

BLOCK = """
planar model Block "Particle on a rough line at the angle `slope`, launched along it"
  parameter Mass m = 1 kg;
  parameter Acceleration g = 9.81 m/s^2;
  parameter Angle turn = -90 deg;
  parameter Angle slope = 0 deg;
  parameter Real mu = 0.3;
  parameter Length x0 = 0 m;
  parameter Length y0 = 0 m;
  parameter Velocity v0 = 1 m/s;
{world}
  body b: particle(mass = m);
  curve line on ground: line(through = (x0, y0), direction = (cos(slope), sin(slope)));
  liaison support: point_courbe(b, line) with coulomb(mu);
initial
  support.abscissa = 0 m;
  b.velocity = (v0*cos(slope), v0*sin(slope));
  experiment(stop = 3 s, tolerance = 1e-11);
end Block;
"""

OSCILLATOR = """
planar model Oscillator "Particle on a rough line, drawn to a point of it"
  parameter Mass m = 1 kg;
  parameter Acceleration g = 9.81 m/s^2;
  parameter Angle turn = -90 deg;
  parameter Angle slope = 0 deg;
  parameter Real mu = 0.1;
  parameter Stiffness k = 9 N/m;
  parameter Length s0 = 2 m;
  parameter Length x0 = 0 m;
  parameter Length y0 = 0 m;
  world(gravity = 0 m/s^2);
  body b: particle(mass = m);
  curve line on ground: line(through = (x0, y0), direction = (cos(slope), sin(slope)));
  liaison guide: point_courbe(b, line) with coulomb(mu);
  force pull: attraction(b, (x0, y0), k = k);
  force weight: on(b, value = (m*g*cos(turn), m*g*sin(turn)));
initial
  guide.abscissa = s0;
  experiment(stop = 12 s, tolerance = 1e-11);
end Oscillator;
"""

HOOP = """
planar model Hoop "Round body on a rough line at the angle `slope`, above it (up = 1) or below"
  parameter Mass m = 1 kg;
  parameter Length r = 0.5 m;
  parameter Inertia J = m*r^2;
  parameter Acceleration g = 9.81 m/s^2;
  parameter Angle turn = -90 deg;
  parameter Angle slope = 0 deg;
  parameter Real up = 1;
  parameter Real mu = 0.3;
  parameter Length delta = 0 m;
  parameter Length x0 = 0 m;
  parameter Length y0 = 0 m;
  parameter Velocity v0 = 1 m/s;
  parameter AngularVelocity w0 = 20 rad/s;
{world}
  body hoop: ring(mass = m, radius = r, inertia = J);
  curve line on ground: line(through = (x0, y0), direction = (cos(slope), sin(slope)));
  liaison floor: contact_ponctuel(line, hoop.rim) with coulomb(mu), rolling_resistance(delta);
initial
  hoop.position = (x0 - up*r*sin(slope), y0 + up*r*cos(slope));
  hoop.velocity = (v0*cos(slope), v0*sin(slope));
  hoop.angular_velocity = w0;
  experiment(stop = 3 s, tolerance = 1e-11);
end Hoop;
"""

BEAD_AND_SPRING = """
planar model BeadAndSpring "Bead on a rough inclined line, a spring to a point off the line"
  parameter Real mu = 0.2;
  parameter Stiffness k = 15 N/m;
  parameter Length rest = 0.8 m;
  parameter Length off = 0.7 m;
  parameter Length s0 = -1 m;
  parameter Velocity v0 = 6 m/s;
  parameter Angle slope = 20 deg;
  body b: particle(mass = 1 kg);
  frame eye on ground at (-off*sin(slope), off*cos(slope));
  curve line on ground: line(through = (0, 0) m, direction = (cos(slope), sin(slope)));
  liaison guide: point_courbe(b, line) with coulomb(mu);
  force elastic: spring(eye, b, k = k, length = rest);
initial
  guide.abscissa = s0;
  b.velocity = (v0*cos(slope), v0*sin(slope));
  experiment(stop = 0.4 s, tolerance = 1e-11);
end BeadAndSpring;
"""

PULLED = """
planar model Pulled "Block on a rough slope under a force that grows with time"
  parameter Mass m = 1 kg;
  parameter Real mu = 0.25;
  parameter Real mu_s = 0.4;
  parameter Angle slope = 0 deg;
  parameter Force rate = 2 N;
  body b: particle(mass = m);
  curve line on ground: line(through = (0, 0) m, direction = (cos(slope), sin(slope)));
  liaison support: point_courbe(b, line) with coulomb(mu, mu_s = mu_s);
  force pull: on(b, value = (rate*(time/(1 s))*cos(slope), rate*(time/(1 s))*sin(slope)));
initial
  support.abscissa = 0 m;
  experiment(stop = 4 s, tolerance = 1e-11);
end Pulled;
"""

DRAGGED = """
planar model Dragged "Block drawn by a spring whose far end moves at a constant speed"
  parameter Mass m = 1 kg;
  parameter Acceleration g = 10 m/s^2;
  parameter Stiffness k = 100 N/m;
  parameter Velocity V = 0.2 m/s;
  parameter Real mu = 0.25;
  parameter Real mu_s = 0.4;
  world(gravity = g);
  body b: particle(mass = m);
  liaison support: point_courbe(b, ground.line) with coulomb(mu, mu_s = mu_s);
  force elastic: spring(b, (V*time, 0 m), k = k, length = 0 m);
initial
  b.position = (0, 0) m;
  experiment(stop = 7 s, tolerance = 1e-11);
end Dragged;
"""

TWO_BLOCKS = """
planar model TwoBlocks "Two equal blocks joined by a spring, let go at rest: mirror images"
  parameter Mass m = 1 kg;
  parameter Stiffness k = 30 N/m;
  parameter Length rest = 1 m;
  parameter Length stretch = 1 m;
  parameter Length apart = 0 m "distance of the two lines";
  parameter Real mu = 0.2;
  body a: particle(mass = m);
  body b: particle(mass = m);
  curve high on ground: line(through = (0 m, apart), direction = (1, 0));
  liaison left: point_courbe(a, ground.line) with coulomb(mu);
  liaison right: point_courbe(b, high) with coulomb(mu);
  force elastic: spring(a, b, k = k, length = rest);
initial
  a.position = (-(rest + stretch)/2, 0 m);
  b.position = ((rest + stretch)/2, apart);
  experiment(stop = 5 s, tolerance = 1e-11);
end TwoBlocks;
"""

SLOPES = (0.0, 0.3, -0.4, 0.15, 0.5)


def _five_blocks() -> str:
    lines = ["planar model FiveBlocks", "  parameter Stiffness k = 8 N/m;"]
    lines += ["  parameter Real mu = 0.15;"]
    for i, slope in enumerate(SLOPES):
        lines += [
            f"  body b{i}: particle(mass = {1 + 0.25 * i} kg);",
            f"  curve c{i} on ground: line(through = ({0.2 * i} m, {0.05 * i} m),"
            f" direction = (cos({slope}), sin({slope})));",
            f"  liaison l{i}: point_courbe(b{i}, c{i}) with coulomb(mu);",
        ]
    for i in range(4):
        lines.append(f"  force s{i}: spring(b{i}, b{i + 1}, k = k, length = 0 m);")
    lines += ["initial"]
    for i in range(5):
        lines.append(f"  l{i}.abscissa = {(0.9, -0.7, 0.4, -1.1, 0.6)[i]} m;")
    lines += ["  experiment(stop = 6 s, tolerance = 1e-12);", "end FiveBlocks;"]
    return "\n".join(lines)


FIVE_BLOCKS = _five_blocks()

WEDGE_AND_HOOP = """
planar model WedgeAndHoop "Hoop on the rough slope of a wedge that slides without friction"
  parameter Acceleration g = 9.81 m/s^2;
  parameter Mass M = 2 kg;
  parameter Angle C = 0.5 rad;
  parameter Real f = 0.1;
  parameter Length r = 0.3 m;
  parameter Velocity v0 = 0.1 m/s "of the hoop on the wedge, down the slope";
  world(gravity = g);
  body wedge: particle(mass = M);
  body hoop: ring(mass = 1 kg, radius = r);
  curve slope on wedge: line(through = (0, 0) m, direction = (cos(C), -sin(C)));
  liaison floor: point_courbe(wedge, ground.line);
  liaison side: contact_ponctuel(slope, hoop.rim) with coulomb(f);
initial
  wedge.position = (0, 0) m;
  wedge.velocity = (0, 0) m/s;
  hoop.position = (r*sin(C), r*cos(C));
  hoop.velocity = (v0*cos(C), -v0*sin(C));
  experiment(stop = 1 s, tolerance = 1e-11);
end WedgeAndHoop;
"""

WEDGE_AND_BEAD = """
planar model WedgeAndBead "Bead on the rough slope of a wedge that rubs on the ground"
  parameter Mass M = 2 kg;
  parameter Angle C = 0.6 rad;
  parameter Real f = 0.1;
  parameter Real f_ground = 0.05;
  parameter Velocity v0 = 1 m/s;
  body wedge: particle(mass = M);
  body bead: particle(mass = 1 kg);
  curve slope on wedge: line(through = (0, 0) m, direction = (cos(C), -sin(C)));
  liaison floor: point_courbe(wedge, ground.line) with coulomb(f_ground);
  liaison side: point_courbe(bead, slope) with coulomb(f);
initial
  wedge.position = (0, 0) m;
  wedge.velocity = (0, 0) m/s;
  side.abscissa = 0 m;
  bead.velocity = (v0*cos(C), -v0*sin(C));
  experiment(stop = 1 s, tolerance = 1e-11);
end WedgeAndBead;
"""

BAR = """
planar model Bar "Homogeneous bar, its ends on two perpendicular rough lines"
  parameter Real f = 0.3;
  parameter Real f1 = 0.2;
  parameter Angle th0 = 0.4 rad;
  parameter AngularVelocity w0 = 1 rad/s;
  parameter Mass m = 1 kg;
  parameter Length length = 2 m;
  parameter Angle turn = 0 rad;
  world(gravity = 0 m/s^2);
  body bar: rod(mass = m, length = length);
  curve ox on ground: line(through = (0, 0) m, direction = (cos(turn), sin(turn)));
  curve oy on ground: line(through = (0, 0) m, direction = (-sin(turn), cos(turn)));
  liaison a: point_courbe(bar.start, ox) with coulomb(f);
  liaison b: point_courbe(bar.tip, oy) with coulomb(f1);
initial
  bar.angle = {angle} + turn;
  bar.angular_velocity = {rate};
  experiment(stop = 6 s, tolerance = 1e-12);
end Bar;
"""

DUMBBELL = """
planar model Dumbbell "Two unit points and a massless rod; gravity along +y, across the line"
  parameter Real f = 0.5;
  parameter Angle th = 0.7 rad;
  parameter AngularVelocity w0 = 1 rad/s;
  parameter Velocity v0 = 1 m/s;
  parameter Length r = 1 m;
  world(gravity = 9.81 m/s^2, down = +y);
  body points: rod(mass = 2 kg, length = r, inertia = 0.5 kg*r^2);
  liaison guide: point_courbe(points.start, ground.line) with coulomb(f);
initial
  points.start.position = (0, 0) m;
  points.angle = th;
  points.angular_velocity = w0;
  points.start.velocity = (v0, 0 m/s);
  experiment(stop = 1e-3 s, tolerance = 1e-11{option});
end Dumbbell;
"""

PARALLEL = """
planar model Parallel "Two unit points joined by a massless rod on two parallel rough lines"
  parameter Real f = 0.5;
  parameter Real f1 = 0.3;
  parameter Angle alpha = 0.9 rad;
  parameter Length length = 1 m;
  parameter Velocity v0 = 1 m/s;
  parameter Force X = 2 N;
  parameter Force X1 = 1 N;
  world(gravity = 0 m/s^2);
  body rod: rod(mass = 2 kg, length = length, inertia = 0.5 kg*length^2);
  curve pq on ground: line(through = (0 m, length*sin(alpha)), direction = (1, 0));
  liaison low: point_courbe(rod.start, ground.line) with coulomb(f);
  liaison high: point_courbe(rod.tip, pq) with coulomb(f1);
  force a: on(rod.start, value = (X, 0 N));
  force b: on(rod.tip, value = (X1, 0 N));
initial
  rod.start.position = (0, 0) m;
  rod.angle = alpha;
  rod.velocity = (v0, 0 m/s);
  experiment(stop = 1e-3 s, tolerance = 1e-11{option});
end Parallel;
"""

PAINLEVE_ROD = """
planar model PainleveRod "Homogeneous rod, its tip on the rough ground"
  parameter Real f = 0.5;
  parameter Angle th = 1.1 rad;
  parameter AngularVelocity w0 = 0 rad/s;
  parameter Velocity v0 = 1 m/s;
  parameter Length l = 1 m;
  body rod: rod(mass = 1 kg, length = 2*l);
  liaison tip: contact_ponctuel(ground.line, rod.start) with coulomb(f);
initial
  rod.start.position = (0, 0) m;
  rod.start.velocity = (v0, 0 m/s);
  rod.angle = th;
  rod.angular_velocity = w0;
  experiment(stop = 1e-3 s, tolerance = 1e-11{option});
end PainleveRod;
"""

GROOVE = """
planar model Groove "Hoop in a groove of two rough lines, spinning in place"
  parameter Real mu = 0.3;
  parameter Angle beta = 0.6 rad;
  parameter AngularVelocity w0 = 0 rad/s;
  parameter Length r = 0.5 m;
  parameter Length delta = 0 m;
  body hoop: ring(mass = 1 kg, radius = r);
  curve left on ground: line(through = (0, 0) m, direction = (cos(beta), -sin(beta)));
  curve right on ground: line(through = (0, 0) m, direction = (cos(beta), sin(beta)));
  liaison a: contact_ponctuel(left, hoop.rim) with coulomb(mu), rolling_resistance(delta);
  liaison b: contact_ponctuel(right, hoop.rim) with coulomb(mu), rolling_resistance(delta);
initial
  hoop.position = (0 m, r/cos(beta));
  hoop.velocity = (0, 0) m/s;
  hoop.angular_velocity = w0;
  experiment(stop = 3 s, tolerance = 1e-11);
end Groove;
"""

SWUNG_ROD = """
planar model SwungRod "Homogeneous rod hung from a point of a line, let go at rest"
  parameter Length length = 1 m;
  parameter Angle th = -30 deg;
  parameter Real mu = 0;
  body rod: rod(mass = 1 kg, length = length);
  liaison guide: point_courbe(rod.start, ground.line) with coulomb(mu);
initial
  rod.start.position = (0, 0) m;
  rod.angle = th;
  experiment(stop = 2 s, tolerance = 1e-10);
end SwungRod;
"""

LIFTED = """
planar model Lifted "Ring on the ground, drawn up by a force that grows with time"
  parameter Mass m = 1 kg;
  parameter Force rate = 5 N;
  parameter Velocity v0 = 3 m/s;
  parameter Real mu = 0.2;
  parameter Length r = 0.3 m;
  body ring: ring(mass = m, radius = r);
  liaison floor: contact_ponctuel(ground.line, ring.rim) with coulomb(mu);
  force up: on(ring, value = (0 N, rate*(time/(1 s))));
initial
  ring.position = (0 m, r);
  ring.velocity = (v0, 0 m/s);
  ring.angular_velocity = 0 rad/s;
  experiment(stop = 4 s, tolerance = 1e-11);
end Lifted;
"""

TURNED_REACTION = """
planar model TurnedReaction "Bead in a rough tube; a force across it turns the reaction"
  parameter Mass m = 1 kg;
  parameter Acceleration g = 9.81 m/s^2;
  parameter Force before = 0 N;
  parameter Force rate = 5 N;
  parameter Velocity v0 = 6 m/s;
  parameter Real mu = 0.2;
  world(gravity = g);
  body b: particle(mass = m);
  liaison tube: point_courbe(b, ground.line) with coulomb(mu);
  force across: on(b, value = (0 N, before + rate*(time/(1 s))));
initial
  b.position = (0, 0) m;
  b.velocity = (v0, 0 m/s);
  experiment(stop = 3 s, tolerance = 1e-11);
end TurnedReaction;
"""

PUSHED = """
planar model Pushed "Bead on a smooth line under a force written with a condition"
  parameter Mass m = 1 kg;
  parameter Force P = 3 N;
  parameter Force Q = -2 N;
  parameter Time t1 = 1.2345 s;
  parameter Length s0 = 0 m;
  parameter Velocity v0 = 0 m/s;
  parameter Stiffness k = 4 N/m;
  world(gravity = 0 m/s^2);
  body b: particle(mass = m);
  liaison line: point_courbe(b, ground.line);
  force push: on(b, value = ({value}, 0 N));
initial
  b.position = (s0, 0 m);
  b.velocity = (v0, 0 m/s);
  experiment(stop = 4 s, tolerance = 1e-11);
end Pushed;
"""


def weighed(text: str, body: str) -> str:
    """The scene with its weight as a force of any direction."""
    return text.format(world=_WEIGHT.format(body=body))


def falling(text: str, down: str) -> str:
    """The scene with gravity along an axis."""
    return text.format(world=_DOWN.format(down=down))


class Scenes:
    """Compiled models by their text."""

    def __init__(self) -> None:
        self._models: dict[str, frot.Model] = {}

    def model(self, text: str) -> frot.Model:
        if text not in self._models:
            self._models[text] = frot.compile(text)
        return self._models[text]

    def run(self, text: str, **options):
        """Simulate with keywords as parameters, but for `stop`, `start` and `tolerance`."""
        asked = {n: options.pop(n) for n in ("stop", "start", "tolerance") if n in options}
        return self.model(text).simulate(parameters=options, **asked)


def rows(kind: str) -> list[dict]:
    """Rows of a kind in the reference values."""
    every = json.loads(REFERENCE.read_text(encoding="utf-8"))
    return [row for row in every if row["id"].rsplit("-", 1)[0] == kind]


def row(name: str) -> dict:
    """One row of the reference values."""
    return next(r for r in rows(name.rsplit("-", 1)[0]) if r["id"] == name)


def near(value: float, expected: float, scale: float | None = None, rel: float = 1e-10) -> bool:
    """Whether a value agrees to `rel` of `scale` (default: the expected value)."""
    return abs(value - expected) <= rel * (abs(expected) if scale is None else scale)


def times_of(result, *kinds: str) -> np.ndarray:
    """Times of the events of these kinds (all kinds if none is named)."""
    return np.array([e.time for e in result.events if not kinds or e.kind in kinds])


def rests_from(result, t: float, body: str) -> bool:
    """Whether the body's speed is zero and its position the same to the bit after t."""
    values = result.at(np.linspace(np.nextafter(t, np.inf), result.time[-1], 200))
    names = [n for n in values if n.startswith(f"{body}.")]
    still = all(
        np.all(values[n] == 0.0) for n in names if "velocity" in n or n.endswith("kinetic_energy")
    )
    kept = all(
        np.all(values[n] == values[n][-1])
        for n in names
        if ".position" in n or n.endswith(".angle")
    )
    return still and kept
