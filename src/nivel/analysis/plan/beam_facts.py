"""Facts of a beam: its mass, and the range of frequencies of the beam and of its elements."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nivel.elements.joints.joint import Joint
from nivel.known import Beam, BeamSection
from nivel.lazy import dataclass, nivel, scipy
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.system.beam_nodes import with_nodes

FIRST_BENDING = 4.730040744862704  # first root above zero of cos x cosh x = 1: a beam with free ends


@dataclass(frozen=True)
class BeamFacts:
    """One beam, as it is given: mass [kg], length [m] along its line, its model, number and order of its elements, names of its stations.

    first_bending : about the lowest frequency [Hz] of the beam straight and free. fastest : highest frequency [Hz] of an element
    of it, or of two half segments on their spring, unstressed, which no vibration of the unstressed beam exceeds.
    """

    name: str
    mass: float
    length: float
    start: tuple[float, ...]
    end: tuple[float, ...]
    model: str
    elements: int
    order: int
    nodes: int
    stations: tuple[str, ...]
    first_bending: float
    fastest: float


def beam_facts(beam: Beam) -> BeamFacts:
    """The facts of a beam."""
    section, length = beam.properties, beam.line.length
    bending = float(np.linalg.eigvalsh(section.stiffness[4:, 4:])[0])
    ends = {0.0: "start", 1.0: "end"} | {share: name for name, share in beam.stations.items()}
    return BeamFacts(
        name=beam.name,
        mass=section.mass * length,
        length=length,
        start=tuple(beam.from_),
        end=tuple(beam.to),
        model=beam.model,
        elements=beam.elements,
        order=beam.order,
        nodes=len(beam.shares),
        stations=tuple(f"{beam.name}.{ends[share]}" for share in sorted(ends)),
        first_bending=(FIRST_BENDING / length) ** 2 * float(np.sqrt(bending / section.mass)) / (2.0 * np.pi),
        fastest=fastest_frequency(beam, section),
    )


def fastest_frequency(beam: Beam, section: BeamSection) -> float:
    """Highest frequency [Hz] of the shortest element of a beam, or piece between two nodes, as if that were straight.

    The frequencies of a structure lie below the highest one of its elements (Irons, Treharne 1971).
    """
    if beam.has_gradients:
        return nivel.elements.beams.models.fastest_of_gradients(beam)
    if beam.model == "segments":
        length = beam.line.length * float(np.diff(beam.shares).min())
        stiffness, mass = _stiffness(section, 1, length), _mass_of_halves(section, length)
    else:
        length = float(nivel.elements.beams.exact.elements_of(beam).weight.sum(axis=1).min())
        stiffness = _stiffness(section, beam.order, length)
        mass = _mass(section, beam.order, length, lumped=not beam.shares_mass)
    return float(np.sqrt(scipy.linalg.eigh(stiffness, mass, eigvals_only=True)[-1])) / (2.0 * np.pi)


def _stiffness(section: BeamSection, order: int, length: float) -> Array:
    """Stiffness of a straight unstressed element for (place, turn) of its nodes: δΓ = δx' + e₁ × δθ, δΚ = δθ'."""
    xi, weight = nivel.elements.beams.exact.gauss(order)
    N, D = nivel.elements.beams.exact.lagrange(order, xi)
    size, along = 6 * (order + 1), nivel.elements.beams.exact.skew(np.array([1.0, 0.0, 0.0]))
    total = np.zeros((size, size))
    for g in range(len(xi)):
        B = np.zeros((6, size))
        for a in range(order + 1):
            B[:3, 6 * a : 6 * a + 3] = B[3:, 6 * a + 3 : 6 * a + 6] = np.eye(3) * D[g, a] / length
            B[:3, 6 * a + 3 : 6 * a + 6] = N[g, a] * along
        total += weight[g] * length * B.T @ section.stiffness @ B
    return total


def _mass(section: BeamSection, order: int, length: float, *, lumped: bool) -> Array:
    """Mass of the element for the same; lumped: what belongs to a node by the shape functions, at that node."""
    xi, weight = nivel.elements.beams.exact.gauss(order + 1)
    N, _ = nivel.elements.beams.exact.lagrange(order, xi)
    shares = length * np.einsum("g,ga,gb->ab", weight, N, N)
    if lumped:
        shares = np.diag(shares.sum(axis=1))
    lever = -nivel.elements.beams.exact.skew(section.mass_centre)
    carried = np.hstack([np.eye(3), lever])
    point = section.mass * carried.T @ carried
    point[3:, 3:] += section.inertia
    return np.asarray(np.kron(shares, point), dtype=float)


def _mass_of_halves(section: BeamSection, length: float) -> Array:
    """Mass of two rigid halves of a piece of this length for (place, turn) of its nodes, at which their outer ends are."""
    total = np.zeros((12, 12))
    for node, share in ((0, 0.5), (6, -0.5)):
        xi, weight = nivel.elements.beams.exact.gauss(2)
        for place, part in zip(share * length * xi, 0.5 * length * weight, strict=True):
            lever = -nivel.elements.beams.exact.skew(section.mass_centre + np.array([place, 0.0, 0.0]))
            carried = np.hstack([np.eye(3), lever])
            point = section.mass * carried.T @ carried
            point[3:, 3:] += section.inertia
            total[node : node + 6, node : node + 6] += part * point
    return total


# Step times angular frequency: beyond the first no explicit method is accurate, and none of ours is stable beyond the second.
ACCURATE, STABLE = 1.0, 2.8


def too_fast(beams: Sequence[Beam], step: float) -> tuple[str, str] | None:
    """(message, advice) where an element of a beam vibrates too fast for explicit steps [s]; None where none does."""
    if not beams:
        return None
    frequency, beam = max(
        ((fastest_frequency(beam, beam.properties), beam) for beam in beams), key=lambda pair: pair[0]
    )
    rate = 2.0 * np.pi * frequency
    if rate * step <= ACCURATE:
        return None
    limit = STABLE / rate
    message = (
        f"an element of the beam {beam.name} vibrates with up to {frequency:.3g} Hz, which an explicit method follows with steps below "
        f"{limit:.2g} s only; of {step:.3g} s they let it grow"
    )
    advice = (
        f"Take an implicit method, which steps over such vibrations: --integrator generalised-alpha, or radau; or --step "
        f"{0.5 * limit:.1g}. Fewer elements of {beam.name}, or `model: segments`, vibrate less fast."
    )
    return message, advice


def with_stiff_beams(machine: MachineRecord) -> MachineRecord:
    """The machine with the nodes of its beams as bodies, each fixed to the next; those joints stand behind its own."""
    whole = with_nodes(machine)
    if not whole.beams:
        return whole
    given: dict[str, Any] = {name: getattr(whole, name) for name in type(whole).model_fields}
    fixed = [
        Joint(name=f"{beam.name}-{k}", type="fixed", bodies=pair, point=whole.body_named[pair[0]].position)
        for beam in whole.beams
        for k, pair in enumerate(zip(beam.node_names[:-1], beam.node_names[1:], strict=True))
    ]
    given |= {"joints": (*whole.joints, *fixed), "beams": ()}
    return type(whole).model_construct(whole.model_fields_set, **given)
