"""The icon of a model: a small picture of its start, without words."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from frot.dsl.messages.errors import FrotError
from frot.view.picture import Picture

if TYPE_CHECKING:
    from frot.compiled_model import CompiledModel

SIZE = (2.56, 1.92)  # inches, of 100 dots


def icon_of(model: CompiledModel) -> bytes | None:
    """A picture `.png`; None where there are no bodies, or no start to draw."""
    from frot.view.show import start_scene

    if not model.checked().bodies:
        return None
    try:
        scene = start_scene(model)
    except FrotError:
        return None
    figure = Picture(scene, *SIZE).draw(0)
    for words in figure.axes[0].texts:
        words.set_visible(False)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=100, transparent=True, metadata={"Software": None})
    return buffer.getvalue()
