"""The outline of a beam's section in its own y and z axes, to draw it by."""

from typing import Final

import numpy as np

from nivel.elements.beams.beam import Beam
from nivel.elements.beams.sections import Box, Circle, GeneralSection, IBeam, Rectangle, Tube, Values
from nivel.machine.units.six_by_six import full_matrix

Outline = list[tuple[float, float]]  # corners (y, z) [m], counter-clockwise
CORNERS: Final = 24  # of a round section


def outline(beam: Beam) -> tuple[Outline, Outline]:
    """The outside and the hole, which is empty where there is none, about the beam's line.

    A section that is given by numbers is drawn as the rectangle that resists bending and stretch alike: h² = 12 I/A.
    """
    match beam.section:
        case Circle(radius=radius):
            outside, hole = _round(radius), []
        case Tube(outer_radius=outer, inner_radius=inner):
            outside, hole = _round(outer), _round(inner)
        case Rectangle(width=width, height=height):
            outside, hole = _rectangle(width, height), []
        case Box(width=width, height=height, wall=wall):
            outside, hole = _rectangle(width, height), _rectangle(width - 2.0 * wall, height - 2.0 * wall)
        case IBeam() as section:
            outside, hole = _i(section), []
        case Values(area=area, iy=iy, iz=iz):
            outside, hole = _alike(area, iy, iz), []
        case GeneralSection(stiffness=stiffness):
            K = np.diag(full_matrix(stiffness))
            outside, hole = _alike(K[0], K[4], K[5]), []
    y, z = beam.centroid
    return [(a + y, b + z) for a, b in outside], [(a + y, b + z) for a, b in hole]


def _round(radius: float) -> Outline:
    angle = 2.0 * np.pi * np.arange(CORNERS) / CORNERS
    return [(float(a), float(b)) for a, b in zip(radius * np.cos(angle), radius * np.sin(angle), strict=True)]


def _rectangle(width: float, height: float) -> Outline:
    y, z = 0.5 * width, 0.5 * height
    return [(-y, -z), (y, -z), (y, z), (-y, z)]


def _alike(stretch: float, bend_y: float, bend_z: float) -> Outline:
    """Bending about y goes with the height along z."""
    return _rectangle(float(np.sqrt(12.0 * bend_z / stretch)), float(np.sqrt(12.0 * bend_y / stretch)))


def _i(section: IBeam) -> Outline:
    y, z, web = 0.5 * section.width, 0.5 * section.height, 0.5 * section.web
    inner = 0.5 * section.height - section.flange
    right = [(y, -z), (y, -inner), (web, -inner), (web, inner), (y, inner), (y, z)]
    return [*right, *((-a, -b) for a, b in right)]
