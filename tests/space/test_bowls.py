"""What is round in a bowl, whichever of the two is written first; the start tells the side."""

import numpy as np
import pytest

import frot

PAIRS = {
    "ball": ("sphere(mass = 1 kg, radius = 0.2 m)", "surface", "(0.3, 0, 0.5)"),
    "coin": ("disc(mass = 1 kg, radius = 0.2 m)", "rim", "(0.3, 0, 0.5)"),
    "hat": ("ring(mass = 1 kg, radius = 0.2 m)", "rim", "(0.1, 0, 4.1)"),
}
KINDS = (
    "contact_ponctuel({0}, {1}, unilateral = false)",
    "contact_ponctuel({1}, {0}, unilateral = false)",
    "roulement({0}, {1})",
    "roulement({1}, {0})",
)


@pytest.fixture(scope="module")
def run() -> frot.Result:
    text, guesses = "", ""
    for name, (shape, figure, place) in PAIRS.items():
        for k, kind in enumerate(KINDS):
            body = f"{name}{k}"
            text += f"  body {body}: {shape};\n"
            text += f"  liaison L_{body}: {kind.format(f'{body}.{figure}', 'bowl')};\n"
            guesses += f"  guess({body}.position = {place} m, {body}.orientation = LEAN);\n"
    guesses = guesses.replace("LEAN", "(cos(0.15), sin(0.15), 0, 0)")
    bowl = "surface bowl on ground: sphere(radius = 2 m, centre = (0, 0, 2) m);"
    end = "  experiment(stop = 0.5 s, tolerance = 1e-10);\nend Bowls;\n"
    return frot.compile(f"model Bowls\n  {bowl}\n{text}initial\n{guesses}{end}").simulate()


def place(run: frot.Result, body: str) -> np.ndarray:
    return np.array([run[f"{body}.position.{k}"] for k in "xyz"])


def axis(run: frot.Result, body: str) -> np.ndarray:
    w, x, y, z = (run[f"{body}.orientation[{k}]"] for k in range(1, 5))
    return np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x**2 + y**2)])


def test_what_starts_in_a_bowl_is_in_it(run: frot.Result) -> None:
    """The ball's centre is at R - r; the rim's farthest point on the bowl, of a hat the nearest."""
    for k in range(len(KINDS)):
        from_centre = place(run, f"ball{k}") - np.array([[0.0], [0.0], [2.0]])
        assert np.abs(np.linalg.norm(from_centre, axis=0) - 1.8).max() < 1e-12
        for body, side in ((f"coin{k}", 1), (f"hat{k}", -1)):
            apart = place(run, body) - np.array([[0.0], [0.0], [2.0]])
            n = axis(run, body)
            along = np.sum(apart * n, 0)
            wide = np.linalg.norm(apart - along * n, axis=0)
            assert np.abs(np.hypot(along, wide + side * 0.2) - 2).max() < 1e-12, body


def test_it_moves_the_same_whichever_is_written_first(run: frot.Result) -> None:
    for name in PAIRS:
        for k in (0, 2):
            first, second = place(run, f"{name}{k}"), place(run, f"{name}{k + 1}")
            assert np.ptp(first[0]) > 0.003
            assert np.abs(first - second).max() < 1e-9, name
