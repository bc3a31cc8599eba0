"""A finite-element model and its reduction in words: what a model file says."""

from collections.abc import Iterator
from typing import Annotated, Any, Final, Literal

from pydantic import BeforeValidator

from nivel.elements.beams.sections import Material, SectionRecord
from nivel.machine.core.coefficient import Truth
from nivel.machine.core.record import Checked, FileName, Name, Problem, unknown_word
from nivel.machine.given import Field, ManyNames, Maybe, OneNumber, OneRecord, TwoNames, TwoNumbers
from nivel.machine.machine_record import Title
from nivel.machine.units.quantity import (
    Direction,
    Length,
    Mass,
    Position,
    PositiveLength,
    Quantity,
    Whole,
    fault,
    shown,
)

FORMATS: Final = ("nastran", "op4", "abaqus", "calculix", "matrix-market")
LENGTHS: Final = {"m": 1.0, "dm": 0.1, "cm": 0.01, "mm": 1e-3, "in": 0.0254, "ft": 0.3048}
MASSES: Final = {"kg": 1.0, "g": 1e-3, "t": 1e3, "lb": 0.45359237, "lbf s^2/in": 175.126835, "slug": 14.59390294}
HELD: Final = ("x", "y", "z", "rx", "ry", "rz")

Frequency = Annotated[OneNumber, Quantity("frequency", positive=True)]
Count = Annotated[Whole, Field(strict=True, ge=0)]
Positive = Annotated[Whole, Field(strict=True, ge=1)]


def _text(value: Any) -> str:
    if not isinstance(value, str) or not value.strip():
        raise fault(f"a text was expected, got {shown(value)}")
    return value


Text = Annotated[str, BeforeValidator(_text)]


def _node(value: Any) -> Any:
    if isinstance(value, bool) or not isinstance(value, str | int | None):
        raise fault(f"the name or the number of a node was expected, got {shown(value)}")
    return value


class BeamRecord(Checked):
    """A straight beam between two nodes, divided into equal elements."""

    nodes: TwoNames[Name]
    section: Name
    material: Name
    elements: Positive = 8
    up: Maybe[Direction] = Field("the local z axis is as near to this direction as it can be", default=None)


class PointMassRecord(Checked):
    """A mass at a node of a frame."""

    node: Name
    mass: Mass


class Frame(Checked):
    """Nodes and the beams between them."""

    theory: Literal["timoshenko", "euler-bernoulli"] = "timoshenko"
    nodes: dict[Name, Position]
    beams: dict[Name, BeamRecord]
    masses: dict[Name, PointMassRecord] = Field(default={})


class Units(Checked):
    """The units of the files of another program; force and time follow: the unit of time is the second."""

    length: Literal["m", "dm", "cm", "mm", "in", "ft"] = "m"
    mass: Literal["kg", "g", "t", "lb", "lbf s^2/in", "slug"] = "kg"


class Matrices(Checked):
    """Stiffness and mass matrices, and nodes, from files of another program."""

    format: Literal["nastran", "op4", "abaqus", "calculix", "matrix-market"]
    stiffness: Text
    mass: Text | None = Field("default: the file of the stiffness has both", default=None)
    freedoms: Text | None = Field("which node and direction each row is", default=None)
    nodes: Text = Field("a mesh (.inp), bulk data (.bdf, .dat) or a table (.csv)")
    stiffness_name: str | None = Field("name of the matrix in the file", default=None)
    mass_name: str | None = Field("name of the matrix in the file", default=None)
    units: OneRecord[Units] = Field(default=Units())


class Plane(Checked):
    """The nodes on a plane."""

    point: Position
    normal: Direction

    def problems(self) -> Iterator[Problem]:
        if not any(self.normal):
            yield Problem(("normal",), "a direction was expected, got a vector of length zero")


class CylinderSurface(Checked):
    """The nodes on a cylinder, over its whole length or between two distances along the axis from the point."""

    point: Position
    axis: Direction
    radius: PositiveLength
    between: Maybe[TwoNumbers[Length]] = Field(default=None)

    def problems(self) -> Iterator[Problem]:
        if not any(self.axis):
            yield Problem(("axis",), "a direction was expected, got a vector of length zero")


class BoxRegion(Checked):
    """The nodes in a box between two opposite corners."""

    from_: Position = Field(key="from")
    to: Position


