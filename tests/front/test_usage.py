"""Wrong usage has status 2 and shows how it is meant; files that cannot be read have status 1."""

import sys
from pathlib import Path

import pytest
from front_door import HOOP, Door, Shell


def test_without_a_command_the_help_is_printed(door: Door) -> None:
    answer = door().succeeds()
    assert all(word in answer.out for word in ("check", "simulate", "fmu", "Exit status"))


@pytest.mark.parametrize("command", [(), ("check",), ("simulate",), ("fmu",)])
def test_every_command_explains_itself(command: tuple[str, ...], door: Door) -> None:
    assert door(*command, "--help").succeeds().out.startswith("usage: frot")


@pytest.mark.parametrize(
    ("words", "cause"),
    [
        (("simulate",), "FILE"),
        (("drive", HOOP), "invalid choice: 'drive'"),
        (("simulate", HOOP, "--wrong"), "--wrong"),
        (("simulate", HOOP, "--set", "mu"), "'mu' is not NAME=VALUE"),
        (("simulate", HOOP, "--set", "=3"), "'=3' is not NAME=VALUE"),
        (("simulate", HOOP, "--set", "mu="), "'mu=' is not NAME=VALUE"),
        (("simulate", HOOP, "--input", "F"), "'F' is not NAME=VALUE"),
        (("simulate", HOOP, "--stop", "late"), "'late' is not a number"),
        (("simulate", HOOP, "--stop", "nan"), "'nan' is not a finite number"),
        (("simulate", HOOP, "--stop", "inf"), "'inf' is not a finite number"),
        (("simulate", HOOP, "--stop", "3 kg"), "expected a time (s), found a mass (kg)"),
        (("fmu", HOOP, "--fmi", "1.0"), "invalid choice: '1.0'"),
        (("check", HOOP, "--emit", "soup"), "invalid choice: 'soup'"),
    ],
)
def test_wrong_usage_is_told(words: tuple[object, ...], cause: str, door: Door) -> None:
    door(*words).is_misused(cause)


@pytest.mark.parametrize("option", ["-o", "--plot"])
def test_an_empty_name_of_an_output_is_not_passed_over(option: str, door: Door) -> None:
    assert door("simulate", HOOP, option, "").status in (1, 2)


@pytest.mark.parametrize("command", ["check", "simulate", "fmu"])
class TestFilesThatCannotBeRead:
    def test_a_missing_file(self, command: str, door: Door) -> None:
        door(command, "none.frot").refuses("E0804", "cannot read 'none.frot'", "check the path")

    def test_a_folder(self, command: str, door: Door) -> None:
        door(command, ".").refuses("E0804", "cannot read '.'", "directory")

    def test_a_file_not_in_utf8(self, command: str, door: Door) -> None:
        (door.folder / "latin.frot").write_bytes("// Painlevé".encode("latin-1"))
        door(command, "latin.frot").refuses("E0804", "it is not UTF-8 (line 1)", "UTF-8")

    def test_random_bytes(self, command: str, door: Door) -> None:
        (door.folder / "random.frot").write_bytes(bytes(range(256)) * 8)
        door(command, "random.frot").refuses("E0804", "it is not UTF-8")

    @pytest.mark.parametrize("text", ["", "\n\n", "// nothing\n", "/* nothing */"])
    def test_a_file_without_a_model(self, command: str, text: str, door: Door) -> None:
        name = door.write(text)
        door(command, name).refuses("E0509", "there is no model", "planar model Name")


def test_a_name_with_a_null_byte_is_refused(door: Door) -> None:
    door("check", "a\0b.frot").refuses("E0804", "cannot read")


def test_an_unknown_model_lists_those_there_are(door: Door) -> None:
    answer = door("simulate", HOOP, "--model", "Ball")
    answer.refuses("E0207", "no model 'Ball'", "there are: BackspinHoop")


def test_several_models_are_chosen_from_by_an_option_of_the_command(door: Door) -> None:
    one = "planar model {}\n  body b: particle(mass = 1 kg);\n  experiment(stop = 1 s);\nend {};\n"
    name = door.write(one.format("A", "A") + one.format("B", "B"))
    door("simulate", name).refuses("E0510", "A, B")
    assert "A: 0 s to 1 s" in door("simulate", name, "--model", "A").succeeds().out
    assert "--model" in door("simulate", name).err


def test_marks_line_ends_and_odd_names_of_files_do_no_harm(door: Door) -> None:
    text = HOOP.read_text(encoding="utf-8").replace("\n", "\r\n")
    (door.folder / "a space é.frot").write_bytes(b"\xef\xbb\xbf" + text.encode())
    door("check", "a space é.frot").succeeds()


def test_the_version_is_printed(door: Door) -> None:
    assert door("--version").succeeds().out.startswith("frot ")


@pytest.mark.parametrize("command", ["check --emit tree", "simulate"])
def test_a_reader_that_goes_away_leaves_no_traceback(command: str, shell: Shell) -> None:
    line = f'"{sys.executable}" -m frot.command_line {command} "{HOOP}"'
    answer = shell.run(["sh", "-c", f"{line} | head -n 1"])
    assert answer.err == "" and answer.out.count("\n") == 1
    answer = shell.run(["sh", "-c", f"{line} | true"])
    assert answer.err == ""


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize("command", ["check", "simulate"])
def test_a_full_disk_behind_the_standard_output_is_told(command: str, shell: Shell) -> None:
    line = f'"{sys.executable}" -m frot.command_line {command} "{HOOP}"'
    answer = shell.run(["sh", "-c", f"{line} > /dev/full"])
    answer.refuses("E0803", "No space left on device")
