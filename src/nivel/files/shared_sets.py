"""Sets of keys that several forces share: `tyres` and `ground`, whose keys are put into the forces that name them.

    tyres: {front: {radius: 31.5 cm, width: 20 cm, nominal_load: 4 kN}}
    ground: {yard: {plane: road, heights: {size: [80, 80], file: yard.csv}, grip: "if(y > 0, 0.3, 0.9)"}}
    forces: {left: {type: tyre, wheel: hub, tyre: front, ground: yard}}

What a force says itself goes before. A fault in a set is told once, where the set stands.
"""

from __future__ import annotations

from copy import deepcopy
from typing import Any, Final

from nivel.files.outline import SETS, section_of
from nivel.files.tree import Path, Tree
from nivel.machine.core.record import unknown_word
from nivel.machine.units.quantity import shown

# keys of `ground` that contacts do not have
OF_TYRES: Final = ("grip",)


def spread_sets(tree: Tree) -> None:
    """Take the sets out of the file, and put their keys where they are named. Faults go to `tree.faults`."""
    for section, key in SETS.items():
        sets = section_of(tree, section)
        tree.data.pop(section, None)
        known: set[str] = set()
        for name, force in section_of(tree, "forces").items():
            if not isinstance(force, dict) or key not in force or force.get("type") not in ("tyre", "contact"):
                continue
            named = force.pop(key)
            if not isinstance(named, str) or named not in sets:
                given = named if isinstance(named, str) else shown(named)
                tree.report(("forces", name, key), unknown_word(given, list(sets), f"entry of `{section}`"))
                tree.broken.add(("forces", name))
                continue
            spread = _spread(tree, sets[named], (section, named), name, force)
            if named in known:  # the same fault of a second force says nothing new
                tree.broken |= spread
            known.add(named)


def _spread(tree: Tree, keys: dict[str, Any], place: tuple[str, str], name: str, force: dict[str, Any]) -> set[Path]:
    """Put the keys of the set at `place` into the force `name`, with where they stand. Returns their paths there."""
    spread: set[Path] = set()
    for word, value in keys.items():
        if word in force or (word in OF_TYRES and force.get("type") != "tyre"):
            continue
        force[word] = deepcopy(value)
        for mine in (tree.places, tree.keys):
            for path in [path for path in mine if path[:3] == (*place, word)]:
                mine[("forces", name, *path[2:])] = mine[path]
        tree.files[("forces", name, word)] = tree.file_of((*place, word))
        spread.add(("forces", name, word))
    return spread
