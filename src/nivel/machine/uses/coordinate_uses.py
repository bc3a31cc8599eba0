"""Uses of joint coordinates by couplings, drivers, forces and sensors: each exists, and none is driven twice."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any, Final

from nivel.elements.joints import JOINTS
from nivel.elements.joints.joint import COORDINATE_OF, CoordinateRates, CoordinateValues, held_by
from nivel.machine.core.index import Index, Place, as_list, as_mapping, elements
from nivel.machine.core.record import GROUND, Record, entry
from nivel.machine.uses.coordinate_reference import Kind, UnknownCoordinateError, find

Faults = Iterator[tuple[Place, str]]

# sections of elements that may have a `coordinate`
WITH_COORDINATE: Final = ("couplings", "drivers", "forces", "hydraulics", "sensors")

# of each type of coupling the key of its references, and the kinds of coordinate that they need
_COUPLED: Final[dict[str, tuple[str, tuple[Kind, ...]]]] = {
    "gear": ("joints", ("angle", "angle")),
    "belt": ("joints", ("angle", "angle")),
    "rack": ("joints", ("angle", "length")),
    "linear": ("coordinates", ()),
}


def coordinate_faults(machine: Any, index: Index) -> Faults:
    """Place and message of everything that is wrong."""
    for at, coupling in enumerate(elements(machine, "couplings")):
        yield from _of_coupling(coupling, index, ("couplings", at))
    driven: dict[tuple[object, ...], str] = {}
    for section in WITH_COORDINATE:
        for at, element in enumerate(elements(machine, section)):
            place = (section, at, "coordinate")
            found = yield from _find(entry(element, "coordinate"), index, None, place)
            if found is not None and section != "sensors":
                yield from _held(found, index, place)
            if section == "forces":
                yield from _of_other(element, found, index, (section, at, "against"))
            if section == "drivers":
                yield from _driven_twice(element, found, driven, (section, at))
    for at, reference in enumerate(as_list(entry(entry(machine, "simulation"), "free"))):
        place = ("simulation", "free", at)
        found = yield from _find(reference, index, None, place)
        if found is not None:
            yield from _held(found, index, place)
            if found in driven:
                yield place, f"`{'.'.join(found)}` is driven by `{driven[found]}`: it is not free"
    by_rate = {str(entry(each, "name")) for each in elements(machine, "drivers") if entry(each, "value") is None}
    for at, joint in enumerate(elements(machine, "joints")):
        yield from _started(joint, driven, by_rate, ("joints", at))


def _of_coupling(coupling: Any, index: Index, place: Place) -> Faults:
    type_ = entry(coupling, "type")
    if not isinstance(type_, str) or type_ not in _COUPLED:
        return
    key, kinds = _COUPLED[type_]
    seen: set[tuple[str, str]] = set()
    references = as_list(entry(coupling, key))
    for at, reference in enumerate(references):
        where = (*place, key, at)
        found = yield from _find(reference, index, kinds[at] if at < len(kinds) else None, where)
        if found is None:
            continue
        if "." not in reference and len(JOINTS[index.joints[found[0]]].coordinates) > 1:
            whole = [".".join(found) if k == at else str(each) for k, each in enumerate(references)]
            count = len(JOINTS[index.joints[found[0]]].coordinates)
            yield where, f"joint `{reference}` has {count} coordinates; write `{key}: [{', '.join(whole)}]`"
            continue
        if found in seen:
            yield where, f"the coordinate `{'.'.join(found)}` is coupled with itself; another one was expected"
        seen.add(found)
        yield from _held(found, index, where)


def _of_other(force: Any, found: tuple[str, str] | None, index: Index, place: Place) -> Faults:
    rims = entry(force, "type") == "belt-drive"
    if rims:
        yield from _find(entry(force, "coordinate"), index, "angle", (*place[:-1], "coordinate"))
    other = yield from _find(entry(force, "against"), index, "angle" if rims else None, place)
    if other is None:
        return
    if other == found:
        yield place, f"`{'.'.join(other)}` is the `coordinate` itself; another one was expected"
    yield from _held(other, index, place)


def _find(reference: Any, index: Index, kind: Kind | None, place: Place) -> Iterator[tuple[Place, str]]:
    """Yields what is wrong with `reference` and returns the joint and coordinate that it means, or None."""
    if not isinstance(reference, str):
        return None
    try:
        found = find(reference, index.joints, kind)
    except UnknownCoordinateError as problem:
        joint = reference.partition(".")[0]
        if joint not in index.joints or index.joints[joint] in JOINTS:  # else the type of the joint is at fault
            yield place, str(problem)
        return None
    return found


def _held(found: tuple[str, str], index: Index, place: Place) -> Faults:
    joint, coordinate = found
    if coordinate in JOINTS[index.joints[joint]].held:
        yield (
            place,
            f"`{joint}.{coordinate}` is held by the joint itself; one that changes is of `type: variable-distance`",
        )
    elif coordinate in held_by(index.locked[joint]):
        yield place, f"`{joint}.{coordinate}` does not change: {_why_held(coordinate, index.locked[joint])}"


def _why_held(coordinate: str, locked: tuple[Any, ...]) -> str:
    if coordinate in (COORDINATE_OF.get(str(each)) for each in locked):
        return f"the joint locks it (`locked: [{', '.join(map(str, locked))}]`)"
    return "an angle about z needs `rx` and `ry` locked"


def _driven_twice(
    driver: Any, found: tuple[str, str] | None, driven: dict[tuple[object, ...], str], place: Place
) -> Faults:
    marker = entry(driver, "marker")
    if found is not None:
        every: list[tuple[object, ...]] = [found]
        words, key = f"the coordinate `{'.'.join(found)}`", "coordinate"
    elif isinstance(marker, str):
        seen_from = str(entry(driver, "relative_to") or GROUND)
        every = [(marker, *motion, seen_from) for motion in _motions(driver)]
        words, key = f"this motion of the marker `{marker}`", "marker"
    else:
        return
    name = str(entry(driver, "name"))
    others = {driven.setdefault(what, name) for what in every} - {name}
    if others:
        yield (*place, key), f"{words} is driven by `{sorted(others)[0]}` already"


def _motions(driver: Any) -> Iterator[tuple[str, str]]:
    whole = [key for key in ("position", "orientation") if entry(driver, key) is not None]
    if not whole:
        yield str(entry(driver, "along")), str(entry(driver, "about"))
    for axis in "xyz":
        if "position" in whole:
            yield axis, str(None)
        if "orientation" in whole:
            yield str(None), axis


def _started(joint: Any, driven: Mapping[tuple[object, ...], str], by_rate: set[str], place: Place) -> Faults:
    """Start values of coordinates that are driven. by_rate : drivers by speeds and accelerations."""
    for key in ("start", "start_rates"):
        given = entry(joint, key)
        for coordinate in given.given if isinstance(given, CoordinateValues | CoordinateRates) else as_mapping(given):
            driver = driven.get((str(entry(joint, "name")), coordinate))
            if driver in by_rate and key == "start":
                told = f"the driver `{driver}` by a speed or an acceleration begins where the bodies are placed"
                yield (*place, key, coordinate), f"{told}: place them there, without `start`"
            elif driver is not None:
                yield (*place, key, coordinate), f"the driver `{driver}` says how this coordinate starts"


def with_whole_coordinates(data: Any) -> Any:
    """`data` of a machine in which every `coordinate: hinge` says which one it is: `coordinate: hinge.angle`.

    The unit of what belongs to the coordinate is then known where its record is read.
    """
    if not isinstance(data, Mapping):
        return data
    index = Index.of(data)
    whole = {
        section: [_with_whole_coordinate(element, index) for element in data[section]]
        for section in WITH_COORDINATE
        if isinstance(data.get(section), list | tuple)
    }
    return {**data, **whole}


def _with_whole_coordinate(element: Any, index: Index) -> Any:
    whole = {}
    for key in ("coordinate", "against"):
        reference = entry(element, key)
        if isinstance(reference, str) and "." not in reference:
            with suppress(UnknownCoordinateError):
                whole[key] = ".".join(find(reference, index.joints))
    if not whole:
        return element
    if isinstance(element, Record):
        element = {
            name: getattr(element, name) for name in (*element.model_fields_set, "type") if hasattr(element, name)
        }
    return {**element, **whole}
