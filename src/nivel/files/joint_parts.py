"""Parts of a joint that act at its coordinate, as keys of the joint: `stops`, `friction`, `rotor_inertia` and `backlash`.

Each becomes the elements that one would write beside the joint. A rotor is a body on the ground that turns by as many radians as the
coordinate has radians or metres: its kinetic energy is ½ I ċ², and it is exact in all coordinates and formulations. Nothing of it depends
on the motion of the bodies: gyroscopic moments of the rotor are left out, as the armature of other programs leaves them out. It is no part
of the machine: no mass, list or export contains it. With backlash its gear is a shaft with play, and motors of the joint turn the rotor.
"""

from collections.abc import Iterator
from typing import Any, Final

from nivel.elements.joints import drawn
from nivel.files.outline import section_of
from nivel.files.tree import Path, Tree
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.quantity import shown
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, resolve

INERTIA, STOPS, FRICTION, BACKLASH = "rotor_inertia", "stops", "friction", "backlash"
ROTOR: Final = "rotor"
MOTORS: Final = ("motor", "servo", "dc-motor", "servo-motor")  # what turns the rotor where there is backlash
# key → record whose keys its mapping has, and those of them that it has not
RECORDS: Final = {STOPS: "Stop", FRICTION: "Friction", BACKLASH: "Shaft"}
FILLED: Final = ("name", "type", "coordinate", "against", "ratio", "free_value", "backlash")
# key → description, keys beside those of the record
DESCRIBED: Final = {
    INERTIA: "inertia of what turns with the coordinate, such as the rotor of a motor times its squared gear ratio",
    STOPS: "ends of the way, with the keys of a stop",
    FRICTION: "dry friction: an effort that sticks, or the keys of a friction, `effort` in place of coefficient and load",
    BACKLASH: "`play` between rotor and joint, from flank to flank, with the stiffness and damping of a shaft; needs `rotor_inertia`",
}
MORE: Final = {STOPS: (), FRICTION: ("effort",), BACKLASH: ("play",)}


def add_joint_parts(tree: Tree) -> None:
    """Take these keys out of all joints, and put elements in their place. Faults go to `tree.faults`."""
    for name, joint in list(section_of(tree, "joints").items()):
        if not isinstance(joint, dict):
            continue
        given = {key: joint.pop(key) for key in DESCRIBED if key in joint}
        free = drawn(str(joint.get("type"))).coordinates if given else ()
        inertias = dict(_by_coordinate(tree, name, INERTIA, given, free))
        plays = dict(_by_coordinate(tree, name, BACKLASH, given, free))
        for coordinate, (value, path) in inertias.items():
            _add_rotor(tree, name, joint, coordinate, value, path, len(free) == 1, plays.pop(coordinate, None))
        for _, path in plays.values():
            tree.report(path, f"`{BACKLASH}` is between a rotor and the joint: give its `{INERTIA}` too")
        for key, add in ((STOPS, _stops), (FRICTION, _friction)):
            for coordinate, (value, path) in _by_coordinate(tree, name, key, given, free):
                stem = name if len(free) == 1 else f"{name}_{coordinate}"
                force = add(tree, value, path, COORDINATE_KINDS[coordinate] == "angle")
                if force is not None:
                    its_name = f"{stem}_{'stop' if key == STOPS else key}"
                    _put(tree, "forces", its_name, force | {"coordinate": f"{name}.{coordinate}"}, path)


def rotors_of(machine: MachineRecord) -> dict[str, tuple[str, str]]:
    """Bodies that `rotor_inertia` made: name, which is that of their joint too, to their gear, a coupling or with backlash a shaft, and the
    coordinate that they follow."""
    joints, rotors = {joint.name: joint for joint in machine.joints}, {}
    shafts: list[Any] = [each for each in machine.forces if each.type == "shaft" and each.name.endswith("_gear")]
    gears = [(each.name, each.terms) for each in machine.couplings]
    gears += [(each.name, ((each.coordinate, 1.0), (str(each.against), -each.ratio))) for each in shafts]
    for gear, terms in gears:
        rotor = gear.removesuffix("_gear")
        body, joint = machine.body_named.get(rotor), joints.get(rotor)
        if body is None or body.inertia is None or joint is None or joint.bodies != (GROUND, rotor):
            continue
        factors = {".".join(resolve(reference, machine.joints)): factor for reference, factor in terms}
        turn = factors.pop(f"{rotor}.angle", None)
        sizes = [abs(factor) for factor in factors.values()]
        if rotor.endswith(f"_{ROTOR}") and turn is not None and sizes == [abs(turn)]:
            rotors[rotor] = (gear, *factors)
    return rotors


def _by_coordinate(
    tree: Tree, name: str, key: str, all_given: dict[str, Any], free: tuple[str, ...]
) -> Iterator[tuple[str, tuple[Any, Path]]]:
    """Coordinate, what is given for it, and where. A joint with one coordinate need not name it."""
    given, path = all_given.get(key), ("joints", name, key)
    if key not in all_given:
        return
    named = isinstance(given, dict) and (key == INERTIA or not COORDINATE_KINDS.keys().isdisjoint(given))
    if not named and len(free) != 1:
        tree.report(path, f"{_which(free, key)}, got {shown(given)}")
    elif not named:
        yield free[0], (given, path)
    elif isinstance(given, dict):
        for coordinate, value in given.items():
            if coordinate in free:
                yield coordinate, (value, (*path, coordinate))
            else:
                tree.report((*path, coordinate), f"there is no coordinate `{coordinate}`; {_which(free, key)}")


