"""Ctrl-C while a model is prepared: no library swallows it, and the command ends in one line.

CasADi probes its operands by code of Python, and takes an exception there for an answer.
"""

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import casadi as ca
import pytest
from front_door import HOOP, Shell
from frot.dsl.messages.interrupts import DeferredInterrupts, raise_noted_interrupt
from patience import PATIENCE
from test_interrupt import let_it_work

import frot

ONE_LINE = (
    "interrupted\n",
    "interrupted while compiling 'BackspinHoop'; nothing half made is left\n",
)


@pytest.fixture(autouse=True)
def usual_handler() -> Iterator[None]:
    """What starts the tests may ignore interrupts."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupt() -> None:
    os.kill(os.getpid(), signal.SIGINT)


def swallowing(call: Callable[[], None]) -> bool:
    """Whether the call ended; like CasADi, it takes any exception for an answer."""
    try:
        call()
    except BaseException:
        return False
    return True


def test_an_interrupt_in_a_library_is_raised_between_two_passes() -> None:
    seen: list[str] = []
    with pytest.raises(KeyboardInterrupt), DeferredInterrupts():
        assert swallowing(interrupt)
        seen.append("rest of the pass")
        raise_noted_interrupt()
        seen.append("next pass")
    assert seen == ["rest of the pass"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_an_interrupt_in_the_last_pass_is_raised_at_the_exit() -> None:
    with pytest.raises(KeyboardInterrupt), DeferredInterrupts():
        interrupt()


def test_a_second_interrupt_is_raised_at_once() -> None:
    seen: list[str] = []
    with pytest.raises(KeyboardInterrupt), DeferredInterrupts():
        interrupt()
        seen.append("rest of the pass")
        interrupt()
        seen.append("after the second")
    assert seen == ["rest of the pass"]
    raise_noted_interrupt()  # none is left


def test_an_interrupt_takes_the_place_of_an_error() -> None:
    with pytest.raises(KeyboardInterrupt), DeferredInterrupts():
        interrupt()
        raise ValueError


def test_contexts_may_be_nested() -> None:
    seen: list[str] = []
    with pytest.raises(KeyboardInterrupt), DeferredInterrupts():
        with DeferredInterrupts():
            interrupt()
        seen.append("after the inner one")
    assert seen == ["after the inner one"]


def test_nothing_changes_where_interrupts_do_something_else() -> None:
    def mine(*_: object) -> None:
        pass

    signal.signal(signal.SIGINT, mine)
    with DeferredInterrupts():
        assert signal.getsignal(signal.SIGINT) is mine
    assert signal.getsignal(signal.SIGINT) is mine


def test_in_another_thread_nothing_changes() -> None:
    seen: list[object] = []

    def work() -> None:
        with DeferredInterrupts():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert seen == [signal.default_int_handler]


def test_from_python_a_report_is_interrupted(monkeypatch: pytest.MonkeyPatch) -> None:
    model, shape = frot.load(HOOP), ca.SX.shape
    left = [1]

    def probed(x: ca.SX) -> tuple[int, int]:
        if left[0]:
            left[0] = 0
            interrupt()
        return shape.fget(x)  # type: ignore[no-any-return]

    monkeypatch.setattr(ca.SX, "shape", property(probed))
    with pytest.raises(KeyboardInterrupt):
        model.report()


# The command with an interrupt when CasADi asks for a shape for the nth time.
_PROBED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
import casadi as ca
shape, left = ca.SX.shape.fget, [int(sys.argv.pop(1))]
def probed(x):
    left[0] -= 1
    if left[0] == 0:
        os.kill(os.getpid(), signal.SIGINT)
    return shape(x)
ca.SX.shape = property(probed)
from frot.command_line import main
sys.exit(main())
"""


@pytest.mark.parametrize("count", [1, 10, 40])
@pytest.mark.parametrize("command", ["check", "simulate", "fmu"])
def test_a_command_ends_wherever_casadi_is_interrupted(
    command: str, count: int, shell: Shell, tmp_path: Path
) -> None:
    cache = tmp_path / "cache"
    words = [sys.executable, "-c", _PROBED, count, command, HOOP]
    answer = shell.run(words, FROT_CACHE=cache)
    assert answer.status == 130 and answer.err in ONE_LINE, answer
    assert not list(cache.glob("*/.new-*")) and not list(shell.folder.glob("*.fmu"))


def chain(count: int) -> str:
    """A chain of rods on dry pins, which takes about a second to prepare."""
    rods = [f"  body b{i}: rod(mass = 1 kg, length = 1 m);" for i in range(count)]
    law = "with coulomb(0.2, radius = 10 mm);"
    pins = [f"  liaison p{i}: rotoide(b{i - 1}.tip, b{i}.start) {law}" for i in range(1, count)]
    first = f"  liaison p0: rotoide(ground, b0.start) {law}"
    lines = ["planar model Chain", *rods, first, *pins, "  experiment(stop = 1 s);", "end Chain;"]
    return "\n".join(lines)


@pytest.mark.skipif(sys.platform != "linux", reason="reads the processor time in /proc")
@pytest.mark.parametrize("after", [0.15, 0.3, 0.5])
def test_a_large_model_is_interrupted_while_it_is_prepared(
    after: float, shell: Shell, tmp_path: Path
) -> None:
    (shell.folder / "chain.frot").write_text(chain(40), encoding="utf-8")
    process = shell.start("check", "chain.frot", changes={"FROT_CACHE": tmp_path / "cache"})
    let_it_work(process.pid, after)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out, err) == (130, "", "interrupted\n")
