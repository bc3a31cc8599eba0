"""A model of another program as the data of a machine file, with the meshes that were made for it and the notes of its translation."""

import re
from collections import Counter
from collections.abc import Iterable
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.files.mesh_file import stl_content
from nivel.files.outline import FORMAT
from nivel.files.writer import write_data
from nivel.lazy import Struct, field
from nivel.machine.core.orientation import euler_parameters_from_matrix
from nivel.machine.core.record import GROUND, NAME

MOST_NAMES: Final = 12  # of a note, in a line


class Notes(Struct, frozen=False):
    """Notes in their order; each is a sentence, and the elements with their lines that it is about."""

    changed: dict[str, dict[str, int]] = field(default_factory=dict)
    left_out: dict[str, dict[str, int]] = field(default_factory=dict)
    acting: set[str] = field(default_factory=set)

    def change(self, sentence: str, name: str = "", line: int = 0) -> None:
        """Something has another form in the machine."""
        self.changed.setdefault(sentence, {}).setdefault(name, line)

    def leave(self, sentence: str, name: str = "", line: int = 0, *, acts: bool = False) -> None:
        """Something is not in the machine. acts : it has a part in the motion, so that the machine moves otherwise than the model."""
        self.acting |= {sentence} if acts else set()
        self.left_out.setdefault(sentence, {}).setdefault(name, line)

    def losses(self) -> list[str]:
        """What is not in the machine and has a part in the motion."""
        return [f"{sentence}{_about(names)}" for sentence, names in self.left_out.items() if sentence in self.acting]

    def lines(self) -> list[str]:
        """All notes under their headings."""
        out = []
        for heading, notes in (("translated in another form", self.changed), ("not translated", self.left_out)):
            if notes:
                out.append(f"{heading}:")
            out += [f"  - {sentence}{_about(names)}" for sentence, names in notes.items()]
        return out


def _about(names: dict[str, int]) -> str:
    given = [f"{name} (line {line})" if line else name for name, line in names.items() if name]
    if not given:
        return ""
    more = len(given) - MOST_NAMES
    return f": {', '.join(given[:MOST_NAMES])}{f' and {more} more' if more > 0 else ''}"


ONE: Final = {
    "bodies": "body",
    "markers": "marker",
    "joints": "joint",
    "couplings": "coupling",
    "forces": "force",
    "inputs": "input",
}
WIDTH: Final = 130  # of comments in a machine file


class Translation(Struct, frozen=False):
    """data : sections of the machine file. meshes : vertices (n, 3) and triangles (m, 3) of the files that belong to it, by their names.

    source : the file that was translated, and its format in words. lines : of an element by its name, where it is in the source, and what.
    """

    source: str
    format: str
    data: dict[str, Any]
    notes: Notes
    meshes: dict[str, tuple[NDArray[Any], NDArray[Any]]] = field(default_factory=dict)
    lines: dict[str, tuple[int, str]] = field(default_factory=dict)

    def summary(self) -> list[str]:
        """What was translated, in lines: counts of elements, and the notes."""
        counts = [
            f"{len(self.data[section])} {section if len(self.data[section]) > 1 else one}"
            for section, one in ONE.items()
            if self.data.get(section)
        ]
        kinds = Counter(joint["type"] for joint in self.data.get("joints", {}).values())
        joints = [f"joints by type: {', '.join(f'{count} {kind}' for kind, count in kinds.items())}"] if kinds else []
        return [f"translated: {', '.join(counts)}", *joints, *self.notes.lines()]

    def text(self) -> str:
        """The machine file; its comments say what was translated and what was not."""
        head = [f"Translated by nivel from {self.source} ({self.format}).", "", *self.summary()]
        comments = "".join(f"# {line}".rstrip() + "\n" for entry in head for line in _wrapped(entry))
        return comments + write_data({"format": FORMAT, **self.data})

    def files(self) -> dict[str, bytes]:
        """Contents of the mesh files that belong to it."""
        return {name: stl_content(*surface) for name, surface in self.meshes.items()}


def _wrapped(text: str) -> list[str]:
    import textwrap

    indent = " " * (len(text) - len(text.lstrip()) + 2)
    return textwrap.wrap(text, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False) or [""]


# kinds of elements that share their names
SHARED: Final = {"marker": "body", "coupling": "joint", "driver": "joint"}
IN_EXPRESSIONS: Final = ("input", "joint")  # where `-` is the minus sign


class Names(Struct, frozen=False):
    """Names given so far. taken : by kind. of : by kind and name in the source."""

    taken: dict[str, set[str]] = field(default_factory=dict)
    of: dict[tuple[str, str], str] = field(default_factory=dict)

    def name(self, kind: str, given: str) -> str:
        """The name for an element of a kind (`body`, `joint`, …); the same where it is asked again."""
        if (kind, given) not in self.of:
            self.of[kind, given] = self.new(given, kind)
        return self.of[kind, given]

    def new(self, wanted: str, kind: str) -> str:
        """A name that nothing of this kind has yet, the wanted one if possible."""
        taken = self.taken.setdefault(SHARED.get(kind, kind), {GROUND})
        other = r"\W+" if kind in IN_EXPRESSIONS else r"[^\w-]+"
        plain = re.sub(other, "_", wanted).strip("_") or kind
        base = plain if NAME.fullmatch(plain) else f"{kind}_{plain}"
        name, count = base, 2
        while name in taken:
            name, count = f"{base}_{count}", count + 1
        taken.add(name)
        return name

    def changed(self, kinds: Iterable[str]) -> list[str]:
        """Names of these kinds that are not those of the source, as `new was old`."""
        kinds = tuple(kinds)
        changed = [(old, new) for (kind, old), new in self.of.items() if kind in kinds and old != new]
        return [f"{new} was {old}" for old, new in dict.fromkeys(changed)]


TINY: Final = 1e-16


def number(value: float) -> float:
    """A number to fifteen digits."""
    return 0.0 if abs(value) < TINY else float(f"{value:.15g}")


def triple(values: Iterable[float]) -> list[float]:
    """Three numbers; those that round-off leaves beside larger ones are zero."""
    given = [float(each) for each in values]
    scale = max(map(abs, given), default=0.0)
    return [0.0 if abs(each) < TINY * max(scale, 1.0) else number(each) for each in given]


def turn(axes: NDArray[np.float64]) -> dict[str, Any]:
    """`orientation` for axes (3, 3) of a frame, nothing where they are not turned."""
    if np.abs(axes - np.eye(3)).max() < TINY:
        return {}
    parameters = euler_parameters_from_matrix(axes).tolist()
    return {"orientation": {"euler_parameters": [0.0 if abs(each) < TINY else each for each in parameters]}}
