"""Parts of a machine against their own motion and their own energy: a flywheel hides no pendulum."""

import re
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from nivel.judge.after.checks.energy import BALANCE
from nivel.judge.after.checks.modes import BACK
from nivel.judge.after.report import ESTIMATE, STEPS, Check
from nivel.judge.after.subject import Run
from nivel.known import Contacts
from nivel.lazy import Struct, is_dataclass
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.bodies.shape import Sphere
from nivel.machine.core.record import Record
from nivel.machine.core.vectors import Array, cross
from nivel.machine.machine_record import MachineRecord
from nivel.results.scales import Readable, largest_mechanical_energy, rotated, speed_of_rest
from nivel.results.trust import Item, Threshold, number, quantity

# Of the size of the machine, or of a radian: motions below it are at rest and have no error of their own.
AT_REST = 1e-6
OWN_MOTION = Threshold(
    1e-2,
    1e-1,
    "Error of a body or of a joint coordinate as a share of its own motion. Below a hundredth it is hardly visible in a curve; "
    "above a tenth the curve is a different one.",
)


class OwnError(Struct):
    """The part that is wrong most against its own motion. error and extent of its motion [units]; of turning up to a radian."""

    name: str
    error: float
    extent: float
    units: str

    @property
    def share(self) -> float:
        return self.error / self.extent


def _look_at_motion(run: Run) -> OwnError | None:
    """Errors of bodies against the extent of their paths and against what they turn by, up to a radian; of joint coordinates against
    their ranges; the largest share."""
    result, estimate = run.result, run.estimate
    if estimate is None:
        return None
    size = run.scales.size
    time = np.array([estimate.time[-1]])
    found: list[OwnError] = []
    if "position" in estimate.values:
        path = result.array("position")
        extent = np.linalg.norm(np.ptp(path, axis=0), axis=-1)
        error = np.linalg.norm(estimate.at("position", time)[0], axis=-1)
        names = result.coordinates["body"]
        moving = np.flatnonzero(extent > AT_REST * size)
        found += [OwnError(names[k], float(error[k]), float(extent[k]), "m") for k in moving]
    if "orientation" in estimate.values:
        theta = result.array("orientation")
        # |θ - θ'| = 2 sin(angle/4), with the sign of θ' that is nearer
        chord = np.sqrt(2.0 * np.maximum(1.0 - np.abs(np.sum(theta * theta[:1], axis=-1)), 0.0))
        turned = np.max(4.0 * np.arcsin(np.clip(0.5 * chord, 0.0, 1.0)), axis=0)
        error = 2.0 * np.linalg.norm(estimate.at("orientation", time)[0], axis=-1)
        names = result.coordinates["body"]
        turning = np.flatnonzero(turned > AT_REST)
        found += [OwnError(names[k], float(error[k]), min(float(turned[k]), 1.0), "rad") for k in turning]
    if "joint_coordinate" in estimate.values:
        extent = np.ptp(result.array("joint_coordinate"), axis=0)
        error = estimate.at("joint_coordinate", time)[0]
        names = result.coordinates[result.variables["joint_coordinate"].dims[1]]
        for k in np.flatnonzero(extent > AT_REST * max(size, 1.0)):
            angle = names[k].rpartition(".")[2].startswith("angle")
            found.append(OwnError(names[k], float(error[k]), float(extent[k]), "rad" if angle else "m"))
    finite = [each for each in found if np.isfinite(each.share)]
    return max(finite, key=lambda each: each.share, default=None)


def _say_motion(found: OwnError) -> Item:
    its = f"{number(found.share)} of its own motion over {number(found.extent)} {found.units}"
    said = f"Parts: {found.name} is off by {number(found.error)} {found.units}, {its}"
    return OWN_MOTION.item("parts", said, found.share, row=found.name)


LEAST = 1e-14  # of the largest energy of the machine: round-off
FRAMES = 20_000  # that are looked at, at most
WORD = re.compile(r"[^\W\d]\w*(?:-\w+)*")
MOST = 50  # parts: machines of more are not looked at


class Part(Struct):
    """Rigid bodies that joints and forces join to each other, and to no others but the ground: mass (b,) [kg], centre (b, 3) [m] and
    inertia (b, 3, 3) [kg m²] about it, body axes; gravity (3,) [m/s²]."""

    bodies: tuple[str, ...]
    mass: Array
    centre: Array
    inertia: Array
    gravity: Array


class PartError(Struct):
    """A part whose energy is wrong by `error` [J] at `time` [s], and its own energy [J]."""

    body: str
    error: float
    energy: float
    time: float

    @property
    def share(self) -> float:
        return self.error / self.energy


def _look_at_energy(run: Run) -> PartError | None:
    """The separate part with the largest share; parts with most of the energy are judged by that of the whole machine."""
    result, slowest = run.result, speed_of_rest(run.result, run.scales.size)
    whole = largest_mechanical_energy(result)
    found = [_error(result, part, slowest, whole) for part in separate_parts(run.machine)]
    return max((each for each in found if each is not None), key=lambda each: each.share, default=None)


