"""What a law of a joint opposes, in the list of motions: a turn, a slide, or both in one slip."""

from __future__ import annotations

import pytest

import frot


@pytest.mark.parametrize(
    ("liaison", "law", "kind", "verb"),
    [
        ("prismatique(post, b)", "coulomb(0.1)", "slide", "slips"),
        ("prismatique(post, b)", "coulomb(0.1, half_length = 5 cm)", "slide", "slips"),
        ("lineaire_annulaire(post, b, axis = x)", "coulomb(0.1)", "slide", "slips"),
        ("appui_plan(post, b)", "coulomb(0.1)", "slide", "slips"),
        ("rotoide(post, b.right)", "coulomb(0.1, radius = 1 cm)", "turn", "turns"),
        ("spherique(post, b.right)", "coulomb(0.1, radius = 1 cm)", "turn", "turns"),
        ("helicoidale(post, b, pitch = 1 m, axis = x)", "coulomb(0.01, radius = 1 mm)", "turn",
         "turns"),
        ("verrou(post, b, axis = x)", "coulomb(0.1, radius = 1 cm)", "slip", "slips"),
    ],
)  # fmt: skip
def test_a_law_of_a_joint_is_named_by_its_motion(
    liaison: str, law: str, kind: str, verb: str
) -> None:
    """A box on a support that is tilted by 30 degrees departs."""
    text = f"""
    model Departs
      body b: box(mass = 1 kg, size = (0.2, 0.1, 0.1) m);
      frame post on ground at (0, 0, 0) m rotated(axis = (0, 3, 1), angle = 30 deg);
      liaison on: {liaison} with {law};
    initial
      b.velocity = (0, 0, 0) m/s;
      b.angular_velocity = (0, 0, 0) rad/s;
      guess(b.orientation = (cos(15 deg), 0, sin(15 deg)*0.948683298050514,
        sin(15 deg)*0.316227766016838));
      experiment(stop = 1 s);
    end Departs;
    """
    (part,) = frot.compile(text).motions().parts
    (motion,) = part.motions
    assert {one.kind for one in motion.laws} == {kind}
    assert f"on {verb}" in motion.words()
