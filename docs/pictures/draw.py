"""The pictures of docs/examples.md: `python docs/pictures/draw.py`, or with names of models.

A model with bodies is drawn in a posture (`frot view`), one of equations by curves (`frot plot`).
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from PIL import Image, ImageChops

from frot.commands import run

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
SIZE = (400, 300)
COLOURS = 48
TITLE = 50  # lines of a picture that hold its name and time
# Moments that show more than the start.
MOMENTS = {
    "backspin_hoop": "0.5",
    "ringing_bell": "0.45",
    "bouncing_ball": "0.2",
    "cycloid": "0.6",
    "double_pendulum": "1",
    "free_frame": "1",
    "rolling_cone": "0.5",
    "slack_threads": "0.9",
    "slider_crank": "0.1",
    "turning_plane": "0.4",
    "turning_tube": "1",
    "two_hoops": "1",
    "wheel_channel": "1",
}
CURVES = {
    "clutch_engagement": "",
    "flexible_slider_crank": "",
    "half_wave_rectifier": "",
    "speed_drive": "",
    "wheelset": "",
}


def draw(name: str, folder: Path) -> None:
    """One picture, small and with few colours."""
    whole = folder / f"{name}.png"
    words = ["plot" if name in CURVES else "view", str(ROOT / "models" / f"{name}.frot")]
    if CURVES.get(name):
        words += ["--curves", CURVES[name]]
    if name in MOMENTS:
        words += ["--at", MOMENTS[name]]
    if run([*words, "-o", str(whole)]) != 0:
        raise SystemExit(f"{name} cannot be drawn")
    with Image.open(whole) as image:
        flat = image.convert("RGB")
        shown = flat if name in CURVES else flat.crop(_extent(flat))
        small = shown.resize(SIZE, Image.Resampling.LANCZOS).quantize(
            COLOURS, dither=Image.Dither.NONE
        )
        small.save(HERE / f"{name}.png", optimize=True)


def _extent(image: Image.Image) -> tuple[int, int, int, int]:
    """What is drawn below the title, with a margin, in the ratio of SIZE."""
    white = Image.new("RGB", image.size, "white")
    difference = ImageChops.difference(image, white)
    difference.paste("black", (0, 0, image.width, TITLE))
    left, top, right, bottom = difference.getbbox() or (0, 0, *image.size)
    ratio = SIZE[0] / SIZE[1]
    high = 1.15 * max(bottom - top, (right - left) / ratio, image.height / 3)
    high = min(high, image.height)
    x = min(max((left + right - ratio * high) / 2, 0), image.width - ratio * high)
    y = min(max((top + bottom - high) / 2, 0), image.height - high)
    return round(x), round(y), round(x + ratio * high), round(y + high)


def main() -> None:
    """The models that are named, or all that are no packages."""
    models = sorted((ROOT / "models").glob("*.frot"))
    names = sys.argv[1:] or [path.stem for path in models if path.stem.islower()]
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            draw(name, Path(folder))


if __name__ == "__main__":
    main()
