"""The scales of a run that its errors are compared with: size, speed, energy. `RULES` states them in words."""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any, Protocol

import numpy as np

from nivel.machine.core.vectors import Array, cross

BLOCK = 16 * 1024  # frames read at once: a long run need not fit in memory
EXTENT_FLOOR = 1e-12  # of the distance from the global origin: round-off of points that are one
REST = 1e-3  # of the size, travelled in the time of the run: a machine that stays below it is at rest
# of the potential energy, of a load times the size, of the energy of travelling by the size in the run: round-off of a machine at rest
# is below green
ENERGY_FLOOR = 1e-9
ROUND_OFF = 1e-14  # of the size: an error below it is none
CLOSED = 1e-12  # of the size: joints that are open by less are closed as well as a run closes them
OPENING_WORK = 1e5  # times the work of the loads over what closed joints are open by: it is a decade below green
POINT_SIZE = 1.0  # m: a single point that never moves has no size; said wherever it is used

RULES = {
    "energy_scale": "the largest of: the kinetic energy, the change of potential energy, the work of external forces (in a verified run "
    "what goes in and comes out), the dissipated energy. For a machine at rest the scale has lower limits: 1e-9 of the largest potential "
    "energy; 1e-9 (or the tolerance, at rest with chosen steps) of the largest load, without dampers, and the weight, times the size, and "
    "of the kinetic energy of moving by the size during the run; 1e5 times the work of these loads over the opening of the joints, if this "
    "is at most 1e-12 of the size. There is no fixed number of joules: if all energies are zero, an error of zero is the fraction zero",
    "size": "the diagonal of the box around all joint points, centres of mass and body origins in the first frame. "
    "If all of them are one point, the larger of: the diagonal of the box around its path, and twice the largest radius of gyration. If "
    "both are missing (a point mass, or one that moves by less than 1e-9 of what its loads would move it), 1 m by convention. "
    "Constraint rows that are cosines of angles are compared with 1",
    "speed": "the largest speed of any joint point, centre of mass or body origin (upper bound |v| + |ω| r, where r is the radius of "
    "gyration of a body without other points). If the machine moves at this speed by less than 1e-3 of its size during the run, it is at "
    "rest, and the speed that moves it by 1e-3 of its size is used. Rates of cosines of angles are compared with speed / size",
}


class Readable(Protocol):
    """What a measurement needs of a result: `Result` is one."""

    @property
    def attributes(self) -> Mapping[str, str | float | int]: ...
    @property
    def variables(self) -> Mapping[str, Any]: ...
    @property
    def coordinates(self) -> Mapping[str, tuple[str, ...]]: ...
    @property
    def time(self) -> Array: ...
    def array(self, name: str, frames: slice = ...) -> Array: ...


def machine_size(result: Readable) -> tuple[float, str]:
    """The length [m], never zero, that distances are compared with, and what it is: see `RULES`."""
    extent = _extent_at_start(result)
    if extent > 0.0:
        return extent, "machine's size"
    turning = 2.0 * max((_gyration(body) for body in bodies(result)), default=0.0)
    path = _extent(result, blocks(result), round_off=ENERGY_FLOOR * _free_path(result))
    if max(path, turning) > 0.0:
        return (path, "extent of its path") if path >= turning else (turning, "largest diameter of gyration")
    return POINT_SIZE, "length taken for a single point at rest"


def _extent_at_start(result: Readable) -> float:
    """The same in the first frame."""
    scene, names = str(result.attributes.get("scene", "{}")), tuple(result.coordinates.get("body", ()))
    known = ("position", "orientation") if "position" in result.variables else ()
    poses = [result.array(name, slice(0, 1)).tobytes() for name in known] or [b"", b""]
    return _extent_of_poses(scene, names, *poses)


