"""A law adds a block of one to three rows to its constraint, bounded by up to three of reaction."""

from __future__ import annotations

from typing import Any

import pytest
from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.laws.elements import link_elements
from frot.compiler.mechanics.laws.law import DryLaw
from frot.compiler.mechanics.laws.law_models import LAW_MODELS
from frot.compiler.mechanics.make_symbols import link_rows
from frot.dsl.catalogue import LAWS
from frot.dsl.checked import Literal
from frot.dsl.messages.source import Source, Span
from frot.dsl.quantities.dimensions import REAL

MU = Literal(0.3, REAL, Span(Source("", ""), 0, 0))


class Bare(Constraint):
    """A constraint of the given numbers of reactions, with these blocks."""

    def __init__(self, reactions: int, *blocks: FrictionBlock) -> None:
        self.count, self.frictions = reactions, blocks

    @property
    def readings(self) -> int:
        return self.count


def block(components: int, **others: Any) -> FrictionBlock:
    return FrictionBlock(MU, MU, components=components, **others)


@pytest.mark.parametrize(("reactions", "components"), [(1, 1), (1, 2), (2, 1), (3, 1), (3, 3)])
def test_rows_of_a_block_follow_those_of_the_reaction(reactions: int, components: int) -> None:
    link = Bare(reactions, block(components))
    first, second = link_rows((Bare(1), link))
    assert first.all == (0,)
    assert second.reaction == tuple(range(1, 1 + reactions))
    assert second.tangent == tuple(range(1 + reactions, 1 + reactions + components))
    elements = link_elements(1, link, second)
    assert tuple(element.row for element in elements) == second.tangent
    assert [(e.part, e.parts) for e in elements] == [(k, components) for k in range(components)]
    for element in elements:
        assert element.bounded_by == second.reaction
        assert element.fixed and not element.rolling


def test_sliding_and_rolling_have_rows_of_their_own() -> None:
    link = Bare(1, block(2), block(2, rolling=True))
    (rows,) = link_rows((link,))
    assert (rows.tangent, rows.rolling) == ((1, 2), (3, 4))
    assert rows.of_laws == ((1, 2), (3, 4))
    elements = link_elements(0, link, rows)
    assert [element.row for element in elements] == [1, 2, 3, 4]
    assert [element.rolling for element in elements] == [False, False, True, True]


@pytest.mark.parametrize("name", [name for name, model in LAW_MODELS.items() if model.is_dry])
def test_the_catalogue_keeps_coefficients_from_being_negative(name: str) -> None:
    model = LAW_MODELS[name]
    assert isinstance(model, DryLaw)
    signs = {a.name: a.sign for a in LAWS[name].arguments}
    assert {signs[x] for x in model.coefficients} == {"nonnegative"}
    below = {a.name: a.not_below for a in LAWS[name].arguments}
    of_motion, of_rest = model.coefficients
    assert of_motion == of_rest or below[of_rest] == of_motion
