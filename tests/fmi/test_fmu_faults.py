"""The faults that an export looks for are those that FMPy finds."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from fmpy.validation import validate_fmu
from frot.runtime.fmi.faults import faults_of

import frot

TEXT = """
model Names
  Real x[2] = (time/(1 s), 1);
  Real y = 2*x[1];
  output Real z = y;
  experiment(stop = 1 s);
end Names;
"""


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("faults") / "Names.fmu"
    frot.compile(TEXT).export_fmu(path, "2.0", "native")
    return path


def changed(archive: Path, folder: Path, old: str, new: str) -> str:
    """The FMU with a phrase of its description replaced."""
    path = folder / "changed.fmu"
    with zipfile.ZipFile(archive) as source, zipfile.ZipFile(path, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            if name == "modelDescription.xml":
                text = content.decode()
                assert old in text
                content = text.replace(old, new).encode()
            target.writestr(name, content)
    return str(path)


@pytest.mark.parametrize(
    "name",
    ["y", "_a1.b", "a[1,22].b[3]", "der(a.b,2)", "der(c[1])", "'odd name'.x", "'a.b: 1'[2]"],
)
def test_a_plain_name_is_one_for_fmpy(archive: Path, tmp_path: Path, name: str) -> None:
    path = changed(archive, tmp_path, 'name="y"', f'name="{name}"')
    assert faults_of(path) == validate_fmu(path) == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('name="y"', 'name="1y"'),
        ('name="y"', 'name="a..b"'),
        ('name="y"', 'name="a[b]"'),
        ('name="y"', 'name="der(y"'),
        ('name="y"', 'name="z"'),
        ("<Outputs>", "<Outputs><Unknown index='1'/>"),
    ],
)
def test_a_fault_is_told_as_fmpy_tells_it(
    archive: Path, tmp_path: Path, old: str, new: str
) -> None:
    path = changed(archive, tmp_path, old, new)
    faults = faults_of(path)
    assert faults and faults == validate_fmu(path)
