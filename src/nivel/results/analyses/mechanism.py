"""Analyses of mechanisms: coupler curves, transmission angles, ranges of motion, and all positions that one free motion comes through."""

import json
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel.elements.joints import drawn
from nivel.errors import Fault, ModelError
from nivel.files.target import write_page
from nivel.known import MachineRecord, Result
from nivel.lazy import Struct, field, provided, xarray
from nivel.machine.core.vectors import Array
from nivel.machine.units.quantity import read_quantity
from nivel.machine.uses.coordinate_reference import unknown_name
from nivel.results.frames.tabulated import Tabulated
from nivel.results.motion import rotation_matrices
from nivel.results.trust import Trust

GROUND: Final = "ground"
# a point that moves slower than this share of its largest speed stands still: a cusp, or a dwell
STILL: Final = 1e-6
# joints nearer to each other than this share of the machine are in one place
APART: Final = 1e-9
# transmission angles further than this from the right angle transmit badly
GOOD: Final = np.radians(40.0)


class Point(Struct):
    """A point of a body, in the axes of the body's frame [m]."""

    name: str
    body: str
    position: tuple[float, float, float]


class Transmission(Struct):
    """The angle at the second of three joints, between the lines to the other two."""

    joints: tuple[str, str, str]

    @property
    def name(self) -> str:
        return f"transmission at {self.joints[1]}"


def read_curve(machine: MachineRecord, text: str) -> Point:
    """`marker`, or `body:x,y,z` with units. Raises ModelError."""
    name, colon, place = text.partition(":")
    if not colon:
        marker = machine.marker_named.get(name)
        if marker is not None and marker.body != GROUND:
            x, y, z = marker.position or (0.0, 0.0, 0.0)
            return Point(name, marker.body, (x, y, z))
        if name in machine.body_named:
            return Point(name, name, (0.0, 0.0, 0.0))
        known = [*machine.marker_named, *machine.body_named]
        raise _fault("curve", unknown_name("marker or body", name, known))
    if name not in machine.body_named:
        raise _fault("curve", unknown_name("body", name, list(machine.body_named)))
    parts = place.split(",")
    if len(parts) != 3:
        raise _fault("curve", f"`{text}` is no point; write BODY:X,Y,Z, e.g. coupler:10 cm,0,0")
    try:
        x, y, z = (float(read_quantity(part, "length", {})) for part in parts)
    except ValueError as error:
        raise _fault("curve", f"`{place}` is no place: {error}") from None
    return Point(text, name, (x, y, z))


def read_transmission(machine: MachineRecord, text: str) -> Transmission:
    """Three joints separated by commas. Raises ModelError."""
    names = [each.strip() for each in text.split(",")]
    if len(names) != 3:
        raise _fault("transmission", f"three joints were expected, e.g. pin,rocker_pin,pivot, got `{text}`")
    known = [joint.name for joint in machine.joints]
    for name in names:
        if name not in known:
            raise _fault("transmission", unknown_name("joint", name, known))
    return Transmission((names[0], names[1], names[2]))


def _fault(field: str, message: str) -> ModelError:
    return ModelError(Fault.at(f"kinematics.{field}", message))


def coupler_curve(result: Result, body: str, position: Sequence[float] = (0.0, 0.0, 0.0)) -> "xarray.Dataset":
    """The path of a point of a body, given in the axes of its frame [m]: position, velocity, acceleration, speed and curvature.

    curvature |ṙ × r̈|/|ṙ|³ [1/m], not a number where the point stands still; cusp : 1 where it does while it accelerates.
    Raises ModelError for a body that the result does not have.
    """
    names = list(result.coordinates.get("body", ()))
    if body not in names:
        raise ModelError(unknown_name("body", body, names))
    b = names.index(body)
    A = rotation_matrices(result.array("orientation")[:, b])
    u = A @ np.asarray(position, dtype=float)
    omega, alpha = result.array("angular_velocity")[:, b], result.array("angular_acceleration")[:, b]
    turning = np.cross(omega, u)
    r = result.array("position")[:, b] + u
    v = result.array("velocity")[:, b] + turning
    a = result.array("acceleration")[:, b] + np.cross(alpha, u) + np.cross(omega, turning)
    speed = np.linalg.norm(v, axis=1)
    slow = speed <= STILL * max(float(speed.max(initial=0.0)), 1e-300)
    with np.errstate(divide="ignore", invalid="ignore"):
        curvature = np.where(slow, np.nan, np.linalg.norm(np.cross(v, a), axis=1) / speed**3)
    accelerates = np.linalg.norm(a, axis=1) > 0.0
    values = {
        "position": (("time", "xyz"), r, {"units": "m"}),
        "velocity": (("time", "xyz"), v, {"units": "m/s"}),
        "acceleration": (("time", "xyz"), a, {"units": "m/s^2"}),
        "speed": (("time",), speed, {"units": "m/s"}),
        "curvature": (("time",), curvature, {"units": "1/m"}),
        "cusp": (("time",), (slow & accelerates).astype(int), {}),
    }
    return xarray.Dataset(values, coords={"time": result.time, "xyz": list("xyz")}, attrs={"body": body})


