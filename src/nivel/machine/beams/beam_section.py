"""The cross-section of a beam of large motion in numbers: stiffness of its six strains, mass and inertia per length.

Section axes: x along the beam, y and z across it, at the line of the beam. Strains are (Γ, Κ): stretch and two shears, twist and two
curvatures; the strain of a point r of the section is Γ + Κ × r.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator

from nivel.lazy import dataclass
from nivel.machine.beams.section import Material, SectionRecord, Values
from nivel.machine.beams.section_properties import section_of
from nivel.machine.beams.six_by_six import (
    Diagonal,
    Matrix,
    full_matrix,
    lowest_eigenvalue,
    six_by_six,
    symmetry_and_sign,
)
from nivel.machine.core.checked import Checked, Problem
from nivel.machine.given import Field, OneNumber, ThreeNumbers, TwoNumbers
from nivel.machine.units.quantity import Length, Quantity, listed

Array = NDArray[np.float64]
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
        description="[EA, GA_y, GA_z, GJ, EI_y, EI_z], or 6×6 rows for stretch, two shears, twist, two curvatures"
    )
    mass: MassPerLength
    inertia: Annotated[ThreeNumbers[InertiaPerLength], BeforeValidator(listed)] = Field(
        description="of a unit of length about the x, y and z axes through the mass centre"
    )
    mass_centre: Offset = Field(default=(0.0, 0.0), description="y and z from the line of the beam")

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


@dataclass(frozen=True)
class BeamSection:
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
