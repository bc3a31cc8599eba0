"""What a machine mentions must exist: bodies, markers, coordinates, forces and symbols, each reported at its place."""

import pytest
from refusals import BALL, CRANK, MARKERS, ROD, faults, refused

from nivel import (
    Body,
    Driver,
    Expression,
    Joint,
    JointSpringDamper,
    MachineRecord,
    PythonLaw,
    Sensor,
    SpringDamper,
    Table,
)
from nivel.machine.bodies.shape import Box, Tube
from nivel.machine.laws.symbols import UnknownSymbolError, find_symbol
from nivel.machine.uses.coordinate_reference import UnknownCoordinateError, resolve

JOINTS = (
    {"name": "hinge", "type": "revolute", "markers": ("base", "eye")},
    {"name": "slide", "type": "cylindrical", "markers": ("eye", "tip")},
    {"name": "weld", "type": "fixed", "markers": ("base", {"body": "slab"})},
    {"name": "link", "type": "distance", "markers": ("base", "tip")},
)
SLAB = Body(name="slab", mass=1, shape=Box(size=(1, 0.1, 0.1)))
PIPE = Body(name="pipe", mass=1, shape=Tube(outer_radius=0.1, inner_radius=0.05, length=1))
PLAIN = Body(name="plain", mass=1, inertia=(1, 1, 1))
SENSORS = (
    {"name": "gap", "distance": ("tip", "base")},
    {"name": "tilt", "angle": ("tip", "base")},
    {"name": "tip", "marker": "tip", "quantity": "position"},
)
CONTACT = {"name": "c", "type": "contact", "stiffness": 1e6, "restitution": 0.5}
SPRING = {"name": "spring", "type": "spring-damper", "markers": ("tip", "eye"), "damping": 1}
MOTOR = {"name": "m", "type": "motor", "coordinate": "hinge"}


def machine(**given):
    return MachineRecord(
        **{
            "name": "m",
            "bodies": (CRANK, ROD, SLAB, PIPE, PLAIN),
            "markers": MARKERS,
            "joints": JOINTS,
            "sensors": SENSORS,
        }
        | given
    )


def test_the_machine_of_these_tests_is_right():
    assert machine(forces=(SPRING,)).joints[0].name == "hinge"


