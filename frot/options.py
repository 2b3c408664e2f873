"""The options that several commands share, and the types of their values."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from frot.runtime.result import Result


def add_file(parser: argparse.ArgumentParser, saved: bool = False) -> None:
    """One file; `saved`: or that of a run."""
    more = ", or a .frotrun that `frot simulate -o` wrote" if saved else ""
    parser.add_argument("file", metavar="FILE", help=f"a .frot file{more}")


def saved_run(options: argparse.Namespace, file: str) -> Result | None:
    """The run that a file holds, None of a model; FrotError for options that a run cannot have."""
    from frot.dsl.messages.errors import fail
    from frot.runtime.run_files import is_run_file, load_result

    if file.endswith((".csv", ".json", ".npz")):
        raise fail(
            "E0804",
            f"'{file}' has values alone, and no model",
            help="save the whole run: frot simulate FILE -o NAME.frotrun",
        )
    if not is_run_file(file):
        return None
    names = ("model", "set", "input", "start", "stop", "tolerance", "compare", "no_run")
    given = [f"--{x.replace('_', '-')}" for x in names if getattr(options, x, None)]
    if given:
        raise fail(
            "E0806",
            f"'{file}' is a saved run: {', '.join(given)} cannot change it",
            help="name the .frot file, which is run anew",
        )
    return load_result(file)


def add_model(parser: argparse.ArgumentParser) -> None:
    """Which of its models."""
    parser.add_argument("--model", metavar="NAME", help="which model, if the file holds several")


def add_settings(parser: argparse.ArgumentParser) -> None:
    """Add the options that set parameters and inputs."""
    parser.add_argument(
        "--set",
        default=[],
        action=Settings,
        metavar="NAME=VALUE",
        help="set a parameter, in SI or with a unit: --set mu=0.2 --set 'r=120 mm', or those of "
        "a file: --set @run.toml (repeatable)",
    )
    parser.add_argument(
        "--input",
        action="append",
        default=[],
        type=assignment,
        metavar="NAME=VALUE",
        help="hold an input at a value, or let it follow a column: F=force.csv:push (repeatable)",
    )


def add_run(parser: argparse.ArgumentParser) -> None:
    """Begin, end and steps of a run."""
    parser.add_argument("--start", type=time, metavar="T", help="start time in s")
    parser.add_argument("--stop", type=time, metavar="T", help="stop time in s")
    parser.add_argument(
        "--tolerance", type=number, metavar="X", help="local error, from 1e-14 to 0.1"
    )


class Settings(argparse.Action):
    """`NAME=VALUE`, or `@FILE.toml` with a line for each parameter."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: object,
        option_string: str | None = None,
    ) -> None:
        """Add the settings to those before them."""
        text = str(values)
        try:
            found = read_toml(text[1:]) if text.startswith("@") else [assignment(text)]
        except argparse.ArgumentTypeError as error:
            raise argparse.ArgumentError(self, str(error)) from None
        setattr(namespace, self.dest, [*getattr(namespace, self.dest), *found])


def read_toml(path: str) -> list[tuple[str, object]]:
    """The parameters of a file: numbers, texts with units, arrays; of tables the dotted names."""
    import tomllib

    try:
        with open(path, "rb") as file:
            content = tomllib.load(file)
    except OSError as error:
        raise argparse.ArgumentTypeError(f"'{path}' cannot be read: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise argparse.ArgumentTypeError(f"'{path}' is no TOML: {error}") from None
    return _dotted("", content)


def _dotted(head: str, table: dict[str, object]) -> list[tuple[str, object]]:
    found: list[tuple[str, object]] = []
    for name, value in table.items():
        found += (
            _dotted(f"{head}{name}.", value) if isinstance(value, dict) else [(head + name, value)]
        )
    return found


def assignment(text: str) -> tuple[str, str]:
    """Name and value of `NAME=VALUE`."""
    name, equals, value = text.partition("=")
    if not equals or not name.strip() or not value.strip():
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=VALUE")
    return name.strip(), value.strip()


def number(text: str) -> float:
    """A finite number."""
    import math

    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number") from None
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"'{text}' is not a finite number")
    return value


def time(text: str) -> float:
    """A time in s, or with its unit: `2`, `2 min`."""
    if not (text[:1].isdigit() and text[-1:].isalpha()):
        return number(text)
    from frot.dsl import parse_value
    from frot.dsl.catalogue import TYPES

    try:
        return float(parse_value(text, TYPES["Time"]))  # type: ignore[arg-type]
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def names(text: str) -> list[str]:
    """`NAME,NAME`: a comma in brackets separates nothing."""
    found, depth = [""], 0
    for letter in text:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and depth == 0:
            found.append("")
        else:
            found[-1] += letter
    return [name.strip() for name in found if name.strip()]
