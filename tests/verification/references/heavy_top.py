"""The heavy top of Arnold and Brüls: a fast symmetric top on a spherical joint at the global origin.

Body axes at the fixed point, body y axis the axis of symmetry, centre of mass at X̄ = (0, 1, 0). With the inertia about
the fixed point J = J_c + m (X̄ᵀX̄ 1 - X̄ X̄ᵀ), ω̄ in body axes and Euler parameters p (scalar first),

    J ω̄' = -ω̄ × J ω̄ + X̄ × m Aᵀ g,      p' = ½ p ∘ (0, ω̄).

Since J1 = J3 the spin ω̄_y is constant. Conserved besides: the energy ½ ω̄ᵀJ ω̄ - m gᵀ A X̄ and the vertical momentum
(A J ω̄)_z.
The force of the joint on the top is m (a - g), a = A (ω̄' × X̄ + ω̄ × (ω̄ × X̄)).
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from .solution import Solution

Array = NDArray[np.float64]

MASS = 15.0
INERTIA = np.array([0.234375, 0.46875, 0.234375])  # about the centre of mass
ARM = np.array([0.0, 1.0, 0.0])  # X̄
GRAVITY = np.array([0.0, 0.0, -9.81])
SPIN = np.array([0.0, 150.0, -4.61538])  # ω̄ at the start; the body axes are then the global ones
INERTIA_AT_POINT = INERTIA + MASS * np.array([1.0, 0.0, 1.0])


@dataclass(frozen=True)
class TopMotion:
    """The top at n times, SI units.

    position, velocity, acceleration (n, 3): centre of mass, global; euler_parameters (n, 4) unit, scalar first;
    rotation (n, 3, 3): columns are the body axes; angular_velocity_body (n, 3) in body axes;
    joint_force (n, 3): on the top, global; kinetic_energy, potential_energy, vertical_momentum (n,)
    """

    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    euler_parameters: Array
    rotation: Array
    angular_velocity_body: Array
    joint_force: Array
    kinetic_energy: Array
    potential_energy: Array
    vertical_momentum: Array


def rotation_matrix(parameters: Array) -> Array:
    """(n, 4) -> (n, 3, 3), the homogeneous form divided by |p|²."""
    e0, e1, e2, e3 = parameters.T
    matrix = np.array(
        [
            [e0**2 + e1**2 - e2**2 - e3**2, 2 * (e1 * e2 - e0 * e3), 2 * (e1 * e3 + e0 * e2)],
            [2 * (e1 * e2 + e0 * e3), e0**2 - e1**2 + e2**2 - e3**2, 2 * (e2 * e3 - e0 * e1)],
            [2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), e0**2 - e1**2 - e2**2 + e3**2],
        ]
    )
    return (matrix / (e0**2 + e1**2 + e2**2 + e3**2)).transpose(2, 0, 1)


def _spin_rate(spin: Array, rotation: Array) -> Array:
    weight = np.einsum("nji,j->ni", rotation, MASS * GRAVITY)
    return (_cross(ARM, weight) - _cross(spin, INERTIA_AT_POINT * spin)) / INERTIA_AT_POINT


def _cross(a: Array, b: Array) -> Array:
    """Without the care for axes that `numpy.cross` takes, which is most of the time of a slope."""
    (a1, a2, a3), (b1, b2, b3) = a.T, b.T
    return np.array([a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1]).T


def _slope(_: float, state: Array) -> Array:
    e0, e1, e2, e3, w1, w2, w3 = state
    parameters = 0.5 * np.array(
        [
            -e1 * w1 - e2 * w2 - e3 * w3,
            e0 * w1 + e2 * w3 - e3 * w2,
            e0 * w2 + e3 * w1 - e1 * w3,
            e0 * w3 + e1 * w2 - e2 * w1,
        ]
    )
    rate = _spin_rate(state[None, 4:], rotation_matrix(state[None, :4]))[0]
    return np.concatenate([parameters, rate])


def solve(times: Array, *, rtol: float = 1e-13, atol: float = 1e-13) -> TopMotion:
    """At `times` (n,) [s] beginning with 0."""
    times = np.asarray(times, dtype=float)
    states = _solution(float(times[0]), rtol, atol)(times)
    return _motion(times, states[:4].T, states[4:].T)


@cache
def _solution(begin: float, rtol: float, atol: float) -> Solution:
    return Solution(_slope, begin, np.concatenate([[1.0, 0.0, 0.0, 0.0], SPIN]), rtol=rtol, atol=atol)


def _motion(times: Array, raw: Array, spin: Array) -> TopMotion:
    parameters = raw / np.linalg.norm(raw, axis=1, keepdims=True)
    rotation = rotation_matrix(parameters)
    rate = _spin_rate(spin, rotation)
    velocity_body = np.cross(spin, ARM)
    acceleration = _turned(rotation, np.cross(rate, ARM) + np.cross(spin, velocity_body))
    momentum = INERTIA_AT_POINT * spin
    position = _turned(rotation, np.broadcast_to(ARM, spin.shape))
    return TopMotion(
        time=times,
        position=position,
        velocity=_turned(rotation, velocity_body),
        acceleration=acceleration,
        euler_parameters=parameters,
        rotation=rotation,
        angular_velocity_body=spin,
        joint_force=MASS * (acceleration - GRAVITY),
        kinetic_energy=0.5 * np.sum(spin * momentum, axis=1),
        potential_energy=-MASS * position @ GRAVITY,
        vertical_momentum=_turned(rotation, momentum)[:, 2],
    )


def _turned(rotation: Array, vectors: Array) -> Array:
    return np.einsum("nij,nj->ni", rotation, vectors)
