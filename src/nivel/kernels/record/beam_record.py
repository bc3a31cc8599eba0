"""Record of beams of large motion, beside their nodes, which are bodies, and their elements, which are forces."""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.core.arrays import F1, F2, F3, U1, U2


class SharedMass(NamedTuple):
    """Mass that nodes of beams have in common; see `nivel.kernels.bodies.shared_mass`. Without numbers for lumped masses."""

    pair: U2  # (m, 4) bodies a, b, markers with the axes of their sections
    mass: F1  # (m,) [kg]
    moment: F3  # (m, 3, 3) [kg m²] J_ab, axes of a and of b
    turn: F3  # (m, 3, 3) from axes of a to axes of b, unstressed


class PointInertia(NamedTuple):
    """What points of beams in absolute nodal coordinates have in common, beside the mass of the bodies that they are on; see
    `nivel.kernels.residual.point_inertia`. Without numbers for other machines."""

    marker: U2  # (E, 8) points; those without one are NONE
    matrix: F3  # (E, 8, 8) [kg]


class BeamTangent(NamedTuple):
    """Derivatives of elements by hand, for E elements without damping; see `nivel.elements.beams.exact_slopes`.

    A node is plain where nothing but elements of beams takes hold of it: all derivatives with respect to its motion are found here.
    """

    wrench: (
        F2  # (E, 24) force and torque of each element on each of its nodes, global axes, in the state last evaluated
    )
    first: U1  # (1,) number of the first of these elements among all forces
    start: U1  # (E + 1,) the unknowns that move the nodes of each element
    # (·, 4) unknown, body that it moves first, nodes of the element that it moves (bits), node that is plain and turned by it, or NONE
    unknown: U2
    place_start: U1  # (E,) derivatives of the rows of these unknowns with respect to them, row by row, ...
    place: U1  # ... stand here in the matrix
    pair: U2  # (E, 2) pairs of `SharedMass` of each element, from, to
    plain: U2  # (·, 8) body, first of its six unknowns, where the first entry of each of its six rows with respect to them stands
    # work
    S: F2  # (9, 9) stiffness at a point, of (y', ψ, ψ')
    B: F2  # (6, 9) strains for (y', ψ, ψ')
    k: F2  # (18, 18) of the nodes seen from the reference node
    P: F1  # (18,) their forces
    twist: F2  # (·, 24) motion of each node by each unknown: (δx, δθ)
    change: F2  # (4, 6) of the force and the torque on each node
    local: F1  # (36,) motion of nodes seen from the reference node, then forces
    psi: F2  # (4, 3) rotation vectors of the nodes
