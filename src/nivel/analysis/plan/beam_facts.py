"""Facts of a beam: its mass, and the range of frequencies of the beam and of its elements."""

from collections.abc import Iterator, Sequence
from math import inf, sqrt
from typing import Any, Final

import numpy as np

from nivel.elements.joints.joint import Joint
from nivel.integrate.catalogue import INTEGRATORS, step_for
from nivel.integrate.facts import IntegratorFacts
from nivel.known import Beam, BeamSection, Component, Contact, Hand, JointSpringDamper, PointForce, Torque
from nivel.lazy import Struct, nivel, scipy
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.bodies.shape import Box, Cylinder, Sphere
from nivel.machine.core.element import ForceElement
from nivel.machine.core.vectors import Array
from nivel.machine.laws.functions import functions_in
from nivel.machine.laws.symbols import find_symbol
from nivel.machine.laws.time_function import signals_of
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import resolve
from nivel.system.beam_nodes import with_nodes

FIRST_BENDING = 4.730040744862704  # first root above zero of cos x cosh x = 1: a beam with free ends


class BeamFacts(Struct):
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


# Machines whose only stiffness is that of the modes of their flexible bodies: some methods need no tangents of these.

SOFT: Final = 0.2  # frequency, or rate of decay, times the step
CORNER: Final = 4.0  # mass of a solid over that which a corner of it feels
ON_GROUND: Final = (
    "tyre",
    "track",
    "blade",
    "soil-wheel",
)  # types of forces that are soft beside any step that they bear
WAITING: Final = ("inputs",)  # signals that the motion does not change
IMPACT: Final = 3.0  # normal force over weight, of bodies set down


def is_soft(machine: MachineRecord, force: ForceElement) -> bool:
    """Whether no motion of a body that the force alone makes is quicker than some steps."""
    if force.type in ON_GROUND:
        return True
    match force:
        case PointForce() | Torque() | Hand():
            return not _follows_motion(machine, force)
        case Contact() | JointSpringDamper():
            return _rate(machine, force) * machine.simulation.step <= SOFT
    return False


def _follows_motion(machine: MachineRecord, force: ForceElement) -> bool:
    """Whether a force given as functions may change with the motion within a step; what it follows then is not bounded."""
    paths = [path for _, function in functions_in(force) for path in function.signals]
    return any(find_symbol(path, machine).section not in WAITING for path in paths)


def _rate(machine: MachineRecord, force: Contact | JointSpringDamper) -> float:
    """Frequency or rate of decay, whichever is larger [1/s]; infinite where it does not follow from a few numbers."""
    if isinstance(force, Contact):
        return _rate_of_contact(machine, force)
    if force.table is not None or force.law is not None:
        return inf
    name, coordinate = resolve(force.coordinate, machine.joints)
    joint = next(each for each in machine.joints if each.name == name)
    bodies = [machine.body_named[each] for each in joint.bodies or () if each in machine.body_named]
    least = min((_inertia(body, is_angle="angle" in coordinate) for body in bodies), default=0.0)
    return max(sqrt((force.stiffness or 0.0) / least), force.damping / least) if least else inf


def _rate_of_contact(machine: MachineRecord, contact: Contact) -> float:
    body = machine.body_named.get(contact.body or "")
    if (
        body is None
        or not isinstance(body.shape, Sphere | Box | Cylinder)
        or contact.law is not None
        or contact.exponent != 1.0
        or not isinstance(contact.stiffness, int | float)
    ):
        return inf
    mass = _inertia(body, is_angle=False)
    if not mass:
        return inf
    transition = inf if contact.sticks else contact.friction_transition_speed or inf
    sliding = IMPACT * contact.friction * float(np.linalg.norm(machine.gravity)) / transition
    return max(sqrt(CORNER * contact.stiffness / mass), sliding)


def _inertia(body: Body, *, is_angle: bool) -> float:
    """Mass, or the least moment of inertia; 0 where a file has it."""
    if body.flexible is not None or body.point_mass:
        return 0.0
    properties = mass_properties(body)
    return float(np.linalg.eigvalsh(properties.inertia)[0]) if is_angle else properties.mass


MOVING = ("joints", "inputs", "markers", "bodies")  # what signals of the motion are read from


def only_circuits_are_stiff(machine: MachineRecord) -> bool:
    """Whether a machine has circuits with derivatives by hand, and besides them and weight no forces but soft ones and those given in
    time, no continuous states, and in circuits no commands that follow pressures at once."""
    return (
        bool(machine.hydraulics)
        and not machine.beams
        and all(is_soft(machine, each) for each in machine.forces)
        and all(state.update is not None for state in machine.states)
        and all(part.role != "state" for block in machine.control for part in block.parts)
        and nivel.system.circuit_elements.has_slopes(machine)
        and all(_waits(machine, path) for component in machine.hydraulics for path in _signals(component))
    )


def _signals(component: Component) -> Iterator[str]:
    """The paths of what a component follows."""
    for key in component.functions:
        yield from signals_of(getattr(component, key) or 0.0)


def _waits(machine: MachineRecord, path: str) -> bool:
    """Whether a signal follows the time, samples or the motion: what acts on a circuit is not back within a step."""
    blocks, open_paths = {block.name: block for block in machine.control}, [path]
    while open_paths:
        symbol = find_symbol(open_paths.pop(), machine)
        if symbol.section != "control" and symbol.section not in (*MOVING, "states"):
            return False
        # blocks may follow each other, and their own parts: each is looked at once
        if symbol.section == "control" and (block := blocks.pop(symbol.name, None)) is not None:
            present = [part.function for part in block.parts if part.role == "signal"]
            varying = [function for function in present if not isinstance(function, float | int)]
            open_paths += [each for function in varying for each in function.signals]
    return True


def only_modes_are_stiff(machine: MachineRecord) -> bool:
    """Whether a machine has flexible bodies, and besides weight no forces but those that are given in time."""
    return (
        machine.is_flexible
        and not machine.beams
        and all(isinstance(each, PointForce | Torque) for each in machine.forces)
    )


def integrator_of(machine: MachineRecord, coordinates: str) -> IntegratorFacts:
    """The integrator of a run of `machine` in these coordinates."""
    name = machine.simulation.integrator
    by_circuits = step_for(name, "flexible circuits" if machine.is_flexible else "circuits")
    if by_circuits and goes_by_circuits(machine, coordinates):
        return by_circuits
    by_modes = step_for(name, "modes")
    return by_modes if by_modes and coordinates == "relative" and only_modes_are_stiff(machine) else INTEGRATORS[name]


def goes_by_circuits(machine: MachineRecord, coordinates: str) -> bool:
    """Whether a machine is one for integrators that take derivatives of circuits by hand."""
    formulation = machine.simulation.formulation
    return coordinates == "relative" and formulation == "newton-euler" and only_circuits_are_stiff(machine)
