"""Pictures of a model and of its motion: one page, still pictures, films."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from frot.view.page import page_of
    from frot.view.parts import Scene
    from frot.view.scene import scene_of

_HOMES = {"Scene": "parts", "page_of": "page", "scene_of": "scene"}
__all__ = ["Scene", "page_of", "scene_of"]


def __getattr__(name: str) -> object:
    """Load a part when it is used first."""
    import importlib

    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
