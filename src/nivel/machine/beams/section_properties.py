"""Properties of cross-sections of beams."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import dataclass
from nivel.machine.beams.section import Box, Circle, IBeam, Rectangle, SectionRecord, Tube, Values

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Section:
    """A cross-section about its centroid, principal axes y and z.

    area [m²]; iy, iz [m⁴] ∫ z² dA, ∫ y² dA; torsion [m⁴] J of St Venant; shear_y, shear_z [m²] shear areas, infinite for
    no shear deformation.
    fibres : (f, 2) [m] y, z of the points where stress is evaluated.
    twist : (f, 2) [1/m³] shear stresses τ_xy, τ_xz there for a unit torque.
    """

    area: float
    iy: float
    iz: float
    torsion: float
    shear_y: float
    shear_z: float
    fibres: Array
    twist: Array


def section_of(record: SectionRecord, poisson_ratio: float) -> Section:
    """The section that `record` describes. Shear coefficients: Cowper 1966, J. Appl. Mech. 33, table 1."""
    nu = poisson_ratio
    match record:
        case Circle(radius=a):
            return _round(a, 0.0, 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu))
        case Tube(outer_radius=a, inner_radius=b):
            m2 = (b / a) ** 2
            k = 6.0 * (1.0 + nu) * (1.0 + m2) ** 2
            return _round(a, b, k / ((7.0 + 6.0 * nu) * (1.0 + m2) ** 2 + (20.0 + 12.0 * nu) * m2))
        case Rectangle(width=b, height=h):
            return _rectangle(b, h, 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu))
        case Box():
            return _box(record)
        case IBeam():
            return _i(record)
        case Values():
            return _values(record)


def _round(a: float, b: float, shear: float) -> Section:
    area, second = np.pi * (a**2 - b**2), np.pi / 4.0 * (a**4 - b**4)
    turn = 2.0 * np.pi * np.arange(8) / 8
    fibres = a * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    return Section(
        area, second, second, 2.0 * second, shear * area, shear * area, fibres, _around(fibres, 2.0 * second)
    )


def _around(fibres: Array, polar: float) -> Array:
    """Shear stress r/J of round sections."""
    return np.stack([-fibres[:, 1], fibres[:, 0]], axis=1) / polar


def _rectangle(b: float, h: float, shear: float) -> Section:
    """J and the greatest stress by St Venant's series: Timoshenko & Goodier 1951, torsion of rectangular bars."""
    small, large = min(b, h), max(b, h)
    n = np.arange(1, 40, 2)
    series = np.sum(np.tanh(n * np.pi * large / (2.0 * small)) / n**5)
    torsion = small**3 * large / 3.0 * (1.0 - 192.0 / np.pi**5 * small / large * series)
    fibres = _border(b, h)
    # the greatest stress, in the middle of the long sides, is taken for all four; the corners have none
    decay = np.exp(
        -n * np.pi * large / (2.0 * small)
    )  # 1/cosh x = 2 e⁻ˣ/(1 + e⁻²ˣ), which does not overflow where thin
    top = 1.0 - 8.0 / np.pi**2 * np.sum(2.0 * decay / (n**2 * (1.0 + decay**2)))
    twist = _tangent(fibres) * (small * top / torsion)
    return Section(b * h, b * h**3 / 12.0, h * b**3 / 12.0, torsion, shear * b * h, shear * b * h, fibres, twist)


def _border(b: float, h: float) -> Array:
    """Corners and middles of the sides of a rectangle."""
    return 0.5 * np.array([[b, h], [0, h], [-b, h], [-b, 0], [-b, -h], [0, -h], [b, -h], [b, 0]], dtype=float)


def _tangent(fibres: Array) -> Array:
    """Unit directions of the flow around at the middles of the sides; zero at corners."""
    middle = np.prod(fibres, axis=1) == 0.0
    around = np.stack([-np.sign(fibres[:, 1]), np.sign(fibres[:, 0])], axis=1)
    return around * middle[:, None]


def _box(record: Box) -> Section:
    """Torsion by Bredt's formulas for thin walls; shear areas are those of the walls along the force."""
    b, h, t = record.width, record.height, record.wall
    bi, hi = b - 2.0 * t, h - 2.0 * t
    inside = (b - t) * (h - t)
    torsion = 2.0 * t * inside**2 / (b + h - 2.0 * t)
    fibres = _border(b, h)
    flow = np.stack([-np.sign(fibres[:, 1]), np.sign(fibres[:, 0])], axis=1)
    flow = flow / np.linalg.norm(flow, axis=1)[:, None] / (2.0 * inside * t)
    iy, iz = (b * h**3 - bi * hi**3) / 12.0, (h * b**3 - hi * bi**3) / 12.0
    return Section(b * h - bi * hi, iy, iz, torsion, 2.0 * t * (b - t), 2.0 * t * (h - t), fibres, flow)


def _i(record: IBeam) -> Section:
    """Torsion of thin strips, Σ b t³ / 3."""
    b, h, f, w = record.width, record.height, record.flange, record.web
    hi = h - 2.0 * f
    area = 2.0 * b * f + hi * w
    iy, iz = (b * h**3 - (b - w) * hi**3) / 12.0, (2.0 * f * b**3 + hi * w**3) / 12.0
    torsion = (2.0 * b * f**3 + (h - f) * w**3) / 3.0
    fibres = _border(b, h)[[0, 1, 2, 4, 5, 6]]
    twist = np.zeros_like(fibres)
    twist[:, 0] = -np.sign(fibres[:, 1]) * f / torsion
    return Section(area, iy, iz, torsion, 5.0 / 6.0 * 2.0 * b * f, w * (h - f), fibres, twist)


def _values(record: Values) -> Section:
    y, z = record.stress_y or 0.0, record.stress_z or 0.0
    fibres = np.array([[y, z], [-y, z], [-y, -z], [y, -z]]) if y or z else np.zeros((1, 2))
    shear_y, shear_z = (np.inf if each is None else each for each in (record.shear_area_y, record.shear_area_z))
    return Section(record.area, record.iy, record.iz, record.torsion, shear_y, shear_z, fibres, np.zeros_like(fibres))
