"""What a thread does not take: friction, and a length by other than time."""

from __future__ import annotations

from frot.compiler.mechanics.liaisons.kinematic_relations import drives_of
from frot.compiler.mechanics.unsupported import refuse
from frot.dsl import Log
from frot.dsl.checked import Liaison


def refuses_thread(liaison: Liaison, log: Log) -> bool:
    """Report friction of a thread, which a rod has in its pins, and a length that is driven."""
    law = next((x for x in liaison.laws if x.kind.name in liaison.kind.laws), None)
    if law is not None:
        refuse(
            log,
            f"friction of '{liaison.name}', a {liaison.kind.title} that can go slack,",
            law.span,
            "leave it out, or write `unilateral = false`",
        )
        return True
    if "length" not in drives_of(liaison):
        return False
    log.report(
        "E0522",
        f"the length of '{liaison.name}', which can go slack, follows other than time",
        liaison.options["length"].span,
        help="write `unilateral = false`: what keeps such a length both pulls and pushes",
    )
    return True
