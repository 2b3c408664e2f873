"""Texts of models of any size, for `scale.py` and its small test."""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from textwrap import dedent


def circuit(n: int) -> str:
    """An RC ladder of n cells of parts with connectors, arrays and loops."""
    return dedent(f"""\
        model Ladder "RC ladder of parts, fed with a step"
          import Electrical.*;
          parameter Integer n = {n};
          ConstantVoltage source(V = 1 V);
          Resistor r[n](R = 1 Ohm);
          Capacitor c[n](C = 1 F);
          Ground earth;
        initial
          for i in 1:n loop
            c[i].v = 0 V;
          end for;
        equation
          connect(source.n, earth.p);
          connect(source.p, r[1].p);
          for i in 1:n loop
            connect(r[i].n, c[i].p);
            connect(c[i].n, earth.p);
          end for;
          for i in 2:n loop
            connect(r[i - 1].n, r[i].p);
          end for;
          experiment(stop = 10 s, tolerance = 1e-8);
        end Ladder;
        """)


def spelled(n: int) -> str:
    """The same ladder, every part and connection written out."""
    parts = "".join(
        f"  Resistor r{i}(R = 1 Ohm);\n  Capacitor c{i}(C = 1 F);\n" for i in range(1, n + 1)
    )
    starts = "".join(f"  c{i}.v = 0 V;\n" for i in range(1, n + 1))
    wires = "".join(
        f"  connect({f'r{i - 1}.n' if i > 1 else 'source.p'}, r{i}.p);\n"
        f"  connect(r{i}.n, c{i}.p);\n  connect(c{i}.n, earth.p);\n"
        for i in range(1, n + 1)
    )
    return (
        'model Spelled "RC ladder of parts, each written out"\n'
        "  import Electrical.*;\n  ConstantVoltage source(V = 1 V);\n  Ground earth;\n"
        f"{parts}initial\n{starts}equation\n  connect(source.n, earth.p);\n{wires}"
        "  experiment(stop = 10 s, tolerance = 1e-8);\nend Spelled;\n"
    )


def resistive(n: int) -> str:
    """A chain of n nodes with resistors between them and a coil from each to the ground.

    The potentials are one linear block of n unknowns.
    """
    return dedent(f"""\
        model Nodes "resistive nodes with a coil each"
          import Electrical.*;
          parameter Integer n = {n};
          ConstantVoltage source(V = 1 V);
          Resistor r[n](R = 1 Ohm);
          Resistor leak[n](R = 10 Ohm);
          Inductor l[n](L = 1 H);
          Ground earth;
        initial
          for i in 1:n loop
            l[i].i = 0 A;
          end for;
        equation
          connect(source.n, earth.p);
          connect(source.p, r[1].p);
          for i in 1:n loop
            connect(r[i].n, l[i].p);
            connect(r[i].n, leak[i].p);
            connect(l[i].n, earth.p);
            connect(leak[i].n, earth.p);
          end for;
          for i in 2:n loop
            connect(r[i - 1].n, r[i].p);
          end for;
          experiment(stop = 10 s, tolerance = 1e-8);
        end Nodes;
        """)


def grid(n: int) -> str:
    """An n by n grid of resistive nodes with a coil from each to the ground."""
    return dedent(f"""\
        model Grid "grid of resistive nodes with a coil each"
          import Electrical.*;
          parameter Integer n = {n};
          ConstantVoltage source(V = 1 V);
          Resistor feed(R = 1 Ohm);
          Resistor east[n*(n - 1)](R = 1 Ohm);
          Resistor north[n*(n - 1)](R = 1 Ohm);
          Inductor l[n*n](L = 1 H);
          Ground earth;
        initial
          for i in 1:n*n loop
            l[i].i = 0 A;
          end for;
        equation
          connect(source.n, earth.p);
          connect(source.p, feed.p);
          connect(feed.n, l[1].p);
          for i in 1:n*n loop
            connect(l[i].n, earth.p);
          end for;
          for i in 1:n loop
            for j in 1:n - 1 loop
              connect(east[(i - 1)*(n - 1) + j].p, l[(i - 1)*n + j].p);
              connect(east[(i - 1)*(n - 1) + j].n, l[(i - 1)*n + j + 1].p);
              connect(north[(i - 1)*(n - 1) + j].p, l[(j - 1)*n + i].p);
              connect(north[(i - 1)*(n - 1) + j].n, l[j*n + i].p);
            end for;
          end for;
          experiment(stop = 10 s, tolerance = 1e-8);
        end Grid;
        """)


def sphere(n: int) -> str:
    """N points that repel each other on a sphere: index 3, n^2 + 4 n variables."""
    # spread evenly along a spiral, none beside another
    starts = []
    for i in range(n):
        z = 1 - (2 * i + 1) / n
        turn, radius = i * pi * (3 - sqrt(5)), sqrt(1 - z * z)
        place = (radius * cos(turn), radius * sin(turn), z)
        starts += [
            f"  guess(x[{i + 1}, {k + 1}] = {item!r});\n  der(x[{i + 1}, {k + 1}]) = 0 1/s;\n"
            for k, item in enumerate(place)
        ]
    return f"""model Points "points that repel each other on a sphere"
  constant Integer n = {n};
  Real x[n, 3] "places";
  Real w[n, n] "how strongly one pushes another, over their distance";
  Real g[n](unit = "1/s^2") "push of the sphere";
initial
{"".join(starts)}equation
  for i in 1:n loop
    for j in 1:n loop
      w[i, j] = if i == j then 0 else
        1/((x[i, 1] - x[j, 1])^2 + (x[i, 2] - x[j, 2])^2 + (x[i, 3] - x[j, 3])^2)^1.5;
    end for;
    for k in 1:3 loop
      der(der(x[i, k])) = g[i]*x[i, k]
        + (sum(w[i, 1:n])*x[i, k] - dot(w[i, 1:n], x[1:n, k]))*1 1/s^2 - 0.5 1/s*der(x[i, k]);
    end for;
    x[i, 1]^2 + x[i, 2]^2 + x[i, 3]^2 = 1;
  end for;
  experiment(stop = 1 s, tolerance = 1e-8);
end Points;
"""


def brusselator(n: int) -> str:
    """Reaction and diffusion in n cells (Hairer, Wanner, Solving ODEs II, IV.1)."""
    return dedent(f"""\
        model Brusselator "two substances that react and diffuse"
          constant Integer n = {n};
          parameter AngularVelocity k = {(n + 1) ** 2 / 50!r} s^-1 "diffusion in a cell";
          Real u[n + 2] "concentration";
          Real v[n + 2] "concentration";
        initial
          for i in 2:n + 1 loop
            u[i] = 1 + sin(2*pi*(i - 1)/(n + 1));
            v[i] = 3;
          end for;
        equation
          u[1] = 1;
          v[1] = 3;
          for i in 2:n + 1 loop
            der(u[i]) = (1 + u[i]^2*v[i] - 4*u[i])*1 1/s + k*(u[i - 1] - 2*u[i] + u[i + 1]);
            der(v[i]) = (3*u[i] - u[i]^2*v[i])*1 1/s + k*(v[i - 1] - 2*v[i] + v[i + 1]);
          end for;
          u[n + 2] = 1;
          v[n + 2] = 3;
          experiment(stop = 10 s, tolerance = 1e-6);
        end Brusselator;
        """)