class InterfaceRecord(Checked):
    """Where the body is held or loaded: a node, or a set of nodes tied to a reference node."""

    node: Annotated[str | int | None, BeforeValidator(_node)] = Field("name or number of a node", default=None)
    nodes: tuple[int, ...] | None = Field("numbers of nodes that are tied", default=None)
    set: str | None = Field("name of a node set in the mesh, whose nodes are tied", default=None)
    plane: Maybe[OneRecord[Plane]] = Field(default=None)
    cylinder: Maybe[OneRecord[CylinderSurface]] = Field(default=None)
    box: Maybe[OneRecord[BoxRegion]] = Field(default=None)
    within: Maybe[OneRecord[BoxRegion]] = Field("only the nodes in this box", default=None)
    tie: Literal["rigid", "average"] = Field(
        "rigid: the nodes move as one solid (RBE2); average: they share the force (RBE3)", default="rigid"
    )
    at: Maybe[Position] = Field("the reference node; default: the middle of the nodes", default=None)
    tolerance: Maybe[PositiveLength] = Field("distance up to which a node is on a surface", default=None)

    def problems(self) -> Iterator[Problem]:
        ways = ("node", "nodes", "set", "plane", "cylinder", "box")
        given = [way for way in ways if getattr(self, way) is not None]
        if len(given) != 1:
            got = " and ".join(f"`{way}`" for way in given) or "none"
            yield Problem((), f"one of {', '.join(f'`{way}`' for way in ways)} was expected, got {got}")
        if given == ["node"]:
            for key in ("at", "within", "tolerance"):
                if getattr(self, key) is not None:
                    yield Problem((key,), f"`{key}` belongs to a set of nodes; this interface is a node", at_key=True)


class Modes(Checked):
    """How many normal modes: a count, or all up to a frequency; `given`: none, the user gives the shapes."""

    count: Count | None = None
    up_to: Maybe[Frequency] = Field(default=None)
    given: bool = False

    def problems(self) -> Iterator[Problem]:
        if self.count is None and self.up_to is None and not self.given:
            yield Problem((), "`count` or `up_to` (a frequency) was expected")


def _modes(value: Any) -> Any:
    if value == "given":
        return {"given": True}
    return {"count": value} if isinstance(value, int) and not isinstance(value, bool) else value


class ShapeFunction(Checked):
    """An assumed mode: displacement of the point x, y, z [m] as expressions of these; a missing one is zero.

    rx, ry, rz : turn of nodes that have one [rad]; a missing one follows from the displacement.
    """

    x: str | float = 0.0
    y: str | float = 0.0
    z: str | float = 0.0
    rx: str | float | None = None
    ry: str | float | None = None
    rz: str | float | None = None


class Reduction(Checked):
    """How the model becomes a flexible body."""

    modes: Annotated[Modes, BeforeValidator(_modes)] = Modes(count=10)
    method: Literal["craig-bampton", "free-interface", "normal-modes"] = "craig-bampton"
    shapes: tuple[ShapeFunction, ...] | Text = Field("of `modes: given`", default=())
    mass: Literal["consistent", "lumped"] = "consistent"
    reference: str = Field("mean-axis, or the interface with which the frame moves", default="mean-axis")
    held: ManyNames[str] = Field("six degrees of freedom `interface.x` … `interface.rz` instead", default=())
    inertia_modes: Truth = Field(
        "whether static answers to its own inertia (accelerations, spinning) are added to the modes", default=False
    )
    stiffening: Truth = Field("whether geometric stiffness is computed", default=False)

    def problems(self) -> Iterator[Problem]:
        if self.modes.given != bool(self.shapes):
            yield Problem(("shapes",), "`modes: given` and `shapes` belong together")
        if self.held and len(self.held) != 6:
            yield Problem(("held",), f"six degrees of freedom were expected, got {len(self.held)}")
        for at, text in enumerate(self.held):
            if text.rpartition(".")[2] not in HELD or not text.rpartition(".")[0]:
                yield Problem(
                    ("held", at), f"an interface and a direction, such as `root.x`, was expected, got `{text}`"
                )


class Recovery(Checked):
    """What can be found out about the body after a run."""

    stress: Truth = True
    strain: Truth = False
    nodes: Literal["all", "interfaces"] | tuple[int, ...] = Field("where stress is known", default="all")
    loads: Truth = Field("forces at the nodes, for load cases of other programs", default=False)


class _PartRecord(Checked):
    cut: Truth = Field("taken away from the parts before it instead of added", default=False)


class BoxPart(_PartRecord):
    """A block between two opposite corners."""

    type: Literal["box"] = "box"
    from_: Position = Field(key="from")
    to: Position

    def problems(self) -> Iterator[Problem]:
        if any(a == b for a, b in zip(self.from_, self.to, strict=True)):
            yield Problem(("to",), "the block has no thickness: `from` and `to` differ along all three axes")


class _RoundPart(_PartRecord):
    from_: Position = Field(key="from")
    to: Position
    radius: PositiveLength

    def problems(self) -> Iterator[Problem]:
        if self.from_ == self.to:
            yield Problem(("to",), "`from` and `to` are the same point")


