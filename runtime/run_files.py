"""A run in a file `.frotrun`: a zip of its text, its settings, the kernel's state and its steps.

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
from frot.runtime.kept import keep, revive
from frot.runtime.tables import Table

if TYPE_CHECKING:
    from frot.runtime.program import Program
    from frot.runtime.result import Result

SUFFIX = ".frotrun"
_FORMAT = 1
_DESCRIPTION, _STATE, _GRID, _RECORD = "run.json", "state", "grid", "record"


def is_run_file(path: str | Path) -> bool:
    """Whether a path is named as a saved run."""
    return Path(path).suffix.lower() == SUFFIX


def run_file(result: Result) -> bytes:
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
        "format": _FORMAT,
        "layout": _layout(result.program),
        "model": {"text": text, "file": _whole(file), "chosen": chosen},
        "schedule": schedule,
        "events": [asdict(one) for one in events],
        "figures": asdict(figures),
        "kept": _plain({**kept, "moving": sorted(kept["moving"])}),
    }
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        archive.writestr(_DESCRIPTION, json.dumps(description))
        for name, content in ((_STATE, state), (_GRID, grid), (_RECORD, record)):
            archive.writestr(name, content)
    return buffer.getvalue()


def load_result(path: str | Path) -> Result:
    """The run of a file that `result.save("NAME.frotrun")` wrote.

    Raises:
        FrotError: E0804 if it cannot be read, is none, or is another version's.
    """
    from frot.runtime.run_report import Event, Figures

    from frot.model import Model

    try:
        with zipfile.ZipFile(path) as archive:
            found: dict[str, Any] = json.loads(archive.read(_DESCRIPTION))
            state, grid, record = (archive.read(name) for name in (_STATE, _GRID, _RECORD))
        model = Model(*(found["model"][name] for name in ("text", "file", "chosen")))
        kept = found["kept"]
        kept["moving"] = frozenset(kept["moving"])
        kept["options"]["tables"] = tuple(_table(x) for x in kept["options"].get("tables", ()))
        events = tuple(Event(**one) for one in found["events"])
        figures = Figures(**found["figures"])
        schedule, layout = _schedule(found["schedule"]), found["layout"]
    except OSError as error:
        why = error.strerror or str(error)
        raise fail("E0804", f"'{path}' cannot be read: {why}", help="check the path") from None
    except (zipfile.BadZipFile, KeyError, ValueError, TypeError, AttributeError):
        raise fail(
            "E0804",
            f"'{path}' is no saved run, or is damaged",
            help=f"save one by `frot simulate FILE -o NAME{SUFFIX}`",
        ) from None

    def check(program: Program) -> None:
        if _layout(program) != layout:
            raise fail(
                "E0804",
                f"'{path}' was saved by another version of Frot, or what its text imports changed",
                help="run the model again",
            )

    return revive(model, state, schedule, (grid, record), events, figures, kept, check)


def _layout(program: Program) -> str:
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


def _table(entry: dict[str, Any]) -> Table:
    pieces = tuple((a, b, c, d) for a, b, c, d in entry["pieces"])
    return Table(entry["name"], entry["way"], tuple(entry["knots"]), pieces)


def _schedule(found: Any) -> Any:
    """Indices of inputs are numbers again, which JSON has as texts."""
    if found is None:
        return None
    begins, offsets, held = found
    return begins, offsets, [{int(key): x for key, x in one.items()} for one in held]
