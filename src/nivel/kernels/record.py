"""The numbers of one machine: what every kernel reads and where it leaves its result.

Capital counts in the comments: B bodies, M markers, R joint rows, K constraint rows of the formulation (R, plus one
normalisation row a body for *lagrange*), N blocks of C_q. Body B (the last, index nb) is the ground. Vectors are in global axes
unless the name ends in `_b` (axes of the body). Symbols: NOTATION.md.
"""

from __future__ import annotations

from typing import NamedTuple

from numba import types

from nivel.kernels.arrays import A1, F1, F2, F3, U1, U2, numba_type
from nivel.kernels.handle import address_type, reader


class Bodies(NamedTuple):
    """Rigid bodies."""

    mass: F1  # (B,) [kg]
    centre_b: F2  # (B, 3) [m] centre of mass from the frame origin
    inertia_b: F3  # (B, 3, 3) [kg m²] about the centre of mass
    inertia_origin_b: F3  # (B, 3, 3) [kg m²] about the frame origin
    whitener_b: F3  # (B, 3, 3) inverse of the lower Cholesky factor of inertia_b
    inverse_root_mass: F1  # (B,) 1/√mass
    gravity: F1  # (3,) [m/s²]
    # work, for the state last evaluated
    R: F2  # (B+1, 3) [m] position of the frame origin
    theta: F2  # (B+1, 4) [-] Euler parameters, scalar first
    A: F3  # (B+1, 3, 3) [-] rotation matrix: columns are the body axes
    Rdot: F2  # (B+1, 3) [m/s]
    omega: F2  # (B+1, 3) [rad/s]
    omega_b: F2  # (B+1, 3) [rad/s]
    c: F2  # (B+1, 3) [m] centre of mass from the frame origin
    wrench: F2  # (B+1, 6) [N, N m] applied force, and torque about the frame origin
    Rddot: F2  # (B+1, 3) [m/s²]
    alpha_b: F2  # (B+1, 3) [rad/s²]


class Markers(NamedTuple):
    """Frames fixed to bodies."""

    body: U1  # (M,)
    position_b: F2  # (M, 3) [m]
    frame_b: F3  # (M, 3, 3) [-]
    # work
    u: F2  # (M, 3) [m] from the frame origin of the body
    r: F2  # (M, 3) [m]
    A: F3  # (M, 3, 3) [-]
    rdot: F2  # (M, 3) [m/s]
    bias: F2  # (M, 3) [m/s²] acceleration of the point when the body's Rddot and alpha are zero


class Constraints(NamedTuple):
    """Basic constraints, one table a kind, and their rows."""

    s: U2  # (·, 3) first marker, second marker, first row
    d1: U2  # (·, 5) first marker, its axis, second marker, its axis, row
    d2: U2  # (·, 4) first marker, its axis, second marker, row
    scale: F1  # (K,) what a violation is measured by: the length of the machine [m], or 1 for cosines
    # work
    C: F1  # (K,)
    Cdot: F1  # (K,)
    gamma: F1  # (K,) right-hand side of C_q v̇ = γ
    J: F2  # (R, 12) row of C_q with respect to (ṙ, ω) of the first marker and of the second
    lam: F1  # (K,) multipliers: M v̇ + C_qᵀ λ = Q


class Joints(NamedTuple):
    """Joints as their user sees them: reactions and joint coordinates."""

    first_marker: U1  # (joints,)
    rows: U2  # (joints, 2) first row, one past the last
    coordinate: U2  # (coordinates, 3) kind, first marker, second marker
    turn: F2  # (coordinates, 3) cosine and sine at the last accepted step, full turns since the start


class Functions(NamedTuple):
    """Functions of time: constants, tables, compiled expressions."""

    kind: U1  # (·,)
    value: F1  # (·,) the constant
    table: U2  # (·, 2) first entry of times/values, one past the last
    times: F1
    values: F1
    address: A1  # (·,) of a compiled function


class Loads(NamedTuple):
    """Point forces and torques of the user."""

    what: U2  # (·, 3) kind (0 force, 1 torque), marker, axes (0 global, 1 body)
    functions: U2  # (·, 3) one function a component
    # work
    magnitude: F1  # (·,) [N or N m]
    power: F1  # (·,) [W]


class Saddle(NamedTuple):
    """The saddle-point system [M C_qᵀ; C_q 0], solved by elimination of the bodies: S = C_q M⁻¹ C_qᵀ.

    W are the blocks of C_q multiplied by the inverse transpose Cholesky factor of the body's mass matrix ("whitened"), so
    S is a sum of dot products. S and its factor L D Lᵀ are in elimination order.
    """

    block: U2  # (N, 4) row, side (0 first marker, 1 second, 2 normalisation), marker, body
    pair: U2  # (·, 3) block, block, entry of S
    order: U1  # (K,) order[k] is the row eliminated as k-th
    S_start: U1  # (K+1,) column k of the upper triangle
    S_row: U1  # diagonal last in each column
    L_start: U1  # (K+1,) column j of L, below the diagonal
    L_row: U1
    P_start: U1  # (K+1,) pattern of row k of L: its columns ...
    P_column: U1
    P_entry: U1  # ... and where each entry stands in column order
    # work
    W: F2  # (N, width)
    G: F3  # (B, width, width) what the formulation needs of each body's mass matrix
    z: F2  # (B, width) whitened applied and velocity forces
    S: F1
    L: F1
    Dinv: F1  # (K,) 1/D; the scale of the rows where the machine is redundant
    y: F1  # (K,)
    b: F1  # (K,) right-hand side, then solution, in row order
    dense: F2  # (K, K) redundant machines: pivoted factor; (0, 0) otherwise
    null: F2  # (K, redundant) null space of S and its normal equations
    pivot: U1  # (K,)


class Control(NamedTuple):
    """Numbers that steer an evaluation."""

    rank: U1  # (1,) independent rows
    stabilise: F1  # (4,) Baumgarte 2α and β²; tolerances of |C|/scale and |Ċ|/scale for the direct correction
    energy: F1  # (3,) kinetic and potential energy of the last observation, their sum at the start
    power: F1  # (2,) work of external forces and dissipation per second
    failure: U1  # (1,) row that could not be eliminated


class Record(NamedTuple):
    """One machine in numbers."""

    bodies: Bodies
    markers: Markers
    constraints: Constraints
    joints: Joints
    functions: Functions
    loads: Loads
    saddle: Saddle
    control: Control


record_type = numba_type(Record)
record_at = reader(record_type)
state_type = types.Array(types.float64, 1, "C")
evaluate_signature = types.int64(address_type, types.float64, state_type, state_type)
correct_signature = types.int64(address_type, types.float64, state_type)
