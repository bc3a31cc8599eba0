"""Models of beams: the families of their elements, and what adds them to a system."""

import numpy as np

from nivel.elements.beams.ancf_beam import apply as ancf_beam
from nivel.elements.beams.ancf_beam import beam_numbers, beam_stiffness
from nivel.elements.beams.ancf_cable import apply as ancf_cable
from nivel.elements.beams.ancf_cable import cable_numbers, cable_stiffness
from nivel.elements.beams.exact import add_elements
from nivel.elements.beams.exact import apply as damped
from nivel.elements.beams.exact import apply_elastic as elastic
from nivel.elements.beams.gradients import add_gradients, consistent_mass, lengths_of
from nivel.elements.beams.segments import add_segments
from nivel.elements.forces.bushing import apply as bushing
from nivel.kernels.record.hook import Family
from nivel.known import Beam, SystemBuilder
from nivel.lazy import scipy

# kernels of elements: those without damping, whose derivatives are found by hand, and all others; of springs between segments
ELASTIC, OTHER, SPRINGS = elastic, damped, bushing
FAMILIES = (ELASTIC, OTHER, SPRINGS, ancf_cable, ancf_beam)


def family_of(beam: Beam) -> Family:
    """The kernel of its elements, or of the springs between its segments."""
    if beam.has_gradients:
        return ancf_cable if beam.model == "ancf-cable" else ancf_beam
    if beam.model == "segments":
        return SPRINGS
    return OTHER if beam.damping > 0.0 or beam.interpolation == "total" else ELASTIC


def add_beam(builder: SystemBuilder, beam: Beam) -> None:
    """What joins the nodes of a beam, which are bodies: its elements, or springs between segments; each couples its own nodes."""
    if beam.has_gradients:
        numbers = cable_numbers(beam) if beam.model == "ancf-cable" else beam_numbers(beam)
        add_gradients(builder, beam, family_of(beam), numbers)
    elif beam.model == "segments":
        add_segments(builder, beam)
    else:
        add_elements(builder, beam, family_of(beam))


def fastest_of_gradients(beam: Beam) -> float:
    """Highest frequency [Hz] of the shortest element of a beam, straight and unstressed."""
    lengths = lengths_of(beam)
    whole = beam.replace(
        from_=(0.0, 0.0, 0.0), to=(float(lengths.min()), 0.0, 0.0), via=None, through=(), twist=0.0, up=None,
        elements=1, stations={},
    )  # fmt: skip
    length = whole.line.length
    stiffness = cable_stiffness(whole, length) if beam.model == "ancf-cable" else beam_stiffness(whole, length)
    mass = np.kron(consistent_mass(whole, length), np.eye(3))
    fastest = float(scipy.linalg.eigh(stiffness, mass, eigvals_only=True)[-1])
    if beam.model == "ancf-cable":
        own = whole.properties
        fastest = max(fastest, 4.0 * float(own.stiffness[3, 3] / own.inertia[0, 0]) / length**2)
    return float(np.sqrt(fastest)) / (2.0 * np.pi)
