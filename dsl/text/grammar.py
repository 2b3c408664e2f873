"""The LALR tables of `frot.lark`: made once, when Frot is installed or by the first run."""

from __future__ import annotations

import contextlib
import hashlib
import logging
import os
import shutil
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from frot.dsl.text.lex import Lexer
    from lark import Lark

GRAMMAR = Path(__file__).with_name("frot.lark")
MADE = GRAMMAR.with_name("made")
OPTIONS = {
    "parser": "lalr",
    "lexer": "basic",
    "propagate_positions": True,
    "maybe_placeholders": False,
}


def cache_folder() -> Path:
    """`$FROT_CACHE`, else the user's cache directory for Frot."""
    override = os.environ.get("FROT_CACHE")
    if override:
        return Path(override)
    from platformdirs import user_cache_dir

    return Path(user_cache_dir("frot"))


@cache
def grammar() -> Lark:
    """The parser tables: those made when Frot was installed, else in the cache if it can be."""
    import lark

    # Lark logs a traceback for an unreadable cache and then goes on without it.
    lark.logger.setLevel(logging.CRITICAL + 1)
    with contextlib.suppress(OSError):
        made, folder = MADE / _name(), cache_folder()
        if made.is_file():
            return _tables(made)
        folder.mkdir(parents=True, exist_ok=True)
        if os.access(folder, os.W_OK) or (folder / made.name).is_file():
            return _tables(folder / made.name)
    return lark.Lark(GRAMMAR.read_text(encoding="utf-8"), **OPTIONS)


def make_tables(folder: Path) -> None:
    """Write the tables into a folder, alone; OSError if it cannot be written."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    _tables(folder / _name())


def _tables(path: Path) -> Lark:
    """Read from the file, which is written if it is not there or damaged."""
    import lark

    return lark.Lark(GRAMMAR.read_text(encoding="utf-8"), cache=str(path), **OPTIONS)


def _name() -> str:
    """Of a file of tables, by all that they are made from."""
    import lark

    text = GRAMMAR.read_text(encoding="utf-8")
    key = hashlib.sha256(f"{lark.__version__}\n{sorted(OPTIONS.items())}\n{text}".encode())
    return f"grammar-{key.hexdigest()[:16]}.bin"


@cache
def lexer() -> Lexer:
    """The lexer of the grammar's terminals."""
    from frot.dsl.text.lex import Lexer

    return Lexer(grammar())
