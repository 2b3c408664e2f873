"""`frot simulate --explain` as a user sees it."""

import json
from pathlib import Path

import pytest

from frot.command_line import main

MODELS = Path(__file__).parents[2] / "models"


def run(capfd: pytest.CaptureFixture[str], *words: object) -> str:
    assert main(["simulate", *(str(w) for w in words)]) == 0
    return capfd.readouterr().out


@pytest.mark.parametrize("columns", ["80", "50"])
def test_reasons_are_as_wide_as_the_terminal(
    columns: str, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Below each event, indented; no line has blanks at its end or parts a number from its unit."""
    monkeypatch.setenv("COLUMNS", columns)
    lines = run(capfd, MODELS / "belt_oscillator.frot", "--explain", "--quiet").splitlines()
    heads = [x for x in lines if not x.startswith("      ")]
    assert len(heads) == 6 and all(" at t = " in x for x in heads)
    told = [x for x in lines if x.startswith("      ")]
    assert all(len(x) <= int(columns) and x == x.rstrip() for x in told)
    assert not any(x[-1].isdigit() and x[-2:-1] == " " for x in told)
    whole = " ".join(x.strip() for x in told)
    assert "the friction needed, 4 N, reaches mu_s N = 4 N; in motion it is mu N = 2.5 N" in whole


def test_of_many_events_the_ends_are_explained(capfd: pytest.CaptureFixture[str]) -> None:
    out = run(capfd, MODELS / "bouncing_ball.frot", "--explain", "--quiet")
    assert out.count("the gap closes at") == 39 and "more events ..." in out


def test_without_events_it_says_so(capfd: pytest.CaptureFixture[str]) -> None:
    out = run(capfd, MODELS / "double_pendulum.frot", "--explain", "--quiet")
    assert out == "  no events to explain\n"


def test_json_has_the_reasons(capfd: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    target = tmp_path / "run.json"
    run(capfd, MODELS / "backspin_hoop.frot", "--explain", "--quiet", "-o", target)
    (event,) = json.loads(target.read_text(encoding="utf-8"))["events"]
    assert (event["motion"], event["direction"]) == ("slip", [1.0])
    assert event["reason"].endswith("is within mu N = 2.943 N")