def transmission_angle(result: Result, first: str, at: str, last: str) -> "xarray.DataArray":
    """[rad] angle at joint `at` between the lines to the joints `first` and `last`, from 0 to π; π/2 transmits best.

    Where `last` slides along a line, that between the line to `first` and the normal of the slide, from 0 to π/2. Raises ModelError for
    joints that the machine does not have, or that are in one place.
    """
    d = _line(result, at, first)
    if (slide := _slide(result, last)) is not None:
        along = np.abs(np.sum(d * slide, axis=1))
        angle = np.arctan2(along, np.linalg.norm(d - np.sum(d * slide, axis=1)[:, None] * slide, axis=1))
    else:
        e = _line(result, at, last)
        angle = np.arctan2(np.linalg.norm(np.cross(d, e), axis=1), np.sum(d * e, axis=1))
    coords, units = {"time": result.time}, {"units": "rad"}
    return xarray.DataArray(angle, coords=coords, dims="time", name="transmission_angle", attrs=units)


def _line(result: Result, at: str, to: str) -> Array:
    """(frames, 3) [m] from one joint to another. Raises ModelError where they are in one place."""
    line = joint_place(result, to) - joint_place(result, at)
    length = np.linalg.norm(line, axis=1)
    if np.any(length <= APART * np.abs(result.array("position")).max(initial=0.0)):
        raise _fault("transmission", f"the joints {at} and {to} are in one place: no line leads from one to the other")
    return line


def _slide(result: Result, name: str) -> Array | None:
    """(frames, 3) direction in which a joint slides; None where it turns."""
    joint = _joints(result).get(name)
    if joint is None or drawn(joint["type"]).looks.ground not in ("rail", "line"):
        return None
    body, axis = joint["bodies"][0], np.array(joint["axes"][0], dtype=float)
    bodies = list(result.coordinates.get("body", ()))
    if body not in bodies:
        return np.tile(axis, (len(result.time), 1))
    return rotation_matrices(result.array("orientation")[:, bodies.index(body)]) @ axis


def _joints(result: Result) -> dict[str, dict[str, Any]]:
    return {each["name"]: each for each in json.loads(str(result.attributes.get("scene", "{}"))).get("joints", [])}


def joint_place(result: Result, name: str) -> Array:
    """(frames, 3) [m] place of a joint on its first body, or on its second where the first is the ground.

    Raises ModelError for a joint that the machine does not have.
    """
    joints = _joints(result)
    if name not in joints:
        raise ModelError(unknown_name("joint", name, list(joints)))
    bodies = list(result.coordinates.get("body", ()))
    body, place = _held(joints[name], bodies)
    if body is None:
        return np.tile(place, (len(result.time), 1))
    b = bodies.index(body)
    return result.array("position")[:, b] + rotation_matrices(result.array("orientation")[:, b]) @ place


def _held(joint: dict[str, Any], bodies: Sequence[str]) -> tuple[str | None, Array]:
    """The body that a joint is followed on, and its place there; None: the ground."""
    ends = list(zip(joint["bodies"], joint["points"], strict=True))
    for body, point in ends:
        if body in bodies:
            return body, np.array(point, dtype=float)
    return None, np.array(ends[0][1], dtype=float)


class Range(Struct):
    """How far a joint coordinate can go: from `low` to `high` [rad or m]; full_turn : it turns right round, both ways.

    low_reason, high_reason : what ends it there, in a sentence; empty where nothing does. trust : the trust report.
    """

    coordinate: str
    unit: str
    low: float
    high: float
    full_turn: bool
    low_reason: str
    high_reason: str
    trust: Trust = field(default_factory=lambda: Trust("green", "done"))

    def summary(self) -> dict[str, Any]:
        """For programs."""
        own = {name: getattr(self, name) for name in self.__dataclass_fields__ if name != "trust"}
        return own | self.trust.summary()

    def __str__(self) -> str:
        if self.full_turn:
            return "\n".join([f"{self.coordinate} turns right round", *self.trust.told_lines()])
        lines = [f"{self.coordinate} goes from {self._shown(self.low)} to {self._shown(self.high)}"]
        lines += [f"  {word}: {text}" for word, text in (("low", self.low_reason), ("high", self.high_reason)) if text]
        return "\n".join([*lines, *self.trust.told_lines()])

    def _shown(self, value: float) -> str:
        return f"{value:.9g} {self.unit}" + (f" ({np.degrees(value):.6g}°)" if self.unit == "rad" else "")


