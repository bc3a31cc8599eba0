"""Pendulums in closed form: the point mass on a massless rod (IFToMM benchmark A01) and the physical pendulum.

φ is the angle from the downward vertical (-Y), positive about +Z: the centre of mass is at c (sin φ, -cos φ). With the
inertia J about the hinge, φ'' = -Ω² sin φ, Ω² = m g c / J. Released at rest from φ0, and with k = sin(φ0/2),
k'² = 1 - k², u = Ω t,

    sin(φ/2) = k cd(u),   cd = cn/dn                       (so φ(0) = φ0)
    φ' = 2 (k cd)' Ω / cos(φ/2) = -2 k k' Ω sn/dn          since cd' = -k'² sn/dn² and 1 - k² cd² = k'²/dn².

The period is 4 K(k)/Ω. Force of the hinge on the pendulum, along the rod (towards the hinge) and across it (direction
of growing φ): N = m (c φ'² + g cos φ), S = m (c φ'' + g sin φ) = m g sin φ (1 - m c²/J), zero for the point mass.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipj, ellipk

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pendulum:
    """A pendulum in XY hinged at the origin; arm: hinge to centre of mass; inertia: about the centre of mass and Z."""

    mass: float = 1.0
    arm: float = 1.0
    inertia: float = 0.0
    gravity: float = 9.81
    start_angle: float = -np.pi / 2

    @property
    def inertia_at_hinge(self) -> float:
        return self.inertia + self.mass * self.arm**2

    @property
    def frequency(self) -> float:
        """Ω [rad/s] of small swings."""
        return float(np.sqrt(self.mass * self.gravity * self.arm / self.inertia_at_hinge))

    @property
    def period(self) -> float:
        """[s] of the swing of amplitude |start_angle|."""
        return float(4 * ellipk(np.sin(self.start_angle / 2) ** 2) / self.frequency)


IFTOMM_A01 = Pendulum()  # 1 kg on 1 m, released at (-1, 0)


@dataclass(frozen=True)
class Swing:
    """The pendulum at n times, SI units, radians.

    angle, rate, angle_acceleration (n,); position, velocity, acceleration (n, 3): centre of mass, global;
    hinge_force (n, 3): on the pendulum, global; rod_force (n,): along the rod, positive in tension;
    kinetic_energy, potential_energy (n,): zero potential at the height of the hinge
    """

    time: Array
    angle: Array
    rate: Array
    angle_acceleration: Array
    position: Array
    velocity: Array
    acceleration: Array
    hinge_force: Array
    rod_force: Array
    kinetic_energy: Array
    potential_energy: Array


def solve(times: Array, pendulum: Pendulum = IFTOMM_A01) -> Swing:
    """At `times` (n,) [s] after the release."""
    times = np.asarray(times, dtype=float)
    k = np.sin(pendulum.start_angle / 2)
    sn, cn, dn, _ = ellipj(pendulum.frequency * times, k**2)
    angle = 2 * np.arcsin(k * cn / dn)
    rate = -2 * k * np.cos(pendulum.start_angle / 2) * pendulum.frequency * sn / dn
    second = -(pendulum.frequency**2) * np.sin(angle)
    zero = np.zeros_like(angle)
    outward = np.stack([np.sin(angle), -np.cos(angle), zero], axis=1)
    across = np.stack([np.cos(angle), np.sin(angle), zero], axis=1)
    arm, mass, gravity = pendulum.arm, pendulum.mass, pendulum.gravity
    tension = mass * (arm * rate**2 + gravity * np.cos(angle))
    shear = mass * (arm * second + gravity * np.sin(angle))
    return Swing(
        time=times,
        angle=angle,
        rate=rate,
        angle_acceleration=second,
        position=arm * outward,
        velocity=(arm * rate)[:, None] * across,
        acceleration=arm * (second[:, None] * across - (rate**2)[:, None] * outward),
        hinge_force=shear[:, None] * across - tension[:, None] * outward,
        rod_force=tension,
        kinetic_energy=0.5 * pendulum.inertia_at_hinge * rate**2,
        potential_energy=-mass * gravity * arm * np.cos(angle),
    )
