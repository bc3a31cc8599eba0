"""Contacts of many spheres that stick, as single contacts of all pairs: each pair keeps its friction, whether it touches or not."""

from __future__ import annotations

from itertools import combinations
from typing import Any, Final

from nivel.files.outline import section_of
from nivel.files.tree import Tree
from nivel.machine.forces.contacts import ALL, MOST_PAIRS

TYPE: Final = "contacts"
# keys that single contacts have too
KEPT: Final = ("stiffness", "exponent", "restitution", "friction", "static_friction", "friction_work")


def divide_heaps(tree: Tree) -> None:
    """Put single contacts in place of `contacts` whose friction sticks: NAME_A_B of two bodies, NAME_A_1 of a body and the first
    plane. Those with faults stay, and are reported where the record is made. Faults go to `tree.faults`."""
    given = section_of(tree, "forces")
    forces: dict[str, Any] = {}
    for name, force in given.items():
        names = _spheres(tree, force)
        if names is None:
            forces[name] = force
            continue
        planes = force.get("planes", [])
        planes = planes if isinstance(planes, list) else [planes]
        count = len(names) * (len(names) - 1) // 2 + len(names) * len(planes)
        if count > MOST_PAIRS:
            message = f"`{name}` has {count} pairs, and friction that sticks can be found for {MOST_PAIRS}"
            message += "; with a `friction_transition_speed` they creep"
            tree.report(("forces", name), message)
            continue
        kept = {key: force[key] for key in KEPT if key in force}
        pairs: dict[str, dict[str, Any]] = {
            f"{name}_{first}_{second}": {"bodies": [first, second]} for first, second in combinations(names, 2)
        }
        pairs |= {
            f"{name}_{body}_{k + 1}": {"body": body, "plane": plane} for body in names for k, plane in enumerate(planes)
        }
        for pair, ends in pairs.items():
            if pair in given or pair in forces:
                tree.report(("forces", pair), f"`{pair}` is the name of a contact of `{name}`; take another one")
            forces[pair] = {"type": "contact", **ends, **kept}
            for places in (tree.places, tree.keys):
                for path in [path for path in places if path[:2] == ("forces", name)]:
                    places["forces", pair, *path[2:]] = places[path]
    if forces:
        tree.data["forces"] = forces


def _spheres(tree: Tree, force: Any) -> list[str] | None:
    """The bodies of `contacts` that stick; None of all else, and where anything is wrong."""
    if not isinstance(force, dict) or force.get("type") != TYPE or not force.get("friction"):
        return None
    model = force.get("friction_model") or ("coulomb" if "friction_transition_speed" in force else "stiction")
    if model != "stiction" or set(force) - {*KEPT, "type", "name", "friction_model", "between", "planes"}:
        return None
    if not {"stiffness", "restitution"} <= set(force):
        return None
    bodies = section_of(tree, "bodies")
    balls = [
        name
        for name, body in bodies.items()
        if isinstance(body, dict) and isinstance(body.get("shape"), dict) and body["shape"].get("type") == "sphere"
    ]
    names = balls if force.get("between") == ALL else force.get("between")
    if not isinstance(names, list) or len(names) < 2 or len(set(map(str, names))) < len(names):
        return None
    return names if all(name in balls for name in names) else None
