"""Sections of beams: materials and shapes as they are given, and their properties; and for beams of large motion stiffness of the six
strains, mass and inertia per length.

Section axes: x along the beam, y and z across it, at the line of the beam. Strains are (Γ, Κ): stretch and two shears, twist and two
curvatures; the strain of a point r of the section is Γ + Κ × r.
"""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.lazy import Struct
from nivel.machine.core.coefficient import SectionLength
from nivel.machine.core.record import Checked, Problem
from nivel.machine.core.vectors import Array
from nivel.machine.given import DENSITY, Field, Maybe, OneNumber, ThreeNumbers, TwoNumbers
from nivel.machine.units.quantity import Density, Length, Quantity, Scalar, listed
from nivel.machine.units.six_by_six import (
    Diagonal,
    Matrix,
    full_matrix,
    lowest_eigenvalue,
    six_by_six,
    symmetry_and_sign,
)

Stress = Annotated[OneNumber, Quantity("pressure", positive=True)]
Area = Annotated[OneNumber, Quantity("area", positive=True)]
SecondMoment = Annotated[OneNumber, Quantity("second moment of area", positive=True)]

SLIP = "a slip of a unit?"
# [Pa], [kg/m³] nothing is as soft and as heavy
SOFT, HEAVY = 1e9, 2500.0


class Material(Checked):
    """A linear elastic, isotropic material."""

    _spellings: ClassVar[Mapping[str, str]] = {"young_modulus": "youngs_modulus"}

    youngs_modulus: Stress
    poisson_ratio: Scalar
    density: Density = Field(usual=DENSITY)

    @property
    def shear_modulus(self) -> float:
        """[Pa]"""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))

    def problems(self) -> Iterator[Problem]:
        if not -1.0 < self.poisson_ratio < 0.5:
            yield Problem(("poisson_ratio",), f"a number between -1 and 0.5 was expected, got {self.poisson_ratio:g}")
        if not 1e4 <= self.youngs_modulus <= 2e12:
            yield Problem(("youngs_modulus",), f"{self.youngs_modulus:.3g} Pa: {SLIP} Steel has 210 GPa")
        elif self.youngs_modulus < SOFT and self.density > HEAVY:
            message = f"{self.youngs_modulus:.3g} Pa with {self.density:.4g} kg/m^3: {SLIP} Numbers are in Pa; steel has 210 GPa"
            yield Problem(("youngs_modulus",), message)
        if not 0.1 <= self.density <= 1e5:
            yield Problem(("density",), f"{self.density:.3g} kg/m^3: {SLIP} Steel has 7850 kg/m^3")


class Circle(Checked):
    """A round bar."""

    type: Literal["circle"] = "circle"
    radius: SectionLength


class Tube(Checked):
    """A round tube."""

    type: Literal["tube"] = "tube"
    outer_radius: SectionLength
    inner_radius: SectionLength

    def problems(self) -> Iterator[Problem]:
        if self.inner_radius >= self.outer_radius:
            sizes = (
                f"`inner_radius` {self.inner_radius:g} m must be smaller than `outer_radius` {self.outer_radius:g} m"
            )
            yield Problem(("inner_radius",), sizes)


class Rectangle(Checked):
    """A full rectangle: `width` along the local y axis, `height` along z."""

    type: Literal["rectangle"] = "rectangle"
    width: SectionLength
    height: SectionLength


class Box(Checked):
    """A hollow rectangle of one wall thickness: outer `width` along the local y axis, outer `height` along z."""

    type: Literal["box"] = "box"
    width: SectionLength
    height: SectionLength
    wall: SectionLength

    def problems(self) -> Iterator[Problem]:
        if 2.0 * self.wall >= min(self.width, self.height):
            yield Problem(("wall",), f"a wall of {self.wall:g} m leaves no hollow; a full section is a `rectangle`")


class IBeam(Checked):
    """An I: flanges of `width` along the local y axis, `height` over all along z."""

    type: Literal["i"] = "i"
    width: SectionLength
    height: SectionLength
    flange: SectionLength = Field("thickness of the flanges")
    web: SectionLength = Field("thickness of the web")

    def problems(self) -> Iterator[Problem]:
        if 2.0 * self.flange >= self.height or self.web > self.width:
            yield Problem((), "the flanges and the web must fit into `height` and `width`")


class Values(Checked):
    """A section given by numbers: `iy` resists bending about the local y axis, `iz` about z, `torsion` is St Venant's J."""

    type: Literal["values"] = "values"
    area: Area
    iy: SecondMoment
    iz: SecondMoment
    torsion: SecondMoment
    shear_area_y: Maybe[Area] = Field("for forces along y; default: no shear deformation", default=None)
    shear_area_z: Maybe[Area] = Field("for forces along z; default: no shear deformation", default=None)
    stress_y: Maybe[SectionLength] = Field("distance of the outermost fibres along y", default=None)
    stress_z: Maybe[SectionLength] = Field("distance of the outermost fibres along z", default=None)


