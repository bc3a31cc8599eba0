"""Lines of ropes, belts and chains around their pulleys."""

import itertools
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import dataclass
from nivel.looks.poses import Array, Pose, ends_in_space, in_space, joint_axis

STEPS: Final = 24  # of an arc


@dataclass
class Place:
    """A wheel, or a point without one. at : its centre seen along the axis; radius : signed; free : direction behind it, of length one;
    near, arc [rad] : which one the arc is next to; below zero where the rope does not touch the wheel."""

    centre: Array
    at: complex
    radius: float
    near: float
    free: complex = 1.0
    arc: float = 0.0


def rope_line(rope: dict[str, Any], poses: dict[str, Pose], steps: int = STEPS) -> Array:
    """(n, 3) [m] global points of a rope around wheels, from its first end to its last; `rope` is one of the scene.

    Its turns on a drum are those next to what is wound as the bodies are placed; of more than one turn the whole rim is there.
    """
    wheels, bodies = rope["wheels"], rope["bodies"]
    n = poses[bodies[wheels["carrier"]]][1] @ np.asarray(wheels["axis"], dtype=float)
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(n)))], n)
    x = x / np.linalg.norm(x)
    plane = x + 1j * np.cross(n, x)  # seen along the axis, vectors are complex numbers
    places = [
        Place(centre, complex(centre @ plane), radius, near)
        for centre, radius, near in zip(ends_in_space(rope, poses), wheels["radii"], wheels["arcs"], strict=True)
    ]
    held = [poses[bodies[k]][1] @ np.asarray(wheels["fixed"][k], dtype=float) for k in (0, -1)]
    fixed = complex(held[0] @ plane), complex(held[1] @ plane)
    _find(places, fixed)
    ends = places[0], places[-1]
    touched = [place for place in places if place.arc >= 0.0 or place is ends[0] or place is ends[1]]
    for end, direction in zip(ends, held, strict=True):
        if end.arc < 0.0:  # an unwound drum holds the rope at its rim
            end.centre = end.centre + abs(end.radius) * direction
            end.at, end.radius = complex(end.centre @ plane), 0.0
    _find(touched, fixed)
    return np.concatenate([_around(touched, k, plane, steps) for k in range(len(touched))])


def _find(places: list[Place], fixed: tuple[complex, complex]) -> None:
    """Set the free parts from place to place, and the arcs. fixed : directions in which the rope is fixed at its ends."""
    for a, b in itertools.pairwise(places):
        d, rho = b.at - a.at, b.radius - a.radius
        a.free = d * complex(np.sqrt(max(abs(d) ** 2 - rho * rho, 0.0)), -rho) / abs(d) ** 2
    last = len(places) - 1
    for k, place in enumerate(places):
        sign = np.sign(place.radius)
        before = places[max(k - 1, 0)].free
        if not sign:
            turned = 0.0
        elif 0 < k < last:
            turned = sign * np.angle(place.free / before)
        else:  # the free part touches the rim at -i times its direction
            turned = (sign if k == 0 else -sign) * np.angle(-1j * sign * before / fixed[0 if k == 0 else 1])
        place.arc = float(turned + 2.0 * np.pi * np.round((place.near - turned) / (2.0 * np.pi))) if sign else 0.0


def _around(places: list[Place], k: int, plane: NDArray[np.complex128], steps: int) -> Array:
    """(n, 3) points of the arc at place k, or its centre."""
    place = places[k]
    if not place.radius:
        return place.centre[None]
    sign, turn = np.sign(place.radius), min(place.arc, 2.0 * np.pi)
    touched = -1j * place.radius * places[max(k - 1, 0)].free
    along = np.linspace(-turn if k == 0 else 0.0, 0.0 if k == 0 else turn, steps + 1)
    rim = touched * np.exp(1j * sign * along)
    return place.centre + np.outer(rim.real, plane.real) + np.outer(rim.imag, plane.imag)


def belt_line(belt: dict[str, Any], joints: list[dict[str, Any]], poses: dict[str, Pose]) -> Array:
    """(n, 3) [m] global points of a closed belt; none where one pulley lies within the other. `belt` and `joints` are those of a scene.

    A pulley turns about the axis of its joint, and its centre is the point of the joint on the second body.
    """
    first, second = (next(each for each in joints if each["name"] == name) for name in belt["joints"])
    centres = [in_space(poses[each["bodies"][1]], each["points"][1])[0] for each in (first, second)]
    axis = joint_axis(first, poses, "first")
    apart = centres[1] - centres[0]
    apart = apart - (apart @ axis) * axis
    distance = float(np.linalg.norm(apart))
    r1, r2 = belt["radii"]
    reach = r1 + r2 if belt["crossed"] else r1 - r2
    if not abs(reach) < distance:
        return np.empty((0, 3))
    x = apart / distance
    y = np.cross(axis, x)
    alpha = float(np.arccos(reach / distance))  # from the line of the centres to where the belt leaves the first pulley
    far = alpha - np.pi if belt["crossed"] else alpha  # the same on the second one
    arcs = (
        (centres[0], r1, np.linspace(alpha, 2.0 * np.pi - alpha, STEPS)),
        (centres[1], r2, np.linspace(-far, far, STEPS)),
    )
    parts = [c + r * (np.outer(np.cos(angle), x) + np.outer(np.sin(angle), y)) for c, r, angle in arcs]
    return np.concatenate([*parts, parts[0][:1]])
