"""Sweeps: a row for each combination, failures as rows, on cores and on a cluster, resumable."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from in_process import Done, command
from view_scenes import MODELS

import frot
from frot.sweep import sweep, values_of

SLIDE = """
planar model Slide "Slides until friction stops it"
  parameter Real mu = 0.3;
  parameter Velocity v = 2 m/s;
  body block: particle(mass = 1 kg);
  liaison floor: contact_ponctuel(block, ground.line) with coulomb(mu);
initial
  block.position = (0, 0) m;
  block.velocity.x = v;
  experiment(stop = 5 s);
end Slide;
"""


def test_rows_are_combinations_with_the_last_name_fastest() -> None:
    """It stops after v^2/(2 mu g)."""
    rows = frot.compile(SLIDE).sweep({"mu": [0.1, 0.5], "v": ["1 m/s", 2.0]}, ["block.position.x"])
    assert [(row["mu"], row["v"]) for row in rows] == [
        (0.1, "1 m/s"),
        (0.1, 2.0),
        (0.5, "1 m/s"),
        (0.5, 2.0),
    ]
    for row, v in zip(rows, (1, 2, 1, 2), strict=True):
        assert row["block.position.x"] == pytest.approx(v**2 / (2 * row["mu"] * 9.81), rel=1e-9)  # type: ignore[operator]
        assert row["error"] == ""


def test_a_run_that_fails_is_a_row() -> None:
    """A mass below zero is refused; the other runs are done."""
    text = SLIDE.replace("1 kg", "m").replace(
        "parameter Real", "parameter Mass m = 1 kg;\n  parameter Real", 1
    )
    rows = frot.compile(text).sweep({"m": [1.0, -1.0, 2.0]}, ["block.position.x"])
    assert [bool(row["error"]) for row in rows] == [False, True, False]
    assert np.isnan(rows[1]["block.position.x"])  # type: ignore[call-overload]
    assert "m" in str(rows[1]["error"])


def test_processes_give_the_rows_of_one() -> None:
    model = frot.compile(SLIDE)
    given = {"mu": list(np.linspace(0.05, 0.5, 150))}
    one = list(sweep(model, given, ["block.position.x"], processes=1))
    two = list(sweep(model, given, ["block.position.x"], processes=2))
    assert one == two
    single = model.simulate(parameters={"mu": 0.05})
    assert one[0]["block.position.x"] == single["block.position.x"][-1]


def test_a_cluster_gives_the_rows_of_one() -> None:
    """A local cluster of Dask with two workers."""
    distributed = pytest.importorskip("distributed", reason="Dask is not installed")
    model = frot.compile(SLIDE)
    given = {"mu": list(np.linspace(0.05, 0.5, 150))}
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None
    ) as cluster:
        rows = model.sweep(given, ["block.position.x"], dask=cluster.scheduler_address)
    assert rows == model.sweep(given, ["block.position.x"])


def test_ranges_have_both_ends() -> None:
    assert values_of("0:0.5:0.1") == ["0.0", "0.1", "0.2", repr(3 * 0.1), "0.4", "0.5"]
    assert values_of("1 kg,2 kg") == ["1 kg", "2 kg"]
    assert values_of("(1, 2) m,(3, 4) m") == ["(1, 2) m", "(3, 4) m"]
    assert [float(x) for x in values_of("3:1:-1")] == [3, 2, 1]


@pytest.mark.parametrize("text", ["0:1", "0:1:0", "0:1:-1", "a:1:2", "0:1:1e-12"])
def test_what_is_no_range_is_refused(text: str) -> None:
    with pytest.raises(frot.FrotError, match=r"no range|values"):
        values_of(text)


@pytest.mark.parametrize(
    ("given", "read", "words"),
    [
        ({"nu": [1]}, ["block.position.x"], "no parameter 'nu'"),
        ({"mu": [0.1]}, ["block.positon.x"], "no variable 'block.positon.x'"),
    ],
)
def test_names_are_looked_up_before_any_run(
    given: dict[str, list[object]], read: list[str], words: str
) -> None:
    with pytest.raises(frot.FrotError, match=words):
        frot.compile(SLIDE).sweep(given, read)


def swept(folder: Path, *words: str) -> Done:
    """The command `sweep` of the hoop."""
    return command(folder, "sweep", str(MODELS / "backspin_hoop.frot"), *words)


def test_the_shell_goes_on_where_a_sweep_was_stopped(tmp_path: Path) -> None:
    words = ["--set", "mu=0.1:0.3:0.05", "--read", "hoop.position.x", "-o", "s.csv"]
    whole = swept(tmp_path, *words)
    assert whole.returncode == 0, whole.stderr
    assert "5 runs, 0 ended in an error" in whole.stdout
    lines = (tmp_path / "s.csv").read_text().splitlines()
    (tmp_path / "s.csv").write_text("\n".join(lines[:3]) + "\n")
    again = swept(tmp_path, *words, "--resume")
    assert again.returncode == 0, again.stderr
    assert (tmp_path / "s.csv").read_text().splitlines() == lines
    other = swept(tmp_path, "--set", "r=1:2:1", "--read", "time", "-o", "s.csv", "--resume")
    assert other.returncode == 1 and "other columns" in other.stderr
    changed = [x.replace("0.05", "0.1") for x in words]
    other = swept(tmp_path, *changed, "--resume")
    assert other.returncode == 1 and "other values" in other.stderr
    assert (tmp_path / "s.csv").read_text().splitlines() == lines


def test_a_table_of_columns_is_written(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("pyarrow")
    words = ["--set", "mu=0.1,0.2", "--read", "hoop.position.x", "-o", "s.parquet"]
    done = swept(tmp_path, *words)
    assert done.returncode == 0, done.stderr
    frame = pandas.read_parquet(tmp_path / "s.parquet")
    assert list(frame["mu"]) == [0.1, 0.2]
    assert frame["hoop.position.x"].dtype == float
    assert list(frame["error"]) == ["", ""]
    assert [path.name for path in tmp_path.iterdir()] == ["s.parquet"]


STICK = """
planar model Stick
  parameter Mass m = 1 kg;
  body stick: rod(mass = m, length = 2 m);
  frame mark on stick at (0.5, 0) m;
  liaison pin: rotoide(ground, stick.start);
initial
  pin.angle = 0;
  experiment(stop = 1 s, tolerance = 1e-10);
end Stick;
"""


def test_any_variable_of_the_language_is_read() -> None:
    """A frame, and a reaction that the run does not need: those of a run by itself."""
    model, read = frot.compile(STICK), ["mark.position.x", "pin.force.y", "stick.angle"]
    for row, m in zip(model.sweep({"m": [1, 3]}, read), (1, 3), strict=True):
        single = model.simulate(parameters={"m": m})
        for name in read:
            assert row[name] == pytest.approx(single[name][-1], rel=1e-9)
    with pytest.raises(frot.FrotError, match="is a vector"):
        model.sweep({"m": [1]}, ["mark.position"])


def test_the_last_of_values_is_looked_up_before_any_run() -> None:
    with pytest.raises(frot.FrotError, match="bad value of 'm'"):
        frot.compile(STICK).sweep({"m": [1, 2, "3 m"]}, ["stick.angle"])
