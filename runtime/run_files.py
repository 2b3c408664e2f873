"""A run read from a file `.frotrun`."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from frot.dsl.messages.errors import fail
from frot.runtime.kept import revive
from frot.runtime.result import Result
from frot.runtime.run_archive import DESCRIPTION, GRID, RECORD, STATE, layout_of
from frot.runtime.tables import Table

if TYPE_CHECKING:
    from frot.runtime.program import Program

SUFFIX = ".frotrun"


def is_run_file(path: str | Path) -> bool:
    """Whether a path is named as a saved run."""
    return Path(path).suffix.lower() == SUFFIX


def load_result(path: str | Path) -> Result:
    """The run of a file that `result.save("NAME.frotrun")` wrote.

    Raises:
        FrotError: E0804 if it cannot be read, is none, or is another version's.
    """
    from frot.runtime.run_report import Event, Figures

    from frot.model import Model

    try:
        with zipfile.ZipFile(path) as archive:
            found: dict[str, Any] = json.loads(archive.read(DESCRIPTION))
            state, grid, record = (archive.read(name) for name in (STATE, GRID, RECORD))
        model = Model(*(found["model"][name] for name in ("text", "file", "chosen")))
        kept = found["kept"]
        kept["moving"] = frozenset(kept["moving"])
        kept["options"]["tables"] = tuple(_table(x) for x in kept["options"].get("tables", ()))
        events = tuple(
            Event(**{**one, "vector": tuple(one.get("vector", ()))}) for one in found["events"]
        )
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
        if layout_of(program) != layout:
            raise fail(
                "E0804",
                f"'{path}' was saved by another version of Frot, or what its text imports changed",
                help="run the model again",
            )

    return revive(
        Result, model, state, schedule, (grid, record), events, figures, kept=kept, check=check
    )


def _table(entry: dict[str, Any]) -> Table:
    pieces = tuple((a, b, c, d) for a, b, c, d in entry["pieces"])
    return Table(entry["name"], entry["way"], tuple(entry["knots"]), pieces)


def _schedule(found: Any) -> Any:
    """Indices of inputs are numbers again, which JSON has as texts."""
    if found is None:
        return None
    begins, offsets, held = found
    return begins, offsets, [{int(key): x for key, x in one.items()} for one in held]
