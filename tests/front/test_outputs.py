"""Files that a run writes: the same numbers everywhere, whole or not at all."""

import csv
import errno
import json
import os
import resource
import subprocess
import sys
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from front_door import HOOP, OSCILLATOR, Door, Shell, files_in
from frot.runtime.run_report import MODES

import frot

RUN = ("--stop", "2.5", "--tolerance", "1e-10", "--set", "r=60 cm", "--interval", "0.01")


@pytest.fixture
def result() -> frot.Result:
    return frot.load(HOOP).simulate(
        stop=2.5, tolerance=1e-10, interval=0.01, parameters={"r": "60 cm"}
    )


def test_csv_holds_the_numbers_of_the_result_to_the_last_bit_and_modes_as_words(
    result: frot.Result, door: Door
) -> None:
    door("simulate", HOOP, *RUN, "-o", "out.csv").succeeds()
    with open("out.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == list(result)
    for name in result:
        if name.endswith(".mode"):
            assert [row[name] for row in rows] == [MODES[int(m)] for m in result[name]]
            assert {row[name] for row in rows} == {"slip", "stick"}
        else:
            assert [float(row[name]) for row in rows] == result[name].tolist()


def test_json_holds_the_numbers_units_parameters_and_events(
    result: frot.Result, door: Door
) -> None:
    door("simulate", HOOP, *RUN, "-o", "out.json").succeeds()
    content = json.loads(Path("out.json").read_text(encoding="utf-8"))
    assert list(content["variables"]) == list(result)
    for name in result:
        assert content["variables"][name] == result[name].tolist()
    assert content["modes"] == ["open", "stick", "slip"]
    assert content["parameters"] == {"r": 0.6, "mu": 0.3, "delta": 0.0}
    assert content["units"]["hoop.velocity.x"] == "m/s" and content["units"]["time"] == "s"
    (event,) = content["events"]
    assert (event["time"], event["before"], event["after"]) == (
        result.events[0].time,
        "slip",
        "stick",
    )


def test_npz_holds_the_numbers_to_the_last_bit(result: frot.Result, door: Door) -> None:
    door("simulate", HOOP, *RUN, "-o", "out.npz").succeeds()
    with np.load("out.npz") as content:
        assert set(content) == set(result)
        for name in result:
            assert content[name].tobytes() == np.ascontiguousarray(result[name]).tobytes()


@pytest.mark.parametrize(
    ("name", "begin"), [("p.png", b"\x89PNG"), ("p.svg", b"<?xml"), ("p.PDF", b"%PDF")]
)
def test_a_plot_is_written_in_the_format_of_its_name(name: str, begin: bytes, door: Door) -> None:
    answer = door("simulate", OSCILLATOR, "--plot", name).succeeds()
    assert answer.new == (name,)
    content = Path(name).read_bytes()
    assert content.startswith(begin) and len(content) > 5000


def test_a_parameter_with_a_unit_is_the_number_in_si(door: Door) -> None:
    door("simulate", HOOP, "--set", "r=600 mm", "-o", "a.csv", "--quiet").succeeds()
    door("simulate", HOOP, "--set", "r=0.6", "-o", "b.csv", "--quiet").succeeds()
    assert Path("a.csv").read_bytes() == Path("b.csv").read_bytes()


def test_a_file_there_is_replaced_whole_and_has_the_usual_permissions(door: Door) -> None:
    Path("out.csv").write_text("old")
    door("simulate", HOOP, "-o", "out.csv").succeeds()
    assert Path("out.csv").read_text().startswith("time,")
    mask = os.umask(0)
    os.umask(mask)
    assert Path("out.csv").stat().st_mode & 0o777 == 0o666 & ~mask
    assert files_in(door.folder) == {"out.csv"}


@pytest.mark.parametrize(
    ("option", "name"),
    [("-o", "out.xlsx"), ("-o", "out"), ("-o", "."), ("--plot", "p.gif"), ("--plot", "p")],
)
def test_an_unknown_format_is_told(option: str, name: str, door: Door) -> None:
    door("simulate", HOOP, option, name).refuses("E0806", "format", "name a file that ends in")


def test_a_format_is_refused_before_the_run_and_before_other_files_are_written(door: Door) -> None:
    answer = door("simulate", HOOP, "-o", "out.csv", "--plot", "p.gif")
    answer.refuses("E0806", "format")


@pytest.mark.parametrize("option", ["-o out.csv", "-o out.json", "-o out.npz", "--plot p.png"])
def test_a_folder_that_does_not_exist_is_told(option: str, door: Door) -> None:
    flag, name = option.split()
    door("simulate", HOOP, flag, f"none/{name}").refuses(
        "E0803", f"'none/{name}' cannot be written", "make the folder 'none' first"
    )


def test_a_folder_in_place_of_the_file_is_told(door: Door) -> None:
    Path("out.csv").mkdir()
    door("simulate", HOOP, "-o", "out.csv").refuses("E0803", "'out.csv' cannot be written")


@pytest.mark.parametrize(
    ("name", "cause"), [("none/a.fmu", "'none/a.fmu' cannot be written"), ("a.zip", ".fmu")]
)
def test_an_fmu_that_cannot_be_written_is_told(name: str, cause: str, door: Door) -> None:
    answer = door("fmu", HOOP, "-o", name, "--platforms", "native")
    assert answer.status == 1 and cause in answer.err and "Traceback" not in answer.err
    assert answer.new == ()


@pytest.mark.parametrize("step", ["write", "replace"])
@pytest.mark.parametrize("option", ["-o out.csv", "-o out.npz", "--plot p.png"])
def test_a_full_disk_leaves_nothing_half_written_and_keeps_the_old_file(
    step: str, option: str, door: Door, monkeypatch: pytest.MonkeyPatch
) -> None:
    flag, name = option.split()
    Path(name).write_text("old")
    full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def fail(*_: object, **__: object) -> None:
        raise full

    with monkeypatch.context() as patch:
        if step == "replace":
            patch.setattr("frot.dsl.files.writing.os.replace", fail)
        else:
            opened = os.fdopen

            def opening(handle: int, *rest: object) -> object:
                file = opened(handle, *rest)  # type: ignore[call-overload]
                if rest == ("wb",):
                    file.close()
                    raise full
                return file

            patch.setattr("frot.dsl.files.writing.os.fdopen", opening)
        answer = door("simulate", HOOP, flag, name)
    answer.refuses("E0803", f"'{name}' cannot be written", "free some space")
    assert Path(name).read_text() == "old"


@pytest.mark.parametrize("words", ["simulate HOOP -o out.csv", "fmu HOOP -o hoop.fmu"])
def test_a_disk_that_takes_no_more_bytes_is_told_and_left_clean(words: str, door: Door) -> None:
    # A real limit of the system: no file may grow beyond 20 kB, those of compiled modules neither.
    frot.load(HOOP).program()
    arguments = words.replace("HOOP", str(HOOP)).split()
    done = subprocess.run(
        [sys.executable, "-B", "-m", "frot.command_line", *arguments],
        cwd=door.folder,
        capture_output=True,
        text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000)),
        check=False,
    )
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert done.stderr.startswith("error[E080"), done.stderr
    assert files_in(door.folder) == set()


