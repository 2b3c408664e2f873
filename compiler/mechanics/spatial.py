"""Vectors, rotations and moving axes in CasADi expressions.

All vectors have three components in ground axes unless a name says otherwise. A planar model is the
same algebra with structural zeros: what does not exist in the plane is never written.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

X, Y, Z = (ca.SX(ca.DM.eye(3)[:, k]) for k in range(3))


def nowhere() -> ca.SX:
    """The zero vector, without entries."""
    return ca.SX(3, 1)


def whole(value: ca.SX) -> ca.SX:
    """A vector of the text (2 or 3) in three components; `(x, y)` gets no third."""
    if value.numel() != 2:
        return ca.sparsify(value)
    vector = nowhere()
    vector[0], vector[1] = value[0], value[1]
    return ca.sparsify(vector)


def about_z(value: ca.SX) -> ca.SX:
    """A vector along z of this size."""
    vector = nowhere()
    vector[2] = value
    return vector


def cross(a: ca.SX, b: ca.SX) -> ca.SX:
    """Vector product without the entries that are zero by structure."""
    return ca.sparsify(ca.cross(a, b)) if a.nnz() and b.nnz() else nowhere()


def size_of_cross(a: ca.SX, b: ca.SX) -> ca.SX:
    """Sizes of the terms of a vector product of sizes, component by component."""
    a, b = ca.fabs(a), ca.fabs(b)
    parts = (a[i] * b[j] + a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1)))
    return ca.sparsify(ca.vertcat(*parts))


def turn_in_plane(angle: ca.SX) -> ca.SX:
    """R (3 x 3): axes turned about z."""
    c, s = ca.cos(angle), ca.sin(angle)
    axes = ca.SX(3, 3)
    axes[0, 0], axes[0, 1], axes[1, 0], axes[1, 1], axes[2, 2] = c, -s, s, c, 1
    return axes


def turn_about(axis: ca.SX, angle: ca.SX) -> ca.SX:
    """R (3 x 3): axes turned about a unit vector (O. Rodrigues 1840)."""
    along = axis @ axis.T
    across = ca.sparsify(ca.SX.eye(3) - along)
    return ca.sparsify(along + ca.cos(angle) * across + ca.sin(angle) * ca.skew(axis))


def axes_of(quaternion: ca.SX) -> ca.SX:
    """R (3 x 3) of a quaternion (w, x, y, z), of whatever length.

    Between the stages of a step the length is no longer one to the order of the turn's square; axes
    of unit length at right angles leave no trace of it. Of none, reported as no orientation,
    they are those of the base.
    """
    w, x, y, z = ca.vertsplit(quaternion)
    two = 2 / ca.fmax(w * w + x * x + y * y + z * z, _NO_LENGTH)
    return ca.blockcat(
        [
            [1 - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y)],
            [two * (x * y + w * z), 1 - two * (x * x + z * z), two * (y * z - w * x)],
            [two * (x * z - w * y), two * (y * z + w * x), 1 - two * (x * x + y * y)],
        ]
    )


def product(a: ca.SX, b: ca.SX) -> ca.SX:
    """Product of quaternions: first turned by b, then by a."""
    vector = a[0] * b[1:] + b[0] * a[1:] + ca.cross(a[1:], b[1:])
    return ca.vertcat(a[0] * b[0] - ca.dot(a[1:], b[1:]), vector)


def conjugate(quaternion: ca.SX) -> ca.SX:
    """The turn back."""
    return ca.vertcat(quaternion[0], -quaternion[1:])


def turning(axis: ca.SX, angle: ca.SX) -> ca.SX:
    """The quaternion of a turn about a unit vector."""
    return ca.vertcat(ca.cos(angle / 2), ca.sin(angle / 2) * axis)


def beside(axis: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Two unit vectors that make a right-handed trihedral with a unit vector, it being the last.

    For z these are x and y. They jump where the choice changes: no motion meets these places, for
    the axis depends on parameters at most (else see `beside_moving`, and `values.beside_given`).
    """
    for k, pair in enumerate(((Y, Z), (Z, X), (X, Y))):
        if axis.nnz() == 1 and axis[k].is_one():
            return pair
    from_x = ca.fabs(axis[0]) < 0.75 * ca.norm_2(axis)
    start = ca.if_else(from_x, ca.DM([1, 0, 0]), ca.DM([0, 1, 0]))
    first = start - ca.dot(start, axis) * axis
    first = ca.sparsify(ca.simplify(first / ca.norm_2(first)))
    return first, cross(axis, first)


