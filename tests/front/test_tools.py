"""The tools for texts: `fmt`, `explain` and `check --json`."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from front_door import BLOCK, HOOP, Door, Shell
from frot.dsl import CODES
from patience import PATIENCE

TEXT = HOOP.read_text(encoding="utf-8")
UNTIDY = TEXT.replace("  body hoop", "body   hoop").replace("mass = 1", "mass=1").rstrip()
FAULTY = "planar model M\n  body  ball: particle(mass = 1 kg);\nend N;\n"


def piped(door: Door, *words: str, text: str | bytes) -> tuple[int, bytes, str]:
    """Run a command with a text on its standard input."""
    done = subprocess.run(
        [sys.executable, "-m", "frot.command_line", *words],
        input=text.encode() if isinstance(text, str) else text,
        cwd=door.folder,
        capture_output=True,
        timeout=PATIENCE,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr.decode()


class TestFmt:
    def test_a_file_is_rewritten_in_its_place(self, door: Door) -> None:
        name = door.write(UNTIDY)
        assert door("fmt", name).succeeds().out == "formatted model.frot\n"
        assert (door.folder / name).read_bytes() == TEXT.encode()
        assert os.listdir(door.folder) == [name]

    def test_a_file_in_its_usual_form_is_not_touched(self, door: Door) -> None:
        name = door.write(TEXT)
        os.utime(name, (1, 1))
        assert door("fmt", name).succeeds().out == ""
        assert os.stat(name).st_mtime == 1

    def test_line_ends_and_a_byte_order_mark_are_dropped(self, door: Door) -> None:
        (door.folder / "a.frot").write_bytes(b"\xef\xbb\xbf" + TEXT.replace("\n", "\r\n").encode())
        door("fmt", "a.frot").succeeds()
        assert (door.folder / "a.frot").read_bytes() == TEXT.encode()

    def test_check_names_the_files_that_would_change(self, door: Door) -> None:
        names = [door.write(UNTIDY, "a.frot"), door.write(TEXT, "b.frot")]
        answer = door("fmt", "--check", *names)
        assert (answer.status, answer.out, answer.err) == (1, "a.frot\n", "")
        assert (door.folder / "a.frot").read_text(encoding="utf-8") == UNTIDY
        assert door("fmt", "--check", "b.frot").status == 0

    def test_diff_shows_what_would_change(self, door: Door) -> None:
        name = door.write(UNTIDY)
        answer = door("fmt", "--diff", name).succeeds()
        assert answer.out.startswith("--- model.frot\n+++ model.frot\n@@ ")
        assert "-body   hoop: ring(mass=1 kg, radius = r);\n" in answer.out
        assert "+  body hoop: ring(mass = 1 kg, radius = r);\n" in answer.out
        assert "-end BackspinHoop;\n\\ No newline at end of file\n+end" in answer.out
        assert (door.folder / name).read_text(encoding="utf-8") == UNTIDY
        assert door("fmt", "--diff", "--check", name).status == 1

    def test_a_faulty_file_is_left_and_the_others_are_done(self, door: Door) -> None:
        names = [door.write(FAULTY, "faulty.frot"), door.write(UNTIDY, "good.frot")]
        answer = door("fmt", *names)
        assert answer.out == "formatted good.frot\n"
        assert (door.folder / "faulty.frot").read_text(encoding="utf-8") == FAULTY
        answer.refuses("E0105", place="faulty.frot:3:5")

    def test_names_and_units_need_not_be_right(self, door: Door) -> None:
        name = door.write("model M\n  parameter Length r=2 kg+q;\nend M;\n")
        door("fmt", name).succeeds()
        assert "r = 2 kg + q;" in (door.folder / name).read_text(encoding="utf-8")

    def test_standard_input_goes_to_standard_output(self, door: Door) -> None:
        assert piped(door, "fmt", "-", text=UNTIDY) == (0, TEXT.encode(), "")
        assert piped(door, "fmt", "--check", "-", text=UNTIDY) == (1, b"<stdin>\n", "")
        status, out, err = piped(door, "fmt", "-", text=FAULTY)
        assert (status, out) == (1, b"") and "--> <stdin>:3:5" in err
        status, out, err = piped(door, "fmt", "-", text=b"// \xff")
        assert (status, out) == (1, b"") and err.startswith("error[E0804]")

    def test_a_link_stays_a_link_and_permissions_stay(self, door: Door) -> None:
        name = door.write(UNTIDY)
        os.chmod(name, 0o640)
        os.symlink(name, "link.frot")
        door("fmt", "link.frot").succeeds()
        assert os.path.islink("link.frot")
        assert (door.folder / name).read_text(encoding="utf-8") == TEXT
        assert os.stat(name).st_mode & 0o777 == 0o640

    def test_a_write_that_fails_leaves_the_file(
        self, door: Door, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def full(*_: object) -> None:
            raise OSError(28, "No space left on device")

        name = door.write(UNTIDY)
        monkeypatch.setattr(os, "replace", full)
        door("fmt", name).refuses("E0803", "'model.frot' cannot be written: No space left")
        assert (door.folder / name).read_text(encoding="utf-8") == UNTIDY

    def test_a_file_that_may_not_be_written_is_not_replaced(
        self, door: Door, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        name = door.write(UNTIDY)
        monkeypatch.setattr(os, "access", lambda *_: False)
        door("fmt", name).refuses("E0803", "Permission denied")

    def test_what_is_not_needed_is_not_loaded(self, shell: Shell) -> None:
        program = (
            "import sys; from frot.command_line import main\n"
            f"assert main(['fmt', '--check', {str(HOOP)!r}]) == 0; print(*sys.modules)"
        )
        loaded = set(shell.run([sys.executable, "-c", program]).succeeds().out.split())
        assert "frot.dsl.layout.formatting" in loaded
        heavy = {"casadi", "numpy", "frot.compiler", "frot.runtime", "frot.dsl.checking"}
        assert not loaded & heavy


class TestExplain:
    @pytest.mark.parametrize("code", CODES)
    def test_every_code_is_explained(self, code: str, door: Door) -> None:
        entry = CODES[code]
        shown = door("explain", code).succeeds().out
        assert shown.startswith(f"{code}: {entry.title}\n")
        words = " ".join(shown.split())
        assert entry.explanation in words and f"Remedy: {entry.remedy}" in words
        assert not entry.example or shown.endswith(f"Example:\n\n{entry.example}")

    def test_without_a_code_all_are_listed(self, door: Door) -> None:
        lines = door("explain").succeeds().out.splitlines()
        assert lines == [f"{code}  {CODES[code].title}" for code in sorted(CODES)]

    @pytest.mark.parametrize(
        ("code", "help_text"),
        [
            ("E203", "did you mean 'E0203'?"),
            ("E0299", "did you mean 'E0201'?"),
            ("E09", "did you mean 'E0901'?"),
            ("E091", "did you mean 'E0910'?"),
            ("impasse", "'frot explain' lists all codes"),
            ("\0", "'frot explain' lists all codes"),
        ],
    )
    def test_an_unknown_code_is_told(self, code: str, help_text: str, door: Door) -> None:
        door("explain", code).refuses("E0806", "there is no code", help_text)

    def test_small_letters_do(self, door: Door) -> None:
        assert door("explain", "e0902").out == door("explain", "E0902").out


class TestCheck:
    def test_several_files_are_checked_each(self, door: Door) -> None:
        answer = door("check", HOOP, door.write(FAULTY), BLOCK)
        assert "BackspinHoop: planar" in answer.out and "InclinedBlock: planar" in answer.out
        answer.refuses("E0105", place="model.frot:3:5")
        assert door("check", HOOP, BLOCK).status == 0

    def test_a_report_as_data(self, door: Door) -> None:
        data = json.loads(door("check", BLOCK, "--json").succeeds().out)
        (file,) = data["files"]
        assert file["file"] == str(BLOCK) and file["diagnostics"] == []
        report = file["report"]
        assert report["model"] == "InclinedBlock"
        assert report["bodies"] == [{"name": "block", "shape": "particle", "freedoms": 2}]
        assert [x["name"] for x in report["liaisons"]] == ["support"]
        assert report["freedoms"] == 2
        assert (report["relations"]["bilateral"], report["relations"]["unilateral"]) == (1, 0)
        assert report["relations"]["by_class"] == {"1": 1}
        assert (report["hyperstatic"], report["loops"], report["first_integrals"]) == (0, [], [])
        assert report["degrees_of_freedom"] == 1

    def test_messages_as_data(self, door: Door) -> None:
        name = door.write(
            "planar model M\r\n  body é: particle(mass = 1 kg);\r\n"
            "  output Length x = é.postion.x;\r\n  parameter Real é = 1;\r\nend M;\r\n"
        )
        answer = door("check", "--json", name, HOOP)
        assert (answer.status, answer.err) == (1, "")
        faulty, good = json.loads(answer.out)["files"]
        assert faulty["report"] is None and good["report"] is not None
        first, second = faulty["diagnostics"]
        assert {key: first[key] for key in ("code", "severity", "message", "help", "file")} == {
            "code": "E0203",
            "severity": "error",
            "message": "no frame 'postion' on body 'é'",
            "help": "did you mean 'position'?",
            "file": "model.frot",
        }
        place = [first[key] for key in ("line", "column", "end_line", "end_column")]
        assert place == [3, 23, 3, 30]
        assert first["caret"] == "" and second["code"] == "E0502"
        (label,) = second["labels"]
        assert label["text"] and (label["line"], label["column"]) == (2, 8)

    def test_a_file_that_cannot_be_read_as_data(self, door: Door) -> None:
        answer = door("check", "--json", "none.frot")
        assert answer.status == 1
        (message,) = json.loads(answer.out)["files"][0]["diagnostics"]
        assert (message["code"], message["file"], message["line"]) == ("E0804", "none.frot", None)

    def test_data_and_a_stage_exclude_each_other(self, door: Door) -> None:
        door("check", HOOP, "--json", "--emit", "tree").is_misused("not allowed with")


def test_what_the_document_shows_is_what_is_printed(door: Door) -> None:
    """Each `$ frot ...` of docs/tools.md, with the file that its first block shows."""
    document = (Path(__file__).parents[2] / "docs" / "tools.md").read_text(encoding="utf-8")
    files = re.findall(r"`(\w+\.frot)`:\n\n```\w*\n(.*?)^```$", document, re.DOTALL | re.MULTILINE)
    for name, text in files:
        door.write(text, name)
    shown = re.findall(r"^\$ frot (.*)\n((?:(?!\$ |```).*\n)*)", document, re.MULTILINE)
    assert len(files) >= 2 and len(shown) >= 5
    for command, output in shown:
        answer = door(*command.split())
        assert answer.out + answer.err == output, command
