"""A model of another program as the data of a machine file, with the meshes that were made for it and the notes of its translation."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import Any, Final

from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.exchange.notes import Notes
from nivel.files.mesh_file import stl_content
from nivel.files.outline import FORMAT
from nivel.files.writer import write_data

ONE: Final = {
    "bodies": "body",
    "markers": "marker",
    "joints": "joint",
    "couplings": "coupling",
    "forces": "force",
    "inputs": "input",
}
WIDTH: Final = 130  # of comments in a machine file


@dataclass
class Translation:
    """data : sections of the machine file. meshes : vertices (n, 3) and triangles (m, 3) of the files that belong to it, by their names.

    source : the file that was translated, and its format in words.
    """

    source: str
    format: str
    data: dict[str, Any]
    notes: Notes
    meshes: dict[str, tuple[NDArray[Any], NDArray[Any]]] = field(default_factory=dict)

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


def refuse(faults: list[Fault]) -> None:
    """Raises ModelError where there are faults."""
    if faults:
        raise ModelError(faults)
