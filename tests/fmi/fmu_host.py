"""A bare host for FMUs: calls functions of the library by name and keeps statuses and messages."""

from __future__ import annotations

import ctypes
import subprocess
import zipfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from c_objects import c_objects
from frot.compiler.toolchain.compiler_choice import KERNEL_FLAGS
from frot.compiler.toolchain.objects import only_seen
from frot.runtime import fmi
from frot.runtime.program import ExperimentInfo, ParameterInfo, Program, Unit, VariableInfo

HERE = Path(__file__).parent
OK, WARNING, DISCARD, ERROR = range(4)
MOST_WORK = 20_000

ONE = Unit("1")
METRE = Unit("m", (1, 0, 0, 0, 0, 0, 0, 0), "mm", 1e-3)
NEWTON = Unit("N", (1, 1, -2, 0, 0, 0, 0, 0))
RADIAN = Unit("rad", (0, 0, 0, 0, 0, 0, 0, 1), "deg", 0.017453292519943295)

# Value references of the hand-written model.
TIME, MU, STIFFNESS, X0, MASS, COUNT, PULLED, WEIGHT, PUSH = range(9)
MODE, X, V, REACTION, FRICTION, CLOCK = range(9, 15)


def compile_library(sources: Sequence[Path], include: Sequence[Path], target: Path) -> None:
    """As the program's own library, what is compiled already taken as it is."""
    objects = c_objects(sources, include, KERNEL_FLAGS)
    seen = only_seen(target.parent)
    subprocess.run(["cc", "-shared", "-o", target, *objects, *seen, "-lm"], check=True)


def compile_libraries(
    sources: Sequence[Path], include: Sequence[Path], libraries: Mapping[str, Path]
) -> None:
    """For this machine alone."""
    (target,) = libraries.values()
    compile_library(sources, include, target)


def hand_program(folder: Path) -> Program:
    """The program of hand_model.c."""
    (folder / "model.c").write_bytes((HERE / "hand_model.c").read_bytes())
    stiffness = Unit("N/m", (0, 1, -2, 0, 0, 0, 0, 0))
    mass = Unit("kg", (0, 1, 0, 0, 0, 0, 0, 0))
    speed = Unit("m/s", (1, 0, -1, 0, 0, 0, 0, 0))
    second = Unit("s", (0, 0, 1, 0, 0, 0, 0, 0))
    return Program(
        name="Hand",
        doc="A block on a rough table & a spring: 100 % dry <friction>",
        key="hand-model-key",
        version="0.1.0",
        planar=True,
        parameters=(
            ParameterInfo("mu", "real", ONE, 0.1, "friction coefficient"),
            ParameterInfo("k", "real", stiffness, 9.0, "stiffness"),
            ParameterInfo("x0", "real", METRE, 2.0, "start"),
            ParameterInfo("block.mass", "real", mass, 1.0, ""),
            ParameterInfo("count", "integer", ONE, 3, "a whole number"),
            ParameterInfo("pulled", "boolean", ONE, 1, "whether the spring pulls"),
            ParameterInfo("weight", "real", NEWTON, 0.0, "", dependent=True),
        ),
        inputs=(ParameterInfo("push", "real", NEWTON, 0.0, "force along the table"),),
        variables=(
            VariableInfo("guide.mode", "mode", ONE, "output", "mode"),
            VariableInfo("x", "real", METRE, "output", "position"),
            VariableInfo("block.velocity.x", "real", speed, "local", ""),
            VariableInfo("guide.reaction", "real", NEWTON, "local", ""),
            VariableInfo("guide.friction", "real", NEWTON, "output", ""),
            VariableInfo("clock", "real", second, "local", "time and count"),
        ),
        contacts=("guide",),
        experiment=ExperimentInfo(0.0, 12.0, 1e-10, None, "rest"),
        compiler=("cc",),
        flags=KERNEL_FLAGS,
        folder=folder,
    )


def unpack_library(archive: Path, version: str, folder: Path) -> Path:
    """The shared library of this platform in an FMU."""
    start = fmi.platform_folder(version) + "/"
    with zipfile.ZipFile(archive) as file:
        (name,) = (name for name in file.namelist() if name.startswith(start))
        return Path(file.extract(name, folder))


_LOG2 = ctypes.CFUNCTYPE(None, ctypes.c_void_p, *[ctypes.c_char_p] * 1, ctypes.c_int,
                         *[ctypes.c_char_p] * 3)  # fmt: skip
