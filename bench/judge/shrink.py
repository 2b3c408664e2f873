"""A failing scene made smaller: whatever can be left out without the same fault going away."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from copy import copy
from dataclasses import replace

import frot
from judge.family import Setting, Structure
from judge.scene import Body, Pin, Scene
from judge.trial import Verdict, try_setting
from judge.write import write


def shrink(structure: Structure, setting: Setting, limit: float) -> tuple[Scene, Verdict]:
    """The smallest scene found with a verdict of the same kind and the same first fault."""
    first = _try(structure.scene, setting, limit)
    assert first is not None
    scene, verdict = structure.scene, first
    again = True
    while again:
        again = False
        for smaller in _without_one(scene):
            found = _try(smaller, setting, limit)
            if found is not None and _alike(found, first):
                scene, verdict, again = smaller, found, True
                break
    return scene, verdict


def _alike(a: Verdict, b: Verdict) -> bool:
    kinds = [[w.split(":")[0].split(" at ")[0] for w in v.why] for v in (a, b)]
    return a.kind == b.kind and bool({*kinds[0][:4]} & {*kinds[1][:1]})


def _try(scene: Scene, setting: Setting, limit: float) -> Verdict | None:
    values = {k: v for k, v in setting.values.items() if k in scene.parameters}
    try:
        model = frot.compile(write(scene))
        return try_setting(
            model, Structure(scene, _draw), replace(setting, values=values), 1, limit
        )
    except (frot.FrotError, KeyError):
        return None


def _draw(_: object) -> Setting:
    raise NotImplementedError


def _without_one(scene: Scene) -> Iterator[Scene]:
    for kind in ("bodies", "contacts", "pins", "forces"):
        if kind == "bodies" and len(scene.bodies) == 1:
            continue
        for item in getattr(scene, kind):
            yield _cleaned(scene, lambda x, item=item: x is not item)
    for i, c in enumerate(scene.contacts):
        for change in ({"mu_s": None}, {"delta": None}, {"mu": None, "mu_s": None}):
            if any(getattr(c, k) is not None for k in change):
                yield _changed(scene, "contacts", i, replace(c, **change))  # type: ignore[arg-type]
    for i, p in enumerate(scene.pins):
        for less in ({"mu_s": None}, {"mu": None, "mu_s": None, "radius": None}):
            if any(getattr(p, k) is not None for k in less):
                yield _changed(scene, "pins", i, replace(p, **less))  # type: ignore[arg-type]
    for i in range(len(scene.told)):
        smaller = copy(scene)
        smaller.told = scene.told[:i] + scene.told[i + 1 :]
        yield smaller


def _changed(scene: Scene, kind: str, at: int, item: object) -> Scene:
    smaller = copy(scene)
    listed = list(getattr(scene, kind))
    old, listed[at] = listed[at], item
    setattr(smaller, kind, listed)
    if isinstance(item, Pin):
        smaller.forces = [replace(f, holder=item) if f.holder is old else f for f in smaller.forces]
    return _cleaned(smaller, lambda _: True)


def _cleaned(scene: Scene, keep: Callable[[object], bool]) -> Scene:
    """What hangs on something left out is left out too, and so are unused parameters."""
    s = copy(scene)
    s.bodies = [b for b in scene.bodies if keep(b)]

    def there(b: Body | None) -> bool:
        return b is None or b in s.bodies

    s.points = [p for p in scene.points if there(p.body)]
    s.lines = [c for c in scene.lines if there(c.owner)]
    s.contacts = [c for c in scene.contacts if keep(c) and there(c.body) and there(c.line.owner)]
    s.pins = [p for p in scene.pins if keep(p) and there(p.a.body) and there(p.b.body)]
    s.forces = [
        f
        for f in scene.forces
        if keep(f)
        and all(there(p.body) for p in f.points)
        and (not isinstance(f.holder, Body) or there(f.holder))
        and (not isinstance(f.holder, Pin) or f.holder in s.pins)
    ]
    joints = {j.name for j in [*s.contacts, *s.pins]}
    s.told = [w for w in scene.told if w in joints]
    gone = {b.name for b in scene.bodies} - {b.name for b in s.bodies}
    gone |= {j.name for j in [*scene.contacts, *scene.pins]} - joints
    s.statements = [
        x
        for x in scene.statements
        if not any(x.replace("guess(", "").startswith(f"{g}.") for g in gone)
    ]
    used = {p.text for f in s.forces for p in f.points}
    used |= {e.text for p in s.pins for e in (p.a, p.b)}
    used |= {c.point.text for c in s.contacts if c.point is not None}
    s.points = [p for p in s.points if p.text in used]
    s.lines = [c for c in s.lines if any(x.line is c for x in s.contacts)]
    text = write(s)
    body = "\n".join(x for x in text.splitlines() if not x.startswith("  parameter"))
    import re

    words = set(re.findall(r"\w+", body))
    s.parameters = {k: v for k, v in scene.parameters.items() if k in words}
    return s
