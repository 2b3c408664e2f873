"""A `tige` that may part is a `fil`, in the plane and in space; what neither takes is refused."""

import numpy as np
import pytest

import frot

TEXT = """
{word}model M
  parameter Real e = 0.5;
  Real x;
  body b: box(mass = 1 kg, size = {size} m);
  liaison k: {kind}(ground, b{length}{option}){drive}{law};
initial
  x = 0;
  guess(b.position = {place} m);
  b.velocity.x = 0.2 m/s;
equation
  der(x) = 0.2 1/s;
  experiment(stop = 0.8 s, tolerance = 1e-10);
end M;
"""


def text(planar: bool, kind: str, length: str = "1 m", **more: str) -> str:
    """A box that falls beside the ground's origin."""
    size, place = ("(1, 2)", "(0.5, 0.1)") if planar else ("(1, 2, 3)", "(0.5, 0.1, 0.2)")
    given = {"option": "", "drive": "", "law": "", **more}
    return TEXT.format(
        word="planar " if planar else "",
        size=size,
        place=place,
        kind=kind,
        length=f", length = {length}" if length else "",
        **given,
    )


@pytest.mark.parametrize("planar", [True, False])
def test_a_rod_that_may_part_is_a_thread(planar: bool) -> None:
    """The same bounces, to the last bit."""
    law = " with restitution(e)"
    rod, cord = (
        frot.compile(text(planar, kind, option=", unilateral = true", law=law)).simulate()
        for kind in ("tige", "fil")
    )
    assert [(e.time, e.kind, e.impulse) for e in rod.events] == [
        (e.time, e.kind, e.impulse) for e in cord.events
    ]
    assert sum(e.kind == "impact" for e in rod.events) >= 2
    assert np.array_equal(rod["k.length"], cord["k.length"])
    assert rod["k.length"].max() < 1 + 1e-12


@pytest.mark.parametrize("planar", [True, False])
def test_what_a_thread_does_not_take(planar: bool) -> None:
    """Friction of its ends, and a length by the text, of which it can only be the largest."""
    slack = ", unilateral = true"
    for kind, length, law, said in (
        ("tige", "1 m", " with coulomb(0.3, radius = 2 cm)", "a tige that can go slack"),
        ("fil", "1 m + x*(1 m)", "", "follows other than time"),
        ("tige", "1 m + 0.1*b.position.x", "", "follows other than time"),
    ):
        with pytest.raises(frot.FrotError, match=said):
            frot.compile(text(planar, kind, length, option=slack, law=law)).report()


@pytest.mark.parametrize("planar", [True, False])
def test_a_driven_length_is_kept_by_rods_and_threads(planar: bool) -> None:
    """Whether a length is given beside the drive or not."""
    size = 1 if planar else np.sqrt(3)
    for length in ("", "3 m"):
        run = frot.compile(
            text(planar, "fil", length, drive=" driven(length = 1 m + x*(1 m))")
        ).simulate()
        ways = "xy" if planar else "xyz"
        far = np.linalg.norm([run[f"b.position.{c}"] for c in ways], axis=0)
        assert np.abs(far - 1 - 0.2 * run.time).max() < 1e-8 * size


@pytest.mark.parametrize("planar", [True, False])
def test_stops_of_a_rod_name_the_length_that_it_keeps(planar: bool) -> None:
    """Bounds in m have the right unit; the length of a rod does not move."""
    law = " with stops(min = 0.5 m, max = 2 m)"
    with pytest.raises(frot.FrotError, match="'length' is kept by the liaison"):
        frot.compile(text(planar, "tige", law=law)).report()


@pytest.mark.parametrize("planar", [True, False])
def test_restitution_of_what_cannot_part_proposes_what_can_be_written(planar: bool) -> None:
    """`unilateral = true` where the liaison takes it; else stops or another liaison."""
    axis = "(1, 0)" if planar else "x"
    law = " with restitution(0.3)"
    for kind, length, option, help_text in (
        ("tige", "1 m", "", "write `unilateral = true`"),
        ("prismatique", "", f", axis = {axis}", r"stops\(min, max, e\)"),
    ):
        with pytest.raises(frot.FrotError, match=help_text):
            frot.compile(text(planar, kind, length, option=option, law=law)).report()
