"""A group of bodies moves as it does alone, in any units and in axes turned by right angles.

`bench/groups.py` examines hundreds of random scenes; here are some of them.
"""

from __future__ import annotations

import pytest
from groups import examine

SEED = 1


@pytest.mark.parametrize("number", range(5))
def test_what_nothing_binds_together_moves_as_it_does_alone(number: int) -> None:
    started, faults = examine(SEED, number)
    assert not faults, faults[0]
    assert started > 0