SectionRecord = Annotated[Circle | Tube | Rectangle | Box | IBeam | Values, Field(discriminator="type")]


class Section(Struct):
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


# --- for beams of large motion ---

LEAST = 1e-12  # share of the largest eigenvalue, scaled, below which a stiffness is none

if TYPE_CHECKING:
    Stiffness = Diagonal | Matrix
else:
    Stiffness = six_by_six(("force", ("force", "torque"), "bending stiffness"))

MassPerLength = Annotated[OneNumber, Quantity("mass per length", positive=True)]
InertiaPerLength = Annotated[OneNumber, Quantity("inertia per length", positive=True)]
Offset = Annotated[TwoNumbers[Length], BeforeValidator(listed)]


class GeneralSection(Checked):
    """A section given by its stiffness, mass and inertia per length."""

    type: Literal["general"] = "general"
    stiffness: Stiffness = Field(
        "[EA, GA_y, GA_z, GJ, EI_y, EI_z], or 6×6 rows for stretch, two shears, twist, two curvatures"
    )
    mass: MassPerLength
    inertia: Annotated[ThreeNumbers[InertiaPerLength], BeforeValidator(listed)] = Field(
        "of a unit of length about the x, y and z axes through the mass centre"
    )
    mass_centre: Offset = Field("y and z from the line of the beam", default=(0.0, 0.0))

    def problems(self) -> Iterator[Problem]:
        matrix = full_matrix(self.stiffness)
        wrong = [*symmetry_and_sign("stiffness", matrix, "stores")]
        for message in wrong:
            yield Problem(("stiffness",), message)
        if not wrong and lowest_eigenvalue(matrix) < LEAST:
            yield Problem(("stiffness",), "`stiffness`: some strain costs no energy; all eigenvalues must be positive")
        x, y, z = sorted(self.inertia)
        if z > (x + y) * (1.0 + 5e-3):
            yield Problem(("inertia",), f"`inertia`: {z:g} exceeds the sum of the other two, {x:g} + {y:g}: impossible")


BeamSectionRecord = Annotated[SectionRecord | GeneralSection, Field(discriminator="type")]


class BeamSection(Struct):
    """stiffness (6, 6) of (Γ, Κ) [N, N m, N m²]; mass [kg/m]; mass_centre (3,) [m]; inertia (3, 3) about it [kg m]."""

    stiffness: Array
    mass: float
    mass_centre: Array
    inertia: Array


def missing_shear_areas(section: object) -> tuple[str, ...]:
    """The shear areas, by which a beam of large motion deforms, that a section given by values lacks."""
    if not isinstance(section, Values):
        return ()
    return tuple(name for name in ("shear_area_y", "shear_area_z") if getattr(section, name) is None)


def beam_section(
    section: SectionRecord | GeneralSection,
    material: Material | None,
    centroid: tuple[float, float],
    shear_centre: tuple[float, float],
) -> BeamSection:
    """The section in numbers; with offsets from the line of the beam: y and z of the centroid, which is the mass centre too, and of the
    shear centre."""
    if isinstance(section, GeneralSection):
        moved = _moved(full_matrix(section.stiffness), centroid, shear_centre)
        return BeamSection(moved, section.mass, np.array([0.0, *section.mass_centre]), np.diag(section.inertia))
    assert material is not None  # the record was checked
    E, G, rho = material.youngs_modulus, material.shear_modulus, material.density
    s = section_of(section, material.poisson_ratio)
    # where there is no shear, in cables, no force asks for this stiffness
    shear_y, shear_z = (each if np.isfinite(each) else s.area for each in (s.shear_y, s.shear_z))
    stiffness = np.diag([E * s.area, G * shear_y, G * shear_z, G * s.torsion, E * s.iy, E * s.iz])
    return BeamSection(
        _moved(stiffness, centroid, shear_centre),
        rho * s.area,
        np.array([0.0, *centroid]),
        rho * np.diag([s.iy + s.iz, s.iy, s.iz]),
    )


def _moved(stiffness: Array, centroid: tuple[float, float], shear_centre: tuple[float, float]) -> Array:
    """Stiffness for strains at the line of the beam: stretch is that of the centroid, shears are those of the shear centre."""
    at_centres = np.eye(6)
    at_centres[0, 4], at_centres[0, 5] = centroid[1], -centroid[0]
    at_centres[1, 3], at_centres[2, 3] = -shear_centre[1], shear_centre[0]
    return at_centres.T @ stiffness @ at_centres