@lru_cache(maxsize=4)  # asked for several times in a report
def _extent_of_poses(scene: str, names: tuple[str, ...], position: bytes, orientation: bytes) -> float:
    found = _read(scene)
    known = {body["name"]: body for body in found.get("bodies", [])}
    parts = [np.array(found.get("ground_points", []), dtype=float).reshape(-1, 3)]
    R, theta = np.frombuffer(position).reshape(-1, 3), np.frombuffer(orientation).reshape(-1, 4)
    if len(R):
        points = [_body_points(known.get(name, {})) for name in names]
        body = np.repeat(np.arange(len(names)), [len(each) for each in points])
        parts.append(R[body] + rotated(theta[body], np.concatenate(points)))
    return _diagonal(parts, 0.0)


def _extent(result: Readable, parts: Iterable[slice], round_off: float = 0.0) -> float:
    """Diagonal of the box around all joint points, centres of mass and body origins in these frames [m]; 0 where all
    of them are one point, or no further apart than `round_off` [m].
    """
    ground = np.array(_scene(result).get("ground_points", []), dtype=float).reshape(-1, 3)
    return _diagonal((points for frames in parts for points in [ground, *_points_in_space(result, frames)]), round_off)


def _diagonal(parts: Iterable[Array], round_off: float) -> float:
    """Diagonal of the box around points (…, 3)."""
    least, largest = np.full(3, np.inf), np.full(3, -np.inf)
    for points in parts:
        known = points.reshape(-1, 3)
        known = known[np.isfinite(known).all(axis=1)]
        least = np.minimum(least, known.min(axis=0, initial=np.inf))
        largest = np.maximum(largest, known.max(axis=0, initial=-np.inf))
    if not np.all(least <= largest):
        return 0.0
    extent = float(np.linalg.norm(largest - least))
    away = float(np.linalg.norm(np.maximum(np.abs(least), np.abs(largest))))
    return extent if np.isfinite(extent) and extent > max(EXTENT_FLOOR * away, round_off) else 0.0


def _free_path(result: Readable) -> float:
    """How far the loads would move the whole machine in the run if nothing balanced them [m]; 0 where its mass is not known."""
    mass = _mass(result)
    force = weight(result) + _largest_load(result, 0.0)
    return 0.5 * force / mass * span(result) ** 2 if mass > 0.0 else 0.0


def speed_of_rest(result: Readable, size: float) -> float:
    """Largest speed [m/s] of a machine that counts as at rest during the run; one frame alone counts as a second."""
    return REST * size / span(result)


def span(result: Readable) -> float:
    """Time between the first and the last frame [s]; a second for one frame alone."""
    time = result.time
    span = float(time[-1] - time[0]) if len(time) else 0.0
    return span if span > 0.0 else 1.0


def largest_speed(result: Readable) -> float:
    """Upper bound |v| + |ω| r of the speed of every joint point, centre of mass and body origin, over the run [m/s].

    Of a body that has no other point than its origin, r is its radius of gyration.
    """
    if "velocity" not in result.variables:
        return 0.0
    reach, largest = reaches(result), 0.0
    for frames in blocks(result):
        v = np.linalg.norm(result.array("velocity", frames), axis=-1)
        omega = np.linalg.norm(result.array("angular_velocity", frames), axis=-1)
        speed = v + omega * reach
        largest = max(largest, float(np.max(speed, initial=0.0, where=np.isfinite(speed))))
    return largest


def reaches(result: Readable) -> Array:
    """(bodies,) [m] how far a body reaches from its origin: to its farthest joint point or centre of mass, else its radius of gyration."""
    return np.array([_reach(body) or _gyration(body) for body in bodies(result)])


def weight(result: Readable) -> float:
    """Of all bodies [N], as far as the scene knows their mass."""
    gravity = _read(str(result.attributes.get("machine_record", "{}"))).get("gravity", (0.0, 0.0, 0.0))
    return _mass(result) * float(np.linalg.norm(np.array(gravity, dtype=float)))


def kinetic_energy_of_rest(result: Readable, slowest: float) -> float:
    """What all bodies have at the speed [m/s] below which a machine is at rest [J]."""
    return 0.5 * _mass(result) * slowest**2


