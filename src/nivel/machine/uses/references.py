"""References of a machine: everything that it mentions exists, interfaces too. Reads raw data too: one fault hides no other."""

from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress
from typing import Any, Final

from nivel.elements.joints import JOINTS
from nivel.known import MachineRecord
from nivel.lazy import nivel
from nivel.machine.bodies.point_masses import point_mass_faults
from nivel.machine.bodies.touching import HULLS, ROUND, SHAPES_ON_PLANE
from nivel.machine.core.element import Marker
from nivel.machine.core.index import SECTIONS, Index, as_list, elements
from nivel.machine.core.record import GROUND, Place, Problem, Record, entry, unknown_word
from nivel.machine.laws.symbols import UnknownSymbolError, find_in, outputs_of, paths_in, states_of, symbol_faults
from nivel.machine.units.tree import Parameters
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, unknown_name
from nivel.machine.uses.coordinate_uses import coordinate_faults

__all__ = ["SECTIONS", "reference_faults"]

Faults = Iterator[tuple[Place, str]]

WITH_ROWS: Final = ("joints", "couplings", "drivers")  # their rows are called NAME.…, so they share their names
# keys of blocks that may use symbols; conditions are looked at in `nivel.machine.control.order`
CONTROL_KEYS: Final = (
    "value",
    "input",
    "inputs",
    "reference",
    "measured",
    "feedforward",
    "measured_speed",
    "speed_reference",
    "then",
    "otherwise",
    "law",
    "x",
    "y",
    "heading",
    "steering",
    "speed",
    "target",
)
SHARING: Final = {"beams": "bodies and beams", "control": "states and blocks of the control"}
_SHAPES: Final = ("box", "cylinder", "capsule", "tube", "sphere", "ellipsoid", "extrusion", "mesh")


def reference_faults(machine: Any, parameters: Parameters | None = None) -> Faults:
    """Place and message of every name that is used twice or mentioned in vain. `machine` is a record, or what it is
    made of, with the `parameters` of its file.
    """
    index = Index.of(machine)
    yield from _twice(machine)
    for at, marker in enumerate(elements(machine, "markers")):
        yield from _unknown_body(entry(marker, "body"), index, ("markers", at, "body"))
        if isinstance(marker, Mapping | Record) and entry(marker, "name") is None:
            yield ("markers", at), "`name` is missing"
    looks = (("joints", _of_joint), ("drivers", _of_driver), ("forces", _of_force), ("sensors", _of_sensor))
    for section, look in looks:
        for at, element in enumerate(elements(machine, section)):
            yield from look(element, index, (section, at))
    for at, block in enumerate(elements(machine, "control")):
        yield from symbol_faults(block, ("control", at), index, parameters or {}, CONTROL_KEYS)
    if elements(machine, "hydraulics"):
        yield from nivel.machine.uses.hydraulic_uses.hydraulic_faults(machine, index, parameters or {})
    for at, component in enumerate(elements(machine, "hydraulics")):
        yield from _of_pair(component, index, ("hydraulics", at), "a cylinder needs two different bodies")
    for at, coupling in enumerate(elements(machine, "couplings")):
        yield from _of_curve(coupling, index, parameters or {}, ("couplings", at))
    for section in ("forces", "states", "sensors", "events"):
        for at, element in enumerate(elements(machine, section)):
            yield from symbol_faults(element, (section, at), index, parameters or {})
    events = [name for event in elements(machine, "events") if isinstance(name := entry(event, "name"), str)]
    for at, state in enumerate(elements(machine, "states")):
        yield from _unknown(entry(state, "event"), events, "event", ("states", at, "event"))
    for at, name in enumerate(as_list(entry(entry(machine, "simulation"), "cut"))):
        yield from _unknown(name, tuple(index.joints), "joint", ("simulation", "cut", at))
    yield from coordinate_faults(machine, index)
    yield from point_mass_faults(machine, index)


def _twice(machine: Any) -> Faults:
    for sections in (
        ("bodies", "beams"),
        ("markers",),
        WITH_ROWS,
        ("forces",),
        ("fluids",),
        ("hydraulics",),
        ("inputs",),
        ("states", "control"),
        ("sensors",),
        ("events",),
    ):
        seen: dict[str, str] = {}
        for section in sections:
            for at, element in enumerate(elements(machine, section)):
                name = entry(element, "name")
                if not isinstance(name, str):
                    continue
                if name not in seen:
                    seen[name] = section
                    continue
                message = f"the name `{name}` stands twice in {section}"
                if seen[name] != section:
                    sharing = SHARING.get(section, "joints, couplings and drivers")
                    message = f"the name `{name}` stands in {seen[name]}; {sharing} share their names"
                yield (section, at, "name"), message


