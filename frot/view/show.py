"""`frot view`, `model.view` and `result.view`: a page, a picture or a film of a run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from frot.dsl.files.writing import check_target, write_whole
from frot.dsl.messages.errors import FrotError, fail
from frot.view.film import FILM, PAGE, RATE, STILL, check_writer, write_film, write_still

if TYPE_CHECKING:
    from frot.compiled_model import CompiledModel
    from frot.runtime.run_values import RunValues
    from frot.view.parts import Scene

MOST_PICTURES = 10_000  # of a film
FORMATS = (*PAGE, *STILL, *FILM)


def check_view(path: str | Path) -> Path:
    """The path of a page, a picture or a film, before long work; FrotError as `check_target`.

    E0820 where what draws it is not installed.
    """
    target = check_target(path, FORMATS)
    check_writer(target)
    if target.suffix.lower() in PAGE:
        from frot.view.page import k3d_package

        k3d_package()
    return target


def write_view(
    result: RunValues,
    path: str | Path,
    *,
    curves: Sequence[str] | None = None,
    at: float | None = None,
    speed: float = 1.0,
    fault: str = "",
    watch: Callable[[int, int], None] | None = None,
) -> None:
    """Write a run as `.html`, a moment of it as `.png`, `.svg` or `.pdf`, a film as `.gif`, `.mp4`.

    Args:
        result: The run, by its model.
        path: The file.
        curves: Variables drawn beside the picture of a page; by default as `plot` chooses.
        at: The moment of a picture, in s; by default the start.
        speed: Of a film, seconds of the run in one.
        fault: Why the run ended, shown on the page.
        watch: Called with pictures drawn, and how many there are.

    Raises:
        FrotError: E0803, E0806 and E0820: the file cannot be written.
    """
    import numpy as np

    target = check_view(path)
    kind = target.suffix.lower()
    if not (speed > 0 and np.isfinite(speed)):
        raise fail("E0806", f"the speed {speed:g} is not positive", help="take 0.5, or leave it")
    first, last = float(result.time[0]), float(result.time[-1])
    if at is not None and not first <= at <= last:
        raise fail(
            "E0806",
            f"there is no picture at t = {at:g} s",
            help=f"the run goes from {first:g} s to {last:g} s",
        )
    if kind not in PAGE:
        need_bodies(model_of(result))
    if kind in PAGE:
        write_whole(target, page(result, curves=curves, fault=fault).encode("utf-8"))
    elif kind in STILL:
        write_still(scene(result, np.array([first if at is None else at])), target)
    else:
        count = max(int((last - first) / speed * RATE), 1) + 1
        if count > MOST_PICTURES:
            raise fail(
                "E0806",
                f"a film of {count} pictures is too long",
                help=f"give a speed from {speed * count / MOST_PICTURES:.2g} on",
            )
        write_film(scene(result, np.linspace(first, last, count)), target, watch)


def need_bodies(model: CompiledModel) -> None:
    """FrotError (E0820) for a model without bodies: a page alone shows its curves."""
    if not model.checked().bodies:
        raise fail(
            "E0820",
            f"the model '{model.name}' has no bodies: there is nothing to draw",
            help="`frot plot` draws curves, and so does a page",
        )


def scene(result: RunValues, times: Any) -> Scene:
    """The scene of a run at these moments."""
    from frot.view.moments import moments_of
    from frot.view.scene import scene_of

    model = model_of(result)
    return scene_of(model.checked(), moments_of(result, model, times))


def page(result: RunValues, *, curves: Sequence[str] | None = None, fault: str = "") -> str:
    """The page of a run as HTML."""
    from frot.view.curves import curves_of
    from frot.view.moments import times_of
    from frot.view.page import page_of
    from frot.view.seen import owners_of

    drawn = len(owners_of(model_of(result).checked()))
    return page_of(scene(result, times_of(result, drawn)), curves_of(result, curves), fault)


def model_of(result: RunValues) -> CompiledModel:
    """The model of a result; FrotError where its text is not known."""
    if result.model is None:
        raise fail(
            "E0820",
            f"the text of the model '{result.program.name}' is not known",
            help="view results of `model.simulate(...)`",
        )
    return result.model


def write_start(
    model: CompiledModel,
    path: Path,
    *,
    start: float | str | None = None,
    parameters: Mapping[str, object] | None = None,
    inputs: Mapping[str, object] | None = None,
) -> None:
    """A picture or a page of the start, before any step; FrotError where there is no start."""
    target = check_view(path)
    if target.suffix.lower() in FILM:
        raise fail("E0806", "a start is no film", help="name a .html or a .png")
    need_bodies(model)
    given = start_scene(model, start=start, parameters=parameters, inputs=inputs)
    if target.suffix.lower() in PAGE:
        from frot.view.page import page_of

        write_whole(target, page_of(given).encode("utf-8"))
    else:
        write_still(given, target)


def start_scene(model: CompiledModel, **options: Any) -> Scene:
    """The scene of the start alone; options as those of `start_of`."""
    from frot.view.moments import start_of
    from frot.view.scene import scene_of

    return scene_of(model.checked(), start_of(model, **options))


class Shown:
    """What a notebook shows as HTML."""

    def __init__(self, html: str) -> None:
        self._html = html

    def _repr_html_(self) -> str:
        return self._html


def show_page(html: str, name: str) -> Any:
    """Show a page: in a notebook below its cell, else as `NAME.html` in a browser.

    Returns what the notebook shows, or the path of the file.
    """
    from frot.progress import in_notebook

    if in_notebook():
        return Shown(framed(html))
    target = Path(f"{name}.html")
    write_whole(target, html.encode("utf-8"))
    open_page(target)
    return target


def open_page(path: Path) -> None:
    """Open a page in a browser, where there is a screen for one."""
    import os
    import sys

    screen = any(os.environ.get(x) for x in ("DISPLAY", "WAYLAND_DISPLAY"))
    if screen or sys.platform in ("darwin", "win32"):
        import webbrowser

        webbrowser.open(path.resolve().as_uri())


def framed(html: str) -> str:
    """The page as a part of another."""
    from html import escape

    text = escape(html, quote=True)
    return f'<iframe srcdoc="{text}" style="width: 100%; height: 620px; border: 0"></iframe>'


def start_html(model: CompiledModel) -> str:
    """A picture of the start of a model with its name, as HTML."""
    import base64
    import tempfile
    from html import escape

    head = f"<b>{escape(model.name)}</b> {escape(model.checked().doc)}"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "start.png"
        try:
            write_start(model, path)
        except FrotError as error:
            return f"{head}<pre>{escape(str(error))}</pre>"
        picture = base64.b64encode(path.read_bytes()).decode("ascii")
    return f'{head}<br><img style="max-width: 640px" src="data:image/png;base64,{picture}">'


__all__ = [
    "check_view",
    "framed",
    "model_of",
    "open_page",
    "page",
    "show_page",
    "start_scene",
    "write_start",
    "write_view",
]