class Turning(Struct):
    """A place `arc` of the curve at which the coordinate turns back, its value [rad or m] there, and the joints that hold it there."""

    arc: float
    value: float
    joints: tuple[str, ...]


class ConfigurationCurve(Struct, Tabulated):
    """values (T, m) [rad, m] of the joint coordinates `names` at the places `arc` (T,), the way of all bodies in machine lengths and rad.

    closed : it comes back to where it began. coordinate : whose turning points are given. crossed : places at which another curve of
    positions crosses, so that the positions behind them are one of several. trust : the trust report.
    """

    machine: str
    coordinate: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    arc: Array
    values: Array
    closed: bool
    turning: tuple[Turning, ...]
    crossed: tuple[float, ...]
    trust: Trust = field(default_factory=lambda: Trust("green", "done"))

    def to_xarray(self) -> "xarray.Dataset":
        """The joint coordinates over the curve."""
        values = {
            name: (("arc",), self.values[:, k], {"units": unit})
            for k, (name, unit) in enumerate(zip(self.names, self.units, strict=True))
        }
        facts = {"machine": self.machine, "closed": int(self.closed), **self.trust.attributes()}
        return xarray.Dataset(values, coords={"arc": self.arc}, attrs=facts)

    def summary(self) -> dict[str, Any]:
        """For programs."""
        return {
            "machine": self.machine,
            "coordinate": self.coordinate,
            "closed": self.closed,
            "positions": len(self.arc),
            "turning_points": [
                {"arc": each.arc, "value": each.value, "joints": list(each.joints)} for each in self.turning
            ],
            "crossed": list(self.crossed),
            **self.trust.summary(),
        }

    def __str__(self) -> str:
        unit = self.units[self.names.index(self.coordinate)]
        whole, part = "comes back to where it began", "does not come back within the positions that were looked at"
        lines = [f"{self.machine}: {len(self.arc)} positions; the motion {whole if self.closed else part}"]
        for each in self.turning:
            turned = f" ({np.degrees(each.value):.6g}°)" if unit == "rad" else ""
            held = f"held there by {', '.join(each.joints)}"
            lines.append(f"  {self.coordinate} turns back at {each.value:.9g} {unit}{turned}, {held}")
        if not self.turning:
            lines.append(f"  {self.coordinate} never turns back")
        if self.crossed:
            some = ", ".join(f"{each:.6g}" for each in self.crossed)
            said = f"another curve of positions crosses at {some} of the way {self.arc[-1]:.6g}"
            lines.append(f"  {said}: the positions behind are one of several")
        lines += self.trust.told_lines("curve")
        return "\n".join(lines)


class Studies(Struct):
    """Coupler curves and transmission angles of a result. curves : (point, its dataset); angles : (what, its array [rad])."""

    name: str
    curves: tuple[tuple[Point, Any], ...]
    angles: tuple[tuple[Transmission, Any], ...]

    def lines(self) -> list[str]:
        """A line for each."""
        out = []
        for what, angle in self.angles:
            values = np.degrees(angle.to_numpy())
            worst = f"at worst {np.max(np.abs(values - 90.0)):.4f}° from the right angle"
            out.append(f"{what.name}: from {values.min():.4f}° to {values.max():.4f}°, {worst}")
        for point, curve in self.curves:
            steps, cusps = np.diff(curve["position"].to_numpy(), axis=0), int(curve["cusp"].sum())
            length = float(np.linalg.norm(steps, axis=1).sum())
            more = f", {cusps} cusp{'s' * (cusps > 1)}" if cusps else ""
            out.append(f"curve of {point.name}: {length:.6g} m long{more}")
        return out

    def summary(self) -> dict[str, Any]:
        """For programs."""
        return {
            "transmission": {what.name: [float(angle.min()), float(angle.max())] for what, angle in self.angles},
            "curves": {point.name: curve["position"].to_numpy().tolist() for point, curve in self.curves},
        }

    def report(self, path: str | PathLike[str]) -> Path:
        """Write a page with the curves."""
        return write_page(provided("mechanism")(self), path)


def add_studies(result: Result, angles: Sequence[Transmission], points: Sequence[Point]) -> Studies | None:
    """Transmission angles and coupler curves of a result; None where none are asked for."""
    if not (angles or points) or not len(result.time):
        return None
    return Studies(
        result.name,
        tuple((point, coupler_curve(result, point.body, point.position)) for point in points),
        tuple((what, transmission_angle(result, *what.joints)) for what in angles),
    )