def _of_driver(driver: Any, index: Index, place: Place) -> Faults:
    marker, seen_from = entry(driver, "marker"), entry(driver, "relative_to")
    yield from _unknown_marker(marker, index, (*place, "marker"))
    if seen_from != GROUND:
        yield from _unknown_marker(seen_from, index, (*place, "relative_to"))
    on = index.body_of(marker) if isinstance(marker, str) else None
    against = GROUND if seen_from in (None, GROUND) else index.body_of(seen_from)
    if on is not None and on == against and marker != seen_from:
        yield (*place, "marker"), f"the marker `{marker}` is on `{on}`, relative to which it is driven; it cannot move"


def _of_curve(coupling: Any, index: Index, parameters: Parameters, place: Place) -> Faults:
    """What a coupling follows: positions of joints alone."""
    yield from symbol_faults(coupling, place, index, parameters)
    for where, path in paths_in(entry(coupling, "value"), (*place, "value"), index, parameters):
        joint, _, quantity = path.partition(".")
        if joint in index.joints and quantity in COORDINATE_KINDS:
            continue
        with suppress(UnknownSymbolError):
            find_in(path, index)
            yield (
                where,
                f"`{path}` is not a position of a joint; a coupling follows joint coordinates such as `hinge.angle`",
            )


def _of_force(force: Any, index: Index, place: Place) -> Faults:
    if entry(force, "type") == "contact":
        yield from _of_contact(force, index, place)
        return
    if entry(force, "type") == "contacts":
        for at, name in enumerate(as_list(entry(force, "between"))):
            yield from _of_shape(name, index, ("sphere",), (*place, "between", at))
        for at, plane in enumerate(as_list(entry(force, "planes"))):
            yield from _of_end(plane, index, (*place, "planes", at))
        return
    for key in ("edge", "contact", "opening"):
        for at, end in enumerate(as_list(entry(force, key))):
            yield from _of_end(end, index, (*place, key, at))
    for key in ("load_at", "wheel", "sprocket", "plane"):
        if (end := entry(force, key)) is not None:
            yield from _of_end(end, index, (*place, key))
    if (wheel := entry(force, "wheel")) is not None:
        yield from _of_wheel(wheel, entry(force, "plane"), index, place)
    yield from _unknown_body(entry(force, "body"), index, (*place, "body"))
    marker = entry(force, "marker")
    yield from _unknown_marker(marker, index, (*place, "marker"))
    if isinstance(marker, str) and index.body_of(marker) == GROUND:
        yield (*place, "marker"), f"the marker `{marker}` is on `{GROUND}`: a force there moves nothing"
    yield from _of_pair(force, index, place, "a force needs two different bodies")


def _of_wheel(wheel: Any, plane: Any, index: Index, place: Place) -> Faults:
    if index.body_of(wheel) == GROUND:
        yield (*place, "wheel"), f"the marker is on `{GROUND}`: a wheel there does not turn"
    elif index.body_of(wheel) is not None and index.body_of(wheel) == index.body_of(plane):
        yield (
            (*place, "plane"),
            f"the plane is on `{index.body_of(plane)}` itself; it needs another body, or `{GROUND}`",
        )


def _of_contact(contact: Any, index: Index, place: Place) -> Faults:
    body, plane = entry(contact, "body"), entry(contact, "plane")
    yield from _of_shape(body, index, SHAPES_ON_PLANE, (*place, "body"))
    yield from _of_touching_pair(contact, index, place)
    yield from _of_end(plane, index, (*place, "plane"))
    if isinstance(body, str) and index.body_of(plane) == _carrier(body, index):
        yield (
            (*place, "plane"),
            f"the plane is on `{index.body_of(plane)}` itself; it needs another body, or `{GROUND}`",
        )
    shape = index.touching.get(body, "") if isinstance(body, str) else ""
    if entry(contact, "heights") is not None and shape == "ellipsoid":
        yield (
            (*place, "heights"),
            f"the shape of `{body}` is `{shape}`, which touches flat planes alone: leave out `heights`",
        )
    if entry(contact, "materials") is not None and shape in SHAPES_ON_PLANE and shape != "sphere":
        message = f"`materials` give the stiffness of spheres (Hertz); the shape of `{body}` is `{shape}`: give its `stiffness`"
        yield (*place, "materials"), message


