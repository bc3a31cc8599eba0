"""Handles of a machine: joint coordinates, angles of spherical joints, and places and angles of bodies that nothing else moves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

import numpy as np

from nivel.analysis.assembly import turned_frame
from nivel.analysis.assembly.closing import Aim
from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.freedoms import Freedoms, coordinate_derivatives
from nivel.elements.joints import JOINTS
from nivel.lazy import dataclass
from nivel.machine.machine_record import MachineRecord
from nivel.system.system import Array


@dataclass(frozen=True)
class Wish:
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


@dataclass(frozen=True)
class MeasuredHandle:
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


@dataclass(frozen=True)
class FrameHandle:
    """Some axes of a frame (`turned_frame`): angles counted from the assembled position, coordinates from the global origin.

    size : [m] the machine's length.
    """

    frame: turned_frame.TurnedFrame
    axes: tuple[int, ...]
    size: float

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(f"{self.frame.name}.{turned_frame.AXIS_NAMES[axis]}" for axis in self.axes)

    @property
    def units(self) -> tuple[str, ...]:
        return tuple("rad" if axis in turned_frame.ANGLES else "m" for axis in self.axes)

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
        return self._all_derivatives(q, state, whole=set(turned_frame.ANGLES) <= set(self.axes))[list(self.axes)]

    def wish(self, wanted: Array, state: Array) -> Wish:
        values = dict(zip(self.axes, wanted.tolist(), strict=True))
        return Wish(aims=(turned_frame.FrameAim(self.frame, values, state, self.size),))

    def single(self, k: int, value: float, state: Array) -> Wish:
        return Wish(aims=(turned_frame.FrameAim(self.frame, {self.axes[k]: value}, state, self.size),))

    def needed(self, q: Array, state: Array, free: Freedoms) -> FrameHandle | None:
        """The handle with those axes only that move apart from each other; None where none moves."""
        derivatives = self._all_derivatives(q, state, whole=False)[list(self.axes)]
        chosen = free.independent(derivatives)
        return FrameHandle(self.frame, tuple(self.axes[k] for k in chosen), self.size) if chosen else None

    def _all_derivatives(self, q: Array, state: Array, *, whole: bool) -> Array:
        """(6, 6 B) of all axes; whole : in place of the angles' the angular velocities about the first frame's axes."""
        out = np.zeros((6, len(q) // 7, 6))
        rates = np.eye(3) if whole else turned_frame.rates_of_angles(state[:3])
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
        yield _handle(motion, joint.name, one, two, markers.frame_b[marker].copy(), q, turned_frame.ANGLES)


def _bodies(motion: MotionEquations, q: Array) -> Iterator[FrameHandle]:
    system = motion.system
    for body, name in enumerate(system.bodies):
        axes = turned_frame.SHIFTS if system.point_masses[body] else (*turned_frame.SHIFTS, *turned_frame.ANGLES)
        yield _handle(motion, name, -1, body, np.eye(3), q, axes)


def _handle(
    motion: MotionEquations, name: str, first: int, second: int, first_axes: Array, q: Array, axes: tuple[int, ...]
) -> FrameHandle:
    """With all angles zero at positions q."""
    unturned = turned_frame.TurnedFrame(name, first, second, first_axes, np.eye(3))
    frame = turned_frame.TurnedFrame(name, first, second, first_axes, unturned.turn(q).T)
    return FrameHandle(frame, axes, motion.system.size)
