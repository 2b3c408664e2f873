"""Words of the exporter and the icon."""

from __future__ import annotations

import struct
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
import pytest
from fmpy.validation import validate_fmu
from frot.runtime.fmi import export
from lxml import etree

import frot
from frot.view.icon import icon_of

MODELS = Path(__file__).parents[2] / "models"


def pretend(
    _sources: Sequence[Path], _include: Sequence[Path], libraries: Mapping[str, Path]
) -> None:
    """Libraries that nobody loads."""
    for path in libraries.values():
        path.write_bytes(b"")


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_author_version_licence_and_date(tmp_path: Path, version: str) -> None:
    """Only those that are given; a day is its first second."""
    model = frot.load(MODELS / "dry_pendulum.frot")
    path = tmp_path / "a.fmu"
    model.export_fmu(
        path, version, "native", author="Ada <ada@x>", licence="MIT", date="2026-11-27"
    )
    with zipfile.ZipFile(path) as file:
        root = ET.fromstring(file.read("modelDescription.xml"))
    said = {name: root.get(name) for name in ("author", "license", "version", "copyright")}
    assert said == {"author": "Ada <ada@x>", "license": "MIT", "version": None, "copyright": None}
    assert root.get("generationDateAndTime") == "2026-11-27T00:00:00Z"
    assert validate_fmu(str(path)) == []
    for wrong in ({"date": "yesterday"}, {"licence": "MIT", "editor": "Ada"}):
        with pytest.raises(frot.FrotError, match="E0806"):
            model.export_fmu(tmp_path / "b.fmu", version, "native", **wrong)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_an_icon_is_drawn_from_the_mechanism(tmp_path: Path, version: str) -> None:
    """A picture of the start, where the versions look for it."""
    model, path = frot.load(MODELS / "slider_crank.frot"), tmp_path / "a.fmu"
    icon = icon_of(model)
    assert icon is not None
    size = struct.unpack(">II", icon[16:24])
    assert (icon[:8], size) == (b"\x89PNG\r\n\x1a\n", (256, 192))
    assert icon_of(model) == icon
    export(model.program(), path, version, pretend, icon=icon)
    assert validate_fmu(str(path)) == []
    with zipfile.ZipFile(path) as file:
        if version == "2.0":
            assert file.read("model.png") == icon
            return
        assert file.read("terminalsAndIcons/icon.png") == icon
        schema = Path(fmpy.__file__).parent / "schema/fmi3/fmi3TerminalsAndIcons.xsd"
        text = file.read("terminalsAndIcons/terminalsAndIcons.xml")
    etree.XMLSchema(etree.parse(str(schema))).assertValid(etree.fromstring(text))


def test_equations_alone_have_no_icon() -> None:
    assert icon_of(frot.load(MODELS / "half_wave_rectifier.frot")) is None