def _of_touching_pair(contact: Any, index: Index, place: Place) -> Faults:
    """Two bodies with shapes: those of a round one have a stiffness, two hulls a foundation."""
    pair = as_list(entry(contact, "bodies"))
    shapes = [index.touching.get(body, "") if isinstance(body, str) else "" for body in pair]
    for at, name in enumerate(pair):
        yield from _of_shape(name, index, SHAPES_ON_PLANE, (*place, "bodies", at))
    if len(pair) == 2 and all(isinstance(each, str) for each in pair) and pair[0] != pair[1]:
        first, second = (_carrier(each, index) for each in pair)
        if first == second:
            yield (*place, "bodies"), f"both shapes are on `{first}`; a contact needs two different bodies"
    if not shapes or not all(each in SHAPES_ON_PLANE for each in shapes):
        return
    if all(each in HULLS for each in shapes):
        for key in ("stiffness", "materials", "law"):
            if entry(contact, key) is not None:
                message = f"`{key}` is not for two of {', '.join(HULLS)}: give `foundation_modulus: 1e10 N/m^3`, pressure by depth"
                yield (*place, key), message
        return
    if entry(contact, "foundation_modulus") is not None:
        message = f"is for two of {', '.join(HULLS)}; what touches a {' or '.join((', '.join(ROUND[:-1]), ROUND[-1]))} takes a `stiffness`"
        yield (*place, "foundation_modulus"), message
    if entry(contact, "materials") is not None and shapes != ["sphere", "sphere"]:
        message = "`materials` give the stiffness of spheres on planes and of two spheres (Hertz): give the `stiffness`"
        yield (*place, "materials"), message


def _of_shape(body: Any, index: Index, allowed: tuple[str, ...], place: Place) -> Faults:
    """Whether `body`, or a marker of this name, is there and has one of the `allowed` shapes."""
    if not isinstance(body, str) or body not in index.touching:
        if isinstance(body, str) and body in index.markers:
            yield place, f"the marker `{body}` has no `shape`, and a contact needs a body or a marker with one"
        else:
            yield from _unknown_body(body, index, place)
        return
    shape = index.touching[body]
    wanted = " or ".join(", ".join(allowed).rsplit(", ", 1))
    if not shape:
        yield place, f"the body `{body}` has no shape; a contact here needs a {wanted}"
    elif shape in _SHAPES and shape not in allowed:
        yield place, f"the shape of `{body}` is `{shape}`; a contact here needs a {wanted}"


def _carrier(name: str, index: Index) -> str:
    return name if name in index.bodies else index.markers.get(name, name)


def _of_sensor(sensor: Any, index: Index, place: Place) -> Faults:
    yield from _unknown_marker(entry(sensor, "marker"), index, (*place, "marker"))
    seen_from = entry(sensor, "relative_to")
    if seen_from != GROUND:
        yield from _unknown_marker(seen_from, index, (*place, "relative_to"))
    for form in ("distance", "angle"):
        for at, end in enumerate(as_list(entry(sensor, form))):
            yield from _of_end(end, index, (*place, form, at))
    force, quantity = entry(sensor, "force"), entry(sensor, "quantity")
    yield from _unknown(force, index.forces, "force", (*place, "force"))
    known = index.forces.get(force) if isinstance(force, str) else None
    outputs = (*outputs_of(known), *states_of(known)) if known is not None else ()
    if outputs and isinstance(quantity, str) and quantity not in outputs:
        type_ = entry(index.forces[str(force)], "type")
        message = f"of the {type_} `{force}`, {unknown_word(quantity, outputs, 'quantity')}"
        yield (*place, "quantity"), message


