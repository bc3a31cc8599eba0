"""What flexible bodies add to a machine in numbers: floating frames with modes (Rantalainen 2007).

F flexible bodies, m modes in all, n the most of one body (tables are padded with zeros), N frames at their interfaces. Such a frame is a
body to markers, joints and forces: it has a place, axes, velocities and a wrench in `Bodies`, behind the ground.
"""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.arrays import F2, F3, U1, U2, W1, W2, W3


class Flexible(NamedTuple):
    """Flexible bodies; all empty where there are none. Modes have unit modal mass; invariants I1 … I9 as in `nivel.flexible.invariants`."""

    body: U1  # (F,)
    rigid: U1  # (B,) 1 for the bodies that are not flexible
    mode: U2  # (F, 2) first of its modes, one past the last
    frame: U2  # (N, 2) flexible body, its number among `Bodies`
    place_b: F2  # (N, 3) [m] undeformed, axes of the body
    shape: F3  # (N, 6, n) displacement, turn by each mode, axes of the body
    I2: F2  # (F, 3)
    I3: F3  # (F, 3, n)
    I4: F3  # (F, 3, n)
    I5: F3  # (F n, 3, n)
    I7: F3  # (F, 3, 3)
    I8: F3  # (F n, 3, 3)
    I9: F3  # (F n n, 3, 3)
    stiffness: F3  # (F, n, n) [1/s²]
    damping: F3  # (F, n, n) [1/s]
    # geometric stiffening, see `nivel.kernels.geometric_stiffening`; empty where no body has any
    of_acceleration: F3  # (3 F, n, n) of the frame's origin less gravity, per m/s²
    of_turning: F3  # (3 F, n, n) per rad/s²
    of_spin: F3  # (6 F, n, n) per rad²/s² of x², y², z², xy, yz, zx
    of_load: F3  # (6 N, n, n) per N and N m on the frame at an interface, axes of the body
    block: U2  # (·, 4) block of the saddle, its frame or NONE, its flexible body, first of the blocks for its modes
    # work
    p: W1  # (m,) modal coordinates
    pdot: W1  # (m,)
    pddot: W1  # (m,)
    Q: W1  # (m,) modal forces
    first: W2  # (F, 3) [kg m] I2 + I3 p
    inertia: W3  # (F, 3, 3) [kg m²] about the frame origin, deformed
    coupling: W3  # (F, 6, n) momentum and angular momentum of a modal velocity, axes of the body
    static: W3  # (F, n, 3) (I8_j + I9_kj p_k) ω̄
    drift: W2  # (F, 3) and
    spin: W2  # (F, 3) momentum of the second order of the modal velocities
    velocity_force: W2  # (F, 6) on the frame, axes of the body
    now: W3  # (N, 6, n) what a mode moves and turns the node by, deformed, axes of the body
    displacement: W3  # (N, 3, n) of the node by a mode, global axes
    turn: W3  # (N, 3, n) of its axes, global axes
    bias: W2  # (N, 6) (α, r̈) of the node while no velocity of the body or of a mode changes
    root: F3  # (F, 6, 6) lower Cholesky factor of what is left of the mass matrix without the modes, axes of the body
