"""The spatial slider-crank of report 44 (Rouvinen 2003), reduced to its crank angle.

The crank turns about the global X axis through the origin, the slider's centre of mass keeps to the line (x, 0, -H)
without turning, the rod of length L joins the crank tip P to it. With s = sin φ, c = cos φ (φ = 0 at the start,
positive about +X):

    P = (0, R s, -R c)                            crank tip
    x = √(L² - R² s² - (R c - H)²)                slider, so that |(x, 0, -H) - P| = L
    a = (x, -R s, R c - H) / L                    rod's x axis, global
    x' = -R H s / x,   a' = (x', -R c, -R s) / L

The universal joint holds the rod's y axis perpendicular to the slider's z axis, which is the global Z. Hence y ⟂ a and
y ⟂ Z:

    ρ = √(a1² + a2²),   y = (-a2, a1, 0) / ρ,   z = a × y = (-a3 a1, -a3 a2, ρ²) / ρ.

This is a rotation ψ = atan2(a2, a1) about Z, then -ε about y with sin ε = a3: the angular velocity is ψ' Z - ε' y,
in rod axes (ψ' a3, -ε', ψ' ρ), with ψ' = (a1 a2' - a2 a1') / ρ² and ε' = a3' / ρ.

The crank's body x axis points from the hinge to P, its z axis along +X (that is what the angles π/2, π/2, -π/2 mean).
The torque of -50 N m about +X drives φ downwards: P starts at -Z, goes through -Y and +Z, and is first on top at
φ = -3π/2.
"""

import numpy as np

from .one_dof import GROUND, Array, Joint, Linkage, Motion, unit_wrenches
from .one_dof import solve as solve_linkage

RADIUS = 0.5
ROD_LENGTH = 1.8
GUIDE_DEPTH = 0.5  # H: the guide runs at z = -H
CRANK, ROD, SLIDER = 0, 1, 2
TOP_DEAD_CENTRE = -1.5 * np.pi


def _slider_position(s: Array, c: Array) -> Array:
    return np.sqrt(ROD_LENGTH**2 - (RADIUS * s) ** 2 - (RADIUS * c - GUIDE_DEPTH) ** 2)


def _rod_axis(s: Array, c: Array) -> tuple[Array, Array, Array]:
    """Slider position x, rod axis a (3, n) and its derivative a' (3, n)."""
    x = _slider_position(s, c)
    slope = -RADIUS * GUIDE_DEPTH * s / x
    axis = np.array([x, -RADIUS * s, RADIUS * c - GUIDE_DEPTH]) / ROD_LENGTH
    derivative = np.array([slope, -RADIUS * c, -RADIUS * s]) / ROD_LENGTH
    return x, axis, derivative


def pose(angle: Array) -> tuple[Array, Array]:
    """Centres of mass (n, 3, 3) and rotation matrices (n, 3, 3, 3) of crank, rod and slider at φ (n,)."""
    s, c = np.sin(angle), np.cos(angle)
    zero, one = np.zeros_like(s), np.ones_like(s)
    x, axis, _ = _rod_axis(s, c)
    tip = np.array([zero, RADIUS * s, -RADIUS * c])
    end = np.array([x, zero, -GUIDE_DEPTH * one])
    a1, a2, a3 = axis
    rho = np.sqrt(a1**2 + a2**2)
    crank = np.array([[zero, zero, one], [s, c, zero], [-c, s, zero]])
    rod = np.array([[a1, -a2 / rho, -a3 * a1 / rho], [a2, a1 / rho, -a3 * a2 / rho], [a3, zero, rho]])
    slider = np.array([[one, zero, zero], [zero, one, zero], [zero, zero, one]])
    position = np.array([tip / 2, (tip + end) / 2, end])
    rotation = np.array([crank, rod, slider])
    return np.moveaxis(position, -1, 0), np.moveaxis(rotation, -1, 0)


def rates(angle: Array) -> tuple[Array, Array]:
    """dr/dφ (n, 3, 3) global and the angular velocity per φ̇ (n, 3, 3) in body axes."""
    s, c = np.sin(angle), np.cos(angle)
    zero, one = np.zeros_like(s), np.ones_like(s)
    _, (a1, a2, a3), (b1, b2, b3) = _rod_axis(s, c)
    rho = np.sqrt(a1**2 + a2**2)
    azimuth = (a1 * b2 - a2 * b1) / rho**2
    elevation = b3 / rho
    tip = np.array([zero, RADIUS * c, RADIUS * s])
    end = np.array([ROD_LENGTH * b1, zero, zero])
    position = np.array([tip / 2, (tip + end) / 2, end])
    rod = np.array([azimuth * a3, -elevation, azimuth * rho])
    angular = np.array([[zero, zero, one], rod, [zero, zero, zero]])
    return position.transpose(2, 0, 1), angular.transpose(2, 0, 1)


def _tip(angle: Array) -> Array:
    return 2 * pose(angle)[0][:, CRANK]


def _slider(angle: Array) -> Array:
    return pose(angle)[0][:, SLIDER]


def _universal(angle: Array) -> Array:
    """Three forces, and a torque along the cross product of the two arms of the cross (rod y, slider z)."""
    basis = np.zeros((len(angle), 6, 4))
    basis[:, :3, :3] = np.eye(3)
    basis[:, 3:, 3] = np.cross(pose(angle)[1][:, ROD, :, 1], [0.0, 0.0, 1.0])
    return basis


LINKAGE = Linkage(
    names=("crank", "rod", "slider"),
    mass=np.array([21.0, 71.7, 7.8]),
    inertia=np.array([[2.2e-2, 0.513, 0.526], [7.5e-2, 20.22, 20.27], [1.3e-2, 1.3e-2, 1.3e-2]]),
    gravity=np.array([0.0, -9.81, 0.0]),
    drive=-50.0,
    driven=CRANK,
    drive_axis=np.array([1.0, 0.0, 0.0]),
    pose=pose,
    rates=rates,
    joints=(
        Joint("hinge", CRANK, GROUND, lambda q: np.zeros((len(q), 3)), lambda q: unit_wrenches(len(q), "xyz", "yz")),
        Joint("pin", CRANK, ROD, _tip, lambda q: unit_wrenches(len(q), "xyz", "")),
        Joint("knee", ROD, SLIDER, _slider, _universal),
        Joint("slide", SLIDER, GROUND, _slider, lambda q: unit_wrenches(len(q), "yz", "xyz")),
    ),
)


def solve(times: Array, *, rtol: float = 1e-12, atol: float = 1e-13) -> Motion:
    """From rest at φ = 0, at `times` (n,) [s] beginning with 0. Bodies: crank, rod, slider."""
    return solve_linkage(LINKAGE, times, 0.0, rtol=rtol, atol=atol)
