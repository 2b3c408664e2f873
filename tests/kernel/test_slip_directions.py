"""Directions in which the slip of one contact begins or ends, against a search over all angles."""

from __future__ import annotations

import ctypes as ct
from dataclasses import dataclass

import numpy as np
import pytest


class SlipContact(ct.Structure):
    _fields_ = (
        ("load_n", ct.c_double),
        ("load_t", ct.c_double * 2),
        ("w_nn", ct.c_double),
        ("w_tn", ct.c_double * 2),
        ("w_tt", ct.c_double * 4),
        ("mu", ct.c_double),
    )


class SlipDirection(ct.Structure):
    _fields_ = (
        ("d", ct.c_double * 2),
        ("rate", ct.c_double),
        ("normal", ct.c_double),
        ("turning", ct.c_double),
    )


@dataclass(frozen=True)
class Contact:
    """Loads and Delassus matrix of normal and two tangents, coefficient."""

    load: np.ndarray
    delassus: np.ndarray
    mu: float

    def motion(self, d: np.ndarray) -> tuple[float, np.ndarray]:
        """Normal reaction and slip acceleration while it slips along d."""
        w = self.delassus
        normal = -self.load[0] / (w[0, 0] - self.mu * w[0, 1:] @ d)
        return normal, self.load[1:] + normal * (w[1:, 0] - self.mu * w[1:, 1:] @ d)

    def directions(self, kernel: ct.CDLL) -> list[SlipDirection]:
        w, found = self.delassus, (SlipDirection * 4)()
        contact = SlipContact(
            self.load[0],
            (ct.c_double * 2)(*self.load[1:]),
            w[0, 0],
            (ct.c_double * 2)(*w[1:, 0]),
            (ct.c_double * 4)(w[1, 1], w[2, 1], w[1, 2], w[2, 2]),
            self.mu,
        )
        count = kernel.frot_slip_directions(ct.byref(contact), found)
        assert 0 <= count <= 4
        return list(found[:count])


def random_contact(seed: int) -> Contact:
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(3, 5))
    load = 3 * rng.normal(size=3)
    load[0] = -abs(load[0])
    return Contact(load, root @ root.T, rng.uniform(0.05, 2))


@pytest.mark.parametrize("first", range(0, 2000, 200))
def test_each_root_is_found_and_none_is_invented(kernel: ct.CDLL, first: int) -> None:
    angles = np.linspace(0, 2 * np.pi, 3601)[:-1]
    for seed in range(first, first + 200):
        contact = random_contact(seed)
        cross = []
        for angle in angles[::10]:
            d = np.array([np.cos(angle), np.sin(angle)])
            normal, s = contact.motion(d)
            cross.append((d[0] * s[1] - d[1] * s[0]) * -contact.load[0] / normal)
        changes = int(np.sum(np.sign(cross) != np.sign(np.roll(cross, 1))))
        found = contact.directions(kernel)
        for one in found:
            d = np.array(one.d)
            normal, s = contact.motion(d)
            size = np.abs(s).max() + np.abs(contact.load).max()
            assert np.abs(s - one.rate * d).max() <= 1e-10 * size
            assert one.normal == pytest.approx(normal, rel=1e-12)
        # a scan of a tenth of a degree may pass over two roots that are nearer
        assert len(found) >= changes
        assert len(found) - changes in (0, 2, 4)


def test_where_painleves_coefficient_is_positive_stick_or_one_stable_departure(
    kernel: ct.CDLL,
) -> None:
    """Stick with the same coefficient is possible exactly where no slip can depart."""
    tried = 0
    for seed in range(3000):
        contact = random_contact(seed)
        w = contact.delassus
        if w[0, 0] <= contact.mu * np.hypot(*w[0, 1:]):
            continue
        tried += 1
        reaction = -np.linalg.solve(w, contact.load)
        sticks = reaction[0] > 0 and np.hypot(*reaction[1:]) <= contact.mu * reaction[0]
        departures = [one for one in contact.directions(kernel) if one.rate > 0]
        assert len(departures) == (0 if sticks else 1)
        assert all(one.turning < 0 and one.normal > 0 for one in departures)
    assert tried > 1000


def test_a_point_on_a_plane_starts_along_its_load(kernel: ct.CDLL) -> None:
    contact = Contact(np.array([-9.81, 3.0, 4.0]), np.eye(3) / 2, 0.3)
    (departure,) = [one for one in contact.directions(kernel) if one.rate > 0]
    assert list(departure.d) == pytest.approx([0.6, 0.8], abs=1e-15)
    assert departure.rate == pytest.approx(5 - 0.3 * 9.81, rel=1e-14)


def test_without_a_load_aside_every_direction_arrives(kernel: ct.CDLL) -> None:
    contact = SlipContact(-9.81, (0, 0), 1, (0, 0), (1, 0, 0, 1), 0.3)
    assert kernel.frot_slip_directions(ct.byref(contact), (SlipDirection * 4)()) == -1
