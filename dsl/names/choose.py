"""Which of the definitions of a file is the model."""

from __future__ import annotations

from frot.dsl.messages.diagnostics import Label, Log
from frot.dsl.names.near import did_you_mean
from frot.dsl.text import tree
from frot.dsl.text.tree_names import children

FLANGES = {"RotationalFlange", "TranslationalFlange"}
_NESTED = 50


def choose(file: tree.Tree, name: str | None, log: Log) -> tree.Definition | None:
    """The model named, or the only one that is not a part of another; None after a message."""
    definitions = [e for e in file.elements if isinstance(e, tree.Definition)]
    models = [d for d in definitions if d.kind == "model"]
    whole = [d for d in models if not d.has("partial")]
    first: dict[str, tree.Definition] = {}
    for definition in definitions:
        other = first.setdefault(definition.name.text, definition)
        if other is not definition:
            message = f"the name {definition.name.text!r} is defined twice"
            labels = (Label(other.name.span, "first here"),)
            log.report("E0502", message, definition.name.span, labels=labels)
            return None
    if name is not None:
        return _named(file, name, models, whole, log)
    if not whole:
        if not (file.lost or log.failed):
            _tell_no_model(file, definitions, models, log)
        return None
    used = set().union(*(_types_used(d) - {d.name.text} for d in definitions))
    free = [d for d in whole if d.name.text not in used]
    if len(free) == 1:
        return free[0]
    if len(whole) == 1:
        return whole[0]
    candidates = free or whole
    by_name = {d.name.text: d for d in definitions}
    # What has connectors is a part of something else.
    complete = [d for d in candidates if not _has_connectors(d, by_name)]
    if len(complete) == 1:
        return complete[0]
    candidates = complete or candidates
    if file.lost or log.failed:
        # What uses the others may stand in what could not be read.
        return candidates[-1]
    names = ", ".join(d.name.text for d in candidates)
    log.report(
        "E0510",
        f"the text holds several models: {names}",
        candidates[-1].header,
        labels=tuple(Label(d.header, "one") for d in candidates[:-1]),
        help=f"name the one to use: --model {candidates[-1].name.text}, or model= in Python",
    )
    return None


def _tell_no_model(
    file: tree.Tree,
    definitions: list[tree.Definition],
    models: list[tree.Definition],
    log: Log,
) -> None:
    """Report a text without a model that can be run: a library, bases alone, nothing."""
    packages = [d for d in definitions if d.kind == "package"]
    if packages:
        name = packages[0].name.text
        message = f"{name!r} is a package: it holds parts of models, and none that can be run"
        help_text = f"run a model that uses it, with 'import {name}.*;'"
        log.report("E0509", message, packages[0].header, help=help_text)
        return
    message = "the text holds no model that can be run" if models else "there is no model"
    start = models[0].header if models else file.span
    log.report("E0509", message, start, help="write 'planar model Name ... end Name;'")


def _named(
    file: tree.Tree,
    name: str,
    models: list[tree.Definition],
    whole: list[tree.Definition],
    log: Log,
) -> tree.Definition | None:
    found = next((d for d in whole if d.name.text == name), None)
    if found is not None:
        return found
    partial = next((d for d in models if d.name.text == name), None)
    if partial is not None:
        log.report("E0509", f"{name!r} is partial: it is only a base of others", partial.header)
        return None
    names = [d.name.text for d in whole]
    help_text = did_you_mean(name, names)
    notes = (f"there are: {', '.join(names)}",) if names else ()
    log.report("E0207", f"no model {name!r} in the text", file.span, notes=notes, help=help_text)
    return None


def _has_connectors(
    definition: tree.Definition, by_name: dict[str, tree.Definition], depth: int = 0
) -> bool:
    """Whether a model, or a base of it, declares connectors."""
    for element in definition.elements:
        if isinstance(element, tree.Component):
            heads = _heads(element.type)
            kinds = {by_name[h].kind for h in heads if h in by_name}
            if "connector" in kinds or heads & FLANGES:
                return True
        elif isinstance(element, tree.Extends) and depth < _NESTED:
            bases = [by_name[h] for h in _heads(element.base) if h in by_name]
            if any(_has_connectors(b, by_name, depth + 1) for b in bases):
                return True
    return False


def _types_used(definition: tree.Definition) -> set[str]:
    """The names of types of components and of bases."""
    used: set[str] = set()
    for element in definition.elements:
        if isinstance(element, tree.Component):
            used |= _heads(element.type)
        elif isinstance(element, tree.Extends):
            used |= _heads(element.base)
    return used


def _heads(root: tree.Expression) -> set[str]:
    pending = [root]
    found = set()
    while pending:
        node = pending.pop()
        if isinstance(node, tree.Name):
            found.add(node.text)
        pending.extend(children(node))
    return found
