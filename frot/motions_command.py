"""`frot motions`: every admissible motion of a state."""

from __future__ import annotations

import argparse
import json

from frot.options import add_file, add_model, add_settings, time


def add_motions(parser: argparse.ArgumentParser) -> None:
    """The options of the command."""
    add_file(parser)
    add_model(parser)
    add_settings(parser)
    parser.add_argument(
        "--at", type=time, metavar="T", help="time in s of the state of a run (default: the start)"
    )
    parser.add_argument(
        "--nodes", type=int, metavar="N", help="examine so many combinations of modes at most"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def motions(options: argparse.Namespace) -> int:
    """Print the motions; status 0 where there is one at least, 1 at an impasse."""
    from frot.model import load
    from frot.progress import Busy

    model = load(options.file, options.model)
    with Busy(f"compiling {model.name}") as busy:
        found = model.motions(
            options.at,
            parameters=dict(options.set) or None,
            inputs=dict(options.input) or None,
            nodes=options.nodes,
            tell=busy.tell,
        )
    print(json.dumps(found.as_data(), indent=2, allow_nan=False) if options.json else found)
    return 0 if len(found) else 1
