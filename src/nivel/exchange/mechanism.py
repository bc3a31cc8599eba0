"""The rigid part of a model of another program: links placed in space, and what connects them.

Every reader (URDF, SDF, MJCF) gives this; `machine.py` writes it as a machine. All links stand where the joint coordinates are as `placed`,
zero unless joints follow each other with an offset. SI, angles in radians, vectors in global axes unless they are said to be in the frame
of a link.
"""

from functools import cached_property
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault
from nivel.exchange.translation import Names, Notes
from nivel.lazy import Struct, field
from nivel.machine.core.record import GROUND
from nivel.machine.core.vectors import Array

Triple = tuple[float, float, float]

WORLD: Final = ""  # in place of the name of a link: the fixed world
MOST_LINKS: Final = 10_000


class Frame(Struct):
    """A frame: axes (3, 3), whose columns are its axes, and origin (3,) [m], both in the frame around it."""

    axes: Array = field(default_factory=lambda: np.eye(3))
    origin: Array = field(default_factory=lambda: np.zeros(3))

    def __matmul__(self, inner: "Frame") -> "Frame":
        """`inner`, given in this frame, in the frame around this one."""
        return Frame(self.axes @ inner.axes, self.axes @ inner.origin + self.origin)

    @property
    def inverse(self) -> "Frame":
        """The frame around this one, in this one."""
        return Frame(self.axes.T, -self.axes.T @ self.origin)


def turned(roll: float, pitch: float, yaw: float) -> Array:
    """(3, 3) rotation about the fixed axes x, y, z, in this order."""
    c, s = np.cos, np.sin
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, c(roll), -s(roll)], [0.0, s(roll), c(roll)]])
    about_y = np.array([[c(pitch), 0.0, s(pitch)], [0.0, 1.0, 0.0], [-s(pitch), 0.0, c(pitch)]])
    about_z = np.array([[c(yaw), -s(yaw), 0.0], [s(yaw), c(yaw), 0.0], [0.0, 0.0, 1.0]])
    return about_z @ about_y @ about_x


class Inertial(Struct):
    """Mass [kg], centre of mass (3,) [m] and inertia (3, 3) [kg m²] about it, both in the frame of the link."""

    mass: float
    centre: Array
    inertia: Array


class Look(Struct):
    """A solid that is drawn. place : of its middle in the frame of the link, cylinders and capsules along its z axis.

    sizes : three lengths of a box, radii of an ellipsoid; radius and length; radius. file, scale : of a mesh, one factor for each of its
    axes. surface : vertices and triangles.
    """

    kind: Literal["box", "cylinder", "capsule", "sphere", "ellipsoid", "mesh", "surface", "plane"]
    place: Frame
    sizes: tuple[float, ...] = ()
    file: str = ""
    scale: Triple = (1.0, 1.0, 1.0)
    colour: str = ""
    line: int = 0
    surface: tuple[Array, NDArray[np.uint32]] | None = None


class Link(Struct, frozen=False):
    """A link. place : global. inertial : None where none is given."""

    name: str
    place: Frame
    inertial: Inertial | None = None
    looks: list[Look] = field(default_factory=list)
    line: int = 0


class Connection(Struct, frozen=False):
    """A joint. kind : the type of joint in a machine file. bodies : names of two links, or WORLD. placed : its coordinate where the links
    stand.

    lower, upper : ends of its way. mimic : name of another joint, factor and offset. follows : name of another joint, and factors a of
    q = reference + a₀ + a₁ d + a₂ d² + …, d the way of that from its own `reference`. stiffness, free : of a spring. armature : inertia of
    a rotor at the coordinate [kg m² or kg]. hardness : stiffness of the ends, 0 where nothing is said of it. creep : rate at which
    friction holds no more, 0 where it sticks. start : of the coordinate. frames : in both links, which an open joint brings together.
    """

    name: str
    kind: str
    bodies: tuple[str, str]
    point: Array
    axes: tuple[Array, ...] = ()
    lower: float | None = None
    upper: float | None = None
    effort: float | None = None
    damping: float = 0.0
    hardness: float = 0.0
    friction: float = 0.0
    creep: float = 0.0
    stiffness: float = 0.0
    free: float = 0.0
    armature: float = 0.0
    mimic: tuple[str, float, float] | None = None
    follows: tuple[str, tuple[float, ...]] | None = None
    pitch: float | None = None
    start: float | None = None
    placed: float = 0.0
    reference: float = 0.0
    frames: tuple[Frame, Frame] | None = None
    line: int = 0

    @property
    def lumps(self) -> bool:
        """Whether it makes both links one body."""
        return self.kind == "fixed" and self.frames is None

    @property
    def coordinate(self) -> str:
        """Name of its only joint coordinate, or an empty text."""
        return {"revolute": "angle", "translational": "displacement", "screw": "angle"}.get(self.kind, "")


Terms = tuple[tuple[str, float], ...]  # joints or spans by name and their factors f in a length l = Σ f q


class Span(Struct):
    """The distance of two points, each by a link and its place (3,) in that."""

    name: str
    ends: tuple[tuple[str, Array], tuple[str, Array]]
    coordinate: str = "distance"
    reference: float = 0.0