@pytest.mark.parametrize(
    ("given", "fault"),
    [
        (
            {"couplings": ({"name": "hinge", "type": "gear", "joints": ("hinge", "slide.angle"), "ratio": 1},)},
            "couplings.hinge.name: the name `hinge` stands in joints; joints, couplings and drivers share their names",
        ),
        (
            {"drivers": ({"name": "d", "coordinate": "hinge", "value": 1},) * 2},
            "drivers.d.name: the name `d` stands twice in drivers",
        ),
        ({"sensors": (SENSORS[0], SENSORS[0])}, "sensors.gap.name: the name `gap` stands twice in sensors"),
        ({"events": ({"name": "e", "when": "time"},) * 2}, "events.e.name: the name `e` stands twice in events"),
        (
            {"events": ({"name": "e", "when": "hing.angle"},)},
            "events.e.when: there is no joint, input, state, block, component, sensor, marker or body `hing`; did you mean `hinge.angle`?",
        ),
        (
            {"couplings": ({"name": "g", "type": "gear", "joints": ("hing", "slide.angle"), "ratio": 1},)},
            "couplings.g.joints.0: there is no joint `hing`; did you mean `hinge`?",
        ),
        (
            {"couplings": ({"name": "g", "type": "gear", "joints": ("hinge", "slide.angl"), "ratio": 1},)},
            "couplings.g.joints.1: of joint `slide`, the coordinate `angl` is not known; did you mean `angle`?",
        ),
        (
            {"couplings": ({"name": "g", "type": "gear", "joints": ("hinge", "slide.displacement"), "ratio": 1},)},
            "couplings.g.joints.1: `slide.displacement` is a length; an angle was expected",
        ),
        (
            {"couplings": ({"name": "g", "type": "belt", "joints": ("hinge", "weld"), "radii": (1, 1)},)},
            "couplings.g.joints.1: joint `weld` has no angle: it is a fixed joint",
        ),
        (
            {"couplings": ({"name": "g", "type": "rack", "joints": ("hinge", "hinge"), "radius": 1},)},
            "couplings.g.joints.1: joint `hinge` has no displacement: it is a revolute joint",
        ),
        (
            {"couplings": ({"name": "g", "type": "linear", "coordinates": ("slide", "hinge"), "factors": (1, 1)},)},
            "couplings.g.coordinates.0: joint `slide` has 2 coordinates; write one of `slide.angle`, `slide.displacement`",
        ),
        (
            {"couplings": ({"name": "g", "type": "gear", "joints": ("hinge", "hinge.angle"), "ratio": 1},)},
            "couplings.g.joints.1: the coordinate `hinge.angle` is coupled with itself; another one was expected",
        ),
        (
            {"drivers": ({"name": "d", "coordinate": "link", "value": 1},)},
            "drivers.d.coordinate: `link.distance` is held by the joint itself; one that changes is of `type: variable-distance`",
        ),
        (
            {
                "drivers": (
                    Driver(name="a", coordinate="hinge", value=1),
                    Driver(name="b", coordinate="hinge.angle", value=1),
                )
            },
            "drivers.b.coordinate: the coordinate `hinge.angle` is driven by `a` already",
        ),
        (
            {"drivers": tuple({"name": name, "marker": "tip", "along": "x", "value": 1} for name in "ab")},
            "drivers.b.marker: this motion of the marker `tip` is driven by `a` already",
        ),
        (
            {"drivers": ({"name": "d", "marker": "tap", "along": "x", "value": 1},)},
            "drivers.d.marker: there is no marker `tap`; did you mean `tip`?",
        ),
        (
            {"simulation": {"cut": ["hinge", "slid"]}},
            "simulation.cut.1: there is no joint `slid`; did you mean `slide`?",
        ),
        (
            {"drivers": ({"name": "d", "marker": "tip", "about": "z", "relative_to": "eey", "value": 1},)},
            "drivers.d.relative_to: there is no marker `eey`; did you mean `eye`?",
        ),
        (
            {"drivers": ({"name": "d", "marker": "base", "along": "x", "value": 1},)},
            "drivers.d.marker: the marker `base` is on `ground`, relative to which it is driven; it cannot move",
        ),
        (
            {
                "drivers": ({"name": "d", "coordinate": "hinge", "value": 1},),
                "joints": ({**JOINTS[0], "start": {"angle": 1}}, *JOINTS[1:]),
            },
            "joints.hinge.start.angle: the driver `d` says how this coordinate starts",
        ),
        (
            {
                "drivers": ({"name": "d", "coordinate": "hinge", "speed": 1},),
                "joints": ({**JOINTS[0], "start": {"angle": 1}}, *JOINTS[1:]),
            },
            "joints.hinge.start.angle: the driver `d` by a speed or an acceleration begins where the bodies are placed",
        ),
        (
            {"forces": ({**MOTOR, "coordinate": "hinge.displacement", "effort": 1},)},
            "forces.m.coordinate: of joint `hinge`, the coordinate `displacement` is not known; there is angle",
        ),
        (
            {"forces": ({**MOTOR, "effort": "5 N"},)},
            "forces.m.effort: `5 N` is a force (N); a torque (N*m) was expected",
        ),
        (
            {"forces": ({**SPRING, "markers": ("tip", "ege")},)},
            "forces.spring.markers.1: there is no marker `ege`; did you",
        ),
        (
            {"forces": ({**SPRING, "markers": ("tip", {"body": "rad"})},)},
            "forces.spring.markers.1.body: there is no body",
        ),
        (
            {"forces": ({**SPRING, "markers": ("tip", {"body": "rod"})},)},
            "forces.spring.markers: both markers are on `rod`; a force needs two different bodies",
        ),
        (
            {"forces": ({**CONTACT, "body": "plain", "plane": "base"},)},
            "forces.c.body: the body `plain` has no shape; a contact here needs a sphere, capsule, ellipsoid, box, cylinder, "
            "extrusion or mesh",
        ),
        (
            {"forces": ({**CONTACT, "body": "pipe", "plane": "base"},)},
            "forces.c.body: the shape of `pipe` is `tube`; a contact here needs a sphere, capsule, ellipsoid, box, cylinder, "
            "extrusion or mesh",
        ),
        (
            {"forces": ({**CONTACT, "bodies": ("rod", "pipe")},)},
            "forces.c.bodies.1: the shape of `pipe` is `tube`; a contact here needs a sphere, capsule, ellipsoid, box, cylinder, extrusion",
        ),
        ({"forces": ({**CONTACT, "body": "rod", "plane": "tip"},)}, "forces.c.plane: the plane is on `rod` itself"),
        ({"forces": ({**CONTACT, "body": "rod", "plane": "flor"},)}, "forces.c.plane: there is no marker `flor`"),
        (
            {
                "forces": (
                    {
                        **{key: value for key, value in CONTACT.items() if key != "stiffness"},
                        "body": "slab",
                        "plane": "base",
                        "materials": ({"youngs_modulus": 1e9, "poisson_ratio": 0.3},) * 2,
                    },
                )
            },
            "forces.c.materials: `materials` give the stiffness of spheres (Hertz); the shape of `slab` is `box`: give its `stiffness`",
        ),
        (
            {"sensors": ({"name": "s", "marker": "tap", "quantity": "position"},)},
            "sensors.s.marker: there is no marker",
        ),
        ({"sensors": ({"name": "s", "distance": ("tip", "tap")},)}, "sensors.s.distance.1: there is no marker `tap`"),
        (
            {"sensors": ({"name": "s", "coordinate": "weld", "quantity": "rate"},)},
            "sensors.s.coordinate: joint `weld` has no coordinate",
        ),
        (
            {"sensors": ({"name": "s", "force": "sprig", "quantity": "power"},), "forces": (SPRING,)},
            "sensors.s.force: there is no force `sprig`; did you mean `spring`?",
        ),
        (
            {"sensors": ({"name": "s", "force": "spring", "quantity": "depth"},), "forces": (SPRING,)},
            "sensors.s.quantity: of the spring-damper `spring`, the quantity `depth` is not known; there are magnitude, power",
        ),
    ],
)
def test_mentioned_in_vain(given, fault):
    found = faults(machine, **given)
    assert len(found) == 1, found
    assert found[0].startswith(fault)


