"""Names of elements of a machine for names of other programs, which may have any characters."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Final

from nivel.machine.core.record import GROUND, NAME

# kinds of elements that share their names
SHARED: Final = {"marker": "body", "coupling": "joint", "driver": "joint"}
IN_EXPRESSIONS: Final = ("input", "joint")  # where `-` is the minus sign


@dataclass
class Names:
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
