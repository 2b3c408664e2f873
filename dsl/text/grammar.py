"""The LALR tables of `frot.lark`, from the cache of an earlier run where there is one."""

from __future__ import annotations

import contextlib
import hashlib
import logging
import os
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from frot.dsl.text.lex import Lexer
    from lark import Lark

GRAMMAR = Path(__file__).with_name("frot.lark")
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
    """The parser tables; read from and written to the cache if it can be."""
    import lark

    text = GRAMMAR.read_text(encoding="utf-8")
    # Lark logs a traceback for an unreadable cache and then goes on without it.
    lark.logger.setLevel(logging.CRITICAL + 1)
    with contextlib.suppress(OSError):
        folder = cache_folder()
        folder.mkdir(parents=True, exist_ok=True)
        key = hashlib.sha256(f"{lark.__version__}\n{sorted(OPTIONS.items())}\n{text}".encode())
        path = folder / f"grammar-{key.hexdigest()[:16]}.bin"
        if os.access(folder, os.W_OK) or path.is_file():
            return lark.Lark(text, cache=str(path), **OPTIONS)
    return lark.Lark(text, **OPTIONS)


@cache
def lexer() -> Lexer:
    """The lexer of the grammar's terminals."""
    from frot.dsl.text.lex import Lexer

    return Lexer(grammar())
