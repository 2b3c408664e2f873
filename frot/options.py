"""The options that several commands share, and the types of their values."""

from __future__ import annotations

import argparse


def add_file(parser: argparse.ArgumentParser) -> None:
    """One file."""
    parser.add_argument("file", metavar="FILE", help="a .frot file")


def add_model(parser: argparse.ArgumentParser) -> None:
    """Which of its models."""
    parser.add_argument("--model", metavar="NAME", help="which model, if the file holds several")


def add_settings(parser: argparse.ArgumentParser) -> None:
    """Parameters and inputs."""
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        type=assignment,
        metavar="NAME=VALUE",
        help="set a parameter, in SI or with a unit: --set mu=0.2 --set 'r=120 mm' (repeatable)",
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


def assignment(text: str) -> tuple[str, str]:
    """`NAME=VALUE`."""
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
