"""Files as members of packages: where they are found, what is told, what a program is made from."""

from pathlib import Path

import pytest
from frot.dsl import Log, checked, compile_text, default_values, load, render_log
from frot.dsl.checked.show import show
from frot.dsl.files.import_scan import imported_files

PART = """model Part
  parameter Real a = 1;
  Real x;
equation
  x = a*time/(1 s);
end Part;
"""
LIBRARY = f"""package Electrical
  constant Real two = 2;
  {PART}
  model Big
    extends Part(a = two);
  end Big;
end Electrical;
"""


def write(folder: Path, **texts: str) -> None:
    for name, text in texts.items():
        path = folder.joinpath(*name.split("__")).with_suffix(".frot")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def loaded(path: Path) -> checked.Model:
    log = Log()
    model = load(path, log)
    assert model is not None, render_log(log)
    assert not log.diagnostics, render_log(log)
    return model


def codes(path: Path) -> list[tuple[str, str]]:
    log = Log()
    assert load(path, log) is None
    return [(d.code, d.message) for d in log]


@pytest.mark.parametrize(
    ("statement", "kind"),
    [
        ("import Electrical.Big;", "Big"),
        ("import Electrical.*;", "Big"),
        ("import Electrical.Big as B;", "B"),
        ("import Electrical;", "Electrical.Big"),
        ("import Electrical as E;", "E.Big"),
    ],
)
@pytest.mark.parametrize("inside", [False, True])
def test_every_form_of_import(tmp_path: Path, statement: str, kind: str, inside: bool) -> None:
    outer, inner = ("", statement) if inside else (statement, "")
    write(tmp_path, Electrical=LIBRARY, main=f"{outer}\nmodel M\n {inner}\n {kind} b;\nend M;\n")
    model = loaded(tmp_path / "main.frot")
    values = {p.name: v for p, v in default_values(model).items()}
    assert values == {"Electrical.two": 2.0, "b.a": 2.0}
    assert [Path(s.name).name for s in model.files] == ["main.frot", "Electrical.frot"]
    assert [show(e.left) for e in model.equations] == ["b.x"]


@pytest.mark.parametrize("statement", ["import Electrical.*;", "import Electrical.two;"])
def test_constants_are_imported(tmp_path: Path, statement: str) -> None:
    write(tmp_path, Electrical=LIBRARY, main=f"{statement}\nmodel M\n Real x = two;\nend M;\n")
    assert [show(e.right) for e in loaded(tmp_path / "main.frot").equations] == ["Electrical.two"]


def test_a_folder_is_a_package_of_its_files(tmp_path: Path) -> None:
    inner = "import Library.Base.Low;\nmodel Part\n extends Low(a = 3);\nend Part;\n"
    write(
        tmp_path,
        Library__Part=inner,
        Library__Base__Low=PART.replace("Part", "Low"),
        main="import Library.*;\nimport Library.Base;\nmodel M\n Part p;\n Base.Low q;\nend M;\n",
    )
    model = loaded(tmp_path / "main.frot")
    assert {p.name: v for p, v in default_values(model).items()} == {"p.a": 3.0, "q.a": 1.0}
    read = imported_files((tmp_path / "main.frot").read_text(), str(tmp_path / "main.frot"))
    assert {p.name for p in read} == {"Part.frot", "Low.frot"}


def test_a_file_of_plain_definitions_is_a_package(tmp_path: Path) -> None:
    write(tmp_path, Parts=PART, main="import Parts.Part;\nmodel M\n Part p;\nend M;\n")
    assert [v.name for v in loaded(tmp_path / "main.frot").variables] == ["p.x"]


def test_a_text_without_file_imports_from_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path, Parts=PART)
    monkeypatch.chdir(tmp_path)
    log = Log()
    text = "import Parts.Part;\nmodel M\n Part p;\nend M;\n"
    assert compile_text(text, log) is not None, render_log(log)
    assert imported_files(text, "<text>") == [tmp_path / "Parts.frot"]


