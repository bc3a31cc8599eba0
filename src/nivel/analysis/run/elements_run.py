"""A run of the same machine with other elements of its beams, beside it: what the two are apart by is what the elements make wrong."""

from __future__ import annotations

from dataclasses import dataclass, replace

from nivel.analysis.plan.plan import Plan, methods_of
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.second_run import SecondRun, Verified
from nivel.errors import ModelError, SolveError
from nivel.judge.after.other_elements import Compared, Pair, element_errors, other_elements
from nivel.results.result import Result


@dataclass(frozen=True)
class Found:
    """A run with other elements as far as it came; None where it has no frame. why : it did not come to its end."""

    pair: Pair
    verified: Verified | None
    why: str

    def compared(self, result: Result) -> Compared:
        """What follows for a result."""
        other = self.verified.result if self.verified is not None else None
        errors = element_errors(result, other, self.pair.factor) if other is not None else None
        return Compared(pair=self.pair, result=other, errors=errors, why=self.why)


@dataclass(frozen=True)
class ElementsRun:
    """The run of a `pair` in its thread."""

    pair: Pair
    run: SecondRun

    @classmethod
    def beside(cls, second: SecondRun, plan: Plan, limit: float | None) -> ElementsRun | None:
        """Of a plan that has a second run; None where there are no beams. limit [s] : as of `SecondRun`."""
        pair = other_elements(plan.machine)
        if pair is None:
            return None
        methods = methods_of(pair.machine, plan.methods.formulation, plan.methods.coordinates)
        other = replace(plan, machine=pair.machine, methods=methods)
        return cls(pair, SecondRun(other, limit, second, f"{pair.words} elements of beams"))

    def wait(self, listener: Listener) -> Found:
        """What it found."""
        try:
            found = self.run.wait(listener)
        except (ModelError, SolveError) as error:
            return Found(self.pair, None, f"the run cannot start: {error}")
        why = "the run has no state" if found is None else found.ended
        return Found(self.pair, found, why)
