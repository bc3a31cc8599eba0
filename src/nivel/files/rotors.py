"""`rotor_inertia:` of a joint: the inertia of what turns with a joint coordinate, such as the rotor of a motor behind its gear.

It is a body on the ground that turns by as many radians as the coordinate has radians or metres: its kinetic energy is ½ I ċ², and it is
exact in all coordinates and formulations. Nothing of it depends on the motion of the bodies: gyroscopic moments of the rotor are left out,
as the armature of other programs leaves them out. It is no part of the machine: no mass, list or export contains it.
"""

from __future__ import annotations

from typing import Any, Final

from nivel.elements.joints import drawn
from nivel.files.outline import section_of
from nivel.files.tree import Tree
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.quantity import shown
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, resolve

KEY: Final = "rotor_inertia"
ROTOR: Final = "rotor"


def add_rotors(tree: Tree) -> None:
    """Take `rotor_inertia` out of all joints, and put a rotor and its coupling in its place. Faults go to `tree.faults`."""
    for name, joint in list(section_of(tree, "joints").items()):
        if not isinstance(joint, dict) or KEY not in joint:
            continue
        given, path = joint.pop(KEY), ("joints", name, KEY)
        free = drawn(str(joint.get("type"))).coordinates
        if not isinstance(given, dict):
            if len(free) != 1:
                tree.report(path, f"{_which(free)}, got {shown(given)}")
                continue
            given = {free[0]: given}
        for coordinate, value in given.items():
            if coordinate not in free:
                tree.report((*path, coordinate), f"there is no coordinate `{coordinate}`; {_which(free)}")
            else:
                _add(tree, name, joint, coordinate, value, single=len(free) == 1)


def rotors_of(machine: MachineRecord) -> dict[str, tuple[str, str]]:
    """Bodies that `rotor_inertia` made: name, which is that of their joint too, to their coupling and the coordinate that they follow."""
    joints, rotors = {joint.name: joint for joint in machine.joints}, {}
    for coupling in machine.couplings:
        rotor = coupling.name.removesuffix("_gear")
        body, joint = machine.body_named.get(rotor), joints.get(rotor)
        if body is None or body.inertia is None or joint is None or joint.bodies != (GROUND, rotor):
            continue
        factors = {".".join(resolve(reference, machine.joints)): factor for reference, factor in coupling.terms}
        turn = factors.pop(f"{rotor}.angle", None)
        if (
            rotor.endswith(f"_{ROTOR}")
            and turn is not None
            and [abs(turn)] == [abs(factor) for factor in factors.values()]
        ):
            rotors[rotor] = (coupling.name, *factors)
    return rotors


def _which(free: tuple[str, ...]) -> str:
    if not free:
        return "this type of joint has no coordinate that a rotor could follow"
    first = free[0]
    if len(free) > 1:
        return f"a mapping such as `{{{first}: 0.01 kg*m^2}}` was expected"
    return f"its coordinate is `{first}`"


def _add(tree: Tree, name: str, joint: dict[str, Any], coordinate: str, value: Any, *, single: bool) -> None:
    rotor = f"{name}_{ROTOR}" if single else f"{name}_{coordinate}_{ROTOR}"
    moment = value if COORDINATE_KINDS[coordinate] == "angle" or not isinstance(value, str) else f"({value})*(1 m)^2"
    at = joint.get("point", [0, 0, 0])
    made = {
        "bodies": {rotor: {"mass": 1.0, "inertia": [moment, moment, moment], "position": at}},
        "joints": {
            rotor: {"type": "revolute", "bodies": [GROUND, rotor], "point": at, "axis": joint.get("axis", [0, 0, 1])}
        },
        "couplings": {
            f"{rotor}_gear": {
                "type": "linear",
                "coordinates": [f"{name}.{coordinate}", f"{rotor}.angle"],
                "factors": [1, -1],
            }
        },
    }
    here = ("joints", name, KEY)
    for section, elements in made.items():
        for its_name, element in elements.items():
            if its_name in section_of(tree, section):
                tree.report(here, f"its rotor needs the name `{its_name}`, which stands in {section} already")
                return
            tree.data.setdefault(section, {})[its_name] = element
            if here in tree.places:
                for path in ((section, its_name), (section, its_name, "inertia")):
                    tree.places[path] = tree.places[here]
                    tree.keys[path] = tree.keys.get(here, tree.places[here])