@pytest.mark.parametrize(("residual", "kinetic", "told"), [(1e-15, 0.0, False), (1.0, 1.0, True)])
def test_energy_is_an_alarm_only_where_something_moves(
    residual: float, kinetic: float, told: bool
) -> None:
    from frot.runtime.run_report import Balance

    import frot

    result = frot.compile(
        "planar model Rest\n  body b: particle(mass = 1 kg);\n  world(gravity = 0 m/s^2);\n"
        f"initial\n  b.velocity.x = {(2 * kinetic) ** 0.5} m/s;\nend Rest;\n"
    ).simulate()
    result.balance = Balance(residual, 2 * residual, residual, 0.0, 0.0)
    assert ("do not trust" in result.summary()) == told


def test_what_is_constant_but_for_rounding_is_drawn_level() -> None:
    from frot.runtime.plotting import draw

    text = (
        "model M\n  body b: sphere(mass = 1 kg, radius = 1 m);\n  output Length far = "
        "norm(b.position);\n  liaison pin: rotoide(ground, b, axis = (1, 2, 2));\n"
        "  frame f on b at (3, 1, 2) m;\n  output Length arm = norm(f.position);\n"
        "initial\n  pin.speed = 3 rad/s;\n  experiment(stop = 2 s);\nend M;\n"
    )
    result = frot.compile(text).simulate()
    panel = draw(result).axes[0]
    low, high = panel.get_ylim()
    assert high - low > 0.3
    assert panel.get_ylabel() == "output"


