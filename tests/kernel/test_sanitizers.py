"""The kernel under the address and undefined-behaviour sanitizers, on worked and small models."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from c_objects import SANITIZED, c_objects
from frot.compiler.toolchain.objects import kernel_folder, kernel_sources
from frot.runtime.program import Program
from patience import PATIENCE
from small_models import Small, source
from test_elements import clutch, pin_pendulum
from test_general_core import kepler, pendulum_in_x_y
from test_text_events import ball, sampler

STOPS = {"inclined_block": 3.0, "backspin_hoop": 3.0, "coulomb_oscillator": 12.0}
SMALL = (
    (clutch("clutch", 1.0, 5.0, start=([0, 0], [10.0, 0.0])), 5.0),
    (pin_pendulum("pin", 0.05, 0.06, start=([1.2], [0.0])), 10.0),
    (pendulum_in_x_y(), 3.0),
    (kepler(0.9), 3.0),
    (ball(), 2.5),
    (sampler("sampler"), 1.05),
)


def drive(model: Path, stop: float, folder: Path) -> None:
    """Compile the driver with a model and run it."""
    binary = folder / "drive"
    sources = [Path(__file__).parent / "drive.c", model, *kernel_sources(kernel_folder())]
    objects = c_objects(sources, [kernel_folder()], SANITIZED)
    subprocess.run(["cc", *SANITIZED, *map(str, objects), "-o", str(binary), "-lm"], check=True)
    done = subprocess.run(
        [binary, str(stop)],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
        env={**os.environ, "ASAN_OPTIONS": "detect_leaks=1"},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout == "0 failures\n"


@pytest.mark.parametrize("name", STOPS)
def test_a_model_runs_clean_under_sanitizers(
    programs: dict[str, Program], name: str, tmp_path: Path
) -> None:
    drive(programs[name].source, STOPS[name], tmp_path)


@pytest.mark.parametrize(("model", "stop"), SMALL, ids=[m.name for m, _ in SMALL])
def test_a_small_model_runs_clean_under_sanitizers(
    model: Small, stop: float, tmp_path: Path
) -> None:
    (tmp_path / "model.c").write_text(source(model))
    drive(tmp_path / "model.c", stop, tmp_path)