def largest_kinetic_energy(result: Readable, size: float) -> float:
    """Largest kinetic energy of the run [J]; 0 of a machine at rest, whose speeds are round-off. size : of the machine [m]."""
    at_rest = largest_speed(result) < speed_of_rest(result, size)
    return 0.0 if at_rest else _largest(result, "kinetic_energy", lambda e: e)


def largest_energy(result: Readable, size: float, opening: float = 0.0, at_rest: bool = False) -> tuple[float, str]:
    """The energy [J] that the energy error is compared with, and what it is: see `RULES`. It may be zero.

    size : of the machine [m]. opening : by how much of it (of 1 for cosines) joints are open at most. at_rest : it is slower than
    `speed_of_rest`. A run without frames has no energy: 0 J of no kind.
    """
    if not len(result.time):
        return 0.0, ""
    candidates = [
        *_mechanical_energies(result),
        ("largest dissipated energy", _largest(result, "dissipated_energy", lambda e: e)),
        ("smallest energy that counts", _energy_of_rest(result, size, opening, at_rest)),
    ]
    kind, value = max(candidates, key=lambda each: each[1])
    return value, kind


def work_to_and_fro(result: Readable) -> float:
    """The work of external forces [J] that went into the machine and out of it, as far as frames show it."""
    if "external_work" not in result.variables:
        return 0.0
    return float(np.nansum(np.abs(np.diff(result.array("external_work")))))


def largest_mechanical_energy(result: Readable) -> float:
    """The largest kinetic energy, change of potential energy or work of external forces [J] of a run with frames."""
    return max(value for _, value in _mechanical_energies(result))


def _mechanical_energies(result: Readable) -> list[tuple[str, float]]:
    return [
        ("largest kinetic energy", _largest(result, "kinetic_energy", lambda e: e)),
        ("largest change of potential energy", _largest(result, "potential_energy", lambda e: e - e[0])),
        ("largest work of external forces", _largest(result, "external_work", lambda e: e)),
    ]


def _energy_of_rest(result: Readable, size: float, opening: float, at_rest: bool) -> float:
    """The energy [J] of which round-off, and what a run at rest is not solved for any more, are below green: see `RULES`."""
    settings = json.loads(str(result.attributes.get("settings", "{}")))
    # loads of a machine that moves may be impacts, whose work is no measure of what it is solved for
    share = max(ENERGY_FLOOR, float(settings.get("tolerance", 0.0))) if at_rest else ENERGY_FLOOR
    work = size * weight(result) + _largest_load(result, size)
    travelling = 0.5 * _mass(result) * (size / span(result)) ** 2
    # the solver closes joints to a share of a metre where all is one point
    closed = CLOSED * max(1.0, POINT_SIZE / size) if _extent_at_start(result) == 0.0 else CLOSED
    return max(
        ENERGY_FLOOR * _largest(result, "potential_energy", lambda e: e),
        share * max(work, travelling),
        OPENING_WORK * min(opening, closed) * work if opening > 0.0 else 0.0,
    )


def blocks(result: Readable) -> Iterator[slice]:
    """The frames of the run in parts."""
    count = len(result.time)
    for start in range(0, count, BLOCK):
        yield slice(start, min(start + BLOCK, count))


def _largest_load(result: Readable, size: float) -> float:
    """Largest reaction, applied force or effort of a driver times the size, or torque [J]; for a size of 0, the largest force [N].

    In every frame it is less by all that dampers do then, themselves and by way of reactions: what only resists a motion loads no machine.
    """
    largest = 0.0
    for frames in blocks(result):
        load = np.zeros(len(result.time[frames]))
        for name, variable in result.variables.items():
            if name not in ("joint_force", "joint_torque") and (
                "." not in name or name.startswith("sensor.") or variable.units not in ("N", "N m")
            ):
                continue
            values = np.abs(result.array(name, frames)).reshape(len(load), -1)
            known = np.max(values, axis=1, initial=0.0, where=np.isfinite(values))
            load = np.maximum(load, _arm(variable.units, size) * known)
        largest = max(largest, float(np.max(load - _damping(result, size, frames), initial=0.0)))
    return largest