def _which(free: tuple[str, ...], key: str) -> str:
    if not free:
        return f"this type of joint has no coordinate that {'a rotor could follow' if key == INERTIA else 'it could act on'}"
    first = free[0]
    if len(free) > 1:
        return f"a mapping such as `{{{first}: {'0.01 kg*m^2' if key == INERTIA else '{…}'}}}` was expected"
    return f"its coordinate is `{first}`"


def _stops(tree: Tree, given: Any, path: Path, angle: bool) -> dict[str, Any] | None:
    if isinstance(given, dict):
        return {"type": "stop", **_own(tree, given, path)}
    example = "{lower: -90 deg, upper: 90 deg, stiffness: 1 kN m/rad, restitution: 0.2}"
    tree.report(path, f"a mapping such as `{example}` was expected, got {shown(given)}")
    return None


def _friction(tree: Tree, given: Any, path: Path, angle: bool) -> dict[str, Any] | None:
    own = {"model": "stiction"} | _own(tree, given if isinstance(given, dict) else {"effort": given}, path)
    if "effort" in own:  # an effort of the coordinate: that of a load of as many newtons, at one metre
        for key in sorted({"coefficient", "normal_load", "radius"} & own.keys()):
            tree.report((*path, key), f"`{key}` must not be given with `effort`, which is all of them", at_key=True)
            del own[key]
        effort = own.pop("effort")
        load = f"max({effort}, 0 N m)/(1 m)" if angle and isinstance(effort, str) else effort  # refuses other units
        own |= {"coefficient": 1.0, "normal_load": load}
        own |= {"radius": 1.0} if angle else {}
        place = tree.places.get((*path, "effort"), tree.places.get(path))
        if place is not None:
            tree.places[*path, "normal_load"] = place
    return {"type": "friction", **own}


def _own(tree: Tree, given: dict[str, Any], path: Path) -> dict[str, Any]:
    """The keys of a mapping; those that the joint fills in are refused."""
    for key in [key for key in FILLED if key in given]:
        tree.report((*path, key), f"`{key}` does not belong here: the joint says it", at_key=True)
    return {key: value for key, value in given.items() if key not in FILLED}


def _put(tree: Tree, section: str, name: str, element: dict[str, Any], path: Path) -> bool:
    """Add an element, which stands in the file where `path` does. False where its name is taken, which is reported."""
    if name in section_of(tree, section):
        tree.report(path, f"what is made of it has the name `{name}`, which stands in {section} already")
        return False
    tree.data.setdefault(section, {})[name] = element
    tree.copy_places(path, (section, name))
    if path in tree.places:
        for places in (tree.places, tree.keys):
            places[section, name, "inertia"] = places.setdefault((section, name), tree.places[path])
    return True


def _add_rotor(
    tree: Tree,
    name: str,
    joint: dict[str, Any],
    coordinate: str,
    value: Any,
    path: Path,
    single: bool,
    play: tuple[Any, Path] | None,
) -> None:
    rotor = f"{name}_{ROTOR}" if single else f"{name}_{coordinate}_{ROTOR}"
    angle = COORDINATE_KINDS[coordinate] == "angle"
    moment = value if angle or not isinstance(value, str) else f"({value})*(1 m)^2"
    at, both = joint.get("point", [0, 0, 0]), [f"{name}.{coordinate}", f"{rotor}.angle"]
    pivot = {"type": "revolute", "bodies": [GROUND, rotor], "point": at, "axis": joint.get("axis", [0, 0, 1])}
    body = {"mass": 1.0, "inertia": [moment, moment, moment], "position": at}
    if not (_put(tree, "bodies", rotor, body, path) and _put(tree, "joints", rotor, pivot, path)):
        return
    if play is None:
        _put(tree, "couplings", f"{rotor}_gear", {"type": "linear", "coordinates": both, "factors": [1, -1]}, path)
        return
    given, here = play
    if not angle:
        tree.report(here, "a rotor on a length has no play; give the `backlash` to a drive, which has a gear")
    elif not isinstance(given, dict) or not {"play", "stiffness"} <= given.keys():
        example = f"{BACKLASH}: {{play: 0.5 deg, stiffness: 10 kN m/rad, damping: 5 N m s/rad}}"
        tree.report(here, f"`play` and `stiffness` of the flanks were expected: `{example}`, got {shown(given)}")
    else:
        shaft = {"type": "shaft", "coordinate": both[0], "against": both[1], "backlash": given["play"]}
        shaft |= {key: each for key, each in _own(tree, given, here).items() if key != "play"}
        _put(tree, "forces", f"{rotor}_gear", shaft, here)
        if "markers" in joint and coordinate not in (joint.get("start") or {}):
            tree.report(here, f"give the joint `start: {{{coordinate}: 0 deg}}`, where the rotor starts too")
        given_starts = {key: joint[key] for key in ("start", "start_rates") if isinstance(joint.get(key), dict)}
        pivot |= {key: {"angle": each[coordinate]} for key, each in given_starts.items() if coordinate in each}
        for force in section_of(tree, "forces").values():
            turns = isinstance(force, dict) and force.get("type") in MOTORS
            if turns and force.get("coordinate") in (both[0], name if single else both[0]):
                force["coordinate"] = both[1]
