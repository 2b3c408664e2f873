"""What must hold of a result, whatever made it: relations, laws, momenta, energy.

Sizes: accelerations and reactions follow from the state alone, so they are held to rounding
(`EXACT`); what the integration carries (relations of loops, velocities against the integral of the
accelerations, bounds before an event is located) to `SLACK` times the tolerance of the run.
"""

from __future__ import annotations

import numpy as np

from judge.energies import balance
from judge.impacts import impact_times, judge_impacts
from judge.instants import instant, jump
from judge.integrals import integrals
from judge.seen import Findings, Seen
from judge.sides import recorded_sides
from judge.switches import switch

# Part of a run that stopped within which it had stopped: an instant is known no better.
AT_LAST = 1e-9


class Judge(Seen):
    """A scene with values of its parameters, and a result of it."""

    def examine(
        self,
        rng: np.random.Generator,
        instants: int = 12,
        events: int = 6,
        *,
        stopped: bool = False,
    ) -> Findings:
        """Look at random instants, at events, and over random intervals.

        Of a run that `stopped`, what it did at last, before it knew, is judged with the stop.
        """
        recorded_sides(self)
        begin, end = float(self.result.time[0]), float(self.result.time[-1])
        judge_impacts(self, begin)
        met = impact_times(self.result.events)
        if met and met[0] <= begin:
            return self.found  # speeds before are not told
        if met:  # what lies between later impacts is the same motion from other speeds
            end, stopped = met[0], True
        end -= AT_LAST * (end - begin) if stopped else 0.0
        marks = sorted({e.time for e in self.result.events if begin <= e.time <= end})
        times = [*rng.uniform(begin, end, instants), begin]
        chosen = [marks[int(k)] for k in rng.permutation(len(marks))[:events]]
        times += chosen
        for t in times:
            instant(self, self.clear(float(t), marks, begin, end))
        for t in chosen:
            if t > begin:
                jump(self, float(t))
                switch(self, float(t), self.clear(float(t), marks, begin, end))
        integrals(self, rng, marks, begin, end)
        balance(self, rng, begin, end)
        return self.found

    def clear(self, t: float, marks: list[float], begin: float, end: float) -> float:
        """A little later where a condition switches, so that all agree on its truth.

        A run that stops there tells the motion before: that is looked at a little earlier.
        """
        if not any(
            e.kind == "condition" and abs(e.time - t) <= 1e-12 * abs(t) for e in self.result.events
        ):
            return t
        room = 1e-12 * abs(t)
        after = min([m for m in [*marks, end] if m > t + room], default=None)
        if after is None:
            before = max([m for m in [begin, *marks] if m < t - room], default=t)
            return t - 1e-3 * (t - before)
        return t + 1e-3 * (after - t)
