"""The page in a real browser: it draws the motion, plays it, and complains of nothing."""

from __future__ import annotations

import io
import shutil
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from view_scenes import result_of

import frot

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
pytestmark = pytest.mark.skipif(
    not (CHROMIUM and DRIVER), reason="chromium and chromedriver are not installed"
)
WAIT = 60.0


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    from selenium import webdriver

    options = webdriver.ChromeOptions()
    for word in (
        "--headless=new",
        "--no-sandbox",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--window-size=900,600",
    ):
        options.add_argument(word)
    options.binary_location = str(CHROMIUM)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    found = webdriver.Chrome(options=options, service=webdriver.ChromeService(DRIVER))
    yield found
    found.quit()


def opened(browser: Any, result: frot.Result, folder: Path) -> None:
    """Open the page of a run, and wait until it is drawn."""
    result.view(folder / "page.html")
    browser.get((folder / "page.html").as_uri())
    end = time.monotonic() + WAIT
    while not browser.execute_script("return !!window.frotView"):
        assert time.monotonic() < end, "the page does not begin"
        time.sleep(0.05)


def faults(browser: Any) -> list[str]:
    return [x["message"] for x in browser.get_log("browser") if x["level"] in ("SEVERE", "WARNING")]


def drawn(browser: Any, t: float) -> np.ndarray:
    """The screen with the run at t, as an array of rows, columns, colours."""
    from PIL import Image

    browser.execute_async_script(
        "const done = arguments[1]; frotView.go(arguments[0]);"
        "requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 50)));",
        t,
    )
    with Image.open(io.BytesIO(browser.get_screenshot_as_png())) as picture:
        return np.asarray(picture.convert("RGB"), dtype=int)


# Where a place of the ground is on the screen, by the camera of the page.
PLACE = """
const world = frotView.k3d.getWorld(), camera = world.camera;
const times = (m, v) => [0, 1, 2, 3].map(
  (i) => m[i]*v[0] + m[4+i]*v[1] + m[8+i]*v[2] + m[12+i]*v[3]);
const p = times(camera.projectionMatrix.elements,
  times(camera.matrixWorldInverse.elements, [...arguments[0], 1]));
const box = document.getElementById("canvasTarget").getBoundingClientRect();
return [box.left + (p[0]/p[3] + 1)/2*box.width, box.top + (1 - p[1]/p[3])/2*box.height];
"""


def test_the_ring_is_where_the_camera_sees_the_body(browser: Any, tmp_path: Path) -> None:
    """Its pixels of light blue are centred where the hoop is, and its height is its width."""
    result = result_of("backspin_hoop", stop=0.4)
    opened(browser, result, tmp_path)
    wide, low = browser.execute_script(
        "document.querySelector('.legend').remove();"
        "const box = document.querySelector('.see').getBoundingClientRect();"
        "return [Math.floor(box.right), Math.floor(box.bottom)]"
    )
    for t in (0.0, 0.4):
        picture = drawn(browser, t)[:low, :wide]
        blue = (picture[..., 2] > 170) & (picture[..., 0] < 130) & (picture[..., 1] > 100)
        rows, columns = np.nonzero(blue)
        there = [float(result.at(t)[f"hoop.position.{k}"]) for k in "xy"]
        x, y = browser.execute_script(PLACE, [*there, 0.0])
        middle = (columns.min() + columns.max()) / 2, (rows.min() + rows.max()) / 2
        assert middle == pytest.approx((x, y), abs=2.5)
        assert np.ptp(columns) == pytest.approx(np.ptp(rows), rel=0.03)
        assert np.ptp(columns) > 60
    assert not faults(browser)


def test_events_are_clicked_and_the_run_is_played(browser: Any, tmp_path: Path) -> None:
    result = result_of("backspin_hoop")
    opened(browser, result, tmp_path)
    (event,) = result.events
    browser.execute_script("document.querySelector('.events i').click()")
    assert browser.execute_script("return frotView.now()") == pytest.approx(event.time, abs=1e-12)
    assert "1.868" in browser.execute_script("return document.querySelector('.label').textContent")
    reached = browser.execute_async_script(
        "const done = arguments[0]; frotView.go(0); frotView.toggle();"
        "setTimeout(() => { const t = frotView.now(); frotView.toggle(); done(t); }, 1500);"
    )
    assert reached > 0
    # the cursor of the curves is at the same part of their axes
    x, left, right = browser.execute_script(
        "frotView.go(1.5); const box = (x) => document.querySelector(x).getBoundingClientRect();"
        "const panel = box('.panels canvas'); return [box('.cursor').left, panel.left, panel.right]"
    )
    assert (x - left - 58) / (right - left - 68) == pytest.approx(0.5, abs=0.01)
    assert not faults(browser)


