"""Straight beams of two nodes with six freedoms each: Euler–Bernoulli and Timoshenko.

Freedoms u, v, w, θx, θy, θz of both ends in local axes; x runs along the beam. Shape functions that satisfy the static
equations (Friedman & Kosmatka 1993, Comput. Struct. 47): exact end stiffness, no locking; without shear deformation they
are Hermite's. θy = -w', θz = v' then.
"""

import numpy as np

from nivel.elements.beams.sections import Material, Section
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array

GAUSS, GAUSS_WEIGHT = (np.polynomial.legendre.leggauss(4)[0] + 1.0) / 2.0, np.polynomial.legendre.leggauss(4)[1] / 2.0


class Beam(Struct):
    """An element: `length` [m], its `section` and `material`; `shear`: whether it deforms by shear (Timoshenko)."""

    length: float
    section: Section
    material: Material
    shear: bool

    @property
    def mass(self) -> float:
        """[kg]"""
        return self.material.density * self.section.area * self.length

    @property
    def flexibility_y(self) -> float:
        """12 E Iz / (G As_y L²): shear against bending for forces along y."""
        return self._flexibility(self.section.iz, self.section.shear_y)

    @property
    def flexibility_z(self) -> float:
        """The same for forces along z."""
        return self._flexibility(self.section.iy, self.section.shear_z)

    def _flexibility(self, second: float, shear_area: float) -> float:
        if not self.shear or np.isinf(shear_area):
            return 0.0
        return (
            12.0 * self.material.youngs_modulus * second / (self.material.shear_modulus * shear_area * self.length**2)
        )


def stiffness(beam: Beam) -> Array:
    """(12, 12) local. Przemieniecki 1968, eq. (5.116)."""
    E, G, L, s = beam.material.youngs_modulus, beam.material.shear_modulus, beam.length, beam.section
    K = np.zeros((12, 12))
    K[np.ix_([0, 6], [0, 6])] = E * s.area / L * np.array([[1, -1], [-1, 1]])
    K[np.ix_([3, 9], [3, 9])] = G * s.torsion / L * np.array([[1, -1], [-1, 1]])
    K[np.ix_([1, 5, 7, 11], [1, 5, 7, 11])] = _bending(E * s.iz, L, beam.flexibility_y)
    turned = np.array([1.0, -1.0, 1.0, -1.0])  # θy turns against w'
    K[np.ix_([2, 4, 8, 10], [2, 4, 8, 10])] = _bending(E * s.iy, L, beam.flexibility_z) * np.outer(turned, turned)
    return K


def _bending(EI: float, L: float, phi: float) -> Array:
    return (
        EI
        / ((1.0 + phi) * L**3)
        * np.array(
            [
                [12, 6 * L, -12, 6 * L],
                [6 * L, (4 + phi) * L**2, -6 * L, (2 - phi) * L**2],
                [-12, -6 * L, 12, -6 * L],
                [6 * L, (2 - phi) * L**2, -6 * L, (4 + phi) * L**2],
            ]
        )
    )


def deflection_shape(s: float, L: float, phi: float) -> tuple[Array, Array, Array]:
    """(4,) each, at the share s of the length: deflection, its derivative along x, and turn of the section for (v, θ) of both ends."""
    d = 1.0 + phi
    v = [1 - 3 * s**2 + 2 * s**3 + phi * (1 - s), L * (s - 2 * s**2 + s**3 + phi / 2 * (s - s**2))]
    v += [3 * s**2 - 2 * s**3 + phi * s, L * (-(s**2) + s**3 - phi / 2 * (s - s**2))]
    slope = [(-6 * s + 6 * s**2 - phi) / L, 1 - 4 * s + 3 * s**2 + phi / 2 * (1 - 2 * s)]
    slope += [(6 * s - 6 * s**2 + phi) / L, -2 * s + 3 * s**2 - phi / 2 * (1 - 2 * s)]
    turn = [6 * (s**2 - s) / L, 1 - 4 * s + 3 * s**2 + phi * (1 - s), 6 * (s - s**2) / L, 3 * s**2 - 2 * s + phi * s]
    return np.array(v) / d, np.array(slope) / d, np.array(turn) / d


