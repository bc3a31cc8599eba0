"""Gears, belts, racks and other couplings as the page draws them: pitch circles on the bodies that turn, and what runs between them.

Teeth say how the radii of two wheels are to each other; how large they are follows from how far their axes are apart: with n₁ and n₂
teeth at a distance a, outside each other r = a n/(n₁ + n₂), one inside the other r = a n/|n₁ - n₂|.
"""

from typing import Any, Final

import numpy as np

from nivel.lazy import nivel
from nivel.looks.viewpoint import rotation
from nivel.machine.core.vectors import Array
from nivel.machine.uses.coordinate_reference import Kind as CoordinateKind
from nivel.view.records import Coupling, End, Track, Wheel
from nivel.view.stage import Cast, CoordinatePlace, coordinate_place, triple

# what the coordinates of a coupling are where only their joints are named
KINDS: Final[dict[str, tuple[CoordinateKind, CoordinateKind]]] = {
    "gear": ("angle", "angle"),
    "belt": ("angle", "angle"),
    "belt-drive": ("angle", "angle"),
    "rack": ("angle", "length"),
}
PARALLEL: Final = 1e-3  # sine between axes that count as parallel


def couplings(cast: Cast, position: Array, orientation: Array) -> list[Coupling]:
    """All couplings of a machine; radii are those at the first frame that is finite of position (n, B, 3) [m], orientation (n, B, 4)."""
    fit = np.all(np.isfinite(position), axis=(1, 2)) & np.all(np.isfinite(orientation), axis=(1, 2))
    k = int(np.argmax(fit)) if fit.any() else 0
    return _Couplings(cast, position[k], orientation[k]).records()


class _Couplings:
    """A machine in one of its positions."""

    def __init__(self, cast: Cast, position: Array, orientation: Array) -> None:
        self._cast = cast
        # the ground is the last: its place among bodies is -1
        self._r, self._A = np.vstack([position, np.zeros(3)]), np.concatenate([rotation(orientation), [np.eye(3)]])

    def records(self) -> list[Coupling]:
        record = self._cast.record
        belts = [
            {**each, "joints": [each.get("coordinate"), each.get("against")]}
            for each in record.get("forces", [])
            if each.get("type") == "belt-drive"
        ]
        return [self._coupling(each) for each in (*record.get("couplings", []), *belts)]

    def _coupling(self, known: dict[str, Any]) -> Coupling:
        kind = str(known.get("type", "coupling"))
        named = list(known.get("joints") or known.get("coordinates") or _followed(known))
        wanted = KINDS.get(kind)
        places = [
            coordinate_place(name, self._cast.joints, wanted[k] if wanted and k < 2 else None)
            for k, name in enumerate(named)
        ]
        found = [place for place in places if place is not None]
        facts = [("type", kind), *((f"coordinate {k + 1}", str(name)) for k, name in enumerate(named))]
        drawn = self._parts(kind, known, found) if len(found) == len(named) else Coupling("", "")
        return Coupling(str(known["name"]), kind, drawn.wheels, drawn.tracks, drawn.joined, drawn.belt, facts)

    def _parts(self, kind: str, known: dict[str, Any], at: list[CoordinatePlace]) -> Coupling:
        """Only what is drawn of a coupling."""
        if kind == "gear" and (wheels := self._gear(known, at)):
            return Coupling("", "", wheels)
        if kind in ("belt", "belt-drive"):
            wheels = [
                self._wheel(place, side, float(r))
                for place, side, r in zip(at, _sides(at), known["radii"], strict=True)
            ]
            return Coupling("", "", wheels, belt="crossed" if known.get("crossed") else "open")
        if kind == "rack":
            sides = _sides(at)
            wheel = self._wheel(at[0], sides[0], abs(float(known["radius"])))
            return Coupling("", "", [wheel], [self._track(wheel, at[1], sides[1])])
        return Coupling("", "", joined=[End(place.joint.bodies[1], place.joint.points[1]) for place in at])

    def _gear(self, known: dict[str, Any], at: list[CoordinatePlace]) -> list[Wheel]:
        """Two pitch circles; none where the axes are not parallel or coincide."""
        sides = _sides(at)
        one, two = (self._wheel(place, side, 0.0) for place, side in zip(at, sides, strict=True))
        axis, other = self._turned(one.body, one.axis), self._turned(two.body, two.axis)
        apart = self._placed(two.body, two.centre) - self._placed(one.body, one.centre)
        apart = apart - (apart @ axis) * axis
        first, second = known.get("teeth") or (1.0, known.get("ratio") or 1.0)
        rest = abs(first - second) if known.get("internal") else first + second
        distance = float(np.linalg.norm(apart))
        if np.linalg.norm(np.cross(axis, other)) > PARALLEL or rest == 0.0 or not 0.0 < distance < np.inf:
            return []
        return [
            self._wheel(place, side, distance * teeth / rest)
            for place, side, teeth in zip(at, sides, (first, second), strict=True)
        ]

    def _wheel(self, at: CoordinatePlace, side: int, radius: float) -> Wheel:
        joint = at.joint
        return Wheel(joint.bodies[side], joint.points[side], joint.axes[side], radius)

    def _track(self, wheel: Wheel, at: CoordinatePlace, side: int) -> Track:
        """The pitch line of a rack: it touches the pinion on the side where the joint of the rack is, one turn to each side."""
        body = at.joint.bodies[side]
        along = self._turned(at.joint.bodies[0], at.axis)
        axis, centre = self._turned(wheel.body, wheel.axis), self._placed(wheel.body, wheel.centre)
        across = np.cross(along, axis)
        length = float(np.linalg.norm(across))
        across = across / length if length > PARALLEL else np.zeros(3)
        towards = float((self._placed(body, at.joint.points[side]) - centre) @ across)
        touch = centre + (wheel.radius if towards >= 0.0 else -wheel.radius) * across
        back = self._A[body].T
        return Track(body, triple(back @ (touch - self._r[body])), triple(back @ along), np.pi * wheel.radius)

    def _turned(self, body: int, vector: Any) -> Array:
        return self._A[body] @ np.asarray(vector, float)

    def _placed(self, body: int, point: Any) -> Array:
        return self._turned(body, point) + self._r[body]


def _followed(known: dict[str, Any]) -> list[str]:
    """The coordinate of a coupling by a function, and those that it follows."""
    coupling = nivel.elements.joints.couplings.FunctionCoupling.model_validate(known)
    return [coupling.coordinate, *coupling.coordinates]


def _sides(at: list[CoordinatePlace]) -> list[int]:
    """Which body of each joint is the wheel: not the one that carries both; without such a one the second, if it is not the ground."""
    carriers = set(at[0].joint.bodies) & set(at[1].joint.bodies)
    out = []
    for place in at:
        first, second = place.joint.bodies
        carried = (first in carriers) != (second in carriers)
        out.append(int(first in carriers) if carried else int(second >= 0))
    return out
