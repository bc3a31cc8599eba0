"""Handles of a machine: joint coordinates, angles of spherical joints, and places and angles of bodies that nothing else moves."""

from collections.abc import Iterator
from typing import Final, Protocol

import numpy as np

from nivel.analysis.assembly.closing import Aim
from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.named_freedoms import Freedoms, coordinate_derivatives
from nivel.elements.joints import JOINTS
from nivel.lazy import Struct, scipy
from nivel.machine.machine_record import MachineRecord
from nivel.results.motion import rotation_matrices
from nivel.system.system import Array

# Relative pose of two body frames, as numbers that can be wished for one by one.
#
# The turn from the first to the second frame is R = R_x(a) R_y(b) R_z(c): angles a, b, c about x, y, z, each about the axis that the turns
# before it have left (Cardan angles; Haug 1989, section 9.3 has the same for z, x, z). A turn has two such triples, (a, b, c) and
# (a + π, π - b, c + π); the one nearest to the angles shown before is taken, so that every angle goes all round without a jump.

ANGLES: Final = (0, 1, 2)  # axes of a frame: its three angles [rad], then its three coordinates [m]
SHIFTS: Final = (3, 4, 5)
AXIS_NAMES: Final = ("angle_x", "angle_y", "angle_z", "x", "y", "z")
UPRIGHT: Final = 1e-6  # cosine of b below which a and c turn about one axis
ALL_ANGLES: Final = frozenset(ANGLES)


class TurnedFrame(Struct):
    """The frame of body `second` seen from that of body `first`, -1 the ground; 3x3 axes of both frames in their bodies.

    Its coordinates x, y, z are those of the second body's origin and make sense from the ground only.
    """

    name: str
    first: int
    second: int
    first_axes: Array
    second_axes: Array

    def turn(self, q: Array) -> Array:
        """(3, 3) R from the first to the second frame at positions q (7 B,)."""
        return self._axes_in_space(q, 0).T @ self._axes_in_space(q, 1)

    def values(self, q: Array, near: Array) -> Array:
        """(6,) three angles, nearest to those of `near` (6,), and three coordinates."""
        place = q.reshape(-1, 7)[self.second, :3]
        return np.append(nearest_angles(self.turn(q), near[:3]), place)

    def turning(self, q: Array) -> Iterator[tuple[int, Array]]:
        """Body and (3, 6): derivative of the turn, as an angular velocity in first axes, for (Ṙ, ω̄) of the body."""
        back = self._axes_in_space(q, 0).T
        for body, sign in ((self.second, 1.0), (self.first, -1.0)):
            if body >= 0:
                yield (
                    body,
                    np.hstack([np.zeros((3, 3)), sign * back @ rotation_matrices(q.reshape(-1, 7)[[body], 3:])[0]]),
                )

    def _axes_in_space(self, q: Array, side: int) -> Array:
        body, axes = (self.first, self.first_axes) if side == 0 else (self.second, self.second_axes)
        return axes if body < 0 else rotation_matrices(q.reshape(-1, 7)[[body], 3:])[0] @ axes


class FrameAim(Struct):
    """Values wished for some axes of a frame: {axis: value}. size : [m] a length to weigh metres against radians."""

    frame: TurnedFrame
    values: dict[int, float]
    near: Array
    size: float

    @property
    def scale(self) -> Array:
        """(k,) what counts as one of each error."""
        return np.array([1.0 if axis in ANGLES else self.size for axis in sorted(self.values)])

    def error(self, q: Array) -> Array:
        """(k,) how far the values are from those wished for, at positions q."""
        if self._is_whole:
            turn = scipy.spatial.transform.Rotation
            wanted = turn.from_euler("XYZ", [self.values[axis] for axis in ANGLES]).as_matrix()
            turned = wanted @ turn.from_matrix(wanted.T @ self.frame.turn(q)).as_rotvec()
            return np.append(turned, [self._shift(q, axis) for axis in sorted(self.values) if axis in SHIFTS])
        now = self.frame.values(q, self.near)
        return np.array(
            [
                _wrapped(now[axis] - self.values[axis]) if axis in ANGLES else self._shift(q, axis)
                for axis in sorted(self.values)
            ]
        )

    def rows(self, q: Array) -> Iterator[tuple[int, int, Array]]:
        """Row, body and (6,) derivatives of the errors for (Ṙ, ω̄) of the body."""
        chosen = sorted(self.values)
        rates = np.eye(3) if self._is_whole else rates_of_angles(self.frame.values(q, self.near)[:3])
        for body, block in self.frame.turning(q):
            for row, axis in enumerate(chosen):
                if axis in ANGLES:
                    yield row, body, rates[axis] @ block
        for row, axis in enumerate(chosen):
            if axis in SHIFTS:
                yield row, self.frame.second, np.eye(6)[axis - 3]

    @property
    def _is_whole(self) -> bool:
        """All angles are wished for: then the turn is aimed at as a whole, which is never singular."""
        return set(self.values) >= ALL_ANGLES

    def _shift(self, q: Array, axis: int) -> float:
        return float(q.reshape(-1, 7)[self.frame.second, axis - 3]) - self.values[axis]


