"""Models that once failed or gave a wrong value, each with what must come out.

A finding is a file `name.frot` of this folder, which opens with one sentence that says what must
hold, and a test that asks for it by `finding("name")` and holds it to a closed form or a converged
reference with a bound. The tests of one subject stand in a file `test_<subject>.py` beside this
one; where a finding has variants (tilted, mirrored, other masses, other tolerances) they are
parameters of its test.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import frot

HERE = Path(__file__).parent
TEXTS = sorted(HERE.glob("*.frot"))
TESTS = "\n".join(path.read_text(encoding="utf-8") for path in sorted(HERE.glob("test_*.py")))


@pytest.mark.parametrize("path", TEXTS, ids=lambda p: p.stem)
def test_a_finding_says_what_must_hold_and_is_asked_for(path: Path) -> None:
    assert path.read_text(encoding="utf-8").startswith("// ")
    assert f'"{path.stem}"' in TESTS


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