def _say_energy(found: PartError) -> Item:
    its = f"{number(found.share)} of its largest energy {quantity(found.energy, 'J')}"
    joined = f"the energy of {found.body} and the bodies joined to it has an error of {its}, at t = {found.time:.6g} s"
    return BALANCE.item("parts", f"Parts: {joined}", found.share, found.time, found.body)


def separate_parts(machine: MachineRecord) -> list[Part]:
    """Those of rigid bodies on which weight alone acts; none of machines with beams or circuits, or of one part."""
    if machine.beams or machine.hydraulics or machine.is_flexible:
        return []
    words: dict[str, set[str]] = {}
    for each in (*machine.joints, *machine.couplings, *machine.drivers, *machine.forces):
        words.setdefault(each.name, set()).update(_words(each))
        if isinstance(each, Contacts) and not each.between:  # all spheres
            words[each.name] |= {body.name for body in machine.bodies if isinstance(body.shape, Sphere)}
    acts_on = {name: _bodies_of(machine, name, words) for name in words}
    groups = _joined([body.name for body in machine.bodies], acts_on.values())
    if not 1 < len(groups) <= MOST:
        return []
    driven = {body for each in (*machine.forces, *machine.drivers) for body in acts_on[each.name]}
    return [_part(machine, group) for group in groups if not driven & set(group)]


def _part(machine: MachineRecord, names: list[str]) -> Part:
    its = [mass_properties(machine.body_named[name]) for name in names]
    return Part(
        bodies=tuple(names),
        mass=np.array([each.mass for each in its]),
        centre=np.array([each.centre_of_mass for each in its]),
        inertia=np.array([each.inertia for each in its]),
        gravity=np.array(machine.gravity, dtype=float),
    )


def _joined(names: list[str], joined: Iterable[set[str]]) -> list[list[str]]:
    """The names in groups: those of a set in one."""
    group = {name: {name} for name in names}
    for each in joined:
        whole = max((group[name] for name in each), key=len, default=set())
        for part in [group[name] for name in each]:
            if part is not whole:  # the smaller one moves, so that long chains take linear time
                whole |= part
                group.update(dict.fromkeys(part, whole))
    groups: dict[int, list[str]] = {}
    for name in names:
        groups.setdefault(id(group[name]), []).append(name)
    return [*groups.values()]


def _bodies_of(machine: MachineRecord, name: str, words: Mapping[str, set[str]]) -> set[str]:
    """Bodies that the element names in any way: itself, by markers, by other elements and their coordinates."""
    left, seen, bodies = set(words[name]), {name}, set[str]()
    while left:
        word = left.pop()
        if word in machine.body_named:
            bodies.add(word)
        elif word in machine.marker_named:
            bodies.add(machine.marker_named[word].body)
        elif word in words and word not in seen:
            seen.add(word)
            left |= words[word]
    return {body for body in bodies if body in machine.body_named}


def _words(element: Any) -> set[str]:
    found: set[str] = set()
    left: list[Any] = [element]
    while left:
        each = left.pop()
        if isinstance(each, str):
            found |= {each, *WORD.findall(each)}
        elif isinstance(each, dict):
            left += each.values()
        elif isinstance(each, list | tuple | set):
            left += each
        elif isinstance(each, Record) or is_dataclass(each):
            left += vars(each).values()
    return found


def _error(result: Readable, part: Part, slowest: float, whole: float) -> PartError | None:
    frames = slice(None, None, max(1, len(result.time) // FRAMES))
    kinetic, potential = _energies(result, part, frames)
    error = np.abs(kinetic + potential - (kinetic + potential)[0])
    own = float(max(kinetic.max(), np.abs(potential - potential[0]).max()))
    if not np.isfinite(own) or own >= 0.5 * whole or own <= max(0.5 * part.mass.sum() * slowest**2, LEAST * whole):
        return None
    k = int(np.argmax(error))
    return PartError(part.bodies[0], float(error[k]), own, float(result.time[frames][k]))


def _energies(result: Readable, part: Part, frames: slice) -> tuple[Array, Array]:
    """Kinetic energy and that of weight (t,) [J]."""
    places = [result.coordinates["body"].index(name) for name in part.bodies]
    position, theta, velocity, omega = (
        result.array(name, frames)[:, places] for name in ("position", "orientation", "velocity", "angular_velocity")
    )
    arm = rotated(theta, part.centre)
    speed, spin = velocity + cross(omega, arm), rotated(theta * BACK, omega)
    turning = np.einsum("tbi,bij,tbj->t", spin, part.inertia, spin, optimize=True)
    kinetic = 0.5 * np.einsum("b,tbi,tbi->t", part.mass, speed, speed, optimize=True) + 0.5 * turning
    return kinetic, -np.einsum(
        "b,tbi,i->t", part.mass, position + arm - (position + arm)[0], part.gravity, optimize=True
    )


CHECKS = (
    Check("parts", Run, _look_at_motion, _say_motion, 320, (ESTIMATE,), "Parts", OWN_MOTION, quiet=True),
    Check("part_energy", Run, _look_at_energy, _say_energy, 310, (STEPS,), line="parts", quiet=True),
)
