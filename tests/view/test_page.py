"""The page of a run is one file; pictures and films are written without a display."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from in_process import command
from view_scenes import MODELS, result_of

import frot
from frot.view.show import page

FALLS = """
planar model Falls "</script><b>"
  body ball: disc(mass = 1 kg, radius = 0.1 m);
  liaison floor: contact_ponctuel(ball.rim, ground.line);
initial
  ball.position = (0, 1) m;
equation
  assert(ball.position.y > 0.2 m, "the floor is near");
  experiment(stop = 2 s);
end Falls;
"""


def content_of(html: str) -> dict[str, object]:
    """What the page knows of its run."""
    found = re.search(r"const frot = (\{.*\});$", html, re.MULTILINE)
    assert found is not None
    content: dict[str, object] = json.loads(found[1])
    return content


def test_a_page_needs_nothing_beside_it() -> None:
    html = page(result_of("backspin_hoop"))
    ours = html[html.index("const frot = ") :]
    assert not re.search(r"""(?:src|href)\s*=\s*["']?(?:https?:)?//""", html)
    # the drawing of curves names the standards that it is written in, as XML does
    assert set(re.findall(r"https?://([^/\"']+)", ours)) <= {
        "www.w3.org",
        "purl.org",
        "creativecommons.org",
        "matplotlib.org",
    }
    content = content_of(html)
    assert content["name"] == "BackspinHoop"
    assert [e["text"].partition(" at")[0] for e in content["events"]] == ["floor: slip -> stick"]  # type: ignore[attr-defined]
    assert {c["name"] for c in content["curves"]} >= {"hoop.position.x", "floor.slip"}  # type: ignore[attr-defined]


def test_a_run_that_ended_in_an_error_is_shown_up_to_there() -> None:
    """The ball falls 0.8 m, to its assertion: t = sqrt(2*0.8/9.81). Its text ends no script."""
    with pytest.raises(frot.SimulationError) as told:
        frot.compile(FALLS).simulate()
    assert told.value.result is not None
    html = page(told.value.result, fault=told.value.result.fault)
    content = content_of(html)
    assert "the floor is near" in str(content["fault"])
    assert content["times"][-1] == pytest.approx(np.sqrt(1.6 / 9.81), abs=1e-6)  # type: ignore[index]
    assert content["doc"] == "</script><b>"
    assert "</script><b>" not in html[html.index("const frot = ") :]


def test_a_model_without_bodies_has_a_page_of_curves_and_no_picture(tmp_path: Path) -> None:
    text = "model Grows\n  Real x(start = 1);\nequation\n  der(x) = x/(1 s);\nend Grows;\n"
    result = frot.compile(text).simulate()
    result.view(tmp_path / "grows.html")
    assert (tmp_path / "grows.html").stat().st_size > 100_000
    with pytest.raises(frot.FrotError, match="no bodies"):
        result.view(tmp_path / "grows.png")


def image(path: Path) -> np.ndarray:
    from matplotlib.image import imread

    return np.asarray(imread(path))[..., :3]


def test_a_picture_shows_the_start_before_any_run(tmp_path: Path) -> None:
    """The hoop is a ring of light blue: its height is its width, in pixels."""
    target = tmp_path / "start.png"
    done = command(tmp_path, "view", str(MODELS / "backspin_hoop.frot"), "-o", str(target))
    assert done.returncode == 0, done.stderr
    picture = image(target)
    blue = (picture[..., 2] > 0.75) & (picture[..., 0] < 0.5)
    rows, columns = np.nonzero(blue)
    wide, high = np.ptp(columns) + 1, np.ptp(rows) + 1
    assert wide == pytest.approx(high, rel=0.02)
    assert wide > 100


def test_a_picture_at_a_time_shows_that_moment(tmp_path: Path) -> None:
    result = result_of("slider_crank", stop=1.0)
    for name, at in (("a", 0.0), ("b", 0.3), ("c", 0.3)):
        result.view(tmp_path / f"{name}.png", at=at)
    one, two, same = (image(tmp_path / f"{k}.png") for k in "abc")
    assert np.abs(one - two).max() > 0.2
    assert np.array_equal(two, same)


@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
def test_a_film_has_twenty_five_pictures_a_second(tmp_path: Path, suffix: str) -> None:
    target = tmp_path / f"film{suffix}"
    result_of("backspin_hoop", stop=1.0).view(target, speed=2.0)
    if suffix == ".gif":
        from PIL import Image

        with Image.open(target) as film:
            assert film.n_frames == 13
            assert film.info["duration"] == 40
    else:
        import imageio_ffmpeg

        frames, seconds = imageio_ffmpeg.count_frames_and_secs(str(target))
        assert frames == 13
        assert seconds == pytest.approx(13 / 25, abs=0.05)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"path": "page.bmp"}, "format of"),
        ({"path": "none/page.html"}, "does not exist"),
        ({"path": "p.png", "at": 4.0}, "no picture at t = 4 s"),
        ({"path": "p.png", "at": float("nan")}, "no picture at t"),
        ({"path": "p.gif", "speed": 0.0}, "not positive"),
        ({"path": "p.gif", "speed": 1e-4}, "too long"),
    ],
)
def test_what_cannot_be_shown_is_refused(
    tmp_path: Path, options: dict[str, object], words: str
) -> None:
    result = result_of("backspin_hoop")
    path = tmp_path / str(options.pop("path"))
    with pytest.raises(frot.FrotError, match=words):
        result.view(path, **options)  # type: ignore[arg-type]
    assert not path.exists()
