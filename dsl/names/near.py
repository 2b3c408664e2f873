"""The name that was meant: the one most like a word."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from frot.dsl.catalogue import plain
from frot.dsl.messages.diagnostics import LIMIT, Log
from frot.dsl.messages.source import Span

_CANDIDATES = 2000
# What the same is called elsewhere.
_ELSEWHERE = {
    **dict.fromkeys(("cube", "square", "rectangle", "block", "cuboid"), "box"),
    **dict.fromkeys(("bar", "beam", "stick", "link"), "rod"),
    **dict.fromkeys(("wheel", "circle"), "disc"),
    **dict.fromkeys(("point", "mass", "pointmass", "point_mass"), "particle"),
    **dict.fromkeys(("friction", "dry_friction", "frottement", "dry"), "coulomb"),
    **dict.fromkeys(("hinge", "pin"), "pivot"),
    **dict.fromkeys(("slider", "slide"), "prismatic"),
    **dict.fromkeys(("fixed", "rigid", "clamp"), "weld"),
    **dict.fromkeys(("rope", "cable", "string"), "thread"),
    **dict.fromkeys(("gravity", "force"), "on"),
    **dict.fromkeys(("ball", "ball_joint"), "spherical"),
    **dict.fromkeys(("torsion", "moment"), "couple"),
    "ln": "log",
    "arcsin": "asin",
    "arccos": "acos",
    "arctan": "atan",
    "arctan2": "atan2",
    "sgn": "sign",
    "fabs": "abs",
    "pow": "^",
    "True": "true",
    "False": "false",
    "TRUE": "true",
    "FALSE": "false",
    "PI": "pi",
    "t": "time",
    "derivative": "der",
}


def near(word: str, names: Iterable[str]) -> str:
    """The name most like `word`, accents and capitals apart, or an empty text.

    A name of which the word is the beginning, `freq` of `frequency`, is like it if it is the only
    one.
    """
    names = list(names)
    if _ELSEWHERE.get(word) in names:
        return _ELSEWHERE[word]
    wanted = plain(word).lower()
    begun = [n for n in names if plain(n).lower().startswith(wanted)] if wanted else []
    if len(begun) == 1:
        return begun[0]
    folded: dict[str, str] = {}
    for name in names:
        if abs(len(name) - len(word)) <= 2 + len(word) // 3:
            folded.setdefault(plain(name).lower(), name)
            if len(folded) >= _CANDIDATES:
                break
    close = difflib.get_close_matches(wanted, folded, n=1, cutoff=0.6)
    return folded[close[0]] if close else ""


def unknown_kind(
    what: str,
    word: str,
    known: Iterable[str],
    span: Span,
    log: Log,
    *,
    usable: Iterable[str] = (),
    help: str = "",
) -> None:
    """Report a kind that is none of those `known` (E0202), and list those `usable`, else all."""
    known = list(known)
    note = f"there are: {', '.join(usable or known)}"
    help_text = help or did_you_mean(word, known, log)
    log.report("E0202", f"unknown {what} {word!r}", span, notes=(note,), help=help_text)


def did_you_mean(word: str, names: Iterable[str], log: Log | None = None) -> str:
    """The help text that proposes a name, or an empty text.

    Past the messages that are shown nothing is looked for: in a large model it would take long.
    """
    if log is not None and len(log.diagnostics) > LIMIT:
        return ""
    found = near(word, names)
    return f"did you mean {found!r}?" if found else ""