def test_curves_are_chosen_and_taken_away(browser: Any, tmp_path: Path) -> None:
    """Of the names the filter leaves those with all its words."""
    opened(browser, result_of("backspin_hoop"), tmp_path)
    shown = (
        "return [...document.querySelectorAll('.panel .row')].map((x) =>"
        "[x.querySelector('span').textContent, x.querySelector('b').textContent])"
    )
    before = dict(browser.execute_script(shown))
    assert "hoop.position.y" not in before
    left = browser.execute_script(
        "const filter = document.querySelector('.chooser input'); filter.value = 'pos hoop';"
        "filter.dispatchEvent(new Event('input'));"
        "const found = [...document.querySelectorAll('.choices label')].filter((x) => !x.hidden);"
        "found.find((x) => x.textContent.startsWith('hoop.position.y')).click();"
        "return found.map((x) => x.firstChild.nextSibling.textContent)"
    )
    assert left == ["hoop.position.x", "hoop.position.y"]
    after = dict(browser.execute_script(shown))
    assert float(after["hoop.position.y"]) == pytest.approx(0.5)
    assert set(after) - set(before) == {"hoop.position.y"}
    browser.execute_script(
        "[...document.querySelectorAll('.panel .row')].find((x) =>"
        "x.textContent.startsWith('hoop.position.y')).querySelector('button').click()"
    )
    assert dict(browser.execute_script(shown)) == before
    assert not faults(browser)


def test_a_cone_in_space_is_drawn_in_its_colour(browser: Any, tmp_path: Path) -> None:
    """It is seen where its G is, beside the plane it rolls on."""
    result = result_of("rolling_cone")
    opened(browser, result, tmp_path)
    for t in (0.0, 1.0):
        picture = drawn(browser, t)
        there = [float(result.at(t)[f"cone.position.{k}"]) for k in "xyz"]
        x, y = (round(v) for v in browser.execute_script(PLACE, there))
        red, _, blue = picture[y - 2 : y + 3, x - 2 : x + 3].reshape(-1, 3).mean(axis=0)
        assert blue > red + 25
    assert not faults(browser)


def fifty() -> str:
    """The text of fifty pendulums."""
    lines = ["planar model Fifty"]
    lines += [f"  body b{k}: rod(mass = 1 kg, length = {0.1 + 0.01 * k} m);" for k in range(50)]
    lines += [f"  liaison p{k}: rotoide(ground, b{k}.start);" for k in range(50)]
    lines += ["initial", *(f"  p{k}.angle = {0.03 * k};" for k in range(50))]
    return "\n".join([*lines, "  experiment(stop = 0.5 s, tolerance = 1e-6);", "end Fifty;"])


def test_fifty_bodies_are_moved_thirty_times_a_second(browser: Any, tmp_path: Path) -> None:
    """The page's own work on a moment; how fast it is painted depends on the graphics card."""
    opened(browser, frot.compile(fifty()).simulate(), tmp_path)
    spent = browser.execute_script(
        "const render = frotView.k3d.render, spent = []; frotView.k3d.render = () => {};"
        "for (let k = 0; k < 15; k++) { const began = performance.now(); frotView.go(k/30);"
        "spent.push(performance.now() - began); } frotView.k3d.render = render; return spent"
    )
    assert np.median(spent) < 1000 / 30
    # without a graphics card, beside other work: 18 to 30
    browser.execute_script("document.querySelector('footer select').selectedIndex = 0")
    play = (
        "const done = arguments[0], began = performance.now(), before = frotView.frames();"
        "frotView.toggle(); setTimeout(() => {"
        "const rate = (frotView.frames() - before)/(performance.now() - began)*1000;"
        "frotView.toggle(); const drawer = frotView.k3d.getWorld().renderer;"
        "done([rate, drawer.getPixelRatio()]); }, 1500)"
    )
    rate, dots = browser.execute_async_script(play)
    if rate <= 8:  # beside other work
        rate, dots = browser.execute_async_script(play)
    assert rate > 8
    assert dots == browser.execute_script("return window.devicePixelRatio")
    assert not faults(browser)
