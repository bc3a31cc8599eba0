"""A machine made ready to run, in its equilibrium where the run starts from that."""

from __future__ import annotations

from nivel.analysis.plan.plan import Methods
from nivel.analysis.preparation import preparation
from nivel.analysis.preparation.preparation import Prepared
from nivel.lazy import nivel


def prepare(methods: Methods) -> Prepared:
    """Build and assemble the machine of these methods and put it into the coordinates of the run.

    Raises ModelError as `nivel.analysis.preparation.preparation.prepare` does; SolveError where there is no equilibrium to start from.
    """
    if methods.machine.simulation.start != "equilibrium":
        return preparation.prepare(methods)
    return preparation.prepare(methods, equilibrium=nivel.analysis.statics.start.settled)
