"""Record of flexible bodies: floating frames with modes (Rantalainen 2007).

F flexible bodies, m modes in all, n the most of one body (tables are padded with zeros), N frames at their interfaces. Such a frame is a
body to markers, joints and forces: it has a place, axes, velocities and a wrench in `Bodies`, behind the ground.

Inner loops run along modes, which are the last index everywhere; tables of matrices that are multiplied by one vector stand side by side,
row by row: [f n + k, c n + j] has entry k, j of matrix c of body f. Symmetric tensors have the components xx, yy, zz, xy, yz, zx.
"""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.core.arrays import F1, F2, F3, U1, U2, W1, W2, W3

# columns of Flexible.terms
TURNING, BULGING, SHORTENING = 0, 1, 2


class Flexible(NamedTuple):
    """Flexible bodies; all empty where there are none. Modes have unit modal mass; I1 … I9 as in `nivel.flexible.body.invariants`."""

    body: U1  # (F,)
    rigid: U1  # (B,) 1 for the bodies that are not flexible
    mode: U2  # (F, 2) first of its modes, one past the last
    # (F, 3) whether it has TURNING terms, BULGING (those of the inertia, quadratic in the modes) and SHORTENING (geometric stiffening)
    terms: U2
    frame: U2  # (N, 2) flexible body, its number among `Bodies`
    loaded: U1  # (N,) whether loads on the frame stiffen its body
    place_b: F2  # (N, 3) [m] undeformed, axes of the body
    shape: F3  # (N, 6, n) displacement, turn by each mode, axes of the body
    I2: F2  # (F, 3)
    I3: F3  # (F, 3, n)
    I4: F3  # (F, 3, n)
    I5: F2  # (F n, 3 n) antisymmetric
    I7: F3  # (F, 3, 3)
    I8: F3  # (F, 6, n) symmetric part
    stiffness: F2  # (F, n) [1/s²]
    damping: F2  # (F, n) [1/s]
    of_inertia: F2  # (F n, 6 n) I9, its symmetric part, less the stiffening by ω_a ω_b: J̄ has pᵀ K p
    of_coupling: F2  # (F n, 3 n) I5 and the stiffening by angular acceleration: momentum of turning has Σ p_j K_jk ṗ_k
    # geometric stiffening, see `nivel.kernels.bodies.geometric_stiffening`; zero where a body has none
    of_acceleration: F2  # (F n, 3 n) of the frame's origin less gravity, per m/s²
    of_turning: F2  # (F n, 3 n) per rad/s²
    of_load: F2  # (N n, 6 n) per N and N m on the frame at an interface, axes of the body
    block: U2  # (·, 4) block of the saddle, its frame or NONE, its flexible body, first of the blocks for its modes
    # work
    p: W1  # (m,) modal coordinates
    pdot: W1  # (m,)
    pddot: W1  # (m,)
    Q: W1  # (m,) modal forces
    first: W2  # (F, 3) [kg m] I2 + I3 p
    inertia: W3  # (F, 3, 3) [kg m²] about the frame origin, deformed
    coupling: W3  # (F, 6, n) momentum and angular momentum of a modal velocity, axes of the body
    bulge: W2  # (F, 6 n) half of what a mode adds to the inertia, deformed
    velocity_force: W2  # (F, 6) on the frame, axes of the body
    scratch: W2  # (2, 6 n)
    now: W3  # (N, 6, n) what a mode moves and turns the node by, deformed, axes of the body
    node: W2  # (N, 29) motion of the node seen from the body, columns named in `nivel.kernels.bodies.floating_frame`
    displacement: W3  # (N, 3, n) of the node by a mode, global axes
    turn: W3  # (N, 3, n) of its axes, global axes
    bias: W2  # (N, 6) (α, r̈) of the node while no velocity of the body or of a mode changes
    root: F3  # (F, 6, 6) lower Cholesky factor of what is left of the mass matrix without the modes, axes of the body


class ModalTree(NamedTuple):
    """What relative coordinates know of flexible bodies; empty elsewhere. D nodes of the tree, K + X rows in the largest bundle.

    A node of kind MODAL carries a flexible body from the frame at its own interface, by which a joint carries it; a node of kind OUTWARD
    one of its other frames. See `nivel.kernels.tree.flexible_tree`.
    """

    link: U1  # (D,) flexible body of a MODAL node, frame of an OUTWARD one
    carrier: U1  # (F,) the frame by which each flexible body is carried, or NONE
    heavy: U1  # (D,) whether an OUTWARD node carries bodies
    shift: F1  # (m,) added to the mass of the modes, see `nivel.motion.modal_shift`; else zero
    # work
    column: W3  # (F, 6, n) motion (angular, of the origin) of the body for a modal velocity while its carrier is at rest, global axes
    effort: W1  # (m,) modal efforts, rows of the residual
    coupling: (
        F3  # (F, 6, n) angular momentum and momentum of a modal velocity, with all that the body carries, global axes
    )
    factor: F3  # (F, n, n + 6) upper Cholesky factor U of the modal mass, and U⁻ᵀ couplingᵀ
    push: F2  # (6, n)
    load: F2  # (rows of the largest bundle, m) zero between uses