def _of_joint(joint: Any, index: Index, place: Place) -> Faults:
    kind = JOINTS.get(str(entry(joint, "type")))
    bodies = as_list(entry(joint, "bodies"))
    placed = bool(entry(joint, "nodes"))  # its beam is nodes already
    if kind is None or not kind.rail or placed or len(bodies) != 2:
        yield from _of_pair(joint, index, place, "a joint needs two different bodies")
        return
    slider, beam = bodies
    if isinstance(slider, str) and slider in index.beams:
        yield (*place, "bodies", 0), f"`{slider}` is a beam; what slides comes first, the beam second"
    else:
        yield from _unknown_body(slider, index, (*place, "bodies", 0))
    if not isinstance(beam, str):
        return
    if beam not in index.beams:
        known = ", ".join(f"`{each}`" for each in index.beams) or "none"
        whole = beam.partition(".")[0]
        hint = f"write `{whole}`, the whole beam" if whole in index.beams else f"there are {known}"
        yield (*place, "bodies", 1), f"`{beam}` is not a beam, along which this joint slides; {hint}"
    elif isinstance(slider, str) and slider.partition(".")[0] == beam:
        yield (*place, "bodies"), f"`{slider}` is on the beam `{beam}` itself, and cannot slide along it"


def _of_pair(element: Any, index: Index, place: Place, needs: str) -> Faults:
    for at, body in enumerate(as_list(entry(element, "bodies"))):
        yield from _unknown_body(body, index, (*place, "bodies", at))
    ends = as_list(entry(element, "markers"))
    for at, end in enumerate(ends):
        yield from _of_end(end, index, (*place, "markers", at))
    on = [index.body_of(end) for end in ends]
    if len(on) == 2 and on[0] is not None and on[0] == on[1]:
        yield (*place, "markers"), f"both markers are on `{on[0]}`; {needs}"


def _of_end(end: Any, index: Index, place: Place) -> Faults:
    """A marker by name, or written out."""
    if isinstance(end, str):
        yield from _unknown_marker(end, index, place)
    else:
        yield from _unknown_body(entry(end, "body"), index, (*place, "body"))


def _unknown_body(name: Any, index: Index, place: Place) -> Faults:
    beam, dot, station = name.partition(".") if isinstance(name, str) else ("", "", "")
    if beam not in index.beams or name in index.bodies:
        if isinstance(name, str) and name not in index.bodies:
            yield from _unknown(name, (*index.bodies, GROUND), "body", place)
        return
    stations = ", ".join(f"`{each}`" for each in index.beams[beam])
    what = f"the beam `{beam}` has no station `{station}`" if dot else f"`{beam}` is a beam; a place on it is needed"
    yield place, f"{what}; there are {stations}"


def _unknown_marker(name: Any, index: Index, place: Place) -> Faults:
    if isinstance(name, str) and name in index.bodies and "." in name:
        yield place, f"`{name}` is a station of a beam; name a marker on it: `markers: {{tip: {{body: {name}}}}}`"
        return
    yield from _unknown(name, index.markers, "marker", place)


def _unknown(name: Any, known: Collection[str], what: str, place: Place) -> Faults:
    if isinstance(name, str) and name not in known:
        yield place, unknown_name(what, name, tuple(known))


def problems_of_interfaces(machine: MachineRecord) -> Iterator[Problem]:
    """Interfaces that are asked for on bodies that are not flexible."""
    flexible = {body.name for body in machine.bodies if body.flexible is not None}
    for place, marker in markers_of(machine):
        if marker.interface is not None and marker.body not in flexible:
            yield Problem(
                (*place, "interface"), f"`{marker.body}` is not flexible and has no interfaces: give a `position`"
            )
    for at, joint in enumerate(machine.joints):
        if joint.interface is not None and not flexible & set(joint.bodies or ()):
            yield Problem(
                ("joints", at, "interface"), "neither of the bodies is flexible and has interfaces: give a `point`"
            )


def markers_of(machine: MachineRecord) -> Iterator[tuple[Place, Marker]]:
    """Every marker of the machine, also those written out inside an element."""
    for at, marker in enumerate(machine.markers):
        yield ("markers", at), marker
    keys = {
        "joints": ("markers",),
        "forces": ("markers", "wheel", "plane"),
        "hydraulics": ("markers",),
        "sensors": ("distance", "angle"),
    }
    for section, names in keys.items():
        for at, element in enumerate(getattr(machine, section)):
            for key in names:
                ends = getattr(element, key, None)
                if isinstance(ends, Marker):
                    yield (section, at, key), ends
                elif isinstance(ends, tuple):
                    yield from (((section, at, key, k), end) for k, end in enumerate(ends) if isinstance(end, Marker))