def law(text):
    return {"forces": ({**MOTOR, "effort": text},)}


@pytest.mark.parametrize(
    ("given", "fault"),
    [
        (
            law("3*hing.angle"),
            "forces.m.effort: there is no joint, input, state, block, component, sensor, marker or body `hing`; "
            "did you mean `hinge.angle`?",
        ),
        (law("3*hinge.angl"), "forces.m.effort: `hinge` has no `angl`; did you mean `hinge.angle`?"),
        (law("3*hinge.q"), "forces.m.effort: `hinge` has no `q`; it has angle, angle_rate"),
        (law("3*weld.angle"), "forces.m.effort: `weld` has no symbols"),
        (law("3*gap.length"), "forces.m.effort: `gap` has no `length`; it has distance, rate"),
        (
            law("3*spring.length"),
            "forces.m.effort: there is no joint, input, state, block, component, sensor, marker or body `spring`",
        ),
        (
            law(Table((0, 1), (0, 1), of="hing.angle")),
            "forces.m.effort: there is no joint, input, state, block, component, sensor, marker or body `hing`",
        ),
        (law({"of": "hing.angle", "points": [0, 1], "values": [0, 1]}), "forces.m.effort.of: there is no joint"),
        (
            law(PythonLaw("def f(x):\n    return x\n", "f", ("hing.angle",))),
            "forces.m.effort: there is no joint, input, state, block, component, sensor, marker or body `hing`",
        ),
        (
            law({"source": "def f(t, x):\n    return x\n", "function": "f", "arguments": ["time", "hing.angle"]}),
            "forces.m.effort.arguments.1: there is no joint, input, state, block, component, sensor, marker or body `hing`",
        ),
        (
            {"forces": ({"name": "f", "type": "torque", "body": "rod", "vector": (0, "3*rod.wq", 0)},)},
            "forces.f.vector.1: `rod` has no `wq`; it has x, y, z, vx, vy, vz, wx, wy, wz",
        ),
        (
            {"forces": ({**SPRING, "damping": 0, "law": "5 N + rop.vx * length"},)},
            "forces.spring.law: there is no joint",
        ),
        (
            {"sensors": ({"name": "s", "value": "rod.vx + rod.vv"},)},
            "sensors.s.value: `rod` has no `vv`; it has x, y, z",
        ),
        (
            {"sensors": ({"name": "s", "value": "spring.lenght"},), "forces": (SPRING,)},
            "sensors.s.value: `spring` has no `lenght`; did you mean `spring.length`?",
        ),
        (
            {"states": ({"name": "x", "rate": "spring.length"},), "forces": (SPRING,)},
            "states.x.rate: `spring.length` is known only when all forces are, on which this depends; take a sample of it",
        ),
    ],
)
def test_symbols_in_vain(given, fault):
    found = faults(machine, **given)
    assert len(found) == 1, found
    assert found[0].startswith(fault)


