"""Couplings, drivers, forces, inputs, states, sensors and events in words: what `nivel check` says of them."""

from collections.abc import Sequence
from pathlib import Path

from nivel.elements.circuits.component import Component
from nivel.elements.circuits.tanks import Volume
from nivel.elements.contacts.contact import Contact, Contacts
from nivel.elements.contacts.heap import spheres_between
from nivel.elements.forces.loads import PointForce
from nivel.elements.joints.couplings import Coupling, FunctionCoupling
from nivel.elements.joints.drivers import Driver
from nivel.machine.control.block import Block
from nivel.machine.control.order import in_order, parts_of
from nivel.machine.control.part import PartFunction, UnitOutput
from nivel.machine.core.element import Between, BetweenMany, BetweenMarkers, End, Ends, ForceElement
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.time_function import TimeFunction
from nivel.machine.laws.varying_value import Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.signals.input import Event, Input, State
from nivel.machine.signals.sensor import Sensor
from nivel.machine.units.formula import Formula, LinearFunction
from nivel.machine.uses.coordinate_reference import resolve


def coupling_in_words(machine: MachineRecord, coupling: Coupling) -> str:
    """The equation that a coupling holds, its first coordinate with the factor one."""
    if isinstance(coupling, FunctionCoupling):
        name = ".".join(resolve(coupling.coordinate, machine.joints))
        placed = "as placed + change of " if coupling.from_start else ""
        return f"{coupling.name}: {name} = {placed}{function_in_words(coupling.value)}"
    leading = coupling.terms[0][1]
    terms = []
    for (reference, factor), kind in zip(coupling.terms, coupling.kinds, strict=True):
        name = ".".join(resolve(reference, machine.joints, kind))
        share = factor / leading
        size = "" if abs(share) == 1.0 else f"{abs(share):.6g} "
        sign = ("" if not terms else "+ ") if share > 0.0 else "- "
        terms.append(f"{sign}{size}{name}")
    return f"{coupling.name}: {coupling.type}, {' '.join(terms)} keeps its value"


def driver_in_words(driver: Driver) -> str:
    """What is driven, and how."""
    if driver.is_pose:
        return f"{driver.name}: pose of {driver.marker} in {driver.relative_to or 'ground'}; {_pose_in_words(driver)}"
    way = f"along {driver.along}" if driver.along else f"about {driver.about}"
    driven = driver.coordinate or f"{driver.marker} {way} of {driver.relative_to or 'ground'}"
    placed = "as placed + change of " if driver.from_start else ""
    for rate, function in (("speed", driver.speed), ("acceleration", driver.acceleration)):
        if function is not None:
            return f"{driver.name}: {driven}, {rate} = {function_in_words(function)}"
    assert driver.value is not None  # the record was checked
    return f"{driver.name}: {driven} = {placed}{function_in_words(driver.value)}"


def _pose_in_words(driver: Driver) -> str:
    said = []
    if driver.position is not None:
        said.append(f"position {', '.join(map(function_in_words, driver.position))}")
    if driver.orientation is not None:
        axes, functions = driver.orientation.turns
        numbers = f"turns about {axes}" if axes else "Euler parameters"
        said.append(f"{numbers} {', '.join(map(function_in_words, functions))}")
    return "; ".join(said)


def function_in_words(function: TimeFunction) -> str:
    """A function of time, short."""
    match function:
        case Table(times=times, of=of):
            return f"a table of {len(times)} points over {of}"
        case PythonLaw(function=name, file=file):
            return f"{name}(…){f' of {file}' if file else ''}"
        case float() | int():
            return f"{function:.6g}"
    return function.text


def force_in_words(machine: MachineRecord, force: ForceElement) -> str:
    """Type of a force, and the bodies or the joint coordinate that it acts on."""
    return f"{force.name}: {getattr(force, 'type', '')} on {_acts_on(machine, force)}"


def _acts_on(machine: MachineRecord, force: ForceElement) -> str:
    bodies = {marker.name: marker.body for marker in machine.markers}

    def body(end: End) -> str:
        return bodies[end] if isinstance(end, str) else end.body

    match force:
        case Between() | BetweenMarkers() | BetweenMany():
            return " and ".join(body(end) for end in force.ends)
        case PointForce(marker=str() as marker):
            return bodies[marker]
        case Contact(bodies=None, body=name, plane=plane) if plane is not None:
            return f"{name} and {body(plane)}"
        case Contact(bodies=tuple() as pair):
            return " and ".join(pair)
        case Contacts():
            planes = f" and {len(force.planes)} plane{'s' if len(force.planes) > 1 else ''}" if force.planes else ""
            creeps = "; bodies at rest creep, `friction_model: stiction` holds up to 15 of them"
            return f"{len(spheres_between(machine, force))} spheres{planes}{creeps if force.friction else ''}"
    on_ground = [end for key in ("edge", "contact") for end in getattr(force, key, ())]
    if (first := getattr(force, "wheel", next(iter(on_ground), None))) is not None:
        source = getattr(force, "source", "")
        return f"{body(first)} and {body(getattr(force, 'plane', ''))}{f'; {source}' if source else ''}"
    return str(getattr(force, "coordinate", None) or getattr(force, "body", ""))


