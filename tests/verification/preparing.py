"""A machine ready to run, whatever its settings say about formulation and coordinates."""

from nivel.analysis.plan.plan import methods_of
from nivel.analysis.run import prepared_state


def prepare(machine, formulation="newton-euler", coordinates="absolute"):
    """Where the equations are in these words."""
    return prepared_state.prepare(methods_of(machine, formulation, coordinates))
