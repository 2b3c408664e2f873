"""The tables of a model that are not mechanics: values, checks, statements, conditions, blocks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import casadi as ca
from frot.compiler.equations.assembled import Assembled
from frot.compiler.equations.reduced import Reduced
from frot.compiler.lowering.jacobian import alike
from frot.compiler.lowering.lower import Lowered
from frot.compiler.mechanics.variables import Closed, Sense
from frot.compiler.product.c_tables import callable_record, number, place, record, text
from frot.dsl.messages.source import Span

# What is read of a mode, by its owner; of any other the mode itself.
_READS: Mapping[type, str] = {Sense: "FROT_READS_SENSE", Closed: "FROT_READS_CLOSED"}
# The type of C, and the items.
Table = tuple[str, list[str]]


def tables_of(
    lowered: Lowered, defaults: Sequence[float], inputs: Sequence[float]
) -> Mapping[str, Table]:
    """By the names of the fields of `frot_model` that point at them."""
    reduced, system = lowered.reduced, lowered.system
    conditions, events = reduced.conditions, reduced.events
    told = zip(
        *(conditions.texts, conditions.report_rules, conditions.spans, conditions.contacts),
        strict=True,
    )
    return {
        "p_default": ("double", [number(x) for x in defaults]),
        "u_default": ("double", [number(x) for x in inputs]),
        "checks": ("frot_check", [record(x.rule, *_at(x.subject, x.span)) for x in lowered.checks]),
        "carried": (
            "frot_carried",
            [record(text(x.body), *_at(x.by, x.span)) for x in lowered.whole.carried],
        ),
        "statements": (
            "frot_statement",
            [record(*_at(x.text, x.span), text(x.unit)) for x in lowered.initial.statements],
        ),
        "loads": ("frot_load", [record(*_at(x.name, x.span)) for x in reduced.mechanism.forces]),
        "equations": (
            "frot_watched",
            [
                record(*_at(x.origin.text, x.origin.span), text(x.lacks) if x.lacks else "NULL")
                for x in lowered.switches.sources
            ],
        ),
        "vanishings": (
            "frot_vanishing",
            [
                record(text(x.text), text(_where(x.names)), text(place(x.liaison.span)))
                for x in lowered.whole.vanishing
            ],
        ),
        "held": (
            "frot_held",
            [
                record(*_at(x.name, x.span), rank)
                for x, rank in zip(reduced.text.held, lowered.switches.ranks.held, strict=True)
            ],
        ),
        "states": ("frot_load", [record(*x) for x in _states(system)]),
        "position_direct": ("unsigned char", _whole(lowered.initial.direct)),
        "position_kind": ("unsigned char", _whole(lowered.initial.kinds)),
        "position_statement": ("int", _whole(lowered.initial.position_statement)),
        "velocity_statement": ("int", _whole(lowered.initial.velocity_statement)),
        "p_dependent": ("int", _whole(lowered.dependent)),
        "p_type": ("int", [str(_TYPES[p.type.base]) for p in reduced.symbols.parameters]),
        "row_depends": ("unsigned char", _whole(x for row in lowered.row_depends for x in row)),
        "conditions": (
            "frot_condition",
            [record(text(a), b, text(place(c)), d) for a, b, c, d in told],
        ),
        "condition_strict": ("unsigned char", _whole(conditions.strict)),
        "q_speed": ("int", _whole(system.q_speed)),
        "q_alike": ("int", _whole(alike(system))),
        "blocks": ("frot_block", _blocks(lowered)),
        "when_condition": ("int", _whole(events.conditions)),
        "when_rank": ("int", _whole(lowered.switches.ranks.whens)),
        "mode_contact": ("int", _whole(k for k, _ in reduced.variables.modes.of.values())),
        "mode_reads": (
            "unsigned char",
            [_READS.get(type(x), "FROT_READS_MODE") for x in reduced.variables.modes.of],
        ),
        "when_at_start": ("unsigned char", _whole(events.at_start)),
        "outcomes": (
            "frot_outcome",
            [record(x.kind, *_at(x.text, x.span)) for x in events.outcomes],
        ),
        "percussions": ("frot_percussion", _percussions(reduced)),
    }


def _percussions(reduced: Reduced) -> list[str]:
    """Of each percussion the places of `due` and `strike` in the discrete values, its outcome."""
    places = {x.symbol.element_hash(): k for k, x in enumerate(reduced.text.discrete)}
    return [
        record(places[x.due.element_hash()], places[x.strike.element_hash()], x.outcome)
        for x in reduced.events.percussions
    ]


def _at(words: str, span: Span | None) -> tuple[str, str]:
    """A text with the place that it describes."""
    return text(words), text(place(span))


def _whole(values: Iterable[int]) -> list[str]:
    """Whole numbers; Booleans are 1 or 0."""
    return [str(int(x)) for x in values]


def _blocks(lowered: Lowered) -> list[str]:
    return [
        record(
            *(callable_record(f), callable_record(g)),
            *(b.first, b.residual.numel(), int(b.linear), int(b.late), int(b.followed)),
            *_at(b.name, b.span),
        )
        for b, f, g in zip(
            lowered.system.blocks, lowered.switches.blocks, lowered.switches.switching, strict=True
        )
    ]


def _where(names: tuple[str, ...]) -> str:
    """The words for the numbers of a place, with their form."""
    told = ", ".join(f"{name} = %.6g" for name in names)
    return f" at {told}" if told else ""


def state_names(system: Assembled) -> tuple[str, ...]:
    """Of the coordinates and speeds."""
    return tuple(
        symbol.name()
        for x in (system.q, system.v)
        for symbol in (ca.vertsplit(x) if x.numel() else ())
    )


def _states(system: Assembled) -> Iterator[tuple[str, str]]:
    """Names and places of the coordinates and speeds."""
    chains = system.reduced.text.chains
    for x in (system.q, system.v):
        for symbol in ca.vertsplit(x) if x.numel() else ():
            chain, _ = chains.place.get(symbol.element_hash(), (-1, 0))
            span = chains.items[chain].span if chain >= 0 else None
            yield text(symbol.name()), text(place(span) if span is not None else "")


_TYPES = {"real": 0, "integer": 1, "boolean": 2}
