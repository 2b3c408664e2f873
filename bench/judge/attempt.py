"""A run within a limit of processor time, with what stopped it."""

from __future__ import annotations

import time

import frot
from judge.family import Setting
from judge.space.scene import END
from judge.verdict import REFUTED, SLOW, Verdict


def attempt(model: frot.Model, setting: Setting, limit: float) -> tuple[frot.Result, str] | Verdict:
    """The result, whole or up to what stopped it, and the code and words of that, "" of nothing.

    A verdict where there is nothing to judge: no start, or more than `limit` seconds.
    """
    deadline = time.process_time() + limit
    late: list[int] = []

    def watch(_: float) -> bool:
        if time.process_time() > deadline:
            late.append(1)
        return bool(late)

    message = ""
    result: frot.Result | None = None
    try:
        every = {**setting.values, END: setting.stop}
        result = model.simulate(tolerance=setting.tolerance, parameters=every, watch=watch)
    except frot.FrotError as error:
        result = error.result if isinstance(error, frot.SimulationError) else None
        message = f"{error.diagnostics[0].code}: {error.diagnostics[0].message}"
    if late:
        reached = "" if result is None else f" {result.time[-1]!r} of {setting.stop!r} s"
        return Verdict(SLOW, [f"more than {limit:g} s:{reached}"])
    if result is None:
        return Verdict(REFUTED, [f"no start: {message}"])
    return result, message