def test_circles_are_told_by_name(tmp_path: Path) -> None:
    write(
        tmp_path,
        A="import B.Y;\nmodel X\n Y y;\nend X;\n",
        B="import C.Z;\nmodel Y\n Z z;\nend Y;\n",
        C="import A.X;\nmodel Z\n X x;\nend Z;\n",
    )
    found = codes(tmp_path / "A.frot")
    circle = "files import each other in a circle: A.frot -> B.frot -> C.frot -> A.frot"
    assert found == [("E0211", circle)]
    files = imported_files((tmp_path / "A.frot").read_text(), str(tmp_path / "A.frot"))
    assert {p.name for p in files} == {"A.frot", "B.frot", "C.frot"}


def test_what_is_missing_is_told_with_its_near_name(tmp_path: Path) -> None:
    write(
        tmp_path,
        Electrical=LIBRARY,
        main="import Electrical.Prat;\nimport Nowhere.*;\nmodel M\n Prat p;\n Other q;\nend M;\n",
    )
    assert codes(tmp_path / "main.frot") == [
        ("E0210", "'Electrical' has no member 'Prat'"),
        ("E0210", "no library 'Nowhere'"),
    ]


def test_faults_of_a_library_are_told_in_its_file(tmp_path: Path) -> None:
    write(
        tmp_path,
        Parts=PART.replace("a*time", "b*time"),
        main="import Parts.Part;\nmodel M\n Part p, q;\nend M;\n",
    )
    log = Log()
    assert load(tmp_path / "main.frot", log) is None
    (told,) = log
    assert told.span is not None
    assert (told.code, Path(told.span.source.name).name) == ("E0201", "Parts.frot")


def test_the_scan_reads_no_comments_and_no_texts(tmp_path: Path) -> None:
    write(tmp_path, A="", B="", C="")
    text = 'import /* import A; */ B.x; // import A;\n"import A;"\nimport  C . y as z;\n'
    found = imported_files(text, str(tmp_path / "main.frot"))
    assert [p.name for p in found] == ["B.frot", "C.frot"]


def test_a_program_is_made_from_what_it_imports(tmp_path: Path) -> None:
    from frot.compiled_model import _identity

    write(tmp_path, Parts=PART, main="import Parts.Part;\nmodel M\n Part p;\nend M;\n")
    path = tmp_path / "main.frot"
    before = _identity(path.read_text(), str(path))
    write(tmp_path, Parts=PART.replace("a = 1", "a = 2"))
    assert _identity(path.read_text(), str(path)) != before


def test_a_file_reads_the_same_files_however_its_user_goes_there(tmp_path: Path) -> None:
    write(tmp_path, Electrical=LIBRARY, inner__other=PART)
    text = "model M\n import Electrical.*;\n Big b;\nend M;\n"
    (tmp_path / "link").symlink_to(tmp_path / "inner")
    seen = {
        tuple(imported_files(text, str(tmp_path / way / "m.frot")))
        for way in (".", "./.", "inner/..", "link/..", "inner/../inner/..")
    }
    assert seen == {(tmp_path / "Electrical.frot",)}


@pytest.mark.parametrize(
    ("first", "second", "told"),
    [("P.A", "Q.A", True), ("P.k", "Q.k", True), ("P.A", "P.A", False), ("P.k", "P.k", False)],
)
def test_a_name_stands_for_one_import(first: str, second: str, told: bool) -> None:
    text = (
        "package P\n constant Real k = 1;\n model A\n  Real x = 1;\n end A;\nend P;\n"
        "package Q\n constant Real k = 2;\n model A\n  Real x = 2;\n end A;\nend Q;\n"
        f"model M\n import {first};\n import {second};\n Real y = 1;\nend M;\n"
    )
    log = Log()
    compile_text(text, log)
    assert [d.code for d in log if d.is_error] == (["E0212"] if told else [])