def beside_moving(axis: ca.SX) -> tuple[ca.SX, ca.SX]:
    """The same of an axis n that moves, by the shortest turn that takes a fixed e to n.

    They jump at n = -e alone, and no other directions would do so nowhere (H. Hopf 1926); e is none
    that a text would name.
    """
    e, *others = (ca.SX(ca.DM(x)) / 7 for x in ((2, 3, 6), (3, -6, 2), (6, 2, -3)))
    both = axis + e
    near = ca.fmax(1 + ca.dot(axis, e), _NEAR_JUMP)
    first, second = (x - ca.dot(axis, x) / near * both for x in others)
    return first, second


def combinations(vectors: Sequence[ca.SX]) -> list[list[ca.SX]]:
    """Factors that combine vectors to orthonormal ones (Gram and Schmidt), for each of the first k.

    Where one depends on those before it its combination is zero.
    """
    found: list[list[ca.SX]] = []
    units: list[ca.SX] = []
    for vector in vectors:
        factors, rest = [ca.SX(0)] * len(found), vector
        for other, unit in zip(found, units, strict=True):
            part = ca.dot(vector, unit)
            rest = rest - part * unit
            for k, factor in enumerate(other):
                factors[k] = factors[k] - part * factor
        size = ca.norm_2(rest)
        scale = 1 / ca.if_else(size > 0, size, 1)
        found.append([*(scale * x for x in factors), scale])
        units.append(scale * rest)
    return found


def combined(factors: Sequence[ca.SX], vectors: Sequence[ca.SX]) -> ca.SX:
    """The sum of the first vectors times these factors."""
    return sum((x * v for x, v in zip(factors, vectors, strict=False)), ca.SX(0))


def orthonormal(vectors: Sequence[ca.SX]) -> list[ca.SX]:
    """Unit vectors that span the same space."""
    return [combined(factors, vectors) for factors in combinations(vectors)]


# At the jump itself there is one direction too.
_NEAR_JUMP = 1e-300
# The square of a quaternion's length, where it has none.
_NO_LENGTH = 1e-300


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Where axes stand: origin (3), unit vectors as columns (3 x 3), the same as a quaternion.

    `angle` counts the turns about z in planar models; it is zero in space.
    """

    origin: ca.SX
    axes: ca.SX
    quaternion: ca.SX
    angle: ca.SX

    def point(self, local: ca.SX) -> ca.SX:
        """Ground coordinates of a point given in these axes."""
        return self.origin + self.direction(local)

    def direction(self, local: ca.SX) -> ca.SX:
        """Ground components of a vector given in these axes."""
        return self.axes @ local if local.nnz() else local


GROUND = Pose(nowhere(), ca.SX(ca.DM.eye(3)), ca.SX(ca.DM([1, 0, 0, 0])), ca.SX(0))


@dataclass(frozen=True, slots=True, eq=False)
class Moving:
    """Axes that move: their pose, and what belongs to their origin.

    `angular` and `linear` velocity; `angular_bias` and `linear_bias` are the accelerations while
    all rates of speeds are zero.
    """

    pose: Pose
    angular: ca.SX
    linear: ca.SX
    angular_bias: ca.SX
    linear_bias: ca.SX

    def velocity_of(self, place: ca.SX) -> ca.SX:
        """Velocity of the material point that is at a place in ground axes."""
        return self.linear + cross(self.angular, place - self.pose.origin)

    def shifted(self, arm: ca.SX) -> Moving:
        """The same axes with their origin at another material point, the vector `arm` away.

        The vector is given, for differences of places lose digits far from the origin.
        """
        swept = cross(self.angular, arm)
        return Moving(
            Pose(self.pose.origin + arm, self.pose.axes, self.pose.quaternion, self.pose.angle),
            self.angular,
            self.linear + swept,
            self.angular_bias,
            self.linear_bias + cross(self.angular_bias, arm) + cross(self.angular, swept),
        )


AT_REST = Moving(GROUND, nowhere(), nowhere(), nowhere(), nowhere())


def counted(angle: ca.SX, about: ca.SX) -> ca.SX:
    """An angle known but for whole turns: the one that is less than half a turn from `about`."""
    apart = angle - about
    return about + ca.atan2(ca.sin(apart), ca.cos(apart))


# Operations within which two moments of inertia are seen to be the same expression.
_DEEP = 8


def is_round(inertia: ca.SX) -> bool:
    """Whether a body has the same inertia about every axis, whatever its parameters."""
    first = inertia[0, 0]
    return all(
        inertia[i, j].is_zero() if i != j else ca.is_equal(inertia[i, i], first, _DEEP)
        for i in range(3)
        for j in range(3)
    )
