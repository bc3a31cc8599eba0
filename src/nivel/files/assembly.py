"""An entry of `assemblies:`: a part file that is placed, mirrored, given parameters, and whose elements get a prefix.

Every element of it is turned, moved and mirrored, so that it moves as before, seen from there.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, ValidationError

from nivel.elements.joints.couplings import FunctionCoupling, LinearCoupling, Rack
from nivel.elements.joints.drivers import MOTIONS, Driver
from nivel.errors import ModelError
from nivel.files.include import FileName, Sections
from nivel.files.outline import section_of
from nivel.files.placed_bodies import placed_beam, placed_body, placed_joint
from nivel.files.placed_forces import placed_ends, placed_force
from nivel.files.placement import AXIAL_Z, POLAR_Z, Placement, Scene
from nivel.files.substitution import NotRepresentableError, negative, renamed
from nivel.files.tree import Tree
from nivel.machine.core.element import Ends
from nivel.machine.core.orientation import Orientation
from nivel.machine.core.record import Record, entry, unknown_word
from nivel.machine.given import Field, Maybe, OneRecord
from nivel.machine.laws.time_function import Expression, PythonLaw, Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.parameters import resolve
from nivel.machine.signals.input import State
from nivel.machine.units.quantity import FAULT, Position, fault, shown
from nivel.machine.units.tree import Parameters
from nivel.machine.uses.references import SECTIONS


def placed_component(component: Any, scene: Scene) -> Any:
    """`component` in the placed part.

    Raises NotRepresentableError.
    """
    coordinate = getattr(component, "coordinate", None)
    if coordinate is not None and scene.is_opposite(coordinate):
        raise NotRepresentableError(f"`{coordinate}` changes its sign there")
    changes = placed_ends(component, scene, with_axes=False) if isinstance(component, Ends) else {}
    varied = {
        name: scene.varied(value) for name, value in component if isinstance(value, Expression | PythonLaw | Table)
    }
    return component.replace(**changes, **varied) if changes or varied else component


Elements = Mapping[str, Sequence[Record]]


def placed(elements: Elements, placing: Placement) -> dict[str, tuple[Record, ...]]:
    """`elements` by section, with all that is global in them transformed.

    Where a part is mirrored, each joint coordinate has the value that it has in the part; only the displacement of a
    cylindrical or screw joint, whose angle is kept, has the opposite sign, and what refers to it is changed with it.
    Raises NotRepresentableError.
    """
    if not placing.changes:
        return {section: tuple(records) for section, records in elements.items()}
    scene = Scene.of(elements, placing)
    rules: dict[str, Callable[[Any], Record]] = {
        "bodies": lambda body: placed_body(body, placing),
        "beams": lambda beam: placed_beam(beam, placing),
        "markers": scene.marker,
        "joints": lambda joint: placed_joint(joint, scene),
        "couplings": lambda coupling: placed_coupling(coupling, scene),
        "drivers": lambda driver: placed_driver(driver, scene),
        "forces": lambda force: placed_force(force, scene),
        "fluids": lambda fluid: fluid,
        "hydraulics": lambda component: placed_component(component, scene),
        "sensors": lambda sensor: sensor if sensor.value is None else sensor.replace(value=scene.varied(sensor.value)),
        "inputs": lambda each: each,
        "states": lambda state: placed_state(state, scene),
        "control": scene.followed,
        "events": lambda event: event.replace(when=scene.varied(event.when)),
    }
    made = {section: tuple(_by(rules[section], record) for record in elements[section]) for section in elements}
    made["markers"] = (*made["markers"], *scene.extra.values())
    return made


def _by(rule: Callable[[Any], Record], record: Record) -> Record:
    try:
        return rule(record)
    except NotRepresentableError as error:
        raise NotRepresentableError(f"{_words(record)}: {error}") from None
    except ModelError as error:
        raise NotRepresentableError(f"{_words(record)}: {'; '.join(fault.message for fault in error.faults)}") from None


def _words(record: Record) -> str:
    return f"{record.collection}.{entry(record, 'name')}"


def placed_coupling(coupling: Any, scene: Scene) -> Any:
    """`coupling` in the placed part: displacements that count the other way change the sign of their factor."""
    if isinstance(coupling, LinearCoupling):
        signs = [-1.0 if scene.is_opposite(reference) else 1.0 for reference in coupling.coordinates]
        return coupling.replace(factors=[sign * each for sign, each in zip(signs, coupling.factors, strict=True)])
    if isinstance(coupling, FunctionCoupling):
        value = scene.varied(coupling.value)
        return coupling.replace(value=negative(value) if scene.is_opposite(coupling.coordinate) else value)
    if isinstance(coupling, Rack) and scene.is_opposite(coupling.joints[1]):
        return coupling.replace(radius=-coupling.radius)
    return coupling


def placed_driver(driver: Driver, scene: Scene) -> Driver:
    """`driver` in the placed part. What is measured from ground is measured from the part's own frame there.

    Raises NotRepresentableError.
    """
    if driver.coordinate is not None:
        if not scene.is_opposite(driver.coordinate):
            return driver
        given = {name: function for name in MOTIONS if (function := getattr(driver, name)) is not None}
        turned = {name: negative(function) for name, function in given.items()}
        return driver.replace(**turned, start_speed=-driver.start_speed + 0.0)
    if driver.is_pose and scene.placement.mirrored:
        raise NotRepresentableError(
            "the driven pose of a marker has no mirror image: drive the marker of the part as placed"
        )
    kept = POLAR_Z if driver.along == "z" else AXIAL_Z
    reference = driver.reference
    return driver.replace(relative_to=scene.ground_frame(kept) if reference is None else scene.variant(reference, kept))


def placed_state(state: State, scene: Scene) -> State:
    """`state` in the placed part: it has the value that it would have in the part.

    Raises NotRepresentableError.
    """
    name = "rate" if state.rate is not None else "update"
    return state.replace(**{name: scene.varied(getattr(state, name))})


_PREFIX = re.compile(r"([^\W\d_][\w-]*)?")


def _prefix(value: Any) -> Any:
    if not isinstance(value, str) or not _PREFIX.fullmatch(value):
        raise fault(f"the start of a name, such as `left_`, was expected, got {shown(value)}")
    return value


def _values(value: Any) -> Any:
    if not isinstance(value, Mapping):
        raise fault(f"a mapping from parameters to values was expected, got {shown(value)}")
    return dict(value)


class Assembly(Record):
    """A part of a machine that stands in a file of its own, and where it goes."""

    file: FileName
    position: Position = Field("of the part's origin", default=(0.0, 0.0, 0.0))
    orientation: Maybe[OneRecord[Orientation]] = Field("of the part's axes", default=None)
    mirror: Literal["x", "y", "z", "none"] = Field(
        "axis of the part along which it is mirrored, before it is placed", default="none"
    )
    parameters: Annotated[dict[str, Any], BeforeValidator(_values)] = Field(
        "values for parameters of the part, in place of its own", default={}
    )
    prefix: Annotated[str, BeforeValidator(_prefix)] = Field(
        "start of the names of all its elements; default the assembly's name and `_`", default=""
    )
    only: Sections | None = Field("sections that are taken; default all", default=None)


def read_assembly(tree: Tree, name: str, given: Any, parameters: Parameters) -> Assembly | None:
    """The entry `name` of `assemblies:`; None where it has faults, which go to `tree.faults`."""
    path = ("assemblies", name)
    data = {"prefix": f"{name}_", **given} if isinstance(given, dict) else given
    try:
        assembly = Assembly.model_validate(data, context={"parameters": parameters})
    except ValidationError as error:
        for line in error.errors(include_url=False):
            where = path if line["loc"] == ("prefix",) and "prefix" not in given else (*path, *line["loc"])
            if line["type"] == FAULT and not tree.is_broken(path):
                tree.faults.append(tree.fault(where, line["msg"], at_key=bool(line.get("ctx", {}).get("at_key"))))
        return None
    return None if tree.is_broken(path) else assembly


def given_parameters(part: Tree, user: Tree, name: str, assembly: Assembly) -> None:
    """Put the values that `assembly` gives in place of the part's parameters. They may use those of its `user`."""
    own = section_of(part, "parameters")
    outer = section_of(user, "parameters")
    fresh = {key: f"given_{key}" for key in assembly.parameters}
    while any(each in outer for each in fresh.values()):
        fresh = {key: f"{each}_" for key, each in fresh.items()}
    values, faults = resolve({**outer, **{fresh[key]: value for key, value in assembly.parameters.items()}})
    for key, word in fresh.items():
        path, value = ("assemblies", name, "parameters", key), values.get(word)
        if key not in own:
            part.faults.append(user.fault(path, unknown_word(key, list(own), "parameter"), at_key=True))
        elif word in faults:
            part.faults.append(user.fault(path, faults[word]))
        if key not in own or value is None:
            continue
        own[key] = value
        part.graft(user, {path: ("parameters", key)})


def made_by(tree: Tree, name: str, assembly: Assembly, part: MachineRecord) -> dict[str, dict[str, Record]] | None:
    """The elements of `part` as `assembly` makes them, by section and name; None where they cannot be, which is
    reported.
    """
    try:
        elements = elements_of(part, assembly)
    except NotRepresentableError as error:
        tree.report(("assemblies", name), str(error))
        return None
    return {section: {str(entry(each, "name")): each for each in records} for section, records in elements.items()}


def elements_of(part: MachineRecord, assembly: Assembly) -> dict[str, tuple[Record, ...]]:
    """The elements of `part` by section, placed and with the prefix of `assembly`. Raises NotRepresentableError."""
    elements = {section: getattr(part, section) for section in SECTIONS}
    placement = Placement.of(assembly.position, assembly.orientation, assembly.mirror)
    return renamed(placed(elements, placement), assembly.prefix)
