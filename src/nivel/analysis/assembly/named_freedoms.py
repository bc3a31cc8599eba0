"""Every freedom of a machine in words: bodies that are free, bodies that turn idly, joint coordinates and what moves with them."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import Joint
from nivel.files.joint_parts import rotors_of
from nivel.lazy import Struct
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import UnknownCoordinateError, resolve
from nivel.system.states.relative import bodies_of
from nivel.system.system import Array, System

# Degrees of freedom in the present position, and the numbers of the state that may be chosen independently.

WITHOUT_MOTION: Final = 1e-7  # a number whose derivative is below this share cannot move
DEPENDENT: Final = 1e-6  # what is left of a derivative that follows from others
RANK: Final = 1e-9  # a singular value below this share of the largest counts as zero
LARGEST: Final = 1_000_000  # entries of the Jacobian up to which free motions are found


class Freedoms(Struct):
    """Motions (Ṙ, ω̄) of all bodies, lengths in machine lengths. directions (f, 6 B) : unit motions that the constraints allow."""

    directions: Array

    def left(self, derivatives: Array) -> Array:
        """(n, f) what the constraints leave of the derivatives (n, 6 B) of some numbers."""
        return derivatives @ self.directions.T

    def movable(self, derivatives: Array) -> NDArray[np.bool_]:
        """(n,) whether each number changes in some motion that the constraints allow."""
        size = np.maximum(np.linalg.norm(derivatives, axis=1), 1e-300)
        return np.linalg.norm(self.left(derivatives), axis=1) > WITHOUT_MOTION * size

    def without(self, derivatives: Array) -> "Freedoms":
        """The motions in which these numbers stay."""
        left = self.left(derivatives)
        if not left.size:
            return self
        _, size, every = np.linalg.svd(left)
        rank = int(np.sum(size > DEPENDENT * max(float(np.linalg.norm(derivatives, axis=1).max()), 1e-300)))
        return Freedoms(every[rank:] @ self.directions)

    def independent(self, derivatives: Array) -> list[int]:
        """Those of some numbers that can be chosen apart from each other, taken in the order of how much they move."""
        left = self.left(derivatives)
        least = DEPENDENT * float(np.linalg.norm(derivatives, axis=1).max(initial=0.0))
        chosen: list[int] = []
        while left.size:
            size = np.linalg.norm(left, axis=1)
            best = int(np.argmax(size > 0.999 * size.max()))  # of equal ones the first
            if size[best] <= max(least, 1e-12):
                break
            chosen.append(best)
            along = left[best] / size[best]
            left = left - np.outer(left @ along, along)
        return sorted(chosen)

    def keeping(self, wished: Array, others: Sequence[Array]) -> list[int]:
        """Which of `others`, each (k, 6 B), may stay while the `wished` (n, 6 B) changes: none follows from it, nor from those before."""
        basis: list[Array] = []
        for row in self.left(wished):
            _extend(basis, row, 1e-12)
        chosen = []
        for k, rows in enumerate(others):
            longer = list(basis)
            sizes = DEPENDENT * np.linalg.norm(rows, axis=1)
            if all(_extend(longer, row, max(size, 1e-12)) for row, size in zip(self.left(rows), sizes, strict=True)):
                basis = longer
                chosen.append(k)
        return chosen


def _extend(basis: list[Array], row: Array, least: float) -> bool:
    """Add to an orthonormal basis what is left of a row, and whether that is more than `least`."""
    rest = row.copy()
    for direction in basis:
        rest -= (rest @ direction) * direction
    length = float(np.linalg.norm(rest))
    if length > least:
        basis.append(rest / length)
    return length > least


def freedoms(motion: MotionEquations) -> Freedoms | None:
    """In the position last evaluated; None of machines that are too large for it."""
    system = motion.system
    if system.machine_rows * 6 * system.body_count > LARGEST:
        return None
    directions = np.eye(6 * system.body_count)
    if system.machine_rows:
        J = motion.jacobian_in_lengths()
        _, size, every = np.linalg.svd(J / np.maximum(np.linalg.norm(J, axis=1, keepdims=True), 1e-300))
        directions = every[int(np.sum(size > RANK * size[0])) :]
    return Freedoms(directions)


def coordinate_derivatives(motion: MotionEquations, places: Sequence[int]) -> Array:
    """(n, 6 B) derivatives of joint coordinates, lengths in machine lengths."""
    system = motion.system
    row, body, block = motion.jacobian_blocks(places)
    own = row >= system.machine_rows
    block = block[own].copy()
    block[:, :3] *= system.size
    J = np.zeros((len(places), system.body_count, 6))
    np.add.at(J, (row[own] - system.machine_rows, body[own]), block)
    return J.reshape(len(places), 6 * system.body_count)


def touches_ground(machine: MachineRecord, system: System) -> bool:
    """Whether a joint, a driver of a marker or a force joins a body to the ground."""
    joined = {body for joint in machine.joints for body in bodies_of(machine, joint)}
    for driver in machine.drivers:
        if driver.marker is not None:
            seen = driver.reference
            joined |= {machine.marker_named[name].body for name in (driver.marker, seen) if name is not None}
            joined |= {GROUND} if seen is None else set()
    return GROUND in joined or any(system.body_count in each.bodies for each in system.coupled)


def idle_angles(machine: MachineRecord) -> frozenset[str]:
    """Angles of cylindrical joints that no driver, coupling or force acts on, as `JOINT.angle`."""
    used = set()
    for each in (*machine.drivers, *machine.forces, *machine.couplings):
        references = (getattr(each, "coordinate", None), *(getattr(each, "coordinates", None) or ()))
        for reference in (*references, *(getattr(each, "joints", None) or ())):
            if isinstance(reference, str):
                used.add(_resolved(machine, reference))
    return frozenset(f"{joint.name}.angle" for joint in machine.joints if _is_bore(joint)) - used


def _resolved(machine: MachineRecord, reference: str) -> str:
    try:
        return ".".join(resolve(reference, machine.joints))
    except UnknownCoordinateError:  # only an angle can be meant
        return f"{reference}.angle"


def without_turn(machine: MachineRecord, joints: Sequence[str], axis: Array) -> str:
    """Which of the `joints` on the `axis` (3,) of a turn to change so that it stops, in words; empty where none is known."""
    through = [joint for joint in machine.joints if joint.name in joints]
    bores = [joint for joint in through if _is_bore(joint)]
    balls = [joint for joint in through if JOINTS[joint.type].is_ball and JOINTS[joint.type].without_turn]
    fixed = [joint for joint in bores if GROUND in (joint.bodies or ())]
    if fixed or (bores and not balls):
        bore = (fixed or bores)[0]
        return f"make {bore.name} {JOINTS[bore.type].without_turn}"
    if not balls:
        return ""
    change = f"make {balls[0].name} {JOINTS[balls[0].type].without_turn}"
    if balls[0].markers is not None:
        return f"{change}, with the z axes of its markers across that axis"
    return f"{change}, with `axes: {_across(axis)}`"


def _is_bore(joint: Joint) -> bool:
    """Whether it slides and turns about one axis, and a kind that only slides can stand in its place."""
    return "angle" in joint.coordinates and bool(JOINTS[joint.type].without_turn)


def _across(axis: Array) -> str:
    """Two directions across `axis` and each other, as they are written in a file."""
    along = axis / np.linalg.norm(axis)
    first = np.eye(3)[int(np.argmin(np.abs(axis)))]
    across = np.asarray(np.cross(along, first), dtype=np.float64)
    first = across / np.linalg.norm(across)
    return "[" + ", ".join(_written(each) for each in np.array([first, np.cross(axis, first)])) + "]"


def _written(direction: Array) -> str:
    return "[" + ", ".join(f"{round(float(each), 6) + 0.0:g}" for each in direction) + "]"


MOST: Final = 60  # freedoms that are named
STILL: Final = 1e-6  # share of the largest motion below which a body rests
MARKED: Final = 0.05  # share of the largest motion of a coordinate from which another counts as much
NEAR: Final = 1e-6  # share of the machine's size within which a point is on an axis


class Freedom(Struct):
    """One freedom or several: `count`, in words, and how it can be removed where nothing is meant to move so (empty: by a driver)."""

    count: int
    words: str
    remedy: str = ""


def named_freedoms(machine: MachineRecord, motion: MotionEquations) -> tuple[Freedom, ...]:
    """The freedoms in the position last evaluated, all joint coordinates measured; together they count as many as the machine has.

    None of machines with beams or bodies that bend, nor of those with more than MOST freedoms.
    """
    if machine.beams or machine.is_flexible:
        return ()
    free = freedoms(motion)
    if free is None:
        return ()
    free = _without_turns_of_points(free, motion)
    return () if len(free.directions) > MOST else tuple(_Names(machine, motion, free).all())


def _without_turns_of_points(free: Freedoms, motion: MotionEquations) -> Freedoms:
    """Point masses have no turns."""
    points = np.flatnonzero(motion.system.point_masses)
    rows = np.zeros((3 * len(points), 6 * motion.system.body_count))
    for k, body in enumerate(points):
        rows[3 * k : 3 * k + 3, 6 * body + 3 : 6 * body + 6] = np.eye(3)
    return free.without(rows) if len(points) else free


class _Names:
    """Takes freedoms out of those that are left, the plainest first."""

    def __init__(self, machine: MachineRecord, motion: MotionEquations, free: Freedoms) -> None:
        self.machine, self.motion, self.left = machine, motion, free
        self.system, self.record = motion.system, motion.system.record
        geared = {coupling.name for coupling in machine.couplings}  # without play
        self.rotors = [rotor for rotor, (gear, _) in rotors_of(machine).items() if gear in geared]
        self.labels = list(self.system.layout.coordinates["joint_coordinate"])
        self.idle = np.array([label in idle_angles(machine) for label in self.labels], dtype=bool)
        places = [int(index) for index in self.record.joints.coordinate]
        self.coordinates = coordinate_derivatives(motion, places) if places else np.zeros((0, free.directions.shape[1]))

    def all(self) -> list[Freedom]:
        bodies = range(self.system.body_count)
        found = [freedom for body in bodies for freedom in self._alone(body)]
        found += [freedom for body in bodies for freedom in self._between_joints(body)]
        carried = self._carried()
        found += [*self._of_coordinates(), *carried, *self._together()]
        if len(self.left.directions):
            moving = self._moving(self.left.directions)
            found.append(Freedom(len(self.left.directions), f"{moving}, which no joint coordinate shows"))
        return found

    def _alone(self, body: int) -> list[Freedom]:
        """Motions of one body while everything else rests, and no joint coordinate changes."""
        others = np.delete(np.eye(6 * self.system.body_count), np.s_[6 * body : 6 * body + 6], axis=0)
        own = self.left.without(np.vstack([others, self._scaled_coordinates()]))
        count, name = len(own.directions), self.system.bodies[body]
        if not count:
            return []
        self._take(own.directions)
        if count == 6 or (count == 3 and self.system.point_masses[body]):
            return [Freedom(count, f"{name} is free in space")]
        motions = own.directions[:, 6 * body : 6 * body + 6]
        if count == 1:
            return [self._screw(body, motions[0])]
        point = self._common_point(body, motions) if count == 3 else ""
        return [Freedom(count, f"{name} turns in every direction about {point}" if point else f"{name} moves alone")]

    def _between_joints(self, body: int) -> list[Freedom]:
        """The turn of a body about the line of its joints, as of a piston: an angle shows it, and nothing uses that."""
        others = np.delete(np.eye(6 * self.system.body_count), np.s_[6 * body : 6 * body + 6], axis=0)
        own = self.left.without(np.vstack([others, self._scaled_coordinates()[~self.idle]]))
        if len(own.directions) != 1:
            return []
        named = self._screw(body, own.directions[0, 6 * body : 6 * body + 6])
        if " and " not in named.words.partition(", through ")[2]:
            return []
        self._take(own.directions)
        return [named]

    def _carried(self) -> list[Freedom]:
        """Six motions of every body that no joint holds, the heaviest of those that hang together, with what it carries."""
        whole, found = self.left.directions, []
        for body in np.argsort(-self.record.bodies.mass[: self.system.body_count], kind="stable"):
            place = np.s_[6 * body : 6 * body + 6]
            own = self.left.directions[:, place]
            if len(own) < 6 or np.linalg.matrix_rank(own, tol=DEPENDENT) < 6:
                continue
            moving = self._moving(np.linalg.pinv(whole[:, place]) @ whole)
            found.append(Freedom(6, f"{self.system.bodies[body]} is free in space: {moving}"))
            self.left = self.left.without(np.eye(6 * self.system.body_count)[place])
        return found

    def _together(self) -> list[Freedom]:
        """The turn of some bodies as one, where that is all that is left."""
        if len(self.left.directions) != 1:
            return []
        motions = self.left.directions[0].reshape(-1, 6)
        bodies = np.flatnonzero(np.linalg.norm(motions, axis=1) > STILL)
        record, size = self.record.bodies, self.system.size
        omega = np.einsum("kij,kj->ki", record.A[bodies], motions[bodies, 3:])
        # of the point of each body that is at the origin
        velocity = motions[bodies, :3] * size - np.cross(omega, record.R[bodies])
        apart = np.abs(omega - omega[0]).max() * size + np.abs(velocity - velocity[0]).max()
        first = int(bodies[0])
        named = self._screw(first, motions[first])
        if apart > STILL * size or " turns about " not in named.words:
            return []
        self._take(self.left.directions)
        where = named.words.partition(" turns about ")[2].replace("its own axis", "their axis")
        moving = self._moving(motions.reshape(1, -1)).replace(" move", " turn together")
        return [Freedom(1, f"{moving} about {where}", named.remedy)]

    def _scaled_coordinates(self) -> Array:
        return self.coordinates / np.maximum(np.linalg.norm(self.coordinates, axis=1, keepdims=True), 1e-300)

    def _take(self, directions: Array) -> None:
        self.left = self.left.without(directions)

    def _screw(self, body: int, motion: Array) -> Freedom:
        """A motion (Ṙ over the size, ω̄) of a body as a turn about an axis, a way, or a screw."""
        name, size = self.system.bodies[body], self.system.size
        velocity, omega = motion[:3] * size, self.record.bodies.A[body] @ motion[3:]
        rate = float(np.linalg.norm(omega))
        if rate * size < STILL * np.linalg.norm(velocity):
            return Freedom(1, f"{name} moves along {_direction(velocity)}")
        axis = omega / rate
        point = self.record.bodies.R[body] + np.cross(axis, velocity) / rate
        if abs(axis @ velocity) > STILL * rate * size:
            return Freedom(1, f"{name} moves along and turns about {_direction(axis)}")
        joints = [joint for joint, at in self._joints_at(body) if _on_axis(at, point, axis, NEAR * size)]
        centre = self.record.bodies.R[body] + self.record.bodies.A[body] @ self.record.bodies.centre_b[body]
        own = "its own axis" if _on_axis(centre, point, axis, NEAR * size) else f"the axis {_direction(axis)}"
        through = f", through {' and '.join(joints)}" if joints else ""
        return Freedom(1, f"{name} turns about {own}{through}", without_turn(self.machine, joints, axis))

    def _joints_at(self, body: int) -> list[tuple[str, Array]]:
        """The joints of a body, and where they hold it."""
        found = []
        for k, joint in enumerate(self.system.joints):
            first = int(self.record.joints.first_marker[k])
            at = [marker for marker in (first, first + 1) if int(self.record.markers.body[marker]) == body]
            found += [(joint, self.record.markers.r[marker]) for marker in at]
        return found

    def _common_point(self, body: int, motions: Array) -> str:
        """The joint about whose point these motions turn the body; empty where there is none."""
        A = self.record.bodies.A[body]
        for joint, at in self._joints_at(body):
            arm = at - self.record.bodies.R[body]
            speeds = [motion[:3] * self.system.size + np.cross(A @ motion[3:], arm) for motion in motions]
            if np.max(np.abs(speeds)) < NEAR * self.system.size:
                return joint
        return ""

    def _of_coordinates(self) -> list[Freedom]:
        """Joint coordinates that can be chosen apart from each other, with the bodies that each moves alone."""
        chosen = self._chosen()
        if not chosen:
            return []
        seen = self.left.left(self.coordinates[chosen])  # (chosen, left)
        found, each = [], np.linalg.pinv(seen)
        for k, place in enumerate(chosen):
            direction = each[:, k] @ self.left.directions
            found.append(Freedom(1, f"{self.labels[place]}: {self._moving(direction[None])}"))
        _, size, every = np.linalg.svd(seen)
        rank = int(np.sum(size > DEPENDENT * size[0]))
        self.left = Freedoms(every[rank:] @ self.left.directions)
        return found

    def _chosen(self) -> list[int]:
        """Independent joint coordinates: those that stand first, unless they hardly move."""
        left, chosen = self.left.left(self.coordinates), []
        least = DEPENDENT * float(np.linalg.norm(self.coordinates, axis=1).max(initial=0.0))
        while left.size:
            sizes = np.linalg.norm(left, axis=1)
            if sizes.max() <= max(least, 1e-12):
                break
            chosen.append(int(np.argmax(sizes > MARKED * sizes.max())))
            along = left[chosen[-1]] / sizes[chosen[-1]]
            left = left - np.outer(left @ along, along)
        return chosen

    def _moving(self, directions: Array) -> str:
        """The bodies that move in these motions, in words."""
        sizes = np.linalg.norm(directions.reshape(-1, self.system.body_count, 6), axis=(0, 2))
        moving = sizes > STILL * sizes.max()
        names = [
            name for name, moves in zip(self.system.bodies, moving, strict=True) if moves and name not in self.rotors
        ]
        if len(names) == 1:
            return f"{names[0]} moves"
        if len(names) == self.system.body_count - len(self.rotors) > 3:
            return "all bodies move"
        return f"{', '.join(names[:-1])} and {names[-1]} move"


def _on_axis(at: Array, point: Array, axis: Array, near: float) -> bool:
    return float(np.linalg.norm(np.cross(at - point, axis))) < near


def _direction(vector: Array) -> str:
    unit = vector / np.linalg.norm(vector)
    if unit[int(np.argmax(np.abs(unit)))] < 0:
        unit = -unit
    return "(" + ", ".join(f"{round(float(each), 6) + 0.0:.4g}" for each in unit) + ")"
