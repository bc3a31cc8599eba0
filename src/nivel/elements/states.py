"""First-order states of elements as facts: all that the rest of nivel knows of a pressure, a bristle or a controller's memory."""

from __future__ import annotations

from typing import NamedTuple

from nivel.lazy import dataclass


@dataclass(frozen=True)
class StateFact:
    """One first-order state x of an element.

    name : signal where it has a dot. variable : of the result, default `state.NAME`; units, long_name : of that, SI. start : at t = 0.
    scale : what errors of x are measured by, at least; the largest |x| of the run counts where it is larger and x is `relative`. sampled :
    x has no rate, it changes at given times or events only. integral : nothing depends on x, so that no step and no iteration waits for
    it; on what its rate depends need not be said. follows : x is what a motion has stretched, so that at rest it is what the way to there
    makes of it.
    """

    name: str
    units: str
    long_name: str
    start: float
    scale: float
    sampled: bool = False
    variable: str = ""
    relative: bool = True
    integral: bool = False
    follows: bool = False

    @property
    def result(self) -> str:
        """Name of the result variable."""
        return self.variable or f"state.{self.name}"


class Coupled(NamedTuple):
    """What one element acts on or depends on: bodies, the ground included, and numbers of states."""

    bodies: frozenset[int]
    states: frozenset[int] = frozenset()
