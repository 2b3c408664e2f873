"""Ctrl-C while a model is prepared: it is lost in no library, and the command ends at once.

CasADi asks operands for their shape by code of Python, and takes an exception there for an answer.
"""

import ast
import importlib
import inspect
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import casadi as ca
import fmpy.validation
import pytest
from front_door import HOOP, Shell
from patience import PATIENCE
from test_interrupt import let_it_work

import frot
from frot import interrupts
from frot.interrupts import Interrupts

ONE_LINE = (
    "interrupted\n",
    "interrupted while compiling 'BackspinHoop'; nothing half made is left\n",
)


@pytest.fixture(autouse=True)
def usual_handler(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """What starts the tests may ignore interrupts; functions of this file are not a library's."""
    monkeypatch.setattr(interrupts, "_SAFE", {*interrupts._SAFE, __name__})
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupt() -> None:
    os.kill(os.getpid(), signal.SIGINT)


def library(text: str, **names: object) -> dict[str, object]:
    """The names that a module of some library defines."""
    space: dict[str, object] = {"__name__": "somebody.library", "interrupt": interrupt, **names}
    exec(compile(text, "library.py", "exec"), space)
    return space


LOSING = """
def ask(what=interrupt):
    try:
        what()
        seen.append("went on")
    except KeyboardInterrupt:
        seen.append("lost")
"""


def losing(seen: list[str]) -> Callable[..., None]:
    return library(LOSING, seen=seen)["ask"]  # type: ignore[return-value]


def test_an_interrupt_in_a_library_is_raised_where_its_caller_goes_on() -> None:
    seen: list[str] = []
    ask = losing(seen)
    with pytest.raises(KeyboardInterrupt), Interrupts():
        ask()
        seen.append("the next line")
    assert seen == ["went on"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert sys.gettrace() is None


def test_code_that_the_library_calls_is_no_place_to_raise_it() -> None:
    seen: list[str] = []
    ask = losing(seen)
    with pytest.raises(KeyboardInterrupt), Interrupts():
        ask(lambda: ask(interrupt))
        seen.append("the next line")
    assert seen == ["went on", "went on"]


def test_a_loop_over_a_library_on_one_line_is_left() -> None:
    seen: list[str] = []
    ask = losing(seen)
    with pytest.raises(KeyboardInterrupt), Interrupts():
        [ask() for _ in range(1000)]
    assert len(seen) < 3


def test_what_is_being_loaded_is_loaded_whole(tmp_path: Path) -> None:
    (tmp_path / "loaded_whole.py").write_text(
        "import os, signal\nos.kill(os.getpid(), signal.SIGINT)\nwhole = True\n"
    )
    sys.path.insert(0, str(tmp_path))
    seen: list[str] = []
    try:
        with pytest.raises(KeyboardInterrupt), Interrupts():
            importlib.import_module("loaded_whole")
            seen.append("the next line")
        assert sys.modules["loaded_whole"].whole and not seen
    finally:
        sys.path.remove(str(tmp_path))
        sys.modules.pop("loaded_whole", None)
    assert "loaded_whole" not in sys.modules


def test_an_interrupt_while_an_object_goes_is_not_lost() -> None:
    class Going:
        def __del__(self) -> None:
            interrupt()

    seen: list[str] = []
    with pytest.raises(KeyboardInterrupt), Interrupts():
        Going()
        seen.append("the next line")
    assert not seen


def test_a_second_one_does_not_hinder_what_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    ended: list[str] = []

    def end() -> None:
        try:
            interrupt()
        finally:
            interrupt()
            ended.append("whole")

    with pytest.raises(KeyboardInterrupt), Interrupts():
        end()
    assert ended == ["whole"]
    monkeypatch.setattr(interrupts, "_CALM", 0.0)
    with pytest.raises(KeyboardInterrupt), Interrupts():
        end()
    assert ended == ["whole"]


def test_nothing_changes_where_interrupts_do_something_else() -> None:
    def mine(*_: object) -> None:
        pass

    signal.signal(signal.SIGINT, mine)
    with Interrupts():
        assert signal.getsignal(signal.SIGINT) is mine
    assert signal.getsignal(signal.SIGINT) is mine


def test_in_another_thread_nothing_changes() -> None:
    seen: list[object] = []

    def work() -> None:
        with Interrupts():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert seen == [signal.default_int_handler]


def test_from_python_a_report_is_interrupted(monkeypatch: pytest.MonkeyPatch) -> None:
    model, shape = frot.load(HOOP), ca.SX.shape

    def asked(x: ca.SX) -> tuple[int, int]:
        interrupt()
        return shape.fget(x)  # type: ignore[no-any-return]

    monkeypatch.setattr(ca.SX, "shape", property(asked))
    with pytest.raises(KeyboardInterrupt):
        model.report()


# The command with an interrupt when CasADi asks for a shape for the nth time.
_ASKED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
import casadi as ca
import fmpy.validation
shape, left = ca.SX.shape.fget, [int(sys.argv.pop(1))]
def asked(x):
    left[0] -= 1
    if left[0] == 0:
        os.kill(os.getpid(), signal.SIGINT)
    return shape(x)
ca.SX.shape = property(asked)
from frot.command_line import main
sys.exit(main())
"""


@pytest.mark.parametrize("count", [1, 10, 40])
@pytest.mark.parametrize("command", ["check", "simulate", "fmu"])
def test_a_command_ends_at_any_question_of_casadi(
    command: str, count: int, shell: Shell, tmp_path: Path
) -> None:
    cache = tmp_path / "cache"
    words = [sys.executable, "-c", _ASKED, count, command, HOOP]
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


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
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


def test_where_fmpy_catches_everything() -> None:
    """`except:` in a function that goes by another name would lose an interrupt."""
    catching = {
        function.name
        for function in ast.walk(ast.parse(inspect.getsource(fmpy.validation)))
        if isinstance(function, ast.FunctionDef)
        for node in ast.walk(function)
        if isinstance(node, ast.ExceptHandler) and node.type is None
    }
    assert catching == interrupts._CATCHING
