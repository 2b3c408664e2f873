"""`frot motions` and `Model.motions`: what is printed, as data, and bad input."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import frot
from frot.commands import run

ROOT = Path(__file__).parents[2]
HOOP = ROOT / "models" / "backspin_hoop.frot"
PAGE = (ROOT / "docs" / "motions.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


def test_the_page_prints_what_the_command_prints(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "lines.frot"
    path.write_text(blocks("frot")[0], encoding="utf-8")
    assert run(["motions", str(path)]) == 0
    assert capsys.readouterr().out == blocks("text")[0]


def test_json_has_the_motions_as_data(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["motions", str(HOOP), "--json", "--at", "0.5", "--set", "mu=0.2"]) == 0
    data = json.loads(capsys.readouterr().out)
    (motion,) = data["parts"][0]["motions"]
    assert data["count"] == 1 and data["complete"] and data["time"] == 0.5
    assert motion["modes"] == {"floor": "slip"}
    (law,) = motion["laws"]
    # the slip of a hoop has 1/m + r^2/I times the friction against it: -2 mu g
    assert law["acceleration"] == pytest.approx(-2 * 0.2 * 9.81, rel=1e-12)
    assert law["direction"] == [1.0] and law["painleve"] == pytest.approx(1.0, rel=1e-12)
    assert motion["accelerations"]["hoop.acceleration.x"] == pytest.approx(-0.2 * 9.81, rel=1e-12)


def test_the_state_at_an_event_is_that_after_it() -> None:
    """The hoop begins to roll: the slip has come to zero and stays there."""
    model = frot.load(HOOP)
    (event,) = model.simulate().events
    (motion,) = model.motions(at=event.time)
    assert motion.modes == {"floor": "stick"}
    assert all(x == 0 for x in motion.accelerations.values())


def test_an_impasse_has_status_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = blocks("frot")[0].replace("coulomb(mu);\n  liaison high", "coulomb(3);\n  liaison high")
    text = text.replace("with coulomb(mu);", "with coulomb(0.1);").replace("45 deg", "1.2 rad")
    text = text.replace("on(M,  value = (1, 0) N)", "on(M,  value = (2, 0) N)")
    path = tmp_path / "lines.frot"
    path.write_text(text, encoding="utf-8")
    arguments = ["motions", str(path), "--set", "v0=-1 m/s"]
    assert run(arguments) == 1
    assert "no admissible motion (impasse)" in capsys.readouterr().out
    assert run([*arguments[:-1], "v0=1 m/s"]) == 0
    assert "2 admissible motions" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "code", "words"),
    [
        (["--at", "-1"], "E0806", "the run begins at 0 s"),
        (["--set", "nothing=1"], "E0805", "nothing"),
        (["--set", "mu=-1"], "E0401", "mu"),
    ],
)
def test_bad_options_are_reported(
    options: list[str], code: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["motions", str(HOOP), *options]) == 1
    told = capsys.readouterr().err
    assert code in told and words in told and "Traceback" not in told


def test_a_search_that_ends_early_says_so() -> None:
    motions = frot.load(HOOP).motions(nodes=1)
    assert not motions.complete
    assert "there may be others" in str(motions)


def test_parts_that_do_not_act_on_each_other_are_listed_apart() -> None:
    text = """
planar model Pair
  body a: particle(mass = 1 kg);
  body b: particle(mass = 1 kg);
  liaison one: contact_ponctuel(ground.line, a) with coulomb(0.3);
  liaison two: contact_ponctuel(ground.line, b) with coulomb(0.3);
  force pull: on(a, value = (4, 0) N);
initial
  a.position = (0, 0) m;
  b.position = (1, 0) m;
  experiment(stop = 1 s);
end Pair;
"""
    motions = frot.compile(text).motions()
    assert [part.liaisons for part in motions.parts] == [("one",), ("two",)]
    first, second = motions
    assert first["a.acceleration.x"] == pytest.approx(4 - 0.3 * 9.81)
    assert second.accelerations["b.acceleration.x"] == 0
    assert len(motions) == 1
