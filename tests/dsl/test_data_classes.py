"""Data classes that are made quickly keep the rules of the standard library's."""

from __future__ import annotations

import copy
import dataclasses
import pickle
from collections.abc import Callable
from typing import Any, ClassVar

import pytest
from frot.dsl.data import classes


def _family(made: Any, field: Callable[..., Any]) -> dict[str, Any]:
    """The same three classes, of either kind."""

    @made(frozen=True, slots=True)
    class Place:
        rule: ClassVar[str] = "none"
        x: float
        y: float = 0.0
        label: str = field(default="", compare=False, repr=False)

    @made(slots=True)
    class Body:
        name: str
        places: list[Any] = field(default_factory=list)
        half: float = field(init=False)

        def __post_init__(self) -> None:
            self.half = len(self.name) / 2

    @made(slots=True, eq=False)
    class Wheel(Body):
        radius: float = 1.0

    return {"Place": Place, "Body": Body, "Wheel": Wheel}


OURS = _family(classes.dataclass, classes.field)
THEIRS = _family(dataclasses.dataclass, dataclasses.field)


def _told(action: Callable[[], object]) -> object:
    """What an action gives, or the kind of its error."""
    try:
        return action()
    except (TypeError, AttributeError) as error:
        return type(error)


@pytest.mark.parametrize(
    "action",
    [
        lambda c: repr(c["Place"](1.0, label="no")).rpartition(".")[2],
        lambda c: c["Place"](1.0, label="a") == c["Place"](1.0, label="b"),
        lambda c: c["Place"](1.0) == c["Place"](2.0),
        lambda c: hash(c["Place"](1.0)) == hash(c["Place"](1.0, label="b")),
        lambda c: hash(c["Body"]("a")),
        lambda c: c["Place"](),
        lambda c: c["Place"](1.0, 2.0, "a", 3.0),
        lambda c: c["Place"](1.0, z=2.0),
        lambda c: setattr(c["Place"](1.0), "x", 2.0),
        lambda c: delattr(c["Place"](1.0), "x"),
        lambda c: setattr(c["Body"]("a"), "other", 2.0),
        lambda c: c["Body"]("a").places is c["Body"]("a").places,
        lambda c: c["Body"]("abc", [1]).half,
        lambda c: c["Body"]("abc", half=1),
        lambda c: (c["Wheel"]("abc", [], 2.0).radius, c["Wheel"]("abc").half),
        lambda c: c["Wheel"]("a") == c["Wheel"]("a"),
        lambda c: c["Body"]("a") == c["Body"]("a"),
        lambda c: c["Body"]("a") == c["Wheel"]("a"),
        lambda c: [f.name for f in dataclasses.fields(c["Wheel"])],
        lambda c: dataclasses.asdict(c["Body"]("a", [c["Place"](1.0)])),
        lambda c: dataclasses.replace(c["Place"](1.0), y=3.0).y,
        lambda c: copy.deepcopy(c["Place"](1.0, 2.0)).y,
        lambda c: c["Place"].__match_args__,
        lambda c: c["Place"].rule,
    ],
)
def test_as_in_the_standard_library(action: Callable[[dict[str, Any]], object]) -> None:
    ours = _told(lambda: action(OURS))
    assert ours == _told(lambda: action(THEIRS))


def test_replacing_one_field_keeps_the_others() -> None:
    place = classes.replace(OURS["Place"](1.0, 2.0, "a"), y=3.0)
    assert (place.x, place.y, place.label) == (1.0, 3.0, "a")


def test_values_of_frot_go_through_a_pickle() -> None:
    from frot.runtime.program import Unit

    unit = Unit("m", (1, 0, 0, 0, 0, 0, 0, 0), "mm", 1e-3)
    assert pickle.loads(pickle.dumps(unit)) == unit
