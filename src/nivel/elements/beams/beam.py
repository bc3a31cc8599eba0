"""A beam of large motion in words."""

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Final, Literal

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BeforeValidator, model_validator

from nivel.elements.beams import sections
from nivel.lazy import Struct, scipy
from nivel.machine.core.placement import PARALLEL, frame_between, no_direction
from nivel.machine.core.record import GROUND, Checked, Name, Place, Problem, superfluous
from nivel.machine.core.vectors import Array
from nivel.machine.given import Field, Given, ManyPlaces, Maybe, OneNumber, OneRecord, TwoNumbers
from nivel.machine.units import quantity

# Lines of beams: straight, an arc of a circle, or a smooth curve through points; and the axes of the sections along them.

# pieces between points in which the length of a curve is found, four-point Gauss in each
PIECES = 64


class NoCurveError(ValueError):
    """The points give no line, or no axes; `point` : number of the one at fault among those that were given, `up` : whether that is."""

    def __init__(self, message: str, *, point: int | None = None, up: bool = False) -> None:
        super().__init__(message)
        self.point, self.up = point, up


class Line(Struct):
    """A line of `length` [m]. at : place (n, 3) and unit tangent (n, 3) at lengths (n,) from its start. up : normal of an arc's plane."""

    length: float
    at: Callable[[Array], tuple[Array, Array]]
    up: Array | None = None


