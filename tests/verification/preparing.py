"""A machine ready to run, whatever its settings say about formulation and coordinates."""

from nivel.analysis import preparation
from nivel.analysis.plan import methods_of


def prepare(machine, formulation="newton-euler", coordinates="absolute"):
    """Where the equations are in these words."""
    return preparation.prepare(methods_of(machine, formulation, coordinates))
