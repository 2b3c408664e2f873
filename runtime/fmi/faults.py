"""What FMPy finds wrong in an FMU, without its search in names that are plainly right."""

from __future__ import annotations

import re

from fmpy import read_model_description
from fmpy.validation import validate_fmu

# A part of a name of FMI's structured grammar (FMI 2.0, 2.2.9) without escapes between quotes.
_PART = r"(?:[A-Za-z_][A-Za-z0-9_]*|'[A-Za-z0-9_ .,:+*/-]+')(?:\[[0-9]+(?:,[0-9]+)*\])?"
_DOTTED = rf"{_PART}(?:\.{_PART})*"
_PLAIN = re.compile(rf"{_DOTTED}|der\({_DOTTED}(?:,[0-9]+)?\)")


def faults_of(path: str) -> list[str]:
    """The faults that FMPy finds in the FMU at `path`.

    FMPy reads each name by a general parser, for 7 ms. It need not where all names are plain.
    """
    try:
        found = read_model_description(path, validate=True, validate_model_structure=True)
    except Exception:
        return list(validate_fmu(path))
    if all(_PLAIN.fullmatch(variable.name) for variable in found.modelVariables):
        return []
    return list(validate_fmu(path))
