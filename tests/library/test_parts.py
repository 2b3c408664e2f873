"""Every part of the library does what its documentation says, against a closed form."""

from __future__ import annotations

import blocks_bench
import electrical_bench
import pytest
import rotational_bench
import sampled_bench
import translational_bench
from reference import Bench

import frot

BENCHES = [
    rotational_bench.BENCH,
    translational_bench.BENCH,
    electrical_bench.BENCH,
    blocks_bench.BENCH,
    sampled_bench.BENCH,
]
_RUNS: dict[str, frot.Result] = {}


def run(bench: Bench) -> frot.Result:
    """One run of a bench, whatever number of its parts are looked at."""
    if bench.text not in _RUNS:
        _RUNS[bench.text] = frot.compile(bench.text).simulate()
    return _RUNS[bench.text]


@pytest.mark.parametrize(
    ("bench", "part"),
    [pytest.param(b, p, id=f"{b.package}.{p}") for b in BENCHES for p in b.references],
)
def test_a_part_follows_its_closed_form(bench: Bench, part: str) -> None:
    result = run(bench)
    for reference in bench.references[part]:
        assert reference.error(result.time, result[reference.variable]) < reference.bound
