"""Pairs of bodies that contacts keep apart, as spheres or as convex hulls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.ways import motion_of
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.shape import Capsule, Ellipsoid, Sphere
from nivel.machine.bodies.solids import length
from nivel.machine.forces import Contact, Contacts
from nivel.machine.machine_record import MachineRecord
from nivel.results.scales import Readable
from nivel.system.forces.heaps import spheres_between
from nivel.system.forces.hulls import Hull, hull_of, hull_of_points, part_of

Array = NDArray[np.float64]
# Overlaps above this share of the distance at which they touch are no touch in passing.
DEEP = 0.05
# Corners of the polyhedron inside a round shape; pairs of a heap times frames that are looked at.
CORNERS, MOST_LOOKS = 42, 2_000_000


@dataclass(frozen=True)
class Pair:
    """A contact of two spheres: its name, bodies, the centres of the spheres in them [m], and the distance at which these touch [m]."""

    contact: str
    bodies: tuple[str, str]
    centres: tuple[Array, Array]
    reach: float


@dataclass(frozen=True)
class HullPair:
    """A contact of two hulls: its name, bodies, and of each hull its middle in the body frame, its corners from there and its faces
    (normal, distance) [m]."""

    contact: str
    bodies: tuple[str, str]
    middles: tuple[Array, Array]
    corners: tuple[Array, Array]
    faces: tuple[Array, Array]

    @property
    def thinnest(self) -> float:
        """[m] of the two least widths between a face and the corners, the smaller one."""
        widths = [
            float((faces[:, 3] - (corners @ faces[:, :3].T).min(axis=0)).min())
            for corners, faces in zip(self.corners, self.faces, strict=True)
        ]
        return min(widths)

    @property
    def reach(self) -> float:
        """[m] between the middles, from which on they cannot touch."""
        return sum(float(np.linalg.norm(corners, axis=1).max()) for corners in self.corners)


def spheres_of(machine: MachineRecord) -> list[Pair]:
    """The contacts of two spheres."""
    out, bodies = [], machine.body_named
    for force in machine.forces:
        if isinstance(force, Contact) and force.bodies is not None and _are_spheres(machine, force):
            (first, one), (second, other) = (_ball(bodies[name]) for name in force.bodies)
            out.append(Pair(force.name, force.bodies, (first, second), one + other))
    return out


def spheres_among(machine: MachineRecord, force: Contacts, result: Readable) -> list[Pair] | None:
    """The pairs of a heap that move so far between two frames that they may pass each other; None where these are too many to look at."""
    names = spheres_between(machine, force)
    balls = [_ball(machine.body_named[name]) for name in names]
    if len(result.time) < 2:
        return []
    # [m] the longest way of each between two frames
    span = np.diff(result.time)
    ways = np.zeros(len(names))
    for k, (name, (centre, _)) in enumerate(zip(names, balls, strict=True)):
        speed = np.linalg.norm(motion_of(result, name, centre)[1], axis=1)
        ways[k] = (span * np.maximum(speed[:-1], speed[1:])).max()
    radii = np.array([radius for _, radius in balls])
    # to overlap by the share DEEP of the reach in passing they take at least this chord
    chord = 2.0 * np.sqrt(1.0 - (1.0 - DEEP) ** 2)
    first, second = np.triu_indices(len(names), 1)
    fast = ways[first] + ways[second] > chord * (radii[first] + radii[second])
    if int(fast.sum()) * len(result.time) > MOST_LOOKS:
        return None
    return [
        Pair(force.name, (names[i], names[j]), (balls[i][0], balls[j][0]), float(radii[i] + radii[j]))
        for i, j in zip(first[fast], second[fast], strict=True)
    ]


def hulls_of(machine: MachineRecord) -> list[HullPair]:
    """The contacts of two bodies that are not two spheres."""
    out, bodies = [], machine.body_named
    for force in machine.forces:
        if isinstance(force, Contact) and force.bodies is not None and not _are_spheres(machine, force):
            pair = [bodies[name] for name in force.bodies]
            first, second = (_hull(pair[k], part_of(force, pair, k)) for k in range(2))
            middles, corners = (first.middle, second.middle), (first.corners, second.corners)
            out.append(HullPair(force.name, force.bodies, middles, corners, (first.faces, second.faces)))
    return out


def _are_spheres(machine: MachineRecord, force: Contact) -> bool:
    return all(isinstance(machine.body_named[name].shape, Sphere) for name in force.bodies or ())


def _ball(body: Body) -> tuple[Array, float]:
    """Centre [m] of a sphere in its body, and its radius [m]."""
    assert isinstance(body.shape, Sphere)  # the record was checked
    return np.array(body.shape.centre or (0.0, 0.0, 0.0), dtype=float), body.shape.radius


def _hull(body: Body, part: int | None) -> Hull:
    """The hull of a solid, or a polyhedron inside a round shape."""
    match body.shape:
        case Sphere() as shape:
            points = shape.radius * _directions()
        case Ellipsoid() as shape:
            points = np.array(shape.semi_axes) * _directions()
        case Capsule() as shape:
            ends = np.zeros((2, 1, 3))
            ends[:, 0, "xyz".index(shape.along or "x")] = 0.5 * length(shape), -0.5 * length(shape)
            points = (ends + shape.radius * _directions()).reshape(-1, 3)
        case _:
            return hull_of(body, part)
    return hull_of_points(points + np.array(shape.centre or (0.0, 0.0, 0.0)))


def _directions() -> Array:
    """(CORNERS, 3) unit vectors that are about evenly apart, on a spiral (Fibonacci)."""
    k = np.arange(CORNERS) + 0.5
    height, turn = 1.0 - 2.0 * k / CORNERS, np.pi * (1.0 + np.sqrt(5.0)) * k
    around = np.sqrt(1.0 - height * height)
    return np.column_stack([around * np.cos(turn), around * np.sin(turn), height])
