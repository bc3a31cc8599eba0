"""Runs with trust reports of variants whose numbers are patched: judged by the machine as the variant has it, and by its own memory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run.attempt import header_of
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.simulate import close_run
from nivel.analysis.sweep.patched import PatchedRuns, Patches, UnsuitedError, learn, read_values
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
        self._runs = PatchedRuns(found)

    def run(self, machine: Model, values: Mapping[str, Any]) -> Result | None:
        """The run of the machine, which has these values, with its trust report; None where it has to be prepared: it needs another method
        or has another structure, or did not come to its end as it should. Raises ModelError as preparing does."""
        found, blank = self._runs.found, self._runs.blank
        plan, x = plan_run(machine.record, machine.origin.settings_outside), read_values(values)
        if not found.has(x):
            return None
        self._runs.begin(x)
        methods = plan.methods
        prepared = replace(blank.prepared, machine=methods.machine, beams=methods.machine.beams)
        refuse(deep_starts(methods.machine, prepared.absolute, prepared.assembly.y))
        if plan.settings != blank.plan.settings:
            return None
        self._runs.begin(x)
        sink = Memory(plan.settings.frames + 1)
        sink.begin(header_of(plan, prepared, ""))
        finished = march(prepared, plan.settings, [sink], loop=blank.loop)
        if finished.outcome == "failed":
            return None
        return close_run(sink, run_of(plan, prepared, finished, sink.result()), {})


def judged_runs(base: Model, sample: Sequence[Mapping[str, Any]]) -> JudgedRuns | None:
    """Runs of the variants of which these are a sample; None where their numbers follow from the parameters by no formulas."""
    try:
        return JudgedRuns(learn(base, sample, judged=True))
    except UnsuitedError:
        return None
