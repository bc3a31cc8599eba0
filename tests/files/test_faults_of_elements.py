"""Faults in joints, couplings, drivers, forces, sensors and events: each is found at its line, with its element and what would be right."""

import pytest
from base_machine import faults_of_full

# what stands there → what is written instead; lines further down; the element; part of the message
FAULTS = {
    # joints
    "screw without pitch": (", pitch: 5 mm", "", 0, "joints.spindle", "`pitch` is missing"),
    "pitch is an angle": ("pitch: 5 mm", "pitch: 5 deg", 0, "joints.spindle.pitch", "a length (m) was expected"),
    "screw that only turns": ("pitch: 5 mm", "pitch: 0", 0, "joints.spindle.pitch", "is zero"),
    "pitch of a rail": ("axis: [0, 1, 0]}", "axis: [0, 1, 0], pitch: 1}", 0, "joints.rail.pitch", "does not belong"),
    "one point": (
        "points: [[0, 3, 2], [0, 3, 0]]",
        "point: [0, 3, 2]",
        0,
        "joints.string",
        "needs `bodies` and `points`",
    ),
    "string of no length": ("distance: 2 m", "distance: 0", 0, "joints.string.distance", "greater than zero"),
    "start of no coordinate": (
        "start: {angle: 5 deg}",
        "start: {displacement: 1}",
        0,
        "joints.hinge.start.displacement",
        "there is angle",
    ),
    "start rate is a speed": (
        "{angle: 2 rpm}",
        "{angle: 2 m/s}",
        0,
        "joints.hinge.start_rates.angle",
        "an angular velocity",
    ),
    "joint of an assembly's body": (
        "bodies: [frame, left_thigh]",
        "bodies: [frame, left_thig]",
        0,
        "joints.left_hip.bodies.1",
        "did you mean `left_thigh`",
    ),
    "rotation of a point mass": (
        "0.5 kg, point",
        "0.5 kg, inertia: [1, 1, 1], point",
        0,
        "bodies.bob.inertia",
        "point mass",
    ),
    "weight of an unwilling body": (
        "assembly_weight: 3",
        "assembly_weight: 0",
        0,
        "bodies.shaft.assembly_weight",
        "greater than zero",
    ),
    # couplings
    "unknown coupling": ("type: gear", "type: gears", 0, "couplings.gears", "did you mean `gear`"),
    "gear of unknown joint": (
        "[hinge, axle.angle]",
        "[hing, axle.angle]",
        0,
        "couplings.gears.joints.0",
        "did you mean `hinge`",
    ),
    "gear of a rail": ("[hinge, axle.angle]", "[hinge, rail]", 0, "couplings.gears.joints.1", "has no angle"),
    "gear of a displacement": (
        "[hinge, axle.angle]",
        "[hinge, axle.displacement]",
        0,
        "couplings.gears.joints.1",
        "an angle was expected",
    ),
    "gear without teeth": (", teeth: [20, 40]", "", 0, "couplings.gears", "`teeth` is missing"),
    "half a tooth": ("[20, 40]", "[20, 40.5]", 0, "couplings.gears.teeth.1", "whole number"),
    "belt without radii": (", radii: [0.1, 20 cm]", "", 0, "couplings.strap", "`radii` is missing"),
    "radius is an angle": (
        "radius: 50 mm",
        "radius: 50 deg",
        0,
        "couplings.pinion.radius",
        "a length (m) was expected",
    ),
    "as many factors": ("factors: [1, -0.05]", "factors: [1]", 0, "couplings.mixed.factors", "as many factors"),
    # drivers
    "driver with corners": ("0.1*sin(2*pi*time)", "abs(0.1*time)", 0, "drivers.lift.value", "corners"),
    "driver of a signal": ("0.1*sin(2*pi*time)", "0.1*hinge.angle", 0, "drivers.lift.value", "hinge.angle"),
    "driver is an angle": ("0.1*sin(2*pi*time)", "30 deg", 0, "drivers.lift.value", "a length"),
    "driver of nothing": (
        "lift: {coordinate: axle.displacement, value",
        "lift: {value",
        0,
        "drivers.lift",
        "needs a `coordinate`",
    ),
    "driver of unknown marker": (
        "{marker: rim, along",
        "{marker: rin, along",
        0,
        "drivers.place.marker",
        "did you mean `rim`",
    ),
    "driver along what": ("along: x, ", "", 0, "drivers.place", "`along` or `about` is missing"),
    # forces
    "unknown force": (
        "type: motor, coordinate: hinge.angle, speed",
        "type: moter, coordinate: hinge.angle, speed",
        0,
        "forces.engine",
        "did you mean `motor`",
    ),
    "spring without free length": ("free_length: 30 cm, ", "", 0, "forces.spring", "`free_length` is missing"),
    "damping is negative": ("damping: 10,", "damping: -10,", 0, "forces.spring.damping", "zero or more"),
    "stiffness is a force": ("stiff: 5 kN/m", "stiff: 5 kN", 35, "forces.spring.stiffness", "was expected"),
    "spring at unknown marker": (
        "markers: [top, rim], stiffness",
        "markers: [top, rum], stiffness",
        0,
        "forces.spring.markers.1",
        "did you mean `rim`",
    ),
    "characteristic goes back": (
        "deflections: [0, 0.1]",
        "deflections: [0, -0.1]",
        0,
        "forces.soft.table.deflections.1",
        "deflections increase",
    ),
    "symbol of another law": (
        "100*length + 2*rate",
        "100*length + 2*rates",
        0,
        "forces.law.law",
        "did you mean `rate`",
    ),
    "stiffness and law": (
        "law: 100*length",
        "stiffness: 3, law: 100*length",
        0,
        "forces.law.stiffness",
        "must not be given with a `law`",
    ),
    "angle is a length": (
        "free_angle: 5 deg",
        "free_angle: 5 mm",
        0,
        "forces.twist.free_angle",
        "an angle (rad) was expected",
    ),
    "coordinate of no joint": (
        "coordinate: hinge.angle, stiffness",
        "coordinate: hinge.angel, stiffness",
        0,
        "forces.centre.coordinate",
        "did you mean `angle`",
    ),
    "stop upside down": ("lower: -10 cm", "lower: 20 cm", 0, "forces.ends.upper", "must be greater"),
    "stop without restitution": (
        "stiffness: 1e5, restitution: 0.5",
        "stiffness: 1e5",
        0,
        "forces.ends",
        "`restitution` is missing",
    ),
    "restitution of 2": ("restitution: 0.5", "restitution: 2", 0, "forces.ends.restitution", "up to 1"),
    "unknown friction": ("model: coulomb", "model: colomb", 0, "forces.bearing.model", "did you mean `coulomb`"),
    "friction without radius": (", radius: 1 cm}", "}", 0, "forces.bearing", "`radius` is missing"),
    "coulomb without transition": (
        ", transition_speed: 1 mm/s",
        "",
        0,
        "forces.bearing",
        "`transition_speed` is missing",
    ),
    "motor without gain": ("gain: 2, ", "", 0, "forces.engine", "`gain` is missing"),
    "motor with two aims": ("gain: 2, ", "gain: 2, effort: 3, ", 0, "forces.engine.speed", "give one of them"),
    "table of nothing": ("{of: length,", "{of: lenght,", 0, "forces.pair.magnitude.of", "was expected, got `lenght`"),
    "times of another variable": (
        "points: [0, 1], values: [0, 10]",
        "times: [0, 1], values: [0, 10]",
        0,
        "forces.pair.magnitude.times",
        "write `points`",
    ),
    "five stiffnesses": ("[1, 1, 1, 2, 2, 2]", "[1, 1, 1, 2, 2]", 0, "forces.mount.stiffness", "a list of 5"),
    "contact without shape": ("body: ball, plane", "body: shaft, plane", 0, "forces.bump.body", "shape"),
    "signal of no joint": (
        "5*rail.displacement_rate",
        "5*rale.displacement_rate",
        0,
        "forces.drag.vector.1",
        "did you mean",
    ),
    "signal of no quantity": ("5*rail.displacement_rate", "5*rail.angle", 0, "forces.drag.vector.1", "rail"),
    # sensors
    "unknown quantity": (
        "quantity: velocity",
        "quantity: speed",
        0,
        "sensors.tip.quantity",
        "the quantity `speed` is not known",
    ),
    "sensor of an unknown output": (
        "quantity: length",
        "quantity: lenth",
        0,
        "sensors.pull.quantity",
        "did you mean `length`",
    ),
    "sensor of an unknown force": (
        "{force: spring",
        "{force: sprang",
        0,
        "sensors.pull.force",
        "did you mean `spring`",
    ),
    "sensor of two": (
        "gap: {distance: [top, rim]}",
        "gap: {distance: [top, rim], angle: [top, rim]}",
        0,
        "sensors.gap",
        "got distance and angle",
    ),
    "expression of metres": (
        "value: 2*gap.distance",
        "value: sin(2 m)*gap.distance",
        0,
        "sensors.sum.value",
        "is taken of an angle",
    ),
    # events
    "comparison": (
        "rail.displacement - 5 cm",
        "rail.displacement > 5 cm",
        0,
        "events.far.when",
        "an event is where an expression passes zero, not a comparison as in `rail.displacement > 5 cm`",
    ),
    "event that never comes": (
        "when: rail.displacement - 5 cm",
        "when: 5 cm",
        0,
        "events.far.when",
        "never passes zero",
    ),
    "event of a table that never comes": (
        "when: rail.displacement - 5 cm",
        "when: {times: [0, 1 s, 2 s], values: [1, 3, 1]}",
        0,
        "events.far.when",
        "the values of the table go from 1 to 3, so they never pass zero",
    ),
    "event of nothing": ("{when: 2*time - 1 + left_foot.z}", "{stop: true}", 0, "events.late", "`when` is missing"),
    "event of an unknown joint": (
        "rail.displacement - 5",
        "rial.displacement - 5",
        0,
        "events.far.when",
        "`rail.displ",
    ),
    "event of unlike quantities": (
        "rail.displacement - 5 cm",
        "rail.displacement - 5 kg + 1 m",
        0,
        "events.far.when",
        "a mass (kg) and a length (m) cannot be added",
    ),
    "unknown direction": ("direction: rising", "direction: risng", 0, "events.far.direction", "did you mean `rising`"),
    "stop is no truth": ("stop: true", "stop: 1", 0, "events.far.stop", "true"),
    "unknown key of an event": ("stop: true", "stops: true", 0, "events.far.stops", "did you mean `stop`"),
    # the whole
    "unknown setting of the assembly": (
        "{largest_gap: 1 cm}",
        "{larges_gap: 1 cm}",
        0,
        "assembly.larges_gap",
        "did you mean `largest_gap`",
    ),
    "joint and driver of one name": ("  lift: {", "  hinge: {", 0, "drivers.hinge", "hinge"),
}


@pytest.mark.parametrize("change", FAULTS.values(), ids=FAULTS.keys())
def test_the_fault_is_found_where_it_stands(change, tmp_path):
    old, new, further, element, part = change
    faults, line = faults_of_full(tmp_path, "machine", old, new)
    found = [fault for fault in faults if part in fault.message]
    assert found, faults
    assert {fault.path for fault in found} == {element}
    if further is not None:
        assert {fault.line for fault in found} == {line + further}


def test_there_are_enough_of_them():
    assert len(FAULTS) >= 50
