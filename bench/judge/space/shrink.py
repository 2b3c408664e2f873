"""A failing mechanism made smaller: what can be left out without the same fault going away."""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from dataclasses import replace

import frot
from judge.family import Setting
from judge.space.scene import SpaceScene
from judge.space.trial import try_mechanism
from judge.verdict import Verdict


def shrink_mechanism(
    scene: SpaceScene, setting: Setting, seed: int, limit: float
) -> tuple[SpaceScene, Verdict | None]:
    """The smallest scene found whose verdict has the same kind and first fault."""
    first = _tried(scene, setting, seed, limit)
    again = first is not None
    while again:
        again = False
        for smaller in _without_one(scene):
            found = _tried(smaller, setting, seed, limit)
            if found and first and found.kind == first.kind and _fault(found) == _fault(first):
                scene, again = smaller, True
                break
    return scene, first


def _fault(v: Verdict) -> str:
    return v.why[0].split(":")[0] if v.why else ""


def _tried(scene: SpaceScene, setting: Setting, seed: int, limit: float) -> Verdict | None:
    values = {k: x for k, x in setting.values.items() if k in scene.parameters or k == "g"}
    try:
        model = frot.compile(scene.text())
        return try_mechanism(model, scene, replace(setting, values=values), seed, limit)
    except (frot.FrotError, KeyError):
        return None


def _without_one(scene: SpaceScene) -> Iterator[SpaceScene]:
    for b in scene.bodies:
        if len(scene.bodies) > 1:
            yield _cleaned(scene, body=b.name)
    for c in scene.links:
        yield _cleaned(scene, link=c.name)
        if c.drive:
            yield _cleaned(scene, drive=c.name)
    for p in scene.pushes:
        yield _cleaned(scene, push=p.name)


def _cleaned(
    scene: SpaceScene, body: str = "", link: str = "", push: str = "", drive: str = ""
) -> SpaceScene:
    """The scene without one thing, and without what hangs on it."""
    s = copy(scene)
    s.bodies = [b for b in scene.bodies if b.name != body]
    there = [None, *s.bodies]
    s.links = [
        replace(c, drive="") if c.name == drive else c
        for c in scene.links
        if c.name != link and c.a.body in there and c.b.body in there
    ]
    s.pushes = [
        p
        for p in scene.pushes
        if p.name != push and p.body in there and all(f.body in there for f in p.frames)
    ]
    used = {f.name for c in s.links for f in (c.a, c.b)}
    used |= {f.name for p in s.pushes for f in p.frames}
    s.frames = [f for f in scene.frames if f.name in used]
    names = used | {x.name for x in (*s.bodies, *s.links, *s.pushes)}
    s.parameters = {k: v for k, v in scene.parameters.items() if k.split("_", 1)[1] in names}
    return s