MANY = """
planar model Many
  body p[100]: particle(mass = 1 kg);
  experiment(stop = 1 s, interval = 1e-7 s);
end Many;
"""


def test_output_times_are_limited_by_the_number_of_variables(door: Door) -> None:
    """A table of all variables takes at most 2^27 numbers of 8 bytes."""
    name = door.write(MANY)
    refusal = door("simulate", name)
    refusal.refuses("E0806", "an interval of 1e-07 s gives 1e+07 output times of 704 variables")
    most = 2**27 // 704
    assert f"at most {most} can be kept" in refusal.err
    least = float(refusal.err.partition("choose an interval of ")[2].split()[0])
    assert 1 / most <= least < 1.1 / most
    door("simulate", name, "--interval", str(10 * least)).succeeds()
    with pytest.raises(frot.FrotError):
        frot.load(name).simulate(interval=1 / (most + 1))


def test_a_model_of_any_size_has_its_default_output_times(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("frot.runtime.run.MOST_VALUES", 1000)
    model = frot.compile(MANY.replace(", interval = 1e-7 s", ""))
    assert len(model.simulate().time) == 501
    with pytest.raises(frot.FrotError):
        model.simulate(interval=1 / 502)


@pytest.mark.parametrize("suffix", ["csv", "json"])
def test_a_table_is_written_without_a_copy_of_it_as_text(
    suffix: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """20 001 rows are some 6 MB of text."""
    result = frot.load(OSCILLATOR).simulate(stop=12.0, interval=6e-4)
    result[next(iter(result))]
    target = folder / f"out.{suffix}"
    tracemalloc.start()
    result.save(target)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < target.stat().st_size


def test_too_little_memory_is_one_message(door: Door, monkeypatch: pytest.MonkeyPatch) -> None:
    def values(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr("frot.runtime.engine.Engine.values", values)
    door("simulate", HOOP).refuses("E0808", "not enough memory")


@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize(
    "words", ["simulate model.frot -o out.csv", "check model.frot", "explain", "fmt --diff *.frot"]
)
def test_a_closed_standard_stream_is_no_fault(closed: str, words: str, shell: Shell) -> None:
    """The file of the table must not take the number of the closed stream."""
    (shell.folder / "model.frot").write_text(HOOP.read_text(encoding="utf-8"), encoding="utf-8")
    answer = shell.run(["sh", "-c", f"{sys.executable} -m frot.command_line {words} {closed}"])
    assert answer.succeeds().err == ""
    if "-o" in words:
        lines = (shell.folder / "out.csv").read_text(encoding="utf-8").splitlines()
        assert len(lines) == 502 and lines[0].startswith("time,")


def test_a_model_is_compiled_with_all_streams_closed(shell: Shell) -> None:
    (shell.folder / "model.frot").write_text(MANY.replace("1e-7", "0.1"), encoding="utf-8")
    run = f"{sys.executable} -m frot.command_line simulate model.frot -o out.json <&- >&- 2>&-"
    shell.run(["sh", "-c", run], FROT_CACHE=shell.folder / "cache").succeeds()
    assert len(json.loads((shell.folder / "out.json").read_text())["variables"]["time"]) == 11
