"""`frot cache`: the folder of compiled models, its size, and its clearing."""

from __future__ import annotations

from collections.abc import Sequence

from frot.compiler.toolchain.cache_size import (
    Entry,
    bytes_of,
    entries,
    read_limit,
    shown,
    shrink,
    sweep,
    write_limit,
)
from frot.dsl.files.folders import cache_folder


def tell_cache(limit: str | None, clear: bool) -> str:
    """Set a new limit, or remove all, as the options say; then the folder, its size and its limit.

    Raises:
        FrotError: `limit` is no size (E0806), or cannot be noted (E0803).
    """
    cache = cache_folder()
    removed: list[Entry] = []
    if limit is not None:
        _note(bytes_of(limit))
    sweep(cache)
    if clear or limit is not None:
        removed = shrink(cache, 0 if clear else read_limit(cache))
    kept = entries(cache)
    lines = [
        f"folder: {cache}",
        f"size: {shown(_size(kept))} of at most {shown(read_limit(cache))}, {_counted(kept)}",
    ]
    if removed:
        lines.append(f"removed: {shown(_size(removed))}, {_counted(removed)}")
    if clear and kept:
        lines.append("what is in use was kept")
    return "\n".join(lines)


def _note(limit: int) -> None:
    """Note the limit, in a folder that is made if need be."""
    from frot.dsl.messages.errors import fail

    cache = cache_folder()
    try:
        cache.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise fail(
            "E0803",
            f"'{cache}' cannot be written: {error.strerror or error}",
            help="set FROT_CACHE to a folder that can be written",
        ) from None
    write_limit(cache, limit)


def _size(found: Sequence[Entry]) -> int:
    return sum(entry.size for entry in found)


def _counted(found: Sequence[Entry]) -> str:
    models = sum(entry.path.parent.name == "programs" for entry in found)
    return "1 compiled model" if models == 1 else f"{models} compiled models"