def test_records_are_looked_through_too():
    spring = JointSpringDamper(name="f", coordinate="hinge", law=Expression("3 N*value + tap.vx"))
    assert (
        "forces.f.law: there is no joint, input, state, block, component, sensor, marker or body `tap`; did you mean `tip.vx`?"
        in refused(machine, forces=(spring,))
    )


def test_names_with_a_hyphen_are_refused_in_expressions_once():
    left = {**JOINTS[0], "name": "left-hinge"}
    (found,) = faults(machine, joints=(left, *JOINTS[1:]), sensors=({"name": "s", "value": "2*left-hinge.angle"},))
    assert "rename it to `left_hinge`" in found


def test_names_with_a_hyphen_are_taken_in_tables():
    left = {**JOINTS[0], "name": "left-hinge"}
    table = {"of": "left-hinge.angle", "points": [0, 1], "values": [0, 1]}
    assert machine(joints=(left, *JOINTS[1:]), sensors=({"name": "s", "value": table},))


def test_one_fault_hides_no_other():
    text = refused(
        machine,
        bodies=(CRANK, ROD, {"name": "slab", "mass": "1 m"}),
        drivers=({"name": "d", "coordinate": "hing", "value": "abs(time)"},),
        forces=({**MOTOR, "effort": "3*hing.angle", "limit": 0},),
        sensors=({"name": "s", "force": "f"},),
    )
    for part in (
        "bodies.slab.mass: ",
        "drivers.d.coordinate: ",
        "drivers.d.value: ",
        "forces.m.effort: ",
        "forces.m.limit: ",
        "sensors.s.force: ",
        "sensors.s: `quantity` is missing",
    ):
        assert part in text


def test_a_coordinate_is_written_out_in_full():
    record = machine(forces=(MOTOR | {"effort": 1}, JointSpringDamper(name="f", coordinate="hinge", stiffness=1)))
    assert [force.coordinate for force in record.forces] == ["hinge.angle", "hinge.angle"]
    assert record.forces[1].stiffness == 1.0


def test_references_are_resolved():
    joints = machine().joints
    assert resolve("hinge", joints) == resolve("hinge.angle", joints) == ("hinge", "angle")
    assert resolve("slide", joints, "length") == ("slide", "displacement")
    with pytest.raises(UnknownCoordinateError, match="has 2 coordinates"):
        resolve("slide", joints)


@pytest.mark.parametrize(
    ("path", "section"),
    [
        ("hinge.angle_rate", "joints"),
        ("gap.rate", "sensors"),
        ("tilt.angle", "sensors"),
        ("tip.vx", "markers"),
        ("rod.wz", "bodies"),
    ],
)
def test_symbols_are_found(path, section):
    symbol = find_symbol(path, machine())
    assert (symbol.section, f"{symbol.name}.{symbol.quantity}") == (section, path)


def test_of_equal_names_the_first_section_that_has_the_quantity_is_meant():
    """Joints, sensors, markers, bodies: `hinge` is all four here, and a planar joint has an x like a marker."""
    markers = (*MARKERS, {"name": "hinge", "body": "rod"}, {"name": "slab", "body": "rod"})
    planar = {**JOINTS[0], "type": "planar"}
    record = machine(
        markers=markers, joints=(planar, *JOINTS[1:]), sensors=({"name": "hinge", "distance": ("tip", "base")},)
    )
    sections = {path: find_symbol(f"hinge.{path}", record).section for path in ("x", "distance", "vx")}
    assert sections == {"x": "joints", "distance": "sensors", "vx": "markers"}
    assert find_symbol("slab.x", record).section == "markers"
    with pytest.raises(UnknownSymbolError):
        find_symbol("hinge.w", record)


def test_machines_from_python_take_every_section():
    record = machine(
        drivers=(Driver(name="d", coordinate="hinge", value="time"),),
        forces=(SpringDamper(name="spring", markers=("tip", "eye"), damping=1),),
        sensors=(Sensor(name="s", force="spring", quantity="length"),),
        joints=(*(Joint(**joint) for joint in JOINTS),),
        assembly={"largest_gap": "1 cm"},
        bodies=(CRANK, ROD, SLAB, Body(name="ball", **BALL, hold=True, assembly_weight=5)),
    )
    assert record.assembly.largest_gap == 0.01
    assert record.bodies[-1].hold
