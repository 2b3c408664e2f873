"""Relations and inertia of the block and the chain in C: Siconos takes them from a library."""

from __future__ import annotations

import math
import subprocess
import tempfile
from pathlib import Path

from peers.impact_scenes import BLOCK, CHAIN

# q of the block: centre and tilt; of the chain: its first end, and the angles of the rods.
# Matrices are stored by columns.
SOURCE = r"""
#include <math.h>
#include <string.h>
#define N %(rods)d
#define SIZE (N + 2)
typedef unsigned int U;
static const double L = %(length).17g, M = %(mass).17g;

/* Height and place of a corner at (a, b) of the block, and their slopes. */
#define CORNER(name, a, b)                                                                  \
  void name##_h(U nq, double *q, U ny, double *y, U nz, double *z) {                        \
    double s = sin(q[2]), c = cos(q[2]);                                                    \
    (void)nq, (void)nz, (void)z;                                                            \
    y[0] = q[1] + (a) * s + (b) * c;                                                        \
    if (ny > 1) y[1] = q[0] + (a) * c - (b) * s;                                            \
  }                                                                                         \
  void name##_G(U nq, double *q, U ny, double *g, U nz, double *z) {                        \
    double s = sin(q[2]), c = cos(q[2]);                                                    \
    (void)nz, (void)z;                                                                      \
    memset(g, 0, sizeof(double) * nq * ny);                                                 \
    g[ny] = 1, g[2 * ny] = (a) * c - (b) * s;                                               \
    g[1] = 1, g[1 + 2 * ny] = -(a) * s - (b) * c;                                           \
  }
CORNER(left, -%(half_wide).17g, -%(half_high).17g)
CORNER(right, %(half_wide).17g, -%(half_high).17g)

static void end_h(int k, const double *q, U ny, double *y) {
  y[0] = q[1];
  if (ny > 1) y[1] = q[0];
  for (int i = 0; i < k; i++) {
    y[0] += L * sin(q[2 + i]);
    if (ny > 1) y[1] += L * cos(q[2 + i]);
  }
}
static void end_G(int k, const double *q, U ny, double *g) {
  memset(g, 0, sizeof(double) * SIZE * ny);
  g[ny] = 1, g[1] = 1;
  for (int i = 0; i < k; i++)
    g[(2 + i) * ny] = L * cos(q[2 + i]), g[1 + (2 + i) * ny] = -L * sin(q[2 + i]);
}
#define END(k)                                                                              \
  void end##k##_h(U nq, double *q, U ny, double *y, U nz, double *z) {                      \
    (void)nq, (void)nz, (void)z, end_h(k, q, ny, y);                                        \
  }                                                                                         \
  void end##k##_G(U nq, double *q, U ny, double *g, U nz, double *z) {                      \
    (void)nq, (void)nz, (void)z, end_G(k, q, ny, g);                                        \
  }
%(ends)s

/* Slopes of the centre of rod k. */
static double along(int k, int i, double value) {
  return i < k ? L * value : i == k ? 0.5 * L * value : 0;
}
void mass(U n, double *q, double *m, U nz, double *z) {
  (void)nz, (void)z;
  memset(m, 0, sizeof(double) * n * n);
  for (int k = 0; k < N; k++) {
    double x[SIZE] = {1}, y[SIZE] = {0, 1};
    for (int i = 0; i < N; i++)
      x[2 + i] = along(k, i, -sin(q[2 + i])), y[2 + i] = along(k, i, cos(q[2 + i]));
    for (U i = 0; i < n; i++)
      for (U j = 0; j < n; j++) m[i + n * j] += M * (x[i] * x[j] + y[i] * y[j]);
    m[(2 + k) * (n + 1)] += M * L * L / 12;
  }
}
/* Inertial forces of the speeds, and minus the weights. */
void gyroscopic(U n, double *q, double *v, double *f, U nz, double *z) {
  (void)nz, (void)z;
  memset(f, 0, sizeof(double) * n);
  for (int k = 0; k < N; k++) {
    double ax = 0, ay = %(gravity).17g;
    for (int i = 0; i <= k; i++) {
      ax += along(k, i, -cos(q[2 + i])) * v[2 + i] * v[2 + i];
      ay += along(k, i, -sin(q[2 + i])) * v[2 + i] * v[2 + i];
    }
    f[0] += M * ax, f[1] += M * ay;
    for (int i = 0; i <= k; i++)
      f[2 + i] += M * (along(k, i, -sin(q[2 + i])) * ax + along(k, i, cos(q[2 + i])) * ay);
  }
}
"""


def library(gravity: float) -> str:
    """The path of the compiled library, without its ending."""
    folder = Path(tempfile.mkdtemp(prefix="frot-bench-siconos-"))
    text = SOURCE % {
        "rods": CHAIN.rods,
        "length": CHAIN.length,
        "mass": CHAIN.mass,
        "half_wide": BLOCK.wide / 2,
        "half_high": BLOCK.high / 2,
        "gravity": gravity,
        "ends": "\n".join(f"END({k})" for k in range(CHAIN.rods + 1)),
    }
    (folder / "corners.c").write_text(text)
    command = ["cc", "-O2", "-shared", "-fPIC", "corners.c", "-o", "corners.so", "-lm"]
    subprocess.run(command, cwd=folder, check=True)
    return str(folder / "corners")


def start_height() -> float:
    """Of the block's centre, on one corner."""
    return BLOCK.wide / 2 * math.sin(BLOCK.tilt) + BLOCK.high / 2 * math.cos(BLOCK.tilt)