def nearest_angles(R: Array, near: Array) -> Array:
    """(3,) angles of the turn R that are nearest to `near`."""
    b = np.arctan2(R[0, 2], np.hypot(R[0, 0], R[0, 1]))
    upright = np.hypot(R[0, 0], R[0, 1]) < UPRIGHT
    a = near[0] if upright else np.arctan2(-R[1, 2], R[2, 2])
    candidates = []
    for first, second in ((a, b), (a + np.pi, np.pi - b)):
        rest = np.array([0.0, np.cos(first), np.sin(first)]) @ R  # second row of R_x(-a) R: (sin c, cos c, 0)
        angles = np.array([first, second, np.arctan2(rest[0], rest[1])])
        candidates.append(near + _wrapped(angles - near))
    return min(candidates, key=lambda angles: float(np.sum((angles - near) ** 2)))


def rates_of_angles(angles: Array) -> Array:
    """(3, 3) ȧ, ḃ, ċ for an angular velocity in first axes: the inverse of [e_x, R_x e_y, R_x R_y e_z]; large near b = ±90°."""
    (ca, cb, _), (sa, sb, _) = np.cos(angles), np.sin(angles)
    cb = cb if abs(cb) > UPRIGHT else UPRIGHT
    return np.array([[1.0, sa * sb / cb, -ca * sb / cb], [0.0, ca, sa], [0.0, -sa / cb, ca / cb]])


def _wrapped(angle: Array) -> Array:
    """Between -π and π."""
    return (angle + np.pi) % (2.0 * np.pi) - np.pi


class Wish(Struct):
    """Values of joint coordinates (name, coordinate, wanted), and aims: as `closing.Wishes` has them."""

    values: tuple[tuple[str, int, float], ...] = ()
    aims: tuple[Aim, ...] = ()


class Handle(Protocol):
    """Numbers of one joint or body that can be wished for together; n of them."""

    @property
    def names(self) -> tuple[str, ...]:
        """Of the numbers."""
        ...

    @property
    def units(self) -> tuple[str, ...]:
        """rad or m."""
        ...

    def state(self, motion: MotionEquations, q: Array, before: Array) -> Array:
        """All that is known of the handle at positions q (7 B,), which were last evaluated; `before` : the same a little earlier."""
        ...

    def values(self, state: Array) -> Array:
        """(n,) the numbers."""
        ...

    def near(self, state: Array, k: int, value: float) -> Array:
        """The state with one number replaced."""
        ...

    def derivatives(self, motion: MotionEquations, q: Array, state: Array) -> Array:
        """(n, 6 B) lengths in machine lengths."""
        ...

    def wish(self, wanted: Array, state: Array) -> Wish:
        """For all numbers (n,)."""
        ...

    def single(self, k: int, value: float, state: Array) -> Wish:
        """For one number, whatever becomes of the others."""
        ...


class MeasuredHandle(Struct):
    """A joint coordinate. place : among the coordinates that are measured."""

    name: str
    unit: str
    place: int

    @property
    def names(self) -> tuple[str, ...]:
        return (self.name,)

    @property
    def units(self) -> tuple[str, ...]:
        return (self.unit,)

    def state(self, motion: MotionEquations, q: Array, before: Array) -> Array:
        return motion.system.record.coordinates.value[[self.place]].copy()

    def values(self, state: Array) -> Array:
        return state

    def near(self, state: Array, k: int, value: float) -> Array:
        return np.array([value])

    def derivatives(self, motion: MotionEquations, q: Array, state: Array) -> Array:
        return coordinate_derivatives(motion, [self.place])

    def wish(self, wanted: Array, state: Array) -> Wish:
        return self.single(0, float(wanted[0]), state)

    def single(self, k: int, value: float, state: Array) -> Wish:
        return Wish(values=((self.name, self.place, value),))


