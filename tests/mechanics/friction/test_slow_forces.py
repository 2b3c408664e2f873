"""A force that varies slowly on a block at rest: long steps, no motion."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import frot

pytestmark = pytest.mark.finding


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
@pytest.mark.parametrize("scale", [0.5, 500.0])
def test_a_slow_force_on_a_block_at_rest_takes_few_steps(
    finding: Callable[..., frot.Model], scale: float, tolerance: float
) -> None:
    result = finding("slow_forcing").simulate(
        stop=2 * scale, tolerance=tolerance, parameters={"scale": scale}
    )
    assert result.figures.steps < 1000
    assert not result.events
    assert np.all(result["b.position.x"] == 0) and np.all(result["b.velocity.x"] == 0)
    force = np.sin(result.time / scale)
    assert np.abs(result["c.tangential_force"] + force).max() < 1e-12