def straight(start: ArrayLike, end: ArrayLike) -> Line:
    """Raises NoCurveError where the points are one."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    length = float(np.linalg.norm(b - a))
    if length == 0.0:
        raise NoCurveError("the beam ends where it starts: it has no length", point=1)
    t = (b - a) / length
    return Line(length, lambda s: (a + np.outer(s, t), np.tile(t, (len(s), 1))))


def arc(start: ArrayLike, via: ArrayLike, end: ArrayLike) -> Line:
    """The circle through three points. Raises NoCurveError where they are on one line."""
    a, m, b = (np.asarray(each, dtype=float) for each in (start, via, end))
    normal = np.cross(m - a, b - m)
    size = max(float(np.linalg.norm(m - a)), float(np.linalg.norm(b - m)))
    if np.linalg.norm(b - a) <= 1e-9 * size:
        raise NoCurveError("an arc does not end where it starts; a ring goes `through` points", point=2)
    if np.linalg.norm(normal) <= 1e-9 * size**2:
        raise NoCurveError("three points on one line make no arc; leave `via` out for a straight beam", point=1)
    normal = normal / np.linalg.norm(normal)
    # the centre is equally far from all three points, in their plane
    rows = np.array([m - a, b - a, normal])
    centre = np.linalg.solve(rows, [(m @ m - a @ a) / 2.0, (b @ b - a @ a) / 2.0, normal @ a])
    first = a - centre
    radius = float(np.linalg.norm(first))
    x = first / radius
    y = np.cross(normal, x)
    angle = float(np.arctan2((b - centre) @ y, (b - centre) @ x)) % (2.0 * np.pi)

    def at(s: Array) -> tuple[Array, Array]:
        turn = s / radius
        c, n = np.cos(turn)[:, None], np.sin(turn)[:, None]
        return centre + radius * (c * x + n * y), c * y - n * x

    return Line(radius * angle, at, normal)


def smooth(points: ArrayLike) -> Line:
    """A cubic spline through the points, its parameter their distance. Raises NoCurveError where two neighbours are one."""
    p = np.asarray(points, dtype=float)
    steps = np.linalg.norm(np.diff(p, axis=0), axis=1)
    if np.any(steps <= 1e-9 * np.sum(steps)):
        raise NoCurveError("this point of the curve is the same as the one before", point=int(np.argmin(steps)) + 1)
    chord = np.concatenate([[0.0], np.cumsum(steps)])
    spline = scipy.interpolate.CubicSpline(chord, p)
    slope = spline.derivative()
    knots = np.concatenate([np.linspace(a, b, PIECES, endpoint=False) for a, b in pairwise(chord)] + [chord[-1:]])
    place, weight = np.polynomial.legendre.leggauss(4)
    half = 0.5 * np.diff(knots)
    inside = (knots[:-1] + half)[:, None] + half[:, None] * place
    pieces = half * (np.linalg.norm(slope(inside), axis=2) @ weight)
    reached = np.concatenate([[0.0], np.cumsum(pieces)])

    def at(s: Array) -> tuple[Array, Array]:
        u = np.interp(s, reached, knots)
        for _ in range(4):  # Newton's iteration for the parameter at this length
            k = np.clip(np.searchsorted(knots, u) - 1, 0, len(half) - 1)
            h = 0.5 * (u - knots[k])
            done = reached[k] + h * (
                np.linalg.norm(slope((knots[k] + h)[:, None] + h[:, None] * place), axis=2) @ weight
            )
            u = np.clip(u - (done - s) / np.linalg.norm(slope(u), axis=1), chord[0], chord[-1])
        tangent = slope(u)
        return spline(u), tangent / np.linalg.norm(tangent, axis=1)[:, None]

    return Line(float(reached[-1]), at)


def axes_along(line: Line, s: Array, up: Array | None, twist: float) -> Array:
    """(n, 3, 3) columns x, y, z of the sections at lengths s (n,): x along the line, z as near to `up` as it can be.

    Without `up`: the normal of an arc's plane; for a straight beam global Z (of a vertical one Y); on other curves the axes at the start
    are carried along without twisting. twist : turn about x at the end [rad], growing with the length.
    Raises NoCurveError where the line runs along `up`.
    """
    _, tangent = line.at(s)
    up = line.up if up is None else up
    axes: Any
    if up is None:
        axes = _carried(line, s)
    else:
        z = up - (tangent @ up)[:, None] * tangent
        size = np.linalg.norm(z, axis=1)
        if np.any(size <= PARALLEL * np.linalg.norm(up)):
            raise NoCurveError("the beam runs along `up` somewhere; it must point across the beam", up=True)
        z = z / size[:, None]
        axes = np.stack([tangent, np.cross(z, tangent), z], axis=2)
    turn: Array = twist * s / line.length
    c, n = np.cos(turn)[:, None], np.sin(turn)[:, None]
    y, z = axes[:, :, 1], axes[:, :, 2]
    return np.stack([axes[:, :, 0], c * y + n * z, c * z - n * y], axis=2)


def _carried(line: Line, s: Array) -> Array:
    """Axes that turn with the tangent only (double reflection: Wang, Jüttler, Zheng, Liu 2008, "Computation of rotation minimizing
    frames")."""
    fine = np.union1d(s, np.linspace(0.0, line.length, 33))
    place, tangent = line.at(fine)
    axes = np.zeros((len(fine), 3, 3))
    axes[0] = frame_between(np.zeros(3), tangent[0])
    z = axes[0, :, 2]
    for k in range(1, len(fine)):
        step = place[k] - place[k - 1]
        square = step @ step
        if square > 0.0:
            mirrored = z - 2.0 / square * (step @ z) * step
            along = tangent[k - 1] - 2.0 / square * (step @ tangent[k - 1]) * step
            bend = tangent[k] - along
            if bend @ bend > 0.0:
                mirrored = mirrored - 2.0 / (bend @ bend) * (bend @ mirrored) * bend
            z = mirrored - (mirrored @ tangent[k]) * tangent[k]
            z = z / np.linalg.norm(z)
        axes[k] = np.column_stack([tangent[k], np.cross(z, tangent[k]), z])
    return axes[np.searchsorted(fine, s)]


START, END = "start", "end"
LEAST: Final = 1e-4  # share of the length by which stations and ends are apart, at least
# of an element, unstressed: rotations within it are interpolated as vectors [rad]
MOST_TURN: Final = 0.5 * np.pi + 1e-6
REPRESENTED: Final = 1e-6  # share by which sections may miss what a model can represent
OTHERS: Final = "or take `model: ancf-beam` or `geometrically-exact`"
FARTHEST: Final = 1e9  # m; farther points are slips, and their squares may overflow

Points = Annotated[ManyPlaces[quantity.Position], BeforeValidator(quantity.listed)]
Offset = Annotated[TwoNumbers[quantity.Length], BeforeValidator(quantity.listed)]
Time = Annotated[OneNumber, quantity.Quantity("time")]


class Beam(Checked):
    """A slender body that may move and bend by any amount: geometrically exact, with shear (Reissner 1981, Simo 1985), or, for comparison,
    a row of rigid segments joined by springs.

    Joints, forces and markers attach to it at stations, which are bodies for them: `BEAM.start`, `BEAM.end`, and those named.
    The axes of a station are those of the section there: x along the beam.
    """

    collection: ClassVar[str] = "beams"
    tagged = {"section": 1}  # noqa: RUF012
    always = frozenset({"order"})  # without it `elements` would mean linear ones

    name: Name
    from_: quantity.Position = Field("where it starts, global", key="from")
    to: quantity.Position = Field("where it ends, global")
    via: Maybe[quantity.Position] = Field("a point on the way: the beam is an arc of a circle", default=None)
    through: Points = Field("points on the way: the beam is a smooth curve through them", default=())
    up: Maybe[quantity.Direction] = Field("the z axes of its sections are as near to this as they can be", default=None)
    twist: quantity.Angle = Field("turn of the last section about the beam, against the first, unstressed", default=0.0)
    section: OneRecord[sections.BeamSectionRecord]
    material: Maybe[OneRecord[sections.Material]] = Field(default=None)
    centroid: Offset = Field("y and z of the sections' centroids from the line of the beam", default=(0.0, 0.0))
    shear_centre: Offset = Field("y and z of the shear centres from the line of the beam", default=(0.0, 0.0))
    elements: Annotated[quantity.Whole, Field(strict=True, ge=1, le=100_000)] = 10
    order: Annotated[quantity.Whole, Field(strict=True, ge=1, le=3)] = Field(
        "of an element: 1, 2 or 3; 1 where `elements` is given without it, and of another model", default=2
    )
    model: Literal["geometrically-exact", "segments", "ancf-cable", "ancf-beam"] = Field(
        "finite elements; rigid segments joined by springs of six directions; or elements in absolute nodal coordinates, with slopes "
        "or all gradients",
        default="geometrically-exact",
    )
    mass: Literal["consistent", "lumped"] | None = Field(
        "of elements: consistent, if not given, or lumped at the nodes; segments have their own", default=None
    )
    interpolation: Literal["relative", "total"] = Field(
        "of rotations in an element: relative to a node of it, or total, which is not objective", default="relative"
    )
    damping: Time = Field("stress from a rate of strain, over that from the strain", default=0.0)
    stations: Given[dict[Name, quantity.Scalar], dict[str, float], Mapping[str, float | str]] = Field(
        "name: share of the length, between 0 and 1", default={}
    )
    velocity: quantity.VelocityVector = Field("of its start, global axes", default=(0.0, 0.0, 0.0))
    angular_velocity: quantity.AngularVelocityVector = Field("as a rigid body, global axes", default=(0.0, 0.0, 0.0))

    @model_validator(mode="before")
    @classmethod
    def _as_before_quadratic_elements(cls, data: Any) -> Any:
        """Who gives `elements` alone means linear ones, as all once were by default; so are those of other models."""
        if not isinstance(data, Mapping) or "order" in data:
            return data
        linear = "elements" in data or data.get("model", "geometrically-exact") != "geometrically-exact"
        return {**data, "order": 1} if linear else data

    @property
    def line(self) -> Line:
        """Its line. Raises NoCurveError."""
        if self.via is not None:
            return arc(self.from_, self.via, self.to)
        return smooth([self.from_, *self.through, self.to]) if self.through else straight(self.from_, self.to)

    @property
    def shares(self) -> Array:
        """(N,) shares of the length at which its nodes are, ascending: stations are nodes, elements between them are equally long."""
        ends = np.array(sorted({0.0, 1.0, *self.stations.values()}))
        counts = _divided(np.diff(ends), self.elements)
        pieces = [
            np.linspace(a, b, self.order * n, endpoint=False)
            for a, b, n in zip(ends[:-1], ends[1:], counts, strict=True)
        ]
        return np.concatenate([*pieces, [1.0]])

    @cached_property
    def node_names(self) -> tuple[str, ...]:
        """(N,) names of its nodes as bodies: `BEAM.start`, `BEAM.1`, …, with the names of stations where they have one."""
        named = {0.0: START, 1.0: END} | {share: name for name, share in self.stations.items()}
        return tuple(f"{self.name}.{named.get(share, k)}" for k, share in enumerate(self.shares.tolist()))

    def frames(self, shares: Array) -> tuple[Array, Array]:
        """Places (n, 3) and axes (n, 3, 3), columns x, y, z, of the sections at these shares of the length, global."""
        s = self.line.length * shares
        return self.line.at(s)[0], axes_along(self.line, s, None if self.up is None else np.array(self.up), self.twist)

    def frame_at(self, station: str) -> tuple[Array, Array]:
        """Place (3,) and axes (3, 3) of the section at a station, by its name within the beam, global."""
        place, axes = self.frames(np.array([{START: 0.0, END: 1.0, **self.stations}[station]]))
        return place[0], axes[0]

    @property
    def shares_mass(self) -> bool:
        """Whether its nodes have mass in common."""
        return self.model != "segments" and self.mass != "lumped"

    @property
    def has_gradients(self) -> bool:
        """Whether its nodes have gradients, which deform: beams in absolute nodal coordinates."""
        return self.model in ("ancf-cable", "ancf-beam")

    @property
    def _missing_shear_areas(self) -> tuple[str, ...]:
        """Those that the section lacks; a cable does not shear."""
        return () if self.model == "ancf-cable" else sections.missing_shear_areas(self.section)

    @property
    def properties(self) -> sections.BeamSection:
        """The section in numbers."""
        return sections.beam_section(self.section, self.material, self.centroid, self.shear_centre)

    def problems(self) -> Iterator[Problem]:
        if self.name == GROUND:
            yield Problem((), f"`{GROUND}` is the fixed world and cannot be a beam")
        zero = [*no_direction("up", self.up)]
        yield from zero
        if self.via is not None and self.through:
            yield superfluous("through", "does not go with `via`, which makes the beam an arc of a circle")
        elif not zero:
            yield from self._problems_of_line()
        yield from self._problems_of_section()
        if self.model == "segments" and self.mass == "consistent":
            yield superfluous(
                "mass", "consistent does not go with `model: segments`: a rigid segment has a mass of its own"
            )
        if self.model == "segments" and self.interpolation == "total":
            yield superfluous("interpolation", "does not go with `model: segments`: nothing is interpolated")
        if self.has_gradients:
            yield from self._problems_of_gradients()
        if self.damping < 0.0:
            yield Problem(("damping",), f"zero or more was expected, got {self.damping:g} s")

    def _problems_of_line(self) -> Iterator[Problem]:
        """Of the line, and of what stands on it."""
        places: list[Place] = [("from",), *(("through", k) for k in range(len(self.through))), ("to",)]
        points = [self.from_, *self.through, self.to]
        if self.via is not None:
            places[1:1], points[1:1] = [("via",)], [self.via]
        far = [place for place, point in zip(places, points, strict=True) if max(map(abs, point)) > FARTHEST]
        yield from (Problem(place, f"farther away than {FARTHEST:g} m: a slip of a unit?") for place in far)
        stations = [*self._problems_of_stations()]
        yield from stations
        if far:
            return
        try:
            self.frames(np.linspace(0.0, 1.0, 33))
            if not stations:
                yield from self.turning_problems()
            yield from self._problems_of_height()
        except NoCurveError as problem:
            yield Problem(("up",) if problem.up else places[problem.point or 0], str(problem))

    def _problems_of_height(self) -> Iterator[Problem]:
        """A section of a material that is higher than the beam is long, as a rectangle of its stiffness."""
        if self.material is None or isinstance(self.section, sections.GeneralSection) or self._missing_shear_areas:
            return
        stiffness, mass = np.diag(self.properties.stiffness), self.properties.mass
        height = float(
            np.sqrt(12.0 * stiffness[4:].max() * self.material.density / self.material.youngs_modulus / mass)
        )
        if height > self.line.length:
            message = f"a section {height:.3g} m high on a beam {self.line.length:.3g} m long: a slip of a unit?"
            yield Problem(("section",), message)

    def turning_problems(self) -> Iterator[Problem]:
        """Elements over which the unstressed beam turns by more than can be followed. Raises NoCurveError."""
        shares = self.shares[:: self.order]
        axes = self.frames(shares)[1]
        along = np.einsum("ni,ni->n", axes[:-1, :, 0], axes[1:, :, 0])
        cosine = 0.5 * (np.einsum("nij,nij->n", axes[:-1], axes[1:]) - 1.0)
        bend = float(np.arccos(np.clip(np.minimum(along, cosine).min(), -1.0, 1.0)))
        turn = max(bend, abs(self.twist) * float(np.diff(shares).max()))
        if turn > MOST_TURN:
            message = (
                f"over an element the unstressed beam turns by {np.degrees(turn):.3g} deg; 90 deg at most can be followed: "
                "take more elements, or see whether the line folds back or runs along `up`"
            )
            yield Problem(("elements",) if "elements" in self.model_fields_set else (), message)

    def _problems_of_section(self) -> Iterator[Problem]:
        if isinstance(self.section, sections.GeneralSection):
            if self.material is not None:
                yield superfluous(
                    "material", "does not belong to a general section, which has its own stiffness and mass"
                )
            if any(self.centroid):
                yield superfluous("centroid", "belongs to a section of a material; a general one has its `mass_centre`")
        elif self.material is None:
            yield Problem((), "`material` is missing: {youngs_modulus: …, poisson_ratio: …, density: …}")
        missing = self._missing_shear_areas
        if missing:
            words = " and ".join(f"`{name}`" for name in missing)
            message = (
                f"{words} {'is' if len(missing) == 1 else 'are'} missing: a beam of large motion deforms by shear too"
            )
            yield Problem(("section",), message)

    def _problems_of_gradients(self) -> Iterator[Problem]:
        """What beams in absolute nodal coordinates do not have."""
        if self.order != 1:
            yield Problem(("order",), f"elements of `model: {self.model}` have two nodes: remove it")
        if self.mass == "lumped":
            yield Problem(("mass",), f"the mass of `model: {self.model}` is always consistent: remove it")
        if self.interpolation == "total":
            yield Problem(("interpolation",), f"`model: {self.model}` has no rotations to interpolate: remove it")
        general = isinstance(self.section, sections.GeneralSection)
        if self._missing_shear_areas or (self.material is None) != general:
            return
        if self.model == "ancf-cable":
            yield from self._problems_of_cable()
            return
        J = self.properties.inertia
        if abs(J[0, 0] - J[1, 1] - J[2, 2]) > REPRESENTED * J[0, 0]:
            message = (
                f"gradients have the inertia of matter: about x it is the sum of those about y and z, {J[1, 1] + J[2, 2]:.6g}, "
                f"not {J[0, 0]:.6g} kg m; give that, or take `model: geometrically-exact`"
            )
            yield Problem(("section", "inertia"), message)

    def _problems_of_cable(self) -> Iterator[Problem]:
        """A cable is straight, and the same in all directions."""
        if self.via is not None or self.through or self.twist:
            name = "via" if self.via is not None else "through" if self.through else "twist"
            yield Problem((name,), f"an `ancf-cable` is straight and not twisted while unstressed: {OTHERS}")
        for name in ("centroid", "shear_centre"):
            if any(getattr(self, name)):
                yield Problem(
                    (name,), f"an `ancf-cable` is the same in all directions about its line: remove it, {OTHERS}"
                )
                return
        own = self.properties
        C = own.stiffness
        bending = C[4, 4], C[5, 5]
        if np.any(own.mass_centre):
            why = "its `mass_centre` is off the line"
        elif abs(bending[0] - bending[1]) > REPRESENTED * max(bending):
            why = f"EI_y = {bending[0]:.6g}, EI_z = {bending[1]:.6g} N m^2"
        elif np.any(np.abs(C - np.diag(np.diag(C))) > REPRESENTED * np.sqrt(np.outer(np.diag(C), np.diag(C)))):
            why = "its `stiffness` has numbers off the diagonal"
        else:
            return
        message = f"an `ancf-cable` has the same bending stiffness in all directions, and nothing couples its strains; here {why}: {OTHERS}"
        yield Problem(("section",), message)

    def _problems_of_stations(self) -> Iterator[Problem]:
        near: dict[float, str] = {0.0: START, 1.0: END}
        for name, share in self.stations.items():
            if name in (START, END):
                yield Problem(("stations", name), f"every beam has a station `{name}`; choose another name")
            elif not 0.0 < share < 1.0:
                yield Problem(("stations", name), f"a share of the length between 0 and 1 was expected, got {share:g}")
            elif close := [other for at, other in near.items() if abs(at - share) < LEAST]:
                message = f"it is where `{close[0]}` is; stations are {LEAST:g} of the length apart at least"
                yield Problem(("stations", name), message)
            else:
                near[share] = name
        if self.elements < len(near) - 1:
            message = f"{len(near) - 1} at least are needed, one between each two stations; got {self.elements}"
            yield Problem(("elements",), message)


def _divided(lengths: Array, count: int) -> list[int]:
    """`count` elements over parts of these lengths, at least one each, the longest elements as short as can be."""
    free = count - len(lengths)
    counts = np.maximum(1, (lengths / np.sum(lengths) * free).astype(int))  # not more than each will have
    while np.sum(counts) < count:
        counts[int(np.argmax(lengths / counts))] += 1
    return counts.tolist()
