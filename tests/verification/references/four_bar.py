"""The planar four-bar of report 44 (Rouvinen 2003), reduced to its crank angle.

Crank from O = (0, 0) to B, coupler from B to E, rocker from D = (G, 0) to E, all in the XY plane; crank length L1,
coupler and rocker of one length L, so that B, E, D is an isosceles triangle. With θ the crank angle from +X:

    B = L1 (cos θ, sin θ),   B' = L1 (-sin θ, cos θ)
    d = D - B,   d' = -B',   r = |d|,   r' = dᵀd' / r
    h = √(L² - r²/4),   h' = -r r' / (4 h)                 height of E above the line B-D
    n = J d / r,   n' = (J d' - n r') / r,   J (x, y) = (-y, x)
    E = (B + D)/2 + h n,   E' = B'/2 + h' n + h n'

The printed data place E to the left of B → D, which is the sign above. Crank and ground are the shortest links and
L1 + L ≤ G + L, so the crank turns right round and h never vanishes: θ describes the whole motion.

For a link of length ℓ from P to Q with unit vector e = (Q - P)/ℓ the angle's derivative is e × (Q' - P') / ℓ.
The crank and the coupler are collinear where e1 × e2 = 0.

The printed centres of mass and angles leave a gap of 2.5e-4 m; here the printed crank angle is kept and the loop is
closed.
"""

import numpy as np

from .one_dof import GROUND, Array, Joint, Linkage, Motion, unit_wrenches
from .one_dof import solve as solve_linkage

CRANK_LENGTH = 2.0
BAR_LENGTH = 4.0  # coupler and rocker
GROUND_LENGTH = 2.5
CRANK, COUPLER, ROCKER = 0, 1, 2
PRINTED_CRANK_ANGLE = 1.047197551197


def _left(vector: Array) -> Array:
    return np.array([-vector[1], vector[0]])


def _loop(angle: Array) -> tuple[Array, Array, Array, Array, Array]:
    """B, E, D, B', E' (2, n) each."""
    s, c = np.sin(angle), np.cos(angle)
    tip, tip_rate = CRANK_LENGTH * np.array([c, s]), CRANK_LENGTH * np.array([-s, c])
    pivot = np.array([GROUND_LENGTH * np.ones_like(s), np.zeros_like(s)])
    span, span_rate = pivot - tip, -tip_rate
    r = np.sqrt(span[0] ** 2 + span[1] ** 2)
    r_rate = (span[0] * span_rate[0] + span[1] * span_rate[1]) / r
    h = np.sqrt(BAR_LENGTH**2 - r**2 / 4)
    h_rate = -r * r_rate / (4 * h)
    normal = _left(span) / r
    normal_rate = (_left(span_rate) - normal * r_rate) / r
    apex = (tip + pivot) / 2 + h * normal
    apex_rate = tip_rate / 2 + h_rate * normal + h * normal_rate
    return tip, apex, pivot, tip_rate, apex_rate


def _in_space(plane: Array) -> Array:
    """(2, n) in the plane -> (n, 3)."""
    return np.stack([plane[0], plane[1], np.zeros_like(plane[0])], axis=1)


def _turn(direction: Array) -> Array:
    """Rotation matrices (n, 3, 3) that take the X axis to the unit vector (2, n) in the plane."""
    e1, e2 = direction
    zero, one = np.zeros_like(e1), np.ones_like(e1)
    return np.moveaxis(np.array([[e1, -e2, zero], [e2, e1, zero], [zero, zero, one]]), -1, 0)


def pose(angle: Array) -> tuple[Array, Array]:
    """Centres of mass (n, 3, 3) and rotation matrices (n, 3, 3, 3) of crank, coupler and rocker at θ (n,)."""
    tip, apex, pivot, _, _ = _loop(angle)
    centres = (tip / 2, (tip + apex) / 2, (pivot + apex) / 2)
    directions = (tip / CRANK_LENGTH, (apex - tip) / BAR_LENGTH, (apex - pivot) / BAR_LENGTH)
    position = np.stack([_in_space(centre) for centre in centres], axis=1)
    return position, np.stack([_turn(direction) for direction in directions], axis=1)


def rates(angle: Array) -> tuple[Array, Array]:
    """dr/dθ (n, 3, 3) global and the angular velocity per θ̇ (n, 3, 3) in body axes (about Z)."""
    tip, apex, pivot, tip_rate, apex_rate = _loop(angle)
    position = np.stack([_in_space(p) for p in (tip_rate / 2, (tip_rate + apex_rate) / 2, apex_rate / 2)], axis=1)
    angular = np.zeros_like(position)
    angular[:, CRANK, 2] = 1.0
    angular[:, COUPLER, 2] = _cross(apex - tip, apex_rate - tip_rate) / BAR_LENGTH**2
    angular[:, ROCKER, 2] = _cross(apex - pivot, apex_rate) / BAR_LENGTH**2
    return position, angular


def _cross(first: Array, second: Array) -> Array:
    return first[0] * second[1] - first[1] * second[0]


def collinearity(angle: Array) -> Array:
    """e1 × e2 (n,): the sine of the angle from the crank to the coupler."""
    tip, apex, *_ = _loop(np.asarray(angle))
    return _cross(tip, apex - tip) / (CRANK_LENGTH * BAR_LENGTH)


def _point(which: int):
    return lambda q: _in_space(_loop(q)[which])


LINKAGE = Linkage(
    names=("crank", "coupler", "rocker"),
    mass=np.array([78.1, 156.2, 156.2]),
    inertia=np.array([[8.14e-2, 26.1, 26.0], [0.163, 208.4, 208.3], [0.163, 208.4, 208.3]]),
    gravity=np.array([0.0, -9.81, 0.0]),
    drive=-1200.0,
    driven=CRANK,
    drive_axis=np.array([0.0, 0.0, 1.0]),
    pose=pose,
    rates=rates,
    joints=(
        Joint("hinge", GROUND, CRANK, lambda q: np.zeros((len(q), 3)), lambda q: unit_wrenches(len(q), "xyz", "xy")),
        Joint("pin", CRANK, COUPLER, _point(0), lambda q: unit_wrenches(len(q), "xyz", "")),
        Joint("sleeve", COUPLER, ROCKER, _point(1), lambda q: unit_wrenches(len(q), "xy", "xy")),
        Joint("pivot", ROCKER, GROUND, _point(2), lambda q: unit_wrenches(len(q), "xyz", "xy")),
    ),
)


def solve(
    times: Array, *, crank_angle: float = PRINTED_CRANK_ANGLE, rtol: float = 1e-12, atol: float = 1e-13
) -> Motion:
    """From rest at `crank_angle`, at `times` (n,) [s] beginning with 0. Bodies: crank, coupler, rocker."""
    return solve_linkage(LINKAGE, times, crank_angle, rtol=rtol, atol=atol)