def motion_shape(beam: Beam, s: float) -> tuple[Array, Array]:
    """(3, 12) displacement and (3, 12) turn of the section at the share s of the length."""
    L = beam.length
    move, turn = np.zeros((3, 12)), np.zeros((3, 12))
    move[0, [0, 6]] = turn[0, [3, 9]] = 1.0 - s, s
    v, _, theta = deflection_shape(s, L, beam.flexibility_y)
    move[1, [1, 5, 7, 11]], turn[2, [1, 5, 7, 11]] = v, theta
    w, _, theta = deflection_shape(s, L, beam.flexibility_z)
    turned = np.array([1.0, -1.0, 1.0, -1.0])
    move[2, [2, 4, 8, 10]], turn[1, [2, 4, 8, 10]] = w * turned, -theta * turned
    return move, turn


def mass_points(beam: Beam, *, lumped: bool) -> tuple[Array, Array, Array]:
    """(p,) masses [kg], (p, 3) local places from the first end [m], (p, 3, 12) displacements of points that carry the mass.

    Four points at each station, on the local y and z axes, have the section's mass and second moments. lumped : stations
    are the two ends, each with half the mass; else the Gauss points that make the integral of the mass matrix exact.
    """
    y, z = np.sqrt(2.0 * np.array([beam.section.iz, beam.section.iy]) / beam.section.area)
    offsets = np.array([[0, y, 0], [0, -y, 0], [0, 0, z], [0, 0, -z]])
    stations, weights = (np.array([0.0, 1.0]), np.array([0.5, 0.5])) if lumped else (GAUSS, GAUSS_WEIGHT)
    masses, places, shapes = [], [], []
    for s, weight in zip(stations, weights, strict=True):
        move, turn = motion_shape(beam, float(s))
        for d in offsets:
            masses.append(0.25 * weight * beam.mass)
            places.append(np.array([s * beam.length, 0.0, 0.0]) + d)
            shapes.append(move + np.cross(turn, d, axis=0))
    return np.array(masses), np.array(places), np.array(shapes)


def mass_matrix(beam: Beam, *, lumped: bool = False) -> Array:
    """(12, 12) local: Σ m Nᵀ N of `mass_points`."""
    masses, _, shapes = mass_points(beam, lumped=lumped)
    return np.einsum("p,pai,paj->ij", masses, shapes, shapes)


def geometric_stiffness(beam: Beam) -> Array:
    """(12, 12) local for a unit tension [1/m]: ∫ (v'ᵀ v' + w'ᵀ w') dx. Przemieniecki 1968, chapter 15."""
    out = np.zeros((12, 12))
    turned = np.array([1.0, -1.0, 1.0, -1.0])
    for s, weight in zip(GAUSS, GAUSS_WEIGHT, strict=True):
        v = deflection_shape(float(s), beam.length, beam.flexibility_y)[1]
        w = deflection_shape(float(s), beam.length, beam.flexibility_z)[1] * turned
        out[np.ix_([1, 5, 7, 11], [1, 5, 7, 11])] += weight * beam.length * np.outer(v, v)
        out[np.ix_([2, 4, 8, 10], [2, 4, 8, 10])] += weight * beam.length * np.outer(w, w)
    return out


def end_stress(beam: Beam) -> Array:
    """(2, f, 6, 12) stresses xx, yy, zz, xy, yz, zx in local axes, at both ends and all fibres, for unit freedoms [Pa/m].

    Internal forces from the end forces K u; shear forces as their mean over the shear area.
    """
    K, s = stiffness(beam), beam.section
    y, z = s.fibres.T
    out = np.zeros((2, len(y), 6, 12))
    for end, forces in enumerate((-K[:6], K[6:])):
        N, Vy, Vz, Mx, My, Mz = forces
        out[end, :, 0] = N / s.area + np.outer(z, My) / s.iy - np.outer(y, Mz) / s.iz
        out[end, :, 3] = np.outer(s.twist[:, 0], Mx) + (0.0 if np.isinf(s.shear_y) else Vy / s.shear_y)
        out[end, :, 5] = np.outer(s.twist[:, 1], Mx) + (0.0 if np.isinf(s.shear_z) else Vz / s.shear_z)
    return out
