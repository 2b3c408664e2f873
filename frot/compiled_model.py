"""A text with its programs and their runs: what parts of the interface need of a model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from frot.compiler import find_program, find_toolchain, program_key
from frot.dsl.files.import_scan import imported_files
from frot.dsl.files.reading import read_text
from frot.dsl.messages.diagnostics import Diagnostic, Log
from frot.dsl.messages.errors import FrotError
from frot.dsl.messages.interrupts import DeferredInterrupts

if TYPE_CHECKING:
    from frot.compiler import Toolchain
    from frot.dsl import checked
    from frot.runtime.program import Program
    from frot.runtime.result import Result
    from frot.runtime.tables import Table


class CompiledModel:
    """A checked text, the programs that are made of it, and their runs."""

    def __init__(self, text: str, name: str, model: str | None) -> None:
        """`name` is the file's, for messages; `model` chooses one of several in the text.

        `warnings` are those of the text, reported when it is checked,
        not where it is compiled already.
        """
        self._text, self._file, self._chosen = text, name, model
        self._checked: checked.Model | None = None
        self.warnings: tuple[Diagnostic, ...] = ()
        self._toolchain = find_toolchain()
        self._identity = _identity(text, name)
        self._key = program_key(self._identity, model, self._toolchain)
        self._program: Program | None = self._named(find_program(self._key))

    def __reduce__(self) -> tuple[object, tuple[str, str, str | None]]:
        return type(self), self.source

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name} of {self._file}>"

    @property
    def name(self) -> str:
        """The model's name in the text."""
        if self._program is not None:
            return self._program.name
        return self.checked().name

    def checked(self) -> checked.Model:
        """The checked model; FrotError with every fault of the text."""
        if self._checked is None:
            from frot.dsl import compile_text

            log = Log()
            with DeferredInterrupts():
                checked_model = compile_text(self._text, log, name=self._file, model=self._chosen)
            if checked_model is None or log.failed:
                raise FrotError(log)
            self._checked = checked_model
            self.warnings = tuple(log)
        return self._checked

    def program(self, tell: Callable[[str], None] | None = None) -> Program:
        """The compiled program, from the cache if it is there.

        `tell` is called with what is being done, in words.
        """
        if self._program is None:
            from frot.compiler import build

            log = Log()
            told = () if tell is None else (tell,)
            with DeferredInterrupts():
                built = build(self.checked(), self._file, self._key, self._toolchain, log, *told)
            self._program = self._named(built)
            if self._program is None:
                raise FrotError(log)
        return self._program

    @property
    def source(self) -> tuple[str, str, str | None]:
        """The text, its file, and which of its models was chosen."""
        return self._text, self._file, self._chosen

    @property
    def file(self) -> str:
        """The file's name, as messages give it."""
        return self._file

    @property
    def toolchain(self) -> Toolchain:
        """The C compiler that makes its programs."""
        return self._toolchain

    def key_of(self, tag: str) -> str:
        """The key of another program of the model, which `tag` tells from its own."""
        return program_key(f"{self._identity}\n{tag}", self._chosen, self._toolchain)

    def named(self, program: Program) -> Program:
        """The program with places that read as this model's user names the file."""
        return replace(program, shown=self._file)

    def _named(self, program: Program | None) -> Program | None:
        """The program with places that read as this model's user names the file."""
        return None if program is None else replace(program, shown=self._file)

    def run(self, program: Program, tables: Sequence[Table] = (), **options: Any) -> Result:
        """Run one of its programs with the options of `simulate`; the result knows its model."""
        from frot.runtime import Interrupted, SimulationError, simulate
        from frot.runtime.tables import moving_of

        try:
            result = simulate(program, tables=tables, **options)
        except (SimulationError, Interrupted) as error:
            if error.result is not None:
                error.result.model, error.result.fault = self, _sentence(error)
                error.result.moving = moving_of(tables)
                error.result.options = {**options, "tables": tables, "watch": None}
            raise
        result.model, result.moving = self, moving_of(tables)
        result.options = {**options, "tables": tables, "watch": None}
        return result


def _sentence(error: BaseException) -> str:
    """The cause of the end of a run, in one line."""
    if isinstance(error, FrotError):
        return "; ".join(one.message for one in error.diagnostics)
    return str(error)


def _identity(text: str, name: str) -> str:
    """The text with all that it imports: what a program is made from.

    Not what the text's file is called: places are reported under the name its user gives.
    """
    parts = [text]
    for path in imported_files(text, name):
        content = read_text(path, Log())
        parts += [str(path), content or ""]
    return "\n".join(parts)
