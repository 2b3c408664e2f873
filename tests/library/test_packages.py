"""Every part of the library has a closed form, a documentation and a line in docs/library.md."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from frot.dsl import Log, Source, parse
from frot.dsl.text import tree
from test_parts import BENCHES

ROOT = Path(__file__).parents[2]
PACKAGES = ("Rotational", "Translational", "Electrical", "Blocks")
TABLES = ROOT / "docs" / "library.md"


def definitions(package: str) -> list[tree.Definition]:
    """The parts of a package, the partial ones and the connectors among them."""
    path = ROOT / "models" / f"{package}.frot"
    log = Log()
    read = parse(Source(str(path), path.read_text(encoding="utf-8")), log)
    assert not log.diagnostics
    (whole,) = (e for e in read.elements if isinstance(e, tree.Definition))
    return [e for e in whole.elements if isinstance(e, tree.Definition)]


def parts(package: str) -> list[str]:
    return [d.name.text for d in definitions(package) if d.kind == "model" and not d.has("partial")]


def is_set(component: tree.Component) -> bool:
    """Whether it declares parameters or constants."""
    return bool({w.text for w in component.prefixes} & {"parameter", "constant"})


def declared(definition: tree.Definition) -> Iterator[tree.Declared]:
    for element in definition.elements:
        if isinstance(element, tree.Component):
            yield from element.declared


def test_the_packages_are_those_that_come_along() -> None:
    found = [
        path.stem
        for path in (ROOT / "models").glob("*.frot")
        if re.search(r"^package ", path.read_text(encoding="utf-8"), re.MULTILINE)
    ]
    assert sorted(found) == sorted(PACKAGES)


@pytest.mark.parametrize("package", PACKAGES)
def test_every_part_has_a_closed_form(package: str) -> None:
    tested = [part for b in BENCHES if b.package == package for part in b.references]
    assert sorted(tested) == sorted(parts(package))
    assert all(b.references[part] for b in BENCHES for part in b.references)


@pytest.mark.parametrize("package", PACKAGES)
def test_every_part_stands_in_the_bench_that_tests_it(package: str) -> None:
    for bench in BENCHES:
        for part in bench.references if bench.package == package else ():
            assert re.search(rf"^  (\w+\.)?{part} \w+[(;]", bench.text, re.MULTILINE), part


@pytest.mark.parametrize("package", PACKAGES)
def test_every_part_and_what_it_declares_is_documented(package: str) -> None:
    for definition in definitions(package):
        assert definition.doc, definition.name.text
        for one in declared(definition):
            assert one.doc, f"{definition.name.text}.{one.name.text}"


@pytest.mark.parametrize("package", PACKAGES)
def test_every_part_has_a_line_in_the_table_of_its_package(package: str) -> None:
    _, _, section = TABLES.read_text(encoding="utf-8").partition(f"\n## {package}\n")
    table = section.partition("\n## ")[0]
    rows = dict(re.findall(r"^\| `(\w+)` (\|.*)$", table, re.MULTILINE))
    assert sorted(rows) == sorted(parts(package))
    for definition in definitions(package):
        row = rows.get(definition.name.text, "")
        if definition.name.text not in rows:
            continue
        for component in definition.elements:
            if isinstance(component, tree.Component) and is_set(component):
                for one in component.declared:
                    named = re.search(rf"`{one.name.text}\b", row)
                    assert named, f"{definition.name.text}.{one.name.text}"
