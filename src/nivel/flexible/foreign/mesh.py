"""A mesh of another program: nodes, elements, sets, sections and materials, as its file has them."""

from collections.abc import Mapping
from typing import Final, NamedTuple

from nivel.flexible.foreign.deck import Card, Line
from nivel.flexible.foreign.elasticity import Law, Orientation
from nivel.flexible.foreign.matrix import fortran_number
from nivel.lazy import dataclass, field
from nivel.machine.core.vectors import Array, Whole

SHELLS: Final = {"S3": 3, "S4": 4, "S4R": 4, "S6": 6, "S8": 8, "S8R": 8}  # types of shells, with their number of nodes


class Shell(NamedTuple):
    """A shell element: its type, number, nodes, and its line in the file."""

    kind: str
    number: int
    nodes: tuple[int, ...]
    line: Line


class Section(NamedTuple):
    """Material and orientation of the elements of a set; of shells thickness, and offset of their nodes above their middle, in thicknesses.

    Names are in capitals; an orientation that is not given is empty. thickness : None of solids.
    problem : why it cannot be followed, or empty. line : of the keyword.
    """

    elements: str
    material: str
    orientation: str
    line: Line
    thickness: float | None = None
    offset: float = 0.0
    problem: str = ""

    def members(self, sets: Mapping[str, list[int]]) -> list[int]:
        """Numbers of the elements of the set."""
        return sets.get(self.elements, [])


def solid_section(card: Card) -> Section:
    """The section of a *SOLID SECTION."""
    problem = "*SOLID SECTION with COMPOSITE: layers cannot be followed" if "COMPOSITE" in card.options else ""
    return Section(card.name("ELSET"), card.name("MATERIAL"), card.name("ORIENTATION"), card.line, problem=problem)


def shell_section(card: Card, thickness: str) -> Section:
    """The section of a *SHELL SECTION with the thickness as it is written."""
    problem, height, offset = "", 0.0, 0.0
    for key, name, what in (
        ("NODALTHICKNESS", "NODAL THICKNESS", "thickness by nodes"),
        ("COMPOSITE", "COMPOSITE", "layers"),
    ):
        if key in card.options:
            problem = f"*SHELL SECTION with {name}: {what} cannot be followed; give each set of elements one thickness"
    try:
        height, offset = fortran_number(thickness), fortran_number(card.options.get("OFFSET", "0"))
    except ValueError:
        given = f"thickness `{thickness}`, OFFSET `{card.options.get('OFFSET', '0')}`"
        problem = problem or f"*SHELL SECTION needs a number for the thickness and for OFFSET, got {given}"
    names = card.name("ELSET"), card.name("MATERIAL"), card.name("ORIENTATION")
    return Section(*names, card.line, height, offset, problem)


SOLIDS: Final = {
    "C3D4": 4,
    "C3D4T": 4,
    "C3D6": 6,
    "C3D8": 8,
    "C3D8I": 8,
    "C3D8R": 8,
    "C3D10": 10,
    "C3D10M": 10,
    "C3D10MH": 10,
    "C3D10T": 10,
    "C3D15": 15,
    "C3D20": 20,
    "C3D20R": 20,
}  # types of elements whose stress can be recovered, with their number of nodes
# types of elements that store energy without a stress
SPRINGS: Final = frozenset({"SPRINGA", "SPRING1", "SPRING2", "GAPUNI"})
# types beside which stress is known
POINTS: Final = SPRINGS | {"MASS", "DASHPOTA", "DASHPOT1", "DASHPOT2", "DCOUP3D", "ROTARYI"}


class RigidGroup(NamedTuple):
    """Nodes that CalculiX moves as a rigid body, by *RIGID BODY or *COUPLING with *KINEMATIC.

    reference : node whose rows are its translations. rotation : node whose rows are its rotations; None: CalculiX makes one.
    members : name of the set of its nodes; empty where they are those of a surface.
    """

    reference: int
    rotation: int | None
    keyword: str
    line: Line
    members: str = ""


@dataclass
class Mesh:
    """Numbers (n,) and places (n, 3) of nodes; node sets by name; `elements` numbers of nodes of solids, by type.

    Names of sets, materials and orientations are in capitals. types : line of the first element of each type. element_sets : numbers of
    elements. element_numbers : of the solids, by type. planes : point and normal of shells that have become solids, by number.
    temperatures : by number of the node; None where the deck has none, and then zero of nodes that it leaves out.
    springs : whether springs or contact store energy beside the elements. stressless : why stress is not known, whatever the materials.
    notes : what was assumed, for the report. of_nodes : first keyword that gives normals or thicknesses by nodes, with its line, or None.
    """

    numbers: Whole
    places: Array
    sets: dict[str, list[int]] = field(default_factory=dict)
    elements: dict[str, list[list[int]]] = field(default_factory=dict)
    element_numbers: dict[str, list[int]] = field(default_factory=dict)
    types: dict[str, Line] = field(default_factory=dict)
    rigid: list[RigidGroup] = field(default_factory=list)
    shells: list[Shell] = field(default_factory=list)
    sections: list[Section] = field(default_factory=list)
    element_sets: dict[str, list[int]] = field(default_factory=dict)
    of_nodes: tuple[str, Line] | None = None
    laws: dict[str, Law] = field(default_factory=dict)
    orientations: dict[str, Orientation] = field(default_factory=dict)
    planes: dict[int, tuple[Array, Array]] = field(default_factory=dict)
    temperatures: dict[int, float] | None = None
    springs: bool = False
    stressless: list[str] = field(default_factory=list)
    notes: tuple[str, ...] = ()
