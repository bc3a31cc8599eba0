"""Assembly: the given positions are moved as little as possible onto the constraints, then the velocities likewise.

Bodies whose orientation is driven, turned to where it begins before the joints are closed.
The rows of a driven orientation vanish half a turn from it as well, so the assembly could close them there. From less than a right angle
it goes to the orientation that is meant.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from nivel.analysis.assembly import velocities
from nivel.analysis.assembly.closing import OPEN, Wishes, close_positions
from nivel.analysis.assembly.equations import MotionEquations, change_between, equations
from nivel.analysis.assembly.redundancy import refuse_lost_directions, refuse_tilted_axes
from nivel.elements.joints import JOINTS
from nivel.errors import Fault, ModelError, refuse
from nivel.files.joint_parts import rotors_of
from nivel.kernels.bodies.driven_turn import TURN_X
from nivel.lazy import Struct
from nivel.machine.bodies.inertia import point_mass_inertia
from nivel.machine.core.orientation import euler_parameters_from_matrix
from nivel.machine.core.placement import marker_frame
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import unknown_name
from nivel.system.states.relative import bodies_of
from nivel.system.system import Array, System

# Less than this angle from its target [rad] a body stays where it is drawn.
NEAR = np.pi / 4
# y and z axes of a marker in the place of z and x, and so on round
NEXT = np.roll(np.eye(3), 1, axis=0)


def turn_to_targets(machine: MachineRecord, motion: MotionEquations, t: float, y: Array) -> None:
    """Turn the bodies in the state y, in place, about their driven markers, where these are far from their orientation at time t; with all
    bodies that joints hold together with them, but by way of the ground, unless the reference is one of these."""
    of = motion.system.record.markers.body
    for _, reference, marker, rows in _driven(machine, motion):
        G = _against_target(motion, t, y, marker, rows)
        if np.trace(G) < 1.0 + 2.0 * np.cos(NEAR):
            together = _held_together(machine, motion, int(of[marker]))
            _turn(motion, t, y, marker, G.T, together if int(of[reference]) not in together else ())


def half_turns(machine: MachineRecord, motion: MotionEquations, t: float, y: Array) -> Iterator[Fault]:
    """A fault for every driver whose marker, in the closed state y, is half a turn from its orientation."""
    for name, _, marker, rows in _driven(machine, motion):
        if np.trace(_against_target(motion, t, y, marker, rows)) < 1.0:
            message = "the marker ends up half a turn from the orientation at the start: place the bodies that it hangs on nearer to it"
            yield Fault.at(f"drivers.{name}.orientation", message)
    motion.evaluate(t, y)


def _driven(machine: MachineRecord, motion: MotionEquations) -> Iterator[tuple[str, int, int, list[int]]]:
    """Driver, marker of reference, driven marker and the three rows of every driven orientation."""
    system, record = motion.system, motion.system.record
    for driver in machine.drivers:
        if driver.orientation is not None:
            rows = [system.rows.index(f"{driver.name}.about_{axis}") for axis in "xyz"]
            combination = record.constraints.combination
            first = int(combination[combination[:, 0] == rows[0]][0, 1])
            what = record.coordinates.what[int(record.constraints.term[first, 0])]
            assert what[0] == TURN_X
            yield driver.name, int(what[1]), int(what[2]), rows


def _against_target(motion: MotionEquations, t: float, y: Array, marker: int, rows: list[int]) -> Array:
    """(3, 3) axes of the marker in those of its target. A state shows three of these cosines; the others are those of the marker with
    its axes in the place of each other."""
    G, x = np.zeros((3, 3)), np.arange(3)
    for turn in range(3):
        tried = y.copy()
        _turn(motion, t, tried, marker, np.linalg.matrix_power(NEXT, turn))
        motion.evaluate(t, tried)
        G[(x + 1) % 3, (x + 2 + turn) % 3] = -motion.system.record.constraints.C[rows]
    return G


def _turn(motion: MotionEquations, t: float, y: Array, marker: int, P: Array, others: Iterable[int] = ()) -> None:
    """Turn the body of a marker about its point, in place, so that its axes A become A P; the others with it."""
    motion.evaluate(t, y)
    record, count = motion.system.record, motion.system.body_count
    body = int(record.markers.body[marker])
    if body >= count:
        return
    A, r = record.markers.A[marker].copy(), record.markers.r[marker].copy()
    T, axes = A @ P @ A.T, record.bodies.A[:count].copy()
    for b in {body, *others}:
        place = y[7 * b : 7 * b + 3]
        place[:] = r + T @ (place - r)
        y[7 * b + 3 : 7 * b + 7] = euler_parameters_from_matrix(T @ axes[b])


def _held_together(machine: MachineRecord, motion: MotionEquations, body: int) -> set[int]:
    """The bodies that joints join to one, directly or by way of others."""
    number = {name: k for k, name in enumerate(motion.system.bodies)}
    joined = [{number[name] for name in bodies_of(machine, joint) if name in number} for joint in machine.joints]
    found, before = {body}, set[int]()
    while found != before:
        before = set(found)
        found |= set[int]().union(*(each for each in joined if each & found))
    return found


TURN_A_MARKER = (
    "turn one of its markers (the name says which axis of the first is perpendicular to which of the second)"
)
# Changes of velocities below this share of the largest one are those of solving for it.
TOLD = 1e-9
# Joints may be open by this share of the machine's length as given, unless the machine says otherwise; directions by this cosine.
GAP, GAP_OF_DIRECTIONS = 0.1, 0.5


class Assembly(Struct):
    """An assembled state and how far it is from the given one.

    y : state. reference : joint angles and other measured coordinates there. gap : largest violation of a position row as given
    (`gap_row` names it) [m or rad]. moved : for each body that moved, name, distance [m] and angle [rad]. velocity_change : the same
    for velocities [m/s], [rad/s]; followed : those of these bodies for which no velocity was given.
    """

    y: Array
    reference: Array
    gap: float
    gap_row: str
    moved: tuple[tuple[str, float, float], ...]
    velocity_change: tuple[tuple[str, float, float], ...]
    followed: tuple[str, ...] = ()


def assemble(machine: MachineRecord, motion: MotionEquations, t: float = 0.0) -> Assembly:
    """Close all joints of `machine` at time t.

    Raises ModelError naming an axis that is not parallel to others as it must be, or every joint that is open by more than the machine
    allows as given, every joint row that cannot be closed with its gap, start values that cannot be reached, and joints whose axes end up
    opposite.
    """
    with np.errstate(over="ignore", invalid="ignore"):  # numbers too large end as joints that stay open
        refuse_tilted_axes(machine, motion)
        return _assemble(machine, motion, t)


def _assemble(machine: MachineRecord, motion: MotionEquations, t: float) -> Assembly:
    system = motion.system
    wishes = _wishes(machine, system)
    y = system.start.copy()
    given = y[: system.positions].copy()
    motion.evaluate(t, y)
    gap, gap_row = _largest_gap(system)
    _refuse_contradictions(machine, motion)
    turn_to_targets(machine, motion, t, y)
    close_positions(motion, t, y, wishes)
    _refuse_open_joints(machine, motion, wishes)
    refuse_lost_directions(machine, motion)
    if faults := list(half_turns(machine, motion, t, y)):
        raise ModelError(faults)
    y, change = velocities.consistent_velocities(machine, motion, t, y, wishes)
    y, more = velocities.taken_along(motion, t, y)
    change = change + more
    told = max(
        velocities.ROUND_OFF, TOLD * float(np.max(np.abs(change / np.repeat([system.size, 1.0], 3)), initial=0.0))
    )
    velocity_change = _named(system.bodies, change[:, :3], change[:, 3:], told * system.size, told)
    changed = {name for name, _, _ in velocity_change}
    kept = velocities.given_velocities(machine)
    followed = tuple(b.name for k, b in enumerate(machine.bodies) if b.name in changed and not kept[k].any())
    reference = system.record.coordinates.reference.copy()
    return Assembly(y, reference, gap, gap_row, _moves(system, given, y[: system.positions]), velocity_change, followed)


def _wishes(machine: MachineRecord, system: System) -> Wishes:
    index = dict(zip(system.layout.coordinates["joint_coordinate"], system.record.joints.coordinate, strict=True))
    values, rates = [], []
    for joint in machine.joints:
        for wanted, given in ((values, joint.start), (rates, joint.start_rates)):
            for name, value in given.given.items() if given is not None else ():
                label = f"{joint.name}.{name}"
                wanted.append((label, int(index[label]), value))
    return Wishes(
        np.array([body.assembly_weight for body in machine.bodies], dtype=float),
        np.array([body.hold for body in machine.bodies], dtype=bool),
        tuple(values),
        tuple(rates),
    )


def _largest_gap(system: System) -> tuple[float, str]:
    """Largest violation of a row in the state last evaluated, measured by the scales of the rows, and its name."""
    violation = np.abs(system.record.constraints.C[: system.machine_rows])
    if not len(violation):
        return 0.0, ""
    worst = int(np.argmax(violation / system.record.constraints.scale[: system.machine_rows]))
    return float(violation[worst]), system.rows[worst]


def _refuse_contradictions(machine: MachineRecord, motion: MotionEquations) -> None:
    """Joints that contradict the given positions by more than the machine allows; not those with a start value of their own."""
    system, faults = motion.system, []
    asked = machine.assembly.largest_gap
    limit = GAP * system.size if asked is None else asked
    rows = _rows_by_owner(system)
    for joint in machine.joints:
        for row in rows.get(joint.name, ()):
            length = system.row_units[row] == "m"
            gap = abs(float(system.record.constraints.C[row]))
            if gap > (limit if length else GAP_OF_DIRECTIONS) and joint.start is None:
                said = f"{gap:.4g} m" if length else f"{np.degrees(np.arcsin(min(gap, 1.0))):.4g} deg"
                allowed = f"{limit:.4g} m" if length else f"{np.degrees(np.arcsin(GAP_OF_DIRECTIONS)):.4g} deg"
                stated = "allowed by `assembly: {largest_gap: …}`" if asked is not None else "allowed"
                further = (
                    f"if it is meant to be closed from there, write `assembly: {{largest_gap: {1.1 * gap:.2g} m}}`"
                )
                message = (
                    f"contradicts the given positions of its bodies: {system.rows[row]} is open by {said}, more than the "
                    f"{allowed} {stated}; {further if length else TURN_A_MARKER}"
                )
                faults.append(Fault.at(f"joints.{joint.name}", message))
                break
    refuse(faults)


def _rows_by_owner(system: System) -> dict[str, list[int]]:
    """Rows of each joint, coupling and driver, in their order."""
    rows: dict[str, list[int]] = {}
    for row, owner in enumerate(system.row_owner):
        rows.setdefault(owner, []).append(row)
    return rows


def _named(
    names: tuple[str, ...], lengths: Array, angles: Array, least_length: float, least_angle: float
) -> tuple[tuple[str, float, float], ...]:
    """(name, length, angle) of the bodies whose vectors are longer than the least ones."""
    sizes = zip(names, np.linalg.norm(lengths, axis=1), np.linalg.norm(angles, axis=1), strict=True)
    return tuple((name, float(d), float(a)) for name, d, a in sizes if d > least_length or a > least_angle)


def _moves(system: System, given: Array, q: Array) -> tuple[tuple[str, float, float], ...]:
    change = change_between(given, q)
    return _named(system.bodies, change[:, :3], change[:, 3:], velocities.ROUND_OFF * system.size, velocities.ROUND_OFF)


def _refuse_open_joints(machine: MachineRecord, motion: MotionEquations, wishes: Wishes) -> None:
    system, record = motion.system, motion.system.record
    share = np.abs(record.constraints.C / record.constraints.scale)[: system.machine_rows]
    faults = []
    parallel = {joint.name: k for k, joint in enumerate(machine.joints) if JOINTS[joint.type].of(joint).parallel}
    for owner, rows in _rows_by_owner(system).items():
        worst = rows[int(np.argmax(share[rows]))]
        if not share[worst] <= OPEN:
            faults.append(Fault.at(f"{velocities.section_of(system, owner)}.{owner}", _gap(system, worst)))
        elif owner in parallel:
            first = int(record.joints.first_marker[parallel[owner]])
            if record.markers.A[first, :, 2] @ record.markers.A[first + 1, :, 2] < 0.0:
                message = "the z axes of its two markers point in opposite directions; turn one of them round"
                faults.append(Fault.at(f"joints.{owner}", message))
    for name, q, wanted in wishes.values:
        got = float(record.coordinates.value[q])
        if abs(got - wanted) > OPEN * max(1.0, system.size, abs(wanted)):
            joint, _, coordinate = name.partition(".")
            message = f"the start value {wanted:.6g} of {name} cannot be reached: the nearest value is {got:.6g}"
            faults.append(Fault.at(f"joints.{joint}.start.{coordinate}", message))
    refuse(faults)


def _gap(system: System, row: int) -> str:
    """What is left open at a row, and what to look at."""
    left = abs(float(system.record.constraints.C[row]))
    name = system.rows[row]
    if system.row_units[row] == "m":
        advice = "check the positions of its bodies and the lengths between their joints"
        return f"cannot be closed: a gap of {left:.6g} m is left at {name}; {advice}"
    if system.row_units[row] == "rad":
        advice = "check what is driven or coupled against what the joints allow"
        return f"cannot be closed: {np.degrees(left):.4g} deg are left at {name}; {advice}"
    angle = np.degrees(np.arcsin(min(left, 1.0)))
    return (
        f"cannot be closed: the two directions of {name} are {angle:.4g} deg away from a right angle; {TURN_A_MARKER}"
    )


# Mass, centre of mass and inertia of a machine, or of some of its bodies, as assembled, about any marker.


class MassProperties(Struct):
    """mass [kg] of `bodies`; centre_of_mass (3,) [m] from the point of `about`; inertia (3, 3) [kg m²] about this point, central_inertia
    about the centre of mass; all along the axes of `about`. Products carry the minus sign of the tensor: xy = -∫ x y dm.

    principal_moments (3,) [kg m²] about the centre of mass, ascending; principal_axes (3, 3) : a column each.
    """

    about: str
    bodies: tuple[str, ...]
    mass: float
    centre_of_mass: Array
    inertia: Array
    central_inertia: Array
    principal_moments: Array
    principal_axes: Array

    def summary(self) -> dict[str, Any]:
        """For programs."""
        facts = {name: getattr(self, name) for name in self.__dataclass_fields__}
        return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in facts.items()}

    def __str__(self) -> str:
        def row(values: Array) -> str:
            size = float(np.abs(self.inertia).max(initial=0.0))
            return ", ".join(f"{value if abs(value) > 1e-12 * size else 0.0:.6g}" for value in values)

        x, y, z = (f"{value if abs(value) > 1e-15 else 0.0:.6g}" for value in self.centre_of_mass)
        return "\n".join(
            [
                f"mass of {', '.join(self.bodies)}: {self.mass:.9g} kg, about {self.about} and along its axes",
                f"  centre of mass: ({x}, {y}, {z}) m",
                *(f"  inertia {axis}: {row(values)} kg m²" for axis, values in zip("xyz", self.inertia, strict=True)),
                f"  principal moments about the centre of mass: {row(self.principal_moments)} kg m²",
            ]
        )


def mass_properties(machine: MachineRecord, about: str = GROUND, bodies: Sequence[str] = ()) -> MassProperties:
    """Of these bodies, or of all but the rotors of `rotor_inertia`. about : a marker, a body (its frame), or the ground (the global frame).

    Raises ModelError for unknown names, for beams, and where the machine cannot be assembled.
    """
    faults = [
        _fault("bodies", unknown_name("body", name, list(machine.body_named)))
        for name in bodies
        if name not in machine.body_named
    ]
    known = [GROUND, *machine.marker_named, *machine.body_named]
    if about not in known:
        faults.append(_fault("about", unknown_name("marker or body", about, known)))
    if machine.beams and not bodies:
        faults.append(_fault("bodies", "beams have no part in mass properties: name the bodies"))
    refuse(faults)
    motion = equations(machine)
    motion.evaluate(0.0, assemble(machine, motion).y)
    system = motion.system
    place, axes = _frame(machine, system, about)
    rotors = rotors_of(machine)
    chosen = tuple(bodies) or tuple(name for name in machine.body_named if name not in rotors)
    parts = system.record.bodies
    mass, moment, inertia = 0.0, np.zeros(3), np.zeros((3, 3))
    for name in chosen:
        b = system.bodies.index(name)
        A, m = parts.A[b], float(parts.mass[b])
        centre = axes.T @ (parts.R[b] + A @ parts.centre_b[b] - place)
        turned = axes.T @ A
        if not system.point_masses[b]:
            inertia += turned @ parts.inertia_b[b] @ turned.T
        inertia += point_mass_inertia(m, centre)
        mass, moment = mass + m, moment + m * centre
    centre = moment / mass
    central = inertia - point_mass_inertia(mass, centre)
    moments, directions = np.linalg.eigh(central)
    return MassProperties(about, chosen, mass, centre, inertia, central, moments, directions)


def _frame(machine: MachineRecord, system: System, about: str) -> tuple[Array, Array]:
    """(place, axes as columns) of a marker, a body or the ground."""
    marker = machine.marker_named.get(about)
    body = marker.body if marker is not None else about
    place, axes = (np.zeros(3), np.eye(3)) if marker is None else marker_frame(marker)
    if body == GROUND:
        return place, axes
    b = system.bodies.index(body)
    A = system.record.bodies.A[b]
    return system.record.bodies.R[b] + A @ place, A @ axes


def _fault(field: str, message: str) -> Fault:
    return Fault.at(f"mass_properties.{field}", message)
