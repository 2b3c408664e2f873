"""A change in a run that cannot be made is told and taken back; with another value it goes on."""

from __future__ import annotations

from pathlib import Path

import pytest
from fmu_host import ERROR, OK, Host, compile_libraries, unpack_library
from frot.runtime import fmi

import frot

FLOOR = """planar model Floor
  parameter Length h = 1 m;
  parameter Real mu = 0.1;
  body b: particle(mass = 2 kg);
  curve floor on ground: line(through = (0 m, h), direction = (1, 0));
  liaison c: contact_ponctuel(b, floor) with coulomb(mu);
  output Length y = b.position.y;
initial
  b.position = (0, 1) m;
  b.velocity = (3, 0) m/s;
  experiment(stop = 10 s);
end Floor;
"""
H, MU, FIRST = 1, 2, 3
CHANGES = {"floor": (H, 1.5, "inside by 0.5 m"), "law": (MU, -0.2, "must not be negative")}


@pytest.fixture(scope="module")
def floors(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[int, Path], bytes]:
    folder = tmp_path_factory.mktemp("floor")
    program = frot.compile(FLOOR).program()
    libraries = {}
    for number in (2, 3):
        archive, version = folder / f"Floor{number}.fmu", f"{number}.0"
        fmi.export(program, archive, version, compile_libraries)
        libraries[number] = unpack_library(archive, version, folder / version)
    return libraries, program.key.encode()


def reference_of(name: str) -> int:
    return FIRST + [v.name for v in frot.compile(FLOOR).program().variables].index(name)


def value(one: Host, name: str) -> float:
    return float(one.get(reference_of(name)))


@pytest.mark.parametrize("change", CHANGES)
def test_the_step_is_refused_and_can_be_made_with_another_value(
    floors: tuple[dict[int, Path], bytes], version: int, change: str
) -> None:
    reference, bad, words = CHANGES[change]
    libraries, token = floors
    one, same = (Host(libraries[version], version, token=token) for _ in range(2))
    for each in (one, same):
        each.start()
        assert each.step(0.0, 1.0) == OK
    old = one.get(reference)
    assert one.set(reference, bad) == OK
    assert one.step(1.0, 1.0) == ERROR
    assert words in one.last
    if version == 3:
        _, ended, early, t = one.answers
        assert (ended, early, t) == (False, False, 1.0)
    assert one.get(reference) == old
    assert one.step(1.0, 1.0) == ERROR
    assert one.set(reference, old) == OK
    for t in (1.0, 2.0):
        assert one.step(t, 1.0) == same.step(t, 1.0) == OK
    for name in ("b.position.x", "b.velocity.x", "y"):
        assert value(one, name) == value(same, name)
    one.free(), same.free()


def test_a_value_that_is_asked_for_tells_the_refusal_once(
    floors: tuple[dict[int, Path], bytes], version: int
) -> None:
    libraries, token = floors
    one = Host(libraries[version], version, token=token)
    one.start()
    assert one.step(0.0, 1.0) == OK
    assert one.set(H, 1.5) == OK
    status, _ = one.try_get(reference_of("y"))
    assert status == ERROR and "refused" in one.last
    assert value(one, "y") == 1.0
    assert one.set(H, 1.0) == OK
    assert one.step(1.0, 1.0) == OK
    one.free()


def test_a_floor_that_is_lowered_lets_the_block_fall(
    floors: tuple[dict[int, Path], bytes], version: int
) -> None:
    libraries, token = floors
    one = Host(libraries[version], version, token=token)
    one.start()
    assert one.step(0.0, 1.0) == OK
    assert one.set(H, -9.0) == OK
    assert one.step(1.0, 1.0) == OK
    assert value(one, "y") == pytest.approx(1 - 9.81 / 2, rel=1e-12)
    one.free()
