"""Notes of a translation: what was translated in another form, and what was not translated."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

MOST_NAMES: Final = 12  # of a note, in a line


@dataclass
class Notes:
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
