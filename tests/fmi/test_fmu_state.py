"""Saved states: back and forth to the last bit, across instances as bytes, damage refused."""

from __future__ import annotations

import ctypes
import random
from collections.abc import Callable

from fmu_host import ERROR, MU, OK, STIFFNESS, X0, Host, X

Make = Callable[..., Host]


def test_restored_state_continues_bit_for_bit(host: Make) -> None:
    one = host()
    one.start()
    one.run(0.0, 1.3, 0.1)
    t = one.get(0)
    state = one.save()
    expected = one.run(t, t + 4.0, 0.25)
    for _ in range(2):
        assert one.restore(state) == OK
        assert one.run(t, t + 4.0, 0.25) == expected
    assert one.drop(state) == OK
    assert state.value is None


def test_state_holds_what_was_set_and_not_yet_settled(host: Make) -> None:
    one = host()
    one.start()
    one.run(0.0, 1.0, 0.5)
    assert one.set(STIFFNESS, 4.0) == OK
    state = one.save()
    expected = one.run(1.0, 2.0, 0.5)
    assert one.set(STIFFNESS, 25.0) == OK
    one.run(2.0, 3.0, 0.5)
    assert one.restore(state) == OK
    assert one.get(STIFFNESS) == 4.0
    assert one.run(1.0, 2.0, 0.5) == expected


def test_state_before_the_start(host: Make) -> None:
    one = host()
    assert one.set(X0, 1.5) == OK
    state = one.save()
    assert one.setup(start=1.0) == OK
    inside = one.save()
    one.call("ExitInitializationMode")
    first = one.run(1.0, 2.0, 0.5)
    assert one.restore(inside) == OK
    assert one.call("ExitInitializationMode") == OK
    assert one.run(1.0, 2.0, 0.5) == first
    assert one.restore(state) == OK
    one.start(start=1.0)
    assert one.run(1.0, 2.0, 0.5) == first


def test_bytes_carry_a_state_to_another_instance(host: Make) -> None:
    one, two = host(), host()
    assert one.set(MU, 0.2) == OK
    one.start()
    one.run(0.0, 1.0, 0.25)
    data = one.serialize(one.save())
    status, state = two.deserialize(data)
    assert status == OK
    assert two.restore(state) == OK
    assert two.get(MU) == 0.2
    assert two.run(1.0, 4.0, 0.25) == one.run(1.0, 4.0, 0.25)
    assert two.serialize(state) == data


def test_same_instant_same_bytes(host: Make) -> None:
    one, two = host(), host()
    for each in (one, two):
        each.start()
        each.run(0.0, 1.0, 0.25)
    assert one.serialize(one.save()) == two.serialize(two.save())


def test_foreign_handles_are_refused(host: Make) -> None:
    one, two = host(), host()
    state = one.save()
    assert two.restore(state) == ERROR
    assert "not a saved state of this instance" in two.last
    for handle in (None, 1, 0xDEADBEEF):
        wrong = ctypes.c_void_p(handle)
        assert one.restore(wrong) == ERROR
        if handle is not None:
            assert one.drop(wrong) == ERROR
    freed = ctypes.c_void_p(state.value)
    assert one.drop(state) == OK
    assert one.restore(freed) == ERROR


def test_damaged_bytes_are_refused(host: Make) -> None:
    one = host()
    one.start()
    one.run(0.0, 1.0, 0.5)
    data = one.serialize(one.save())
    chance = random.Random(1895)
    for _ in range(300):
        damaged = bytearray(data)
        for _ in range(chance.choice((1, 1, 3, 50))):
            damaged[chance.randrange(len(data))] ^= chance.randrange(1, 256)
        if bytes(damaged) == data:
            continue
        status, state = one.deserialize(bytes(damaged))
        assert status == ERROR
        assert state.value is None
    for size in (0, 1, 16, len(data) - 1):
        assert one.deserialize(data[:size])[0] == ERROR
    assert one.deserialize(data + b"\0")[0] == ERROR
    assert one.deserialize(chance.randbytes(len(data)))[0] == ERROR
    assert "are not a saved state" in one.last
    assert one.deserialize(data)[0] == OK
    assert one.get(X) == one.get(X)


def test_states_left_over_are_freed_with_the_instance(host: Make) -> None:
    one = host()
    one.start()
    for _ in range(5):
        one.save()
