"""A part that is placed: every element of it turned, moved and mirrored, so that it moves as before, seen from there."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from nivel.elements.joints.couplings import FunctionCoupling, LinearCoupling, Rack
from nivel.elements.joints.drivers import MOTIONS, Driver
from nivel.errors import ModelError
from nivel.files.placed_bodies import placed_beam, placed_body, placed_joint
from nivel.files.placed_forces import placed_ends, placed_force
from nivel.files.placement import AXIAL_Z, POLAR_Z, Placement, Scene
from nivel.files.substitution import NotRepresentableError, negative
from nivel.machine.core.element import Ends
from nivel.machine.core.record import Record, entry
from nivel.machine.laws.time_function import Expression, PythonLaw, Table
from nivel.machine.signals.input import State


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