class Rope(Struct):
    """A rope along a way of (link, point (3,) in the link, signed radius of a wheel or 0). axis : of the wheels, global, as in a machine
    file; None without wheels. length [m] : from which on it pulls. stiffness : 0 where it is an end, which is found later."""

    name: str
    way: list[tuple[str, Array, float]]
    axis: Array | None
    length: float
    stiffness: float
    damping: float


class Actuator(Struct, frozen=False):
    """A force F = (gain[0] + gain[1] l + gain[2] l̇) a + bias[0] + bias[1] l + bias[2] l̇ along a length l, within `limit`.

    Each joint has f F. control, activation : ranges of the control u and of a. time : of the filter a from u [s], 0 of an integrator of u,
    None where a = u. rest : u without operator.
    """

    name: str
    terms: Terms
    gain: Triple
    bias: Triple = (0.0, 0.0, 0.0)
    limit: tuple[float, float] | None = None
    control: tuple[float, float] | None = None
    activation: tuple[float, float] | None = None
    time: float | None = None
    rest: float = 0.0


class Tendon(Struct, frozen=False):
    """A length of joints with a spring that is slack between `free`, a damper, and ends; those have a stiffness that is found later."""

    name: str
    terms: Terms
    stiffness: float = 0.0
    free: tuple[float, float] = (0.0, 0.0)
    damping: float = 0.0
    ends: tuple[float, float] | None = None


class Surface(Struct):
    """What a file says of the surface of a solid. stiffness [N/m], damping [N s/m] : of a point, None where it says nothing."""

    friction: float = 1.0
    stiffness: float | None = None
    damping: float | None = None


class Solid(Struct):
    """A solid of a link, or of WORLD, that touches others. look : its kind and place; a `plane` has its normal along z.

    apart_from : name of the model whose other solids it does not touch.
    """

    name: str
    link: str
    look: Look
    surface: Surface = Surface()
    apart_from: str = ""


class Touch(Struct):
    """Two solids by name that touch. stiffness [N/m] : of a point; damping [s/m] : factor of the force by the speed of approach. spin,
    roll [m] : moments of friction by the normal force."""

    first: str
    second: str
    friction: float
    stiffness: float
    damping: float
    spin: float = 0.0
    roll: float = 0.0


class Group(Struct, frozen=False):
    """Links that move as one. first : the one whose frame is that of the body, WORLD for the ground. links : all of them."""

    first: str
    links: list[str] = field(default_factory=list)


class Mechanism(Struct, frozen=False):
    """links by name, and what connects them. gravity : (3,) [m/s²].

    sites : further frames, (name, link, frame in the link). lifts : constant forces, (link, point in the link, force in global axes).
    step : of its simulation [s]. solids, touches : what touches, by name, and pairs of it. stands : whether a ground is put below what
    touches and moves. sums : lengths by name that stay as they are. names, faults : of its translation, from a `file`.
    """

    name: str
    format: str
    gravity: Triple
    links: dict[str, Link] = field(default_factory=dict)
    connections: list[Connection] = field(default_factory=list)
    notes: Notes = field(default_factory=Notes)
    actuators: list[Actuator] = field(default_factory=list)
    sites: list[tuple[str, str, Frame]] = field(default_factory=list)
    lifts: list[tuple[str, Array, Array]] = field(default_factory=list)
    step: float | None = None
    solids: dict[str, Solid] = field(default_factory=dict)
    touches: list[Touch] = field(default_factory=list)
    stands: bool = False
    tendons: list[Tendon] = field(default_factory=list)
    sums: list[tuple[str, Terms]] = field(default_factory=list)
    spans: list[Span] = field(default_factory=list)
    ropes: list[Rope] = field(default_factory=list)
    names: Names = field(default_factory=Names)
    file: str = ""
    faults: list[Fault] = field(default_factory=list)

    def fault(self, line: int, where: str, message: str) -> None:
        """Remember what is wrong in a line of the file."""
        self.faults.append(Fault(self.file, line, 1, where, message))

    def body(self, link: str) -> str:
        """Name in the machine file of the body that a link is part of."""
        first = self.groups[link].first
        return GROUND if first == WORLD else self.names.name("body", first)

    @cached_property
    def groups(self) -> dict[str, Group]:
        """The group of every link and of WORLD, by name of the link; the first link is the one nearest to the root."""
        parent: dict[str, str] = {name: name for name in (WORLD, *self.links)}

        def root(name: str) -> str:
            while parent[name] != name:
                parent[name] = parent[parent[name]]
                name = parent[name]
            return name

        for each in self.connections:
            if not each.lumps:
                continue
            first, second = map(root, each.bodies)
            if second == WORLD:
                first, second = second, first
            if first != second:
                parent[second] = first
        found = {name: Group(name) for name in dict.fromkeys(map(root, parent))}
        for name in self.links:
            found[root(name)].links.append(name)
        return {name: found[root(name)] for name in parent}

    @property
    def measured(self) -> dict[str, Connection | Span]:
        """What has a coordinate, by name."""
        return {each.name: each for each in (*self.connections, *self.spans)}

    def roots(self) -> list[str]:
        """Links that are the second of no connection."""
        carried = {each.bodies[1] for each in self.connections}
        return [name for name in self.links if name not in carried]