_UPDATE = ctypes.CFUNCTYPE(
    None,
    *(ctypes.c_void_p, ctypes.c_double, *[ctypes.c_bool] * 4),
    *(ctypes.POINTER(ctypes.c_bool), ctypes.POINTER(ctypes.c_double)),
)
_LOG3 = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, *[ctypes.c_char_p] * 2)
_ALLOCATE = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_size_t, ctypes.c_size_t)
_RELEASE = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
_TYPES = {
    "Real": ctypes.c_double,
    "Integer": ctypes.c_int,
    "Boolean": ctypes.c_int,
    "String": ctypes.c_char_p,
    "Float64": ctypes.c_double,
    "Float32": ctypes.c_float,
    "Int32": ctypes.c_int32,
    "Int64": ctypes.c_int64,
}


class _Callbacks2(ctypes.Structure):
    _fields_ = (
        ("logger", _LOG2),
        ("allocate", _ALLOCATE),
        ("release", _RELEASE),
        ("finished", ctypes.c_void_p),
        ("environment", ctypes.c_void_p),
    )


class Host:
    """One instance. `version` is 2 or 3; `messages` holds (status, category, text) of the log."""

    def __init__(self, library: Path, version: int, **options: Any) -> None:
        self.version = version
        self.library = ctypes.CDLL(str(library))
        self.messages: list[tuple[int, str, str]] = []
        self.allocated: set[int] = set()
        self.instance = self._instantiate(**options)

    def _instantiate(
        self,
        name: bytes | None = b"one",
        token: bytes | None = b"hand-model-key",
        logging: bool = True,
        event_mode: bool = False,
        early: bool = False,
        kind: int = 1,
        allocator: bool = False,
        update: Callable[..., None] | None = None,
        required: Sequence[int] = (),
    ) -> ctypes.c_void_p | None:
        if self.version == 2:
            # Variadic, but called with one argument more: "%s" and the message.
            self._log: Any = _LOG2(
                lambda _env, _name, status, category, form, text: self._keep(
                    status, category, text if form == b"%s" else form
                )
            )
            self._callbacks = _Callbacks2(self._log)
            if allocator:
                self._callbacks.allocate = _ALLOCATE(self._allocate)
                self._callbacks.release = _RELEASE(self._release)
            make = self.library.fmi2Instantiate
            make.restype = ctypes.c_void_p
            callbacks = ctypes.byref(self._callbacks)
            pointer = make(name, kind, token, b"", callbacks, 0, int(logging))
        else:
            self._log = _LOG3(
                lambda _env, status, category, text: self._keep(status, category, text)
            )
            kinds = ("ModelExchange", "CoSimulation")
            make = getattr(self.library, f"fmi3Instantiate{kinds[kind]}")
            make.restype = ctypes.c_void_p
            flags = [ctypes.c_bool(f) for f in (False, logging, event_mode, early)]
            self._update: Any = _UPDATE(update) if update else None
            wanted = (ctypes.c_uint32 * max(len(required), 1))(*required)
            more = (*flags, wanted, ctypes.c_size_t(len(required)), None, self._log, self._update)
            if kind == 0:
                more = (*flags[:2], None, self._log)
            pointer = make(name, token, None, *more)
        return ctypes.c_void_p(pointer) if pointer else None

    def _keep(self, status: int, category: bytes, text: bytes) -> None:
        self.messages.append((status, category.decode(), text.decode()))

    def _allocate(self, count: int, size: int) -> int:
        buffer = ctypes.create_string_buffer(count * size + 16)
        address = ctypes.addressof(buffer) + -ctypes.addressof(buffer) % 16
        self._buffers = {**getattr(self, "_buffers", {}), address: buffer}
        self.allocated.add(address)
        return address

    def _release(self, address: int) -> None:
        self.allocated.remove(address)

    @property
    def last(self) -> str:
        """The text of the last message."""
        return self.messages[-1][2]

    def call(self, name: str, *arguments: Any) -> int:
        """The status of fmi<version><name>(instance, ...)."""
        return int(getattr(self.library, f"fmi{self.version}{name}")(self.instance, *arguments))

    def setup(
        self, start: float = 0.0, stop: float | None = None, tolerance: float | None = None
    ) -> int:
        """Enter the initialization mode with the times of the experiment."""
        flag = ctypes.c_int if self.version == 2 else ctypes.c_bool
        arguments = (
            flag(tolerance is not None),
            ctypes.c_double(tolerance or 0.0),
            ctypes.c_double(start),
            flag(stop is not None),
            ctypes.c_double(stop or 0.0),
        )
        if self.version == 3:
            return self.call("EnterInitializationMode", *arguments)
        status = self.call("SetupExperiment", *arguments)
        return status if status != OK else self.call("EnterInitializationMode")

    def start(self, **options: Any) -> None:
        """Go through the initialization mode without setting anything."""
        assert self.setup(**options) == OK, self.messages
        assert self.call("ExitInitializationMode") == OK, self.messages

    def step(self, t: float, h: float) -> int:
        """One communication step."""
        if self.version == 2:
            return self.call("DoStep", ctypes.c_double(t), ctypes.c_double(h), 1)
        flags = [ctypes.c_bool(True) for _ in range(3)]
        reached = ctypes.c_double(-1.0)
        status = self.call("DoStep", ctypes.c_double(t), ctypes.c_double(h), ctypes.c_bool(True),
                           *map(ctypes.byref, flags), ctypes.byref(reached))  # fmt: skip
        self.answers = (*(flag.value for flag in flags), reached.value)
        return status

    def run(self, t: float, end: float, h: float) -> list[tuple[float, ...]]:
        """Steps from t to the end; the values of all reals and the mode after each."""
        rows = []
        while t < end - 1e-9:
            assert self.step(t, h) == OK, self.messages
            t += h
            rows.append(self.values())
        return rows

    def values(self) -> tuple[float, ...]:
        """Time, x, v, reaction, friction, clock, mode."""
        return (
            *(self.get(r) for r in (TIME, X, V, REACTION, FRICTION, CLOCK)),
            self.get(MODE, self.mode_type),
        )

    @property
    def real(self) -> str:
        """The name of the type of real numbers."""
        return "Real" if self.version == 2 else "Float64"

    @property
    def integer(self) -> str:
        """The name of the type of whole numbers."""
        return "Integer" if self.version == 2 else "Int32"

    @property
    def mode_type(self) -> str:
        """The name of the type that modes are read as."""
        return "Integer" if self.version == 2 else "Int64"

    def _type(self, kind: str) -> Any:
        return ctypes.c_bool if kind == "Boolean" and self.version == 3 else _TYPES[kind]

    def try_get(self, reference: int, kind: str = "") -> tuple[int, Any]:
        """Status and value."""
        kind = kind or self.real
        value = self._type(kind)()
        count = ctypes.c_size_t(1)
        counts = (count,) if self.version == 3 else ()
        vr = (ctypes.c_uint32 * 1)(reference)
        status = self.call(f"Get{kind}", vr, count, ctypes.byref(value), *counts)
        return status, value.value

    def get(self, reference: int, kind: str = "") -> Any:
        """A value that must be readable."""
        status, value = self.try_get(reference, kind)
        assert status == OK, self.messages[-1:]
        return value

    def set(self, reference: int, value: Any, kind: str = "") -> int:
        """The status of setting a value."""
        kind = kind or self.real
        count = ctypes.c_size_t(1)
        counts = (count,) if self.version == 3 else ()
        vr = (ctypes.c_uint32 * 1)(reference)
        holder = (self._type(kind) * 1)(value)
        return self.call(f"Set{kind}", vr, count, holder, *counts)

    def _state(self, function: str) -> str:
        spelled = {"De": "DeSerializeFMUstate", "Size": "SerializedFMUstateSize"}
        name = spelled.get(function, f"{function}FMUstate")
        if self.version == 2:
            return name
        return name.replace("FMUstate", "FMUState").replace("DeSerialize", "Deserialize")

    def save(self) -> ctypes.c_void_p:
        """A new saved state."""
        state = ctypes.c_void_p(None)
        assert self.call(self._state("Get"), ctypes.byref(state)) == OK, self.messages
        return state

    def restore(self, state: ctypes.c_void_p) -> int:
        """Go back to a saved state."""
        return self.call(self._state("Set"), state)

    def drop(self, state: ctypes.c_void_p) -> int:
        """Free a saved state."""
        return self.call(self._state("Free"), ctypes.byref(state))

    def serialize(self, state: ctypes.c_void_p) -> bytes:
        """The bytes of a saved state."""
        size = ctypes.c_size_t()
        assert self.call(self._state("Size"), state, ctypes.byref(size)) == OK
        array = (ctypes.c_uint8 * size.value)()
        assert self.call(self._state("Serialize"), state, array, size) == OK
        return bytes(array)

    def deserialize(self, data: bytes) -> tuple[int, ctypes.c_void_p]:
        """Status and the state made from bytes."""
        state = ctypes.c_void_p(None)
        array = (ctypes.c_uint8 * max(len(data), 1)).from_buffer_copy(data or b"\0")
        size = ctypes.c_size_t(len(data))
        status = self.call(self._state("De"), array, size, ctypes.byref(state))
        return status, state

    def log(self, on: bool, *categories: bytes) -> int:
        """Choose the categories of the log."""
        flag = ctypes.c_int(on) if self.version == 2 else ctypes.c_bool(on)
        names = (ctypes.c_char_p * max(len(categories), 1))(*categories)
        return self.call("SetDebugLogging", flag, ctypes.c_size_t(len(categories)), names)

    def free(self) -> None:
        """End the instance."""
        free = getattr(self.library, f"fmi{self.version}FreeInstance")
        free.restype = None
        free(self.instance)