def _damping(result: Readable, size: float, frames: slice) -> Array:
    """(frames,) what all dampers of the machine do, as `_largest_load` measures it."""
    total = np.zeros(len(result.time[frames]))
    for force in _read(str(result.attributes.get("machine_record", "{}"))).get("forces", ()):
        name, damping = f"force.{force['name']}", force.get("damping", 0.0)
        if f"{name}.rate" in result.variables and isinstance(damping, float | int) and damping > 0.0:
            effort = np.abs(damping * result.array(f"{name}.rate", frames))
            arm = _arm(result.variables[f"{name}.magnitude"].units, size)
            total += arm * np.where(np.isfinite(effort), effort, 0.0)
    return total


def _arm(units: str, size: float) -> float:
    """What forces [N] and torques [N m] are multiplied by."""
    return (size or 1.0) if units == "N" else float(size > 0.0)


def _mass(result: Readable) -> float:
    """Of all bodies [kg], as far as the scene knows it."""
    return sum(float(body.get("mass", 0.0)) for body in bodies(result))


def _largest(result: Readable, name: str, change: Callable[[Array], Array]) -> float:
    if name not in result.variables or not len(result.time):
        return 0.0
    values = np.abs(change(result.array(name)))
    return float(np.max(values, initial=0.0, where=np.isfinite(values)))


def _scene(result: Readable) -> dict[str, Any]:
    return _read(str(result.attributes.get("scene", "{}")))


@lru_cache(maxsize=4)
def _read(text: str) -> dict[str, Any]:
    """What a text of a result's attributes says, not to be changed: it is asked for several times in a report."""
    return json.loads(text)


def bodies(result: Readable) -> list[dict[str, Any]]:
    """Bodies of the scene in the order of the result; a body that the scene does not know is a bare origin."""
    known = {body["name"]: body for body in _scene(result).get("bodies", [])}
    return [known.get(name, {}) for name in result.coordinates.get("body", ())]


def _body_points(body: dict[str, Any]) -> Array:
    """(n, 3) [m] origin, centre of mass and joint points in the body frame."""
    origin = [0.0, 0.0, 0.0]
    return np.array([origin, body.get("centre_of_mass", origin), *body.get("points", [])], dtype=float)


def _reach(body: dict[str, Any]) -> float:
    """Largest distance of a point of the body from its origin [m]."""
    return float(np.linalg.norm(_body_points(body), axis=1).max())


def _gyration(body: dict[str, Any]) -> float:
    """Its largest radius of gyration about the centre of mass [m]; 0 of a point mass, or where the scene does not know it."""
    return float(body.get("radius_of_gyration", 0.0))


def levers(result: Readable, size: float) -> Array:
    """(bodies,) [m] what an angle moves the farthest of a body by: its farthest joint point or centre of mass from its origin, or twice
    its largest radius of gyration; the `size` of the machine [m] for a body of which neither is known, and at most that."""
    known = [max(_reach(body), 2.0 * _gyration(body)) for body in bodies(result)]
    return np.array([min(each, size) if each > 0.0 else size for each in known])


def _points_in_space(result: Readable, frames: slice) -> Iterator[Array]:
    """For each body its points (frames, n, 3) in global axes [m]."""
    if "position" not in result.variables:
        return
    position, orientation = result.array("position", frames), result.array("orientation", frames)
    for k, body in enumerate(bodies(result)):
        local = _body_points(body)
        yield position[:, k, None, :] + rotated(orientation[:, k, None, :], local)


def rotated(theta: Array, r: Array) -> Array:
    """A r for Euler parameters θ (…, 4), scalar first, and vectors r (…, 3) in the body frame."""
    e0, e = theta[..., :1], theta[..., 1:]
    t = 2.0 * cross(e, r)
    return r + e0 * t + cross(e, t)
