"""Lines of an input file of CalculiX or Abaqus as it comes: comments, lower case, lines that go on, and *INCLUDE.

Blanks have no meaning in keywords and options, and case has none but in names of files.
"""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches
from pathlib import Path
from typing import Final, NamedTuple

from nivel.flexible.foreign.matrix import FormatError, text_lines

DEEPEST: Final = 10  # files that include each other


class Line(int):
    """The number of a line; `file` : the included file in which it is, or None in the deck itself."""

    file: Path | None = None

    @classmethod
    def of(cls, number: int, file: Path | None) -> Line:
        """The line `number` of `file`."""
        line = cls(number)
        line.file = file
        return line


class Card(NamedTuple):
    """A keyword in capitals, as `CARDS` names it; its options by names in capitals without blanks; its line."""

    keyword: str
    options: dict[str, str]
    line: Line

    def name(self, key: str) -> str:
        """The value of an option in capitals, as of a set or a material; empty where it is not given."""
        return self.options.get(key, "").upper()


def entries(path: Path) -> Iterator[tuple[Card, Line, list[str] | None]]:
    """Each card, with None, and then each line of its data: the card, the line, what stands between commas.

    Raises FormatError for cards that cannot be followed and that are not known.
    """
    card: Card | None = None
    head, start = "", Line(0)
    for line, text in _lines(path, path.parent, None, 0):
        if head:
            text, line = head + text, start  # noqa: PLW2901 a keyword goes on after a comma
        head = ""
        if text.startswith("*"):
            if text.endswith(","):
                head, start = text, line
                continue
            card = _card(text, line)
            yield card, line, None
        elif card is not None:
            yield card, line, [part.strip() for part in text.split(",")]
        else:
            raise FormatError(f"a keyword such as `*NODE` was expected, got `{text[:60]}`", line)
    if head:
        raise FormatError(f"the file ends where `{head[:60]}` goes on", start)


def _lines(path: Path, folder: Path, file: Path | None, depth: int) -> Iterator[tuple[Line, str]]:
    """Lines that are no comments, without blanks around them; those of included files in their place."""
    waiting = ""
    for number, raw in text_lines(path):
        text = raw.strip()
        if not text or text.startswith("**"):
            continue
        line = Line.of(number, file)
        if _squeezed(text.split(",")[0]) == "*INCLUDE" or waiting:
            waiting += text
            if waiting.endswith(","):
                continue
            yield from _included(_card(waiting, line), folder, depth)
            waiting = ""
            continue
        yield line, text


def _included(card: Card, folder: Path, depth: int) -> Iterator[tuple[Line, str]]:
    """The lines of the file that an *INCLUDE names, from the folder of the deck. Raises FormatError."""
    name = card.options.get("INPUT", "")
    path = folder / name
    if not name or not path.is_file():
        raise FormatError(f"*INCLUDE needs `INPUT=` with a file; there is no file `{path}`", card.line)
    if depth == DEEPEST:
        raise FormatError(
            f"*INCLUDE of `{name}`: files include each other {DEEPEST} deep; does one include itself?", card.line
        )
    yield from _lines(path, folder, path, depth + 1)


def _card(text: str, line: Line) -> Card:
    first, *parts = text.split(",")
    options = {}
    for part in parts:
        name, _, value = part.partition("=")
        options[_squeezed(name)] = value.strip().strip('"')
    squeezed = _squeezed(first[1:])
    plain = " ".join(first[1:].upper().split())
    # CalculiX looks at the begin of a keyword
    keyword = CARDS.get(squeezed) or CARDS.get(squeezed.removesuffix("S"), plain)
    if problem := refusal(keyword):
        raise FormatError(problem, line)
    return Card(keyword, options, line)


def _squeezed(text: str) -> str:
    return "".join(text.upper().split())


def _names(text: str) -> frozenset[str]:
    return frozenset(name.strip() for name in text.replace("\n", " ").split("|"))


