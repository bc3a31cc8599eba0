"""Runs with trust reports of variants whose numbers are patched: judged by the machine as the variant has it, and by its own memory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from nivel.analysis.plan.plan import Plan, plan_run
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.run.attempt import header_of
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.simulate import close_run
from nivel.analysis.sweep.patched import Array, Patches, UnsuitedError, blank_of, learn, read_values
from nivel.errors import refuse
from nivel.judge.after.subject import run_of
from nivel.judge.before.refusals import deep_starts
from nivel.model import Model
from nivel.results.memory import Memory
from nivel.results.result import Result


class JudgedRuns:
    """Runs of variants in memory of their own, one after the other. What is no number of the memory is the same in all of them."""

    def __init__(self, found: Patches) -> None:
        """Raises UnsuitedError where the memory cannot be copied."""
        again = found.blank.prepared.again()
        if again is None:
            raise UnsuitedError("its records cannot be copied")
        self._found, self._blank = found, blank_of(found.blank.plan, again, judged=True)
        if any(len(a) != len(b) for a, b in zip(self._blank.pieces, found.start, strict=True)):
            raise UnsuitedError("its memory is laid out otherwise")

    def run(self, machine: Model, values: Mapping[str, Any]) -> Result | None:
        """The run of the machine, which has these values, with its trust report; None where it has to be prepared: it needs another method,
        or did not come to its end as it should. Raises ModelError as preparing does."""
        plan, x = plan_run(machine.record, machine.origin.settings_outside), read_values(values)
        self._found.put(self._blank.pieces, x)
        methods = plan.methods
        prepared = replace(self._blank.prepared, machine=methods.machine, beams=methods.machine.beams)
        refuse(deep_starts(methods.machine, prepared.absolute, prepared.assembly.y))
        if plan.settings != self._blank.plan.settings:
            return None
        return self._run(plan, prepared, x)

    def _run(self, plan: Plan, prepared: Prepared, x: Array) -> Result | None:
        self._found.put(self._blank.pieces, x)
        sink = Memory(plan.settings.frames + 1)
        sink.begin(header_of(plan, prepared, ""))
        finished = march(prepared, plan.settings, [sink], loop=self._blank.loop)
        if finished.outcome == "failed":
            return None
        return close_run(sink, run_of(plan, prepared, finished, sink.result()), {})


def judged_runs(base: Model, sample: Sequence[Mapping[str, Any]]) -> JudgedRuns | None:
    """Runs of the variants of which these are a sample; None where their numbers follow from the parameters by no formulas."""
    try:
        return JudgedRuns(learn(base, sample, judged=True))
    except UnsuitedError:
        return None