class CylinderPart(_RoundPart):
    """A round bar between two points of its axis."""

    type: Literal["cylinder"] = "cylinder"


class ConePart(_RoundPart):
    """A round bar that tapers from `radius` to `end_radius`."""

    type: Literal["cone"] = "cone"
    end_radius: PositiveLength

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.radius == self.end_radius:
            yield Problem(("end_radius",), "equal radii make a `cylinder`")


class SpherePart(_PartRecord):
    """A ball."""

    type: Literal["sphere"] = "sphere"
    centre: Position
    radius: PositiveLength


Part = Annotated[BoxPart | CylinderPart | ConePart | SpherePart, Field(discriminator="type")]


class Solid(Checked):
    """A solid of one material, meshed with tetrahedra of ten nodes."""

    parts: tuple[Part, ...] = ()
    file: FileName | None = Field("a STEP file", default=None)
    material: Name
    element_size: PositiveLength
    tagged = {"parts": 2}  # noqa: RUF012

    def problems(self) -> Iterator[Problem]:
        if (self.file is None) == (not self.parts):
            yield Problem((), "either `parts` or a `file` was expected")
        if self.parts and self.parts[0].cut:
            yield Problem(("parts", 0, "cut"), "the first part has nothing to be cut from")


class ModelRecord(Checked):
    """A finite-element model, its interfaces, and how it is reduced."""

    name: Title
    description: str = ""
    materials: dict[Name, Material] = Field(default={})
    sections: dict[Name, SectionRecord] = Field(default={})
    frame: Maybe[OneRecord[Frame]] = Field(default=None)
    solid: Maybe[OneRecord[Solid]] = Field(default=None)
    matrices: Maybe[OneRecord[Matrices]] = Field(default=None)
    interfaces: dict[Name, InterfaceRecord] = Field(default={})
    reduction: OneRecord[Reduction] = Field(default=Reduction())
    recovery: OneRecord[Recovery] = Field(default=Recovery())
    expected_mass: Maybe[Mass] = Field("what the body should weigh, to check the units", default=None)

    tagged = {"sections": 2}  # noqa: RUF012

    def problems(self) -> Iterator[Problem]:
        sources = [key for key in ("frame", "solid", "matrices") if getattr(self, key) is not None]
        if len(sources) != 1:
            got = " and ".join(f"`{key}`" for key in sources) or "none"
            yield Problem((), f"one of `frame`, `solid` and `matrices` was expected, got {got}")
        if self.frame is not None:
            yield from self._problems_of_frame(self.frame)
        if self.solid is not None and self.solid.material not in self.materials:
            place = ("solid", "material")
            yield Problem(place, unknown_word(self.solid.material, list(self.materials), "material"))
        yield from self._problems_of_reduction()

    def _problems_of_frame(self, frame: Frame) -> Iterator[Problem]:
        for name, beam in frame.beams.items():
            place = ("frame", "beams", name)
            for at, node in enumerate(beam.nodes):
                if node not in frame.nodes:
                    yield Problem((*place, "nodes", at), unknown_word(node, list(frame.nodes), "node"))
            if beam.section not in self.sections:
                yield Problem((*place, "section"), unknown_word(beam.section, list(self.sections), "section"))
            if beam.material not in self.materials:
                yield Problem((*place, "material"), unknown_word(beam.material, list(self.materials), "material"))
            if all(node in frame.nodes for node in beam.nodes):
                ends = [frame.nodes[node] for node in beam.nodes]
                if sum((a - b) ** 2 for a, b in zip(*ends, strict=True)) < 1e-18:
                    yield Problem((*place, "nodes"), "the beam has no length: both nodes are at the same place")
        if not frame.beams:
            yield Problem(("frame", "beams"), "a frame needs at least one beam")
        for name, mass in frame.masses.items():
            if mass.node not in frame.nodes:
                yield Problem(("frame", "masses", name, "node"), unknown_word(mass.node, list(frame.nodes), "node"))

    def _problems_of_reduction(self) -> Iterator[Problem]:
        reduction, names = self.reduction, list(self.interfaces)
        if reduction.reference != "mean-axis" and reduction.reference not in self.interfaces:
            message = unknown_word(reduction.reference, ["mean-axis", *names], "reference")
            yield Problem(("reduction", "reference"), message)
        if reduction.reference != "mean-axis" and reduction.held:
            yield Problem(("reduction", "held"), "`reference` and `held` say the same: give one of them", at_key=True)
        for at, text in enumerate(reduction.held):
            if text.rpartition(".")[0] not in self.interfaces:
                yield Problem(("reduction", "held", at), unknown_word(text.rpartition(".")[0], names, "interface"))
        if reduction.method == "free-interface" and not self.interfaces:
            yield Problem(("reduction", "method"), "attachment modes need `interfaces` where loads act")