USED: Final = _names(
    "COUPLING|ELASTIC|ELEMENT|ELSET|INCLUDE|INITIAL CONDITIONS|INSTANCE|KINEMATIC|MATERIAL|NODAL THICKNESS|NODE|NORMAL|NSET|ORIENTATION|"
    "RIGID BODY|SHELL SECTION|SOLID SECTION|STEP"
)
WITHOUT_INFLUENCE: Final = _names(
    # of CalculiX
    """AMPLITUDE|BASE MOTION|BEAM GENERAL SECTION|BEAM SECTION|BOUNDARY|BOUNDARYF|BUCKLE|CFD|CFLUX|CHANGE CONTACT TYPE|CHANGE FRICTION|
    CHANGE SURFACE BEHAVIOR|CLEARANCE|CLOAD|COMPLEX FREQUENCY|CONDUCTIVITY|CONSTRAINT|CONTACT DAMPING|CONTACT FILE|CONTACT OUTPUT|
    CONTACT PAIR|CONTACT PRINT|CONTROLS|CORRELATION LENGTH|COUPLED TEMPERATURE-DISPLACEMENT|CRACK PROPAGATION|DAMPING|DASHPOT|DENSITY|
    DEPVAR|DESIGN RESPONSE|DESIGN VARIABLES|DFLUX|DISTRIBUTING|DISTRIBUTING COUPLING|DISTRIBUTION TABLE|DLOAD|DSLOAD|DYNAMIC|
    ELECTRICAL CONDUCTIVITY|ELECTROMAGNETICS|ELEMENT OUTPUT|EL FILE|EL PRINT|END STEP|EQUATION|EXPANSION|FEASIBLE DIRECTION|FILM|FILTER|
    FLUID CONSTANTS|FLUID SECTION|FREQUENCY|FRICTION|GAP|GAP CONDUCTANCE|GAP HEAT GENERATION|GEOMETRIC CONSTRAINT|GEOMETRIC TOLERANCE|
    GREEN|HCF|HEADING|HEAT TRANSFER|MAGNETIC PERMEABILITY|MASS|MASS FLOW|MATRIX ASSEMBLE|MEMBRANE SECTION|MODAL DAMPING|MODAL DYNAMIC|
    MPC|NETWORK MPC|NO ANALYSIS|NODE FILE|NODE OUTPUT|NODE PRINT|OBJECTIVE|OUTPUT|PHYSICAL CONSTANTS|RADIATE|RANDOM FIELD|RESTART|
    RETAINED NODAL DOFS|ROBUST DESIGN|SECTION PRINT|SENSITIVITY|SPECIFIC GAS CONSTANT|SPECIFIC HEAT|SPRING|STATIC|STEADY STATE DYNAMICS|
    SUBSTRUCTURE GENERATE|SUBSTRUCTURE MATRIX OUTPUT|SURFACE|SURFACE BEHAVIOR|SURFACE INTERACTION|TIE|TIME POINTS|
    UNCOUPLED TEMPERATURE-DISPLACEMENT|USER SECTION|VALUES AT INFINITY|VIEWFACTOR|VISCO"""
) | _names(
    # of Abaqus alone
    """ASSEMBLY|BULK VISCOSITY|CONNECTOR BEHAVIOR|CONNECTOR ELASTICITY|CONNECTOR SECTION|CONTACT|CONTACT CONTROLS|CONTACT INCLUSIONS|
    CONTACT INITIALIZATION ASSIGNMENT|CONTACT PROPERTY ASSIGNMENT|CONTACT STABILIZATION|DIAGNOSTICS|ELEMENT MATRIX OUTPUT|
    EMBEDDED ELEMENT|END ASSEMBLY|END INSTANCE|END LOAD CASE|END PART|ENERGY OUTPUT|FASTENER|FASTENER PROPERTY|FILE FORMAT|
    HOURGLASS STIFFNESS|INERTIA RELIEF|KINEMATIC COUPLING|LOAD CASE|MATRIX GENERATE|MATRIX OUTPUT|MONITOR|NONSTRUCTURAL MASS|PART|
    PREPRINT|PRINT|RETAINED EIGENMODES|ROTARY INERTIA|SECTION CONTROLS|SELECT EIGENMODES|SHELL TO SOLID COUPLING|SURFACE SMOOTHING|
    TRANSVERSE SHEAR STIFFNESS"""
)
NO_STRESS: Final = dict.fromkeys(
    _names(
        """CREEP|CYCLIC HARDENING|DAMAGE INITIATION|DEFORMATION PLASTICITY|HYPERELASTIC|HYPERFOAM|HYPOELASTIC|MOHR COULOMB|
        MOHR COULOMB HARDENING|NO COMPRESSION|NO TENSION|PLASTIC|POROUS ELASTIC|RATE DEPENDENT|USER MATERIAL|VISCOELASTIC"""
    ),
    "is no linear elasticity",
) | {
    "CHANGE MATERIAL": "changes a material",
    "CHANGE PLASTIC": "changes a material",
    "CHANGE SOLID SECTION": "changes a section",
    "DISTRIBUTION": "gives axes or thicknesses element by element, and is not followed",
    "INITIAL STRAIN INCREASE": "adds strains",
    "PRE-TENSION SECTION": "adds a load inside of the body",
    "TEMPERATURE": "changes temperatures in a step; give those of the matrices by `*INITIAL CONDITIONS, TYPE=TEMPERATURE`",
    "USER ELEMENT": "has elements of its own",
}  # why stress is not known where a deck has the card
REFUSED: Final = {
    "CYCLIC SYMMETRY MODEL": "the matrices are those of a sector; write them of the whole body",
    "SELECT CYCLIC SYMMETRY MODES": "the matrices are those of a sector; write them of the whole body",
    "INITIAL MESH": "the mesh is another one than that of the deck; write the deck of the mesh that was computed",
    "MODEL CHANGE": "elements come and go; write a deck of the elements that are there",
    "REFINE MESH": "the mesh is another one than that of the deck; write the deck of the mesh that was computed",
    "USE REFINED MESH": "the mesh is another one than that of the deck; write the deck of the mesh that was computed",
    "SUBMODEL": "the model hangs on another one; write the matrices of a body that nothing holds",
    "TRANSFORM": "rows of nodes may be along axes of their own; remove it, also where the matrices are written",
    "TRANSFORMF": "rows of nodes may be along axes of their own; remove it, also where the matrices are written",
    "SYSTEM": "nodes are in axes of their own; write them in global ones",
    **dict.fromkeys(
        ("ELCOPY", "ELGEN", "NCOPY", "NFILL", "NGEN", "NMAP"),
        "nodes and elements are made by rules; write them one by one",
    ),
}
# names by how CalculiX reads them: without blanks
CARDS: Final = {name.replace(" ", ""): name for name in (*USED, *WITHOUT_INFLUENCE, *NO_STRESS, *REFUSED)}


def refusal(keyword: str) -> str:
    """Why a deck with this card cannot be read; empty where it can. keyword : in capitals, as in CARDS or as it stands."""
    if keyword in REFUSED:
        return f"*{keyword}: {REFUSED[keyword]}"
    if keyword.replace(" ", "") in CARDS:
        return ""
    near = get_close_matches(keyword, CARDS.values(), n=1, cutoff=0.75)
    hint = f"did you mean `*{near[0]}`?" if near else "take it out if nodes, rows and elasticity do not depend on it"
    return f"*{keyword} is no card that is known here; {hint}"
