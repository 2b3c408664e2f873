"""The content of a file `.frotrun`: a zip of text, settings, the kernel's state and the steps.

Nothing in it is executed but the compiled text, as a `.frot` file's would be.
"""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from frot.dsl.messages.errors import fail
from frot.runtime.kept import keep
from frot.runtime.tables import Table

if TYPE_CHECKING:
    from frot.runtime.program import Program
    from frot.runtime.run_values import RunValues

FORMAT = 1
DESCRIPTION, STATE, GRID, RECORD = "run.json", "state", "grid", "record"


def run_file(result: RunValues) -> bytes:
    """The content of the file; FrotError (E0806) where the text of the model is not known."""
    try:
        model, state, schedule, (grid, record), events, figures, kept = keep(result)
    except TypeError:
        raise fail(
            "E0806",
            f"the text of the model '{result.program.name}' is not known",
            help="save results of `model.simulate(...)`, or write a .csv",
        ) from None
    text, file, chosen = model.source
    description = {
        "format": FORMAT,
        "layout": layout_of(result.program),
        "model": {"text": text, "file": _whole(file), "chosen": chosen},
        "schedule": schedule,
        "events": [asdict(one) for one in events],
        "figures": asdict(figures),
        "kept": _plain({**kept, "moving": sorted(kept["moving"])}),
    }
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        archive.writestr(DESCRIPTION, json.dumps(description))
        for name, content in ((STATE, state), (GRID, grid), (RECORD, record)):
            archive.writestr(name, content)
    return buffer.getvalue()


def layout_of(program: Program) -> str:
    """A digest of the generated C and of Frot: with the same, states have the same places."""
    from frot.compiler import own_identity

    digest = hashlib.sha256(program.source.read_bytes())
    digest.update(own_identity().encode())
    return digest.hexdigest()


def _whole(file: str) -> str:
    """The file from the root, so that what it imports is found from any folder."""
    return str(Path(file).resolve()) if Path(file).is_file() else file


def _plain(value: Any) -> Any:
    """The value in what JSON has; arrays as lists."""
    if isinstance(value, Table):
        return asdict(value)
    if isinstance(value, dict):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, (tuple, list)):
        return [_plain(one) for one in value]
    return value.tolist() if hasattr(value, "tolist") else value