def sensor_in_words(sensor: Sensor) -> str:
    """What a sensor measures."""
    match sensor.form:
        case "distance" | "angle" as form:
            ends = sensor.distance or sensor.angle or ()
            names = [end if isinstance(end, str) else f"a point of {end.body}" for end in ends]
            return f"{sensor.name}: {form} of {' and '.join(names)}"
        case "value":
            assert sensor.value is not None  # the record was checked
            return f"{sensor.name}: {function_in_words(sensor.value)}{f' [{sensor.units}]' if sensor.units else ''}"
        case form:
            seen = f", seen from {sensor.relative_to}" if sensor.relative_to else ""
            return f"{sensor.name}: {str(sensor.quantity).replace('_', ' ')} of {getattr(sensor, form)}{seen}"


def input_in_words(given: Input) -> str:
    """Range and rest value of an input, and what it follows without an operator."""
    units = f" {given.units}" if given.units else ""
    course = "" if given.signal is None else f", follows {function_in_words(given.signal)}"
    limit = "" if given.rate is None else f", at most {given.rate:.6g}{units} per second"
    return f"{given.name}: {given.range[0]:.6g} to {given.range[1]:.6g}{units}, {given.rest_value:.6g} at rest{limit}{course}"


def state_in_words(state: State) -> str:
    """How a state changes, and its start."""
    start = f"{state.start:.6g}{f' {state.units}' if state.units else ''} at the start"
    if state.rate is not None:
        return f"{state.name}: rate {function_in_words(state.rate)}, {start}"
    assert state.update is not None  # the record was checked
    times = [f"every {state.every:.6g} s"] if state.every else []
    times += [f"at the event {state.event}"] if state.event else []
    return f"{state.name}: {function_in_words(state.update)}, sampled {' and '.join(times)}, {start}"


def component_in_words(component: Component) -> str:
    """Type of a component of a circuit, and where its ports are connected."""
    ports = ", ".join(f"{port} to {node}" for port, node in component.ports.items())
    ends = component.ends if isinstance(component, Ends) else ()
    on = f" on {' and '.join(end if isinstance(end, str) else end.body for end in ends)}" if ends else ""
    size = ""
    if isinstance(component, Volume) and "volume" not in component.model_fields_set:
        size = f" of {1e3 * component.volume:g} L, as none is given"
    return f"{component.name}: {component.type}{size}{on}{f', {ports}' if ports else ''}"


def event_in_words(event: Event) -> str:
    """When an event is, and whether it ends the run."""
    way = "" if event.direction == "both" else f", {event.direction}"
    end = "; the run ends there" if event.stop else ""
    return f"{event.name}: {function_in_words(event.when)} passes zero{way}{end}"


def block_in_words(block: Block) -> str:
    """Kind of a block, what it takes, and when."""
    taken = [_in_words(part.function) for part in block.parts if part.key]
    of = f" of {', '.join(dict.fromkeys(taken))}" if taken else ""
    return f"{block.name}: {block.type}{of}{_times(block)}"


def control_in_words(blocks: Sequence[Block]) -> str:
    """How many blocks, continuous states and sampled values there are."""
    roles = [part.role for block in blocks for part in block.parts]
    states, values = roles.count("state"), roles.count("sample") + roles.count("memory")
    periods = sorted({block.period for block in blocks if block.is_sampled})
    often = f" every {', '.join(f'{period:.6g} s' for period in periods)}" if periods else ""
    count = f"{len(blocks)} block{'s' * (len(blocks) != 1)}"
    order, _ = in_order(parts_of(blocks))
    names = [each.block.name for each in order if each.block.is_sampled and each.part.name == each.block.output]
    then = f"; order of a sample: {', '.join(names)}" if len(names) > 1 else ""
    return f"{count}, {states} continuous state{'s' * (states != 1)}, {values} sampled value{'s' * (values != 1)}{often}{then}"


def _in_words(function: PartFunction) -> str:
    if isinstance(function, LinearFunction):
        return " + ".join(f"{factor:.6g}*{path}" for factor, path in function.terms)
    if isinstance(function, UnitOutput):
        return f"{function.facts.outputs[function.number]} of {Path(function.facts.file).name}"
    assert not isinstance(function, Formula)  # made by the block, not given
    return function_in_words(function)


def _times(block: Block) -> str:
    if not block.is_sampled:
        return ", continuous"
    later = f" from {block.offset:.6g} s" if block.offset else ""
    late = f", {block.latency:.6g} s late" if block.latency else ""
    return f", every {block.period:.6g} s{later}{late}"
