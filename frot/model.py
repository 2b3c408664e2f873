"""A model as its user holds it: loaded, run, exported."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from frot.compiled_model import CompiledModel
from frot.dsl.files.reading import read_text
from frot.dsl.messages.diagnostics import Log
from frot.dsl.messages.errors import FrotError, fail
from frot.dsl.messages.interrupts import DeferredInterrupts

if TYPE_CHECKING:
    from frot.compiler.product.dae import Dae
    from frot.compiler.report.report import Report
    from frot.runtime.fmi.check import Checked
    from frot.runtime.listed_motions import Motions
    from frot.runtime.program import Program
    from frot.runtime.result import Result
    from frot.runtime.tables import Table


class Model(CompiledModel):
    """A model of a `.frot` text. Made by `load` or `compile`."""

    def _repr_html_(self) -> str:
        """In a notebook: a picture of the start, and the documentation."""
        from frot.view.show import start_html

        return start_html(self)

    def simulate(
        self,
        *,
        stop: float | str | None = None,
        start: float | str | None = None,
        tolerance: float | str | None = None,
        interval: float | str | None = None,
        parameters: Mapping[str, object] | None = None,
        inputs: Mapping[str, object] | None = None,
        watch: Callable[[float], bool] | None = None,
    ) -> Result:
        """Run the model; see `frot.runtime.run.simulate`. In a notebook long runs show progress.

        Of `inputs` a scalar one may be given over time: by (times, values), (times, values, way)
        with way `held`, `linear` or `cubic`, an array of two columns, a pandas Series, a function
        of time, or the text `FILE.csv:COLUMN`; see docs/inputs.md.
        """
        from frot.progress import shown_in_notebook

        program, constants, tables = self._with_inputs(inputs, start, stop)
        with shown_in_notebook(program, stop, watch) as told:
            return self.run(
                program,
                stop=stop,
                start=start,
                tolerance=tolerance,
                interval=interval,
                parameters=parameters,
                inputs=constants,
                watch=told,
                tables=tables,
            )

    def _with_inputs(
        self,
        inputs: Mapping[str, object] | None,
        start: float | str | None,
        stop: float | str | None,
    ) -> tuple[Program, Mapping[str, object] | None, tuple[Table, ...]]:
        """The program for these inputs, those that are constant, and those over time."""
        if inputs is None or (isinstance(inputs, dict) and not inputs):
            return self.program(), inputs, ()
        from frot.inputs_over_time import driven_program

        return driven_program(self, inputs, start, stop)

    def motions(
        self,
        at: float | str | None = None,
        *,
        parameters: Mapping[str, object] | None = None,
        inputs: Mapping[str, object] | None = None,
        nodes: int | None = None,
        tell: Callable[[str], None] | None = None,
    ) -> Motions:
        """Every admissible motion of the start, or of the state of a run at the time `at`.

        Args:
            at: Time in s, or a text with its unit; None: the start.
            parameters: As for `simulate`.
            inputs: Constant values, as for `simulate`.
            nodes: How many combinations of modes are examined at most.
            tell: Called with what is being done, in words.

        Raises:
            FrotError: As `simulate`; also where the run ends before `at`.
        """
        from frot.runtime.motions import NODES, list_motions
        from frot.second import second_program

        program = second_program(self, "motions", tell=tell, orders=True)
        return list_motions(program, at, parameters, inputs, NODES if nodes is None else nodes)

    def sweep(
        self,
        parameters: Mapping[str, Sequence[object]],
        read: Sequence[str],
        *,
        dask: str = "",
        **options: Any,
    ) -> list[dict[str, object]]:
        """Run all combinations of parameters: a row each, with what was read at the end.

        `error` of a row is empty where its run was good. `dask` is the address of a scheduler; see
        `frot.sweep.sweep`. `pandas.DataFrame(rows)` makes a table of it.
        """
        from frot.sweep import sweep

        return list(sweep(self, parameters, read, dask=dask, **options))

    def view(
        self,
        path: str | Path | None = None,
        *,
        start: float | str | None = None,
        parameters: Mapping[str, object] | None = None,
        inputs: Mapping[str, object] | None = None,
    ) -> Any:
        """A page `.html` or a picture of the start, before any run.

        Without a path the page is shown as that of `Result.view`.
        """
        from frot.view.page import page_of
        from frot.view.show import show_page, start_scene, write_start

        options = {"start": start, "parameters": parameters, "inputs": inputs}
        if path is None:
            return show_page(page_of(start_scene(self, **options)), self.name)
        return write_start(self, Path(path), **options)  # type: ignore[arg-type]

    def report(self) -> Report:
        """Mobility, liaisons, first integrals; `str(report)` is what `frot check` prints."""
        from frot.compiler import make_report

        log = Log()
        with DeferredInterrupts():
            report = make_report(self.checked(), log)
        if report is None:
            raise FrotError(log)
        return report

    def dae(self) -> Dae:
        """The CasADi DAE with its switching and impacts: see docs/dae.md, `frot.compiler.Dae`."""
        from frot.compiler import make_dae
        from frot.runtime.library import load

        log = Log()
        with DeferredInterrupts():
            dae = make_dae(self.checked(), log, lambda: load(str(self.program().library)))
        if dae is None:
            raise FrotError(log)
        return dae

    def export_fmu(
        self,
        path: str | Path,
        fmi: str = "2.0",
        platforms: str | Sequence[str] | None = None,
        arrays: bool = False,
        **about: str,
    ) -> None:
        """Write an FMU for co-simulation and model exchange. `fmi`: "2.0" or "3.0".

        `platforms` are those its libraries are for, as "x86_64-windows": all that can be made, if
        none is given; "native" is this machine's, made in the shortest time and without an icon.
        With `arrays` vectors and matrices of the text are single variables, in FMI 3.0.
        `about` are author, version, licence, copyright and date: see `frot.runtime.fmi.About`.

        Raises:
            FrotError: The file cannot be written, or an option has a bad value.
        """
        from functools import partial

        from frot.compiler import compile_libraries, possible_platforms
        from frot.dsl.files.writing import remedy
        from frot.runtime.fmi import About, InvalidFmuError, check_platforms, export
        from frot.view.icon import icon_of

        chosen = (platforms,) if isinstance(platforms, str) else platforms or possible_platforms()
        fmi = str(fmi)
        if fmi not in ("2.0", "3.0"):
            raise fail("E0806", f"FMI version '{fmi}' is not known", help="choose 2.0 or 3.0")
        if arrays and fmi == "2.0":
            raise fail("E0806", "FMI 2.0 has no arrays", help="choose FMI 3.0, or leave them apart")
        try:
            check_platforms(chosen)
            words = About(**about)
            words.attributes()
        except (ValueError, TypeError) as error:
            raise fail("E0806", str(error)) from None
        target = Path(path)
        try:
            with DeferredInterrupts():
                make = partial(compile_libraries, self._toolchain)
                icon = None if tuple(chosen) == ("native",) else icon_of(self)
                export(self.program(), target, fmi, make, chosen, words, icon, arrays)
        except OSError as error:
            raise fail(
                "E0803",
                f"'{target}' cannot be written: {error.strerror or error}",
                help=remedy(target, error),
            ) from None
        except (ValueError, RuntimeError, InvalidFmuError) as error:
            raise fail("E0807", f"no FMU can be made: {error}") from None

    def check_fmu(self, path: str | Path) -> Checked:
        """Hold an FMU of this model against FMPy's rules and against `simulate`.

        Raises:
            FrotError: The file cannot be read or run, or the model cannot be.
        """
        from frot.runtime.fmi.check import check

        try:
            with DeferredInterrupts():
                return check(self.program(), Path(path), self.simulate)
        except FrotError:
            raise
        except Exception as error:  # FMPy raises what it likes
            raise fail("E0809", f"'{path}' cannot be checked: {error}") from None


def load(path: str | Path, model: str | None = None) -> Model:
    """Read a `.frot` file. `model` chooses one of several models in it.

    Raises:
        FrotError: E0804 if the file cannot be read, and every fault of the text.
    """
    log = Log()
    text = read_text(path, log)
    if text is None:
        raise FrotError(log)
    return _make(text, str(path), model)


def compile(text: str, model: str | None = None) -> Model:
    """A model from a text. `model` chooses one of several models in it.

    Raises:
        FrotError: Every fault of the text.
    """
    return _make(text, "<text>", model)


def _make(text: str, name: str, chosen: str | None) -> Model:
    model = Model(text, name, chosen)
    if model._program is None:
        model.checked()
    return model
