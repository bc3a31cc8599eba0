"""A machine made ready to run, in its equilibrium where the run starts from that."""

from __future__ import annotations

from nivel.analysis.plan.plan import Methods
from nivel.analysis.preparation import preparation
from nivel.analysis.preparation.preparation import Prepared


def prepare(methods: Methods) -> Prepared:
    """Build and assemble the machine of these methods and put it into the coordinates of the run.

    Raises ModelError as `nivel.analysis.preparation.preparation.prepare` does; SolveError where there is no equilibrium to start from.
    """
    if methods.machine.simulation.start != "equilibrium":
        return preparation.prepare(methods)
    from nivel.analysis.statics.start import settled  # is imported where it is needed: most runs start as given

    return preparation.prepare(methods, equilibrium=settled)
