"""Data classes made in microseconds, where `dataclasses` takes a millisecond for each.

The standard library writes and compiles six functions for each class when its module is loaded. For
the three hundred of Frot that is 0.15 s of the 1.25 in which a first run loads its modules. Here
what compares, prints, copies and refuses to be changed is shared by all of them, and `__init__` is
written at the first object.

The rules are those of `dataclasses` for the options that there are. Annotations must be texts, as
`from __future__ import annotations` makes them. `fields`, `asdict`, `replace` and `is_dataclass` of
the standard library know these classes.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from operator import attrgetter
from reprlib import recursive_repr
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

Made = TypeVar("Made")
_MISSING = object()


class Field:
    """A field of a class: its default, how one is made, and what it takes part in."""

    __slots__ = ("annotation", "compare", "default", "factory", "init", "repr")

    def __init__(
        self, default: Any, factory: Any, init: bool = True, repr: bool = True, compare: bool = True
    ) -> None:
        """`default` and `factory` are _MISSING where there is none."""
        self.default, self.factory = default, factory
        self.init, self.repr, self.compare = init, repr, compare
        self.annotation = ""


def _field(
    *,
    default: Any = _MISSING,
    default_factory: Any = _MISSING,
    init: bool = True,
    repr: bool = True,
    compare: bool = True,
) -> Field:
    """What a plain default cannot say of a field."""
    return Field(default, default_factory, init, repr, compare)


def _dataclass(
    *, frozen: bool = False, slots: bool = False, eq: bool = True, repr: bool = True
) -> Callable[[type[Made]], type[Made]]:
    """Make a class that holds the fields annotated in it; see `dataclasses.dataclass`."""

    def make(cls: type[Made]) -> type[Made]:
        inherited: dict[str, Field] = getattr(cls, "__fields__", {})
        own = {
            name: _field_of(vars(cls).get(name, _MISSING), text)
            for name, text in cls.__annotations__.items()
            if not text.startswith("ClassVar")
        }
        if slots:
            cls = _with_slots(cls, set(own), [name for name in own if name not in inherited])
        else:
            for name, one in own.items():
                if one.default is not _MISSING:
                    setattr(cls, name, one.default)
                elif name in vars(cls):
                    delattr(cls, name)
        every = {**inherited, **own}
        given: dict[str, Any] = {
            "__fields__": every,
            "__dataclass_fields__": _DESCRIBED,
            "__match_args__": tuple(name for name, one in every.items() if one.init),
            "__init__": _first_init(cls, frozen),
        }
        if repr:
            given["__repr__"] = _repr
        if eq:
            given |= _comparing(every, frozen)
        if frozen:
            given |= {"__setattr__": _refuse, "__delattr__": _refuse}
            if slots:
                given |= {"__getstate__": _state, "__setstate__": _set_state}
        written = vars(cls)
        for name, value in given.items():
            if name not in written or name in ("__init__", "__match_args__"):
                setattr(cls, name, value)
        return cls

    return make


def _replace(value: Made, /, **changes: Any) -> Made:
    """A value like this one but for the changes."""
    every: dict[str, Field] = value.__fields__  # type: ignore[attr-defined]
    for name, one in every.items():
        if one.init and name not in changes:
            changes[name] = getattr(value, name)
    return type(value)(**changes)


def _field_of(written: Any, annotation: str) -> Field:
    """The field of what stands behind its name in the class."""
    made = written if isinstance(written, Field) else Field(written, _MISSING)
    made.annotation = annotation
    return made


def _with_slots(cls: type[Made], own: set[str], new: list[str]) -> type[Made]:
    """The class again, for slots cannot be given to one that is made."""
    left_out = {*own, "__dict__", "__weakref__"}
    content = {name: value for name, value in vars(cls).items() if name not in left_out}
    content["__slots__"] = tuple(new)
    kind: Any = type(cls)
    made: type[Made] = kind(cls.__name__, cls.__bases__, content)
    made.__qualname__ = cls.__qualname__
    return made


def _first_init(cls: type, frozen: bool) -> Callable[..., None]:
    """The `__init__` of a class until its first object: it puts the real one in its place."""

    def __init__(self: object, *given: Any, **named: Any) -> None:
        cls.__init__ = _written_init(cls, frozen)  # type: ignore[misc]
        cls.__init__(self, *given, **named)  # type: ignore[misc]

    return __init__


def _written_init(cls: type, frozen: bool) -> Callable[..., None]:
    """The `__init__` of a class: arguments in the order of the fields, defaults made anew."""
    every: dict[str, Field] = cls.__fields__  # type: ignore[attr-defined]
    scope: dict[str, Any] = {"_set": object.__setattr__, "_MISSING": _MISSING}
    arguments, body = ["self"], []
    for name, one in every.items():
        value = name
        if one.factory is not _MISSING:
            scope[f"_make_{name}"] = one.factory
            value = f"_make_{name}()"
            if one.init:
                arguments.append(f"{name}=_MISSING")
                value = f"{value} if {name} is _MISSING else {name}"
        elif one.default is not _MISSING:
            scope[f"_default_{name}"] = one.default
            if one.init:
                arguments.append(f"{name}=_default_{name}")
            else:
                value = f"_default_{name}"
        elif one.init:
            arguments.append(name)
        else:
            continue
        body.append(f"_set(self, '{name}', {value})" if frozen else f"self.{name} = {value}")
    if hasattr(cls, "__post_init__"):
        body.append("self.__post_init__()")
    lines = "\n ".join(body or ["pass"])
    exec(f"def __init__({', '.join(arguments)}):\n {lines}", scope)
    made: Callable[..., None] = scope["__init__"]
    made.__qualname__ = f"{cls.__qualname__}.__init__"
    return made


def _comparing(every: dict[str, Field], frozen: bool) -> dict[str, Any]:
    """Objects of one class are equal where their fields are; only what is frozen has a hash."""
    names = [name for name, one in every.items() if one.compare]
    if names:
        values: Callable[[object], Any] = attrgetter(*names)
    else:

        def values(one: object) -> Any:
            return ()

    def __eq__(self: object, other: object) -> bool:
        return bool(values(self) == values(other)) if type(self) is type(other) else NotImplemented

    def __hash__(self: object) -> int:
        return hash(values(self))

    return {"__eq__": __eq__, "__hash__": __hash__ if frozen else None}


@recursive_repr()
def _repr(self: Any) -> str:
    every: dict[str, Field] = self.__fields__
    shown = (f"{name}={getattr(self, name)!r}" for name, one in every.items() if one.repr)
    return f"{type(self).__qualname__}({', '.join(shown)})"


def _refuse(self: object, name: str, *_: object) -> NoReturn:
    from dataclasses import FrozenInstanceError

    raise FrozenInstanceError(f"field '{name}' of '{type(self).__qualname__}' cannot be changed")


def _state(self: Any) -> list[Any]:
    return [getattr(self, name) for name in self.__fields__]


def _set_state(self: Any, state: list[Any]) -> None:
    for name, value in zip(self.__fields__, state, strict=True):
        object.__setattr__(self, name, value)


class _Described:
    """The fields of a class as the standard library describes them, made when it asks."""

    def __get__(self, _: object, owner: type) -> dict[str, Any]:
        return _description(owner)


_DESCRIBED = _Described()


@functools.cache
def _description(cls: type) -> dict[str, Any]:
    import dataclasses

    def of(one: Field) -> Any:
        options: dict[str, Any] = {"init": one.init, "repr": one.repr, "compare": one.compare}
        if one.default is not _MISSING:
            options["default"] = one.default
        if one.factory is not _MISSING:
            options["default_factory"] = one.factory
        return dataclasses.field(**options)

    every: dict[str, Field] = cls.__fields__  # type: ignore[attr-defined]
    known = [(name, one.annotation, of(one)) for name, one in every.items()]
    made = dataclasses.make_dataclass(cls.__name__, known)
    fields: dict[str, Any] = made.__dataclass_fields__  # type: ignore[attr-defined]
    return fields


if TYPE_CHECKING:
    # Type checkers know these.
    from dataclasses import dataclass, field, replace
else:
    dataclass, field, replace = _dataclass, _field, _replace

__all__ = ["dataclass", "field", "replace"]