class FrameHandle(Struct):
    """Some axes of a frame: angles counted from the assembled position, coordinates from the global origin.

    size : [m] the machine's length.
    """

    frame: TurnedFrame
    axes: tuple[int, ...]
    size: float

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(f"{self.frame.name}.{AXIS_NAMES[axis]}" for axis in self.axes)

    @property
    def units(self) -> tuple[str, ...]:
        return tuple("rad" if axis in ANGLES else "m" for axis in self.axes)

    def state(self, motion: MotionEquations, q: Array, before: Array) -> Array:
        return self.frame.values(q, before)

    def values(self, state: Array) -> Array:
        return state[list(self.axes)]

    def near(self, state: Array, k: int, value: float) -> Array:
        out = state.copy()
        out[self.axes[k]] = value
        return out

    def derivatives(self, motion: MotionEquations, q: Array, state: Array) -> Array:
        """Where all three angles are here, of the turn about the three axes: that is never singular."""
        return self._all_derivatives(q, state, whole=set(ANGLES) <= set(self.axes))[list(self.axes)]

    def wish(self, wanted: Array, state: Array) -> Wish:
        values = dict(zip(self.axes, wanted.tolist(), strict=True))
        return Wish(aims=(FrameAim(self.frame, values, state, self.size),))

    def single(self, k: int, value: float, state: Array) -> Wish:
        return Wish(aims=(FrameAim(self.frame, {self.axes[k]: value}, state, self.size),))

    def needed(self, q: Array, state: Array, free: Freedoms) -> "FrameHandle | None":
        """The handle with those axes only that move apart from each other; None where none moves."""
        derivatives = self._all_derivatives(q, state, whole=False)[list(self.axes)]
        chosen = free.independent(derivatives)
        return FrameHandle(self.frame, tuple(self.axes[k] for k in chosen), self.size) if chosen else None

    def _all_derivatives(self, q: Array, state: Array, *, whole: bool) -> Array:
        """(6, 6 B) of all axes; whole : in place of the angles' the angular velocities about the first frame's axes."""
        out = np.zeros((6, len(q) // 7, 6))
        rates = np.eye(3) if whole else rates_of_angles(state[:3])
        for body, block in self.frame.turning(q):
            out[:3, body] += rates @ block
        out[3:, self.frame.second, :3] = self.size * np.eye(3)
        return out.reshape(6, 6 * (len(q) // 7))


def measured_handles(motion: MotionEquations) -> list[MeasuredHandle]:
    """One for each joint coordinate."""
    system = motion.system
    names = system.layout.coordinates["joint_coordinate"]
    places = system.record.joints.coordinate
    return [
        MeasuredHandle(name, unit, int(place))
        for name, unit, place in zip(names, system.coordinate_units, places, strict=True)
    ]


def further_handles(machine: MachineRecord, motion: MotionEquations, q: Array, free: Freedoms) -> Iterator[FrameHandle]:
    """Angles of spherical joints, then coordinates and angles of bodies, for motions that none of those before makes.

    free : what can move while all joint coordinates stay, in the positions q last evaluated.
    """
    for handle in (*_balls(machine, motion, q), *_bodies(motion, q)):
        if not len(free.directions):
            return
        state = handle.state(motion, q, np.zeros(6))
        needed = handle.needed(q, state, free)
        if needed is not None:
            yield needed
            free = free.without(needed.derivatives(motion, q, state))


def _balls(machine: MachineRecord, motion: MotionEquations, q: Array) -> Iterator[FrameHandle]:
    markers, ground = motion.system.record.markers, motion.system.body_count
    for k, joint in enumerate(machine.joints):
        if not JOINTS[joint.type].is_ball:
            continue
        first = int(motion.system.record.joints.first_marker[k])
        bodies = [int(markers.body[m]) for m in (first, first + 1)]
        turned = bodies[1] >= ground  # the ground may be either body; what moves is the second of the frame
        one, two = bodies[::-1] if turned else bodies
        one = -1 if one >= ground else one
        marker = first + 1 if turned else first
        yield _handle(motion, joint.name, one, two, markers.frame_b[marker].copy(), q, ANGLES)


def _bodies(motion: MotionEquations, q: Array) -> Iterator[FrameHandle]:
    system = motion.system
    for body, name in enumerate(system.bodies):
        axes = SHIFTS if system.point_masses[body] else (*SHIFTS, *ANGLES)
        yield _handle(motion, name, -1, body, np.eye(3), q, axes)


def _handle(
    motion: MotionEquations, name: str, first: int, second: int, first_axes: Array, q: Array, axes: tuple[int, ...]
) -> FrameHandle:
    """With all angles zero at positions q."""
    unturned = TurnedFrame(name, first, second, first_axes, np.eye(3))
    frame = TurnedFrame(name, first, second, first_axes, unturned.turn(q).T)
    return FrameHandle(frame, axes, motion.system.size)
