"""Record of derivatives for linearly implicit steps of machines with circuits, see `nivel.elements.circuits.tangent`."""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.core.arrays import F1, F2, F3, U1, U2


class CircuitTangent(NamedTuple):
    """X states of circuits, in the order of elimination, and C coordinates on which pistons and motors act. Without numbers for other
    methods.

    Columns of slopes: the X states, the C coordinates, their C rates.
    """

    family: U1  # of each family with slopes its number among those of `Elements`; what adds them are the last ones of the hooks
    pistons: U1  # (1,) number of the family of pistons and their end stops, or NONE
    state: U1  # (X,) of each among the states of elements
    unknown: U1  # (states of elements,) number among the X, or NONE
    coordinate: U1  # (C,) of each among the coordinates of the machine
    number: U1  # (coordinates of the machine,) number among the C, or NONE
    signal: U1  # (nodes,) number among the X of a pressure that is a signal, or NONE
    source: U2  # (outputs, 2) of the position of a valve: number among the X, or element that is a poppet without lag, or NONE
    # work
    by_mass: F1  # (nodes,) [Pa/kg] ∂p/∂m
    by_stroke: F2  # (nodes, C) [Pa/m] ∂p/∂s of chambers
    effort: F2  # (C, X + 2 C) slopes of the efforts on the coordinates
    slopes: F2  # (X + C, X + 2 C) of the rates of the states, and of the second derivatives of the coordinates
    direction: F2  # (C, velocities) ∂ṡ/∂v
    response: F2  # (C, velocities) accelerations v̇ for a unit effort
    compliance: F2  # (C, C) second derivatives of the coordinates for unit efforts
    matrix: F3  # (2, X + C, X + C) factors for two lengths of a step
    b: F1  # (X + C,) right-hand side, then solution
    load: F1  # (C,) [N or N m] efforts of the solution
    travel: F2  # (2, C) [m or rad] change of the coordinates in a whole step and in two halves
