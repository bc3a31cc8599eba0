"""Phases of the evaluation of a circuit: the order in which its families are called.

    begin → volumes → pressures → strokes → (control) → positions → flows → balance

A control may read at once what is sensed: pressures, and positions, speeds and frictions of pistons. It acts on all that follows.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum

from nivel.kernels.record.hook import Family


class Phase(IntEnum):
    """When a family is called.

    BEGIN : sums are set to zero. VOLUMES : what pistons leave open. PRESSURES : of all nodes. STROKES : of pistons, and their end stops.
    POSITIONS : of valves, and settings of pumps. FLOWS : flows, forces and the rates that follow from these. BALANCE : energies and mass.
    """

    BEGIN = 0
    VOLUMES = 1
    PRESSURES = 2
    STROKES = 3
    POSITIONS = 4
    FLOWS = 5
    BALANCE = 6

    @property
    def sensed(self) -> bool:
        """Whether a control may read it at once."""
        return self < Phase.POSITIONS


PHASES: dict[Family, tuple[Phase, int]] = {}
# what adds the slopes of a family to those of `nivel.elements.circuits.tangent`; None: they are none, or slow beside steps
SLOPES: dict[Family, Family | None] = {}


def called(phase: Phase, order: int = 99, *, slow: bool = False) -> Callable[[Family], Family]:
    """Decorator above `@family`: the phase in which it is called, and its order there. slow : steps over circuits need no slopes of it."""

    def state(family: Family) -> Family:
        PHASES[family] = (phase, order)
        if slow:
            SLOPES[family] = None
        return family

    return state


def slopes_of(family: Family) -> Callable[[Family], Family]:
    """Decorator above `@family`: a function that adds the slopes of another one. Special integrators of circuits take machines all of
    whose families have one, or are slow."""

    def state(slopes: Family) -> Family:
        SLOPES[family] = slopes
        return slopes

    return state
