"""Films of a scene, `.gif` or `.mp4`, and still pictures, from the shell and without a display."""

from __future__ import annotations

import contextlib
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from frot.dsl.files.writing import write_whole
from frot.dsl.messages.errors import fail
from frot.dsl.messages.interrupts import DeferredInterrupts, raise_noted_interrupt
from frot.view.picture import Picture

if TYPE_CHECKING:
    from frot.view.parts import Scene

STILL, FILM, PAGE = (".png", ".svg", ".pdf"), (".gif", ".mp4"), (".html",)
RATE = 25  # pictures a second
DOTS = 120  # an inch


def write_still(scene: Scene, path: Path, moment: int = 0) -> None:
    """A picture of one moment."""
    import io

    buffer = io.BytesIO()
    Picture(scene).draw(moment).savefig(buffer, format=path.suffix[1:].lower(), dpi=DOTS)
    write_whole(path, buffer.getvalue())


def write_film(scene: Scene, path: Path, watch: Callable[[int, int], None] | None = None) -> None:
    """A film of all moments, RATE a second. `watch` is called with what is done, and of how much.

    FrotError (E0820) where a `.mp4` is wanted and there is no program that writes one.
    """
    picture = Picture(scene)
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / f"film{path.suffix.lower()}"
        writer = _writer(path)
        writer.setup(picture.figure, str(made), DOTS)
        try:
            with DeferredInterrupts():
                for k in range(len(scene.times)):
                    picture.draw(k)
                    writer.grab_frame()
                    if watch is not None:
                        watch(k + 1, len(scene.times))
                    raise_noted_interrupt()
        except BaseException:
            # Ctrl-C: a .gif is written when it is finished, ffmpeg ends when it is
            if path.suffix.lower() != ".gif":
                with contextlib.suppress(subprocess.CalledProcessError, OSError):
                    writer.finish()
            raise
        writer.finish()
        write_whole(path, made.read_bytes())


def check_writer(path: Path) -> None:
    """FrotError (E0820) where no film of this format can be written."""
    if path.suffix.lower() in FILM:
        _writer(path)


def _writer(path: Path) -> Any:
    from matplotlib import animation, rcParams

    if path.suffix.lower() == ".gif":
        return animation.PillowWriter(fps=RATE)
    program = shutil.which("ffmpeg")
    if program is None:
        try:
            from imageio_ffmpeg import get_ffmpeg_exe

            program = get_ffmpeg_exe()
        except (ImportError, RuntimeError):
            raise fail(
                "E0820",
                f"'{path}' cannot be written: there is no ffmpeg on this machine",
                help="pip install imageio-ffmpeg, which brings one, or write a .gif",
            ) from None
    rcParams["animation.ffmpeg_path"] = program
    return animation.FFMpegWriter(fps=RATE, codec="libx264", extra_args=["-pix_fmt", "yuv420p"])
