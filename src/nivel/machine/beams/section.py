"""Materials and cross-sections of beams in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar, Literal

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.core.coefficient import SectionLength
from nivel.machine.core.usual import DENSITY
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.units.quantity import Density, Quantity, Scalar

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
    flange: SectionLength = Field(description="thickness of the flanges")
    web: SectionLength = Field(description="thickness of the web")

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
    shear_area_y: Maybe[Area] = Field(default=None, description="for forces along y; default: no shear deformation")
    shear_area_z: Maybe[Area] = Field(default=None, description="for forces along z; default: no shear deformation")
    stress_y: Maybe[SectionLength] = Field(default=None, description="distance of the outermost fibres along y")
    stress_z: Maybe[SectionLength] = Field(default=None, description="distance of the outermost fibres along z")


SectionRecord = Annotated[Circle | Tube | Rectangle | Box | IBeam | Values, Field(discriminator="type")]
