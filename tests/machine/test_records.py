"""Records made in Python: what they read, refuse and show."""

import pickle

import numpy as np
import pytest

from nivel import Body, Expression, Joint, MachineRecord, Marker, PointForce, SimulationSettings, Table, Torque
from nivel.errors import ModelError
from nivel.machine.bodies.shape import Box, Cylinder, Sphere, Tube
from nivel.machine.settings.analyses import StaticsSettings

BALL = {"mass": 1, "shape": Sphere(radius=0.1)}
CRANK, ROD = Body(name="crank", **BALL), Body(name="rod", **BALL)


def refused(make, **given):
    with pytest.raises(ModelError) as caught:
        make(**given)
    return str(caught.value)


def test_numbers_texts_and_arrays_say_the_same():
    plain = Body(name="a", mass=21, inertia=(1, 2, 2.5), position=(0.1, 0, 0))
    written = Body(name="a", mass="21 kg", inertia=np.array([1, 2, 2.5]), position=("10 cm", 0, "0"))
    assert plain == written
    assert hash(plain.position) == hash(written.position)


def test_records_are_frozen_and_replaced():
    changed = CRANK.replace(mass="2 kg")
    assert (changed.mass, CRANK.mass) == (2.0, 1.0)
    assert "greater than zero" in refused(CRANK.replace, mass=-1)
    with pytest.raises(ModelError, match=r"with_values\(\{'crank.mass': 3\}\)"):
        CRANK.mass = 3


def test_a_record_shows_what_was_given():
    assert repr(Marker(body="rod", position=(1, 0, 0))) == "Marker(body='rod', position=(1.0, 0.0, 0.0))"


def test_all_faults_come_at_once_and_name_the_element():
    text = refused(Body, name="crank", mass="3 m", inertia=(1, 2), positon=(0, 0, 0), shape={"type": "boks"})
    assert "bodies.crank.mass: `3 m` is a length (m); a mass (kg) was expected" in text
    assert "bodies.crank.inertia: three moments" in text
    assert "bodies.crank.positon: the key `positon` is not known; did you mean `position`?" in text
    assert (
        "bodies.crank.shape: the type `boks` is not known; there are box, cylinder, capsule, tube, sphere, ellipsoid, extrusion, mesh"
        in text
    )


def test_nested_faults_name_the_elements_of_the_machine():
    text = refused(
        MachineRecord,
        name="m",
        bodies=[CRANK, {"name": "rod", "mass": 0, "shape": {"type": "sphere", "radius": 1}}],
        joints=[{"name": "pin", "type": "spherical", "bodies": ("crank", "rodd"), "point": (0, 0, "1 kg")}],
    )
    assert "bodies.rod.mass: a mass greater than zero was expected, got `0`" in text
    assert "joints.pin.point.2: `1 kg` is a mass (kg)" in text
    assert "joints.pin.bodies.1: there is no body `rodd`; did you mean `rod`?" in text


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({}, "`mass` is missing"),
        ({"mass": 1}, "`inertia` is missing"),
        ({"inertia": (1, 1, 1)}, "`mass` is missing"),
        ({"density": 1}, "`density` needs a `shape`"),
        ({"shape": Sphere(radius=1)}, "`mass` is missing"),
        ({"shape": Sphere(radius=1), "density": 1, "mass": 1}, "`mass` follows"),
        ({"shape": Sphere(radius=1), "density": 1, "inertia": (1, 1, 1)}, "`inertia` follows"),
        ({"shape": Sphere(radius=1), "density": 1, "centre_of_mass": (0, 0, 0)}, "`centre_of_mass` follows"),
        ({"shape": Sphere(radius=1), "mass": 1, "centre_of_mass": (0, 0, 0)}, "`centre_of_mass` follows"),
        ({"shape": Sphere(radius=1), "mass": 1, "inertia_about": "origin"}, "`inertia_about` belongs"),
        ({**BALL, "angular_velocity": (0, 0, 1), "angular_velocity_body": (0, 0, 1)}, "not both"),
        ({**BALL, "velocity": (1, 2)}, "entries are missing: there are only 2"),
        ({**BALL, "velocity": (1, 2, 3, 4)}, "3 entries were expected, got 4"),
        ({**BALL, "velocity": 4}, "a list was expected, got `4`"),
        ({**BALL, "inertia_about": "centre"}, "is not known"),
        ({"mass": 1, "shape": 5}, "a mapping was expected, got `5`"),
        ({"mass": 1, "shape": {"radius": 5}}, "`type` is missing"),
        (
            {"density": 1, "shape": Box(from_=(0, 0, 0), to=(1, 0, 0), width=1, height=1), "position": (0, 0, 0)},
            "`position` follows",
        ),
    ],
)
def test_bodies_refused(given, part):
    assert part in refused(Body, name="a", **given)


@pytest.mark.parametrize("name", ["", "1a", "a.b", "a b", "-a", "_a", "a/b", None, 5, True])
def test_names_refused(name):
    assert "name" in refused(Body, name=name, **BALL)


@pytest.mark.parametrize("name", ["a", "A1", "front-left_2", "Välitanko"])
def test_names_taken(name):
    assert Body(name=name, **BALL).name == name


def test_ground_is_no_body():
    assert "fixed world" in refused(Body, name="ground", **BALL)


@pytest.mark.parametrize(
    ("make", "given", "part"),
    [
        (Box, {}, "`size` or `from` and `to` must be given"),
        (Box, {"size": (1, 1, 0)}, "greater than zero"),
        (Box, {"size": (1, 1, 1), "width": 1}, "`width` belongs"),
        (Box, {"from_": (0, 0, 0), "to": (1, 0, 0), "width": 1}, "`height` is missing"),
        (Box, {"from_": (0, 0, 0), "width": 1, "height": 1}, "belong together"),
        (Box, {"from_": (0, 0, 0), "to": (0, 0, 0), "width": 1, "height": 1}, "same point"),
        (Box, {"from_": (0, 0, 0), "to": (1, 0, 0), "width": 1, "height": 1, "size": (1, 1, 1)}, "`size` follows"),
        (Cylinder, {"radius": 1}, "`length` or `from` and `to`"),
        (Cylinder, {"length": 1}, "`radius` is missing"),
        (Cylinder, {"radius": 1, "from_": (0, 0, 0), "to": (1, 0, 0), "along": "y"}, "`along` must not"),
        (Cylinder, {"radius": 1, "from_": (0, 0, 0), "to": (1, 0, 0), "centre": (0, 0, 0)}, "`centre` follows"),
        (Cylinder, {"radius": 1, "length": 1, "along": "X"}, "did you mean `x`"),
        (Tube, {"outer_radius": 1, "inner_radius": 1, "length": 1}, "must be smaller"),
        (Sphere, {}, "`radius` is missing"),
        (Sphere, {"radius": "1 kg"}, "a length (m) was expected"),
    ],
)
def test_shapes_refused(make, given, part):
    assert part in refused(make, **given)


POINT = {"bodies": ("crank", "rod"), "point": (0, 0, 0)}
MARKERS = {"markers": ({"body": "crank"}, {"body": "rod"})}


@pytest.mark.parametrize("kind", ["spherical", "universal", "revolute", "cylindrical", "translational", "fixed"])
def test_every_joint_can_be_placed_by_markers_and_by_a_point(kind):
    assert Joint(name="j", type=kind, **MARKERS)
    axis = {"universal": {"axes": ((1, 0, 0), (0, 1, 0))}, "spherical": {}, "fixed": {}}.get(kind, {"axis": (0, 0, 1)})
    assert Joint(name="j", type=kind, **POINT, **axis)


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"type": "spherical"}, "needs `bodies` and a `point`"),
        ({"type": "spherical", "bodies": ("crank", "rod")}, "needs `bodies` and a `point`"),
        ({"type": "spherical", "point": (0, 0, 0)}, "needs `bodies` and a `point`"),
        ({"type": "spherical", **POINT, **MARKERS}, "`bodies` must not be given with `markers`"),
        ({"type": "revolute", "axis": (1, 0, 0), **MARKERS}, "`axis` must not be given with `markers`"),
        ({"type": "spherical", "bodies": ("rod", "rod"), "point": (0, 0, 0)}, "two different bodies"),
        ({"type": "revolute", **POINT}, "`axis` is missing"),
        ({"type": "translational", **POINT, "axis": (0, 0, 0)}, "no direction"),
        ({"type": "translational", **POINT, "axis": (0, 0, 1), "x_axis": (0, 0, 2)}, "parallel"),
        ({"type": "universal", **POINT}, "`axes` is missing"),
        ({"type": "universal", **POINT, "axis": (1, 0, 0), "axes": ((1, 0, 0), (0, 1, 0))}, "has no `axis`"),
        ({"type": "universal", **POINT, "axes": ((1, 0, 0), (1, 1, 0))}, "perpendicular; these are 45 deg"),
        ({"type": "universal", **POINT, "axes": ((1, 0, 0), (0, 0, 0))}, "no direction"),
        ({"type": "spherical", **POINT, "axis": (1, 0, 0)}, "a spherical joint has no `axis`"),
        ({"type": "fixed", **POINT, "x_axis": (1, 0, 0)}, "a fixed joint has no `x_axis`"),
        (
            {"type": "revolute", **POINT, "axes": ((1, 0, 0), (0, 1, 0)), "axis": (1, 0, 0)},
            "has no `axes`; write `axis`",
        ),
        ({"type": "prismatic", **POINT}, "the word `prismatic` is not known"),
        ({"type": "sphericl", **POINT}, "did you mean `spherical`"),
        ({"type": "spherical", "markers": ({"body": "rod"},)}, "entries are missing: there is only 1"),
        ({"type": "spherical", "markers": (5, {"body": "rod"})}, "the name of a marker"),
        ({"type": "spherical", "markers": ({"bdy": "rod"}, {"body": "rod"})}, "did you mean `body`"),
    ],
)
def test_joints_refused(given, part):
    assert part in refused(Joint, name="j", **given)


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"vector": (0, 0, 1)}, "needs a `body`"),
        ({"vector": (0, 0, 1), "body": "rod", "marker": "tip"}, "`body` must not"),
        ({"vector": (0, 0, 1), "position": (0, 0, 0), "marker": "tip"}, "`position` must not"),
        ({"vector": (0, 0, 1), "body": "ground"}, "moves nothing"),
        ({"vector": (0, 0), "body": "rod"}, "entries are missing"),
        ({"vector": (0, 0, "1 N*m"), "body": "rod"}, "is a torque (N*m); a force (N) was expected"),
        ({"vector": (0, 0, 1), "body": "rod", "axes": "own"}, "there are global, body"),
        ({"body": "rod"}, "`vector` is missing"),
    ],
)
def test_forces_refused(given, part):
    assert part in refused(PointForce, name="f", **given)


def test_torques_refused():
    assert "a torque (N*m) was expected" in refused(Torque, name="t", body="rod", vector=("1 N", 0, 0))
    assert "moves nothing" in refused(Torque, name="t", body="ground", vector=(1, 0, 0))


def force(component):
    return PointForce(name="f", body="rod", vector=(component, 0, 0)).vector[0]


def test_components_that_change_with_time():
    assert force("2 kN") == 2000.0
    assert force("10 + 3*sin(2*pi*time)")(0.25) == pytest.approx(13)
    assert force(Expression("2 kN * sin(90 deg/s * time)"))(1) == pytest.approx(2000)
    assert force("5 N * sin(2*pi * 2 Hz * time)")(0.125) == pytest.approx(5)
    assert force("5 N/s * time")(2) == pytest.approx(10)
    assert force(Expression("2*time")) == force("2*time") == Expression("2.0*time")


def test_tables():
    table = force(Table(("0 ms", "10 ms", 2), (0, "1 kN", np.float64(3))))
    assert table == Table((0.0, 0.01, 2.0), (0.0, 1000.0, 3.0))
    assert [table(t) for t in (-1, 0.005, 0.01, 9)] == [0, 500, 1000, 3]
    assert force({"times": [0], "values": [4]}) == Table((0.0,), (4.0,))


@pytest.mark.parametrize(
    ("component", "part"),
    [
        ("time*1 m", "is a length"),
        ("sin(time*1 m)", "is taken of an angle"),
        ("1 N + 1 m * time", "cannot be added"),
        ("2^(time)*(3 m)^time", "cannot be raised to a power that changes with time"),
        ("tim", "did you mean `time`"),
        (Table((0, 0), (1, 2)), "0 s does not come after 0 s"),
        (Table((1, 0), (1, 2)), "does not come after"),
        (Table((0, 1), (1,)), "as many values as times"),
        (Table((), ()), "at least one time"),
        ({"times": [0, 1]}, "`values` is missing"),
        ({"times": 0, "values": [1]}, "a list was expected"),
        ({"times": ["1 m"], "values": [1]}, "a time (s) was expected"),
        ({"times": [0], "values": ["1 m"]}, "a force (N) was expected"),
        ({"times": [0], "values": [0], "vals": []}, "the key `vals` is not known; did you mean `values`?"),
        (None, "a force (N) was expected, got nothing"),
        (True, "got `true`"),
        ([1], "got a list"),
    ],
)
def test_components_refused(component, part):
    assert part in refused(force_record, component=component)


def force_record(component):
    return PointForce(name="f", body="rod", vector=(component, 0, 0))


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"duration": 0}, "greater than zero"),
        ({"step": "-1 ms"}, "greater than zero"),
        ({"step": 2}, "longer than `duration`"),
        ({"integrator": "rk4", "step": 1e-3, "output_interval": 1e-4}, "shorter than `step`"),
        ({"integrator": "rk5"}, "did you mean `rk4`"),
        ({"formulation": "newton"}, "did you mean `newton-euler`"),
        ({"stabilisation": "baumgart"}, "did you mean `baumgarte`"),
        ({"stabilisation": False}, "the word `false` is not known"),
        ({"coordinates": "polar"}, "there are auto, absolute"),
        ({"tolerance": "tight"}, "a number was expected, got `tight`"),
        ({"tolerance": 1.5}, "a number less than 1 was expected, got `1.5`"),
        ({"penalty": {"iterations": 2.5}}, "a whole number was expected, got `2.5`"),
        ({"baumgarte": {"alpha": 5, "beta": 5}}, "needs `stabilisation: baumgarte`"),
        ({"stabilisation": "baumgarte", "baumgarte": {"alpha": 5}}, "takes `alpha` and `beta`, both or none"),
        ({"stabilisation": "baumgarte", "baumgarte": {"alpha": 5, "beta": "5 m"}}, "a rate (1/s) was expected"),
        ({"stabilization": "none"}, "did you mean `stabilisation`"),
    ],
)
def test_settings_refused(given, part):
    assert part in refused(SimulationSettings, **given)


def test_a_switch_that_is_neither_on_nor_off_is_refused():
    assert "`true` or `false` was expected, got `perhaps`" in refused(StaticsSettings, verify="perhaps")


def machine(**given):
    return MachineRecord(**{"name": "m", "bodies": (CRANK, ROD), **given})


PIN = {"name": "pin", "type": "spherical", **POINT}


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"bodies": ()}, "bodies: a machine needs at least one body"),
        ({"bodies": (CRANK, CRANK)}, "the name `crank` stands twice in bodies"),
        ({"joints": (PIN, PIN)}, "the name `pin` stands twice in joints"),
        ({"markers": (Marker(body="rod"),)}, "`name` is missing"),
        ({"markers": (Marker(name="a", body="rid"),)}, "there is no body `rid`; did you mean `rod`?"),
        ({"joints": ({**PIN, "bodies": ("crank", "x")},)}, "there are crank, rod, ground"),
        (
            {"joints": ({"name": "p", "type": "fixed", "markers": ("tip", "tap")},)},
            "there is no marker `tip`; there are no markers",
        ),
        (
            {"joints": ({"name": "p", "type": "fixed", "markers": ({"body": "x"}, {"body": "rod"})},)},
            "joints.p.markers.0.body",
        ),
        (
            {"joints": ({"name": "p", "type": "fixed", "markers": ({"body": "rod"}, {"body": "rod"})},)},
            "both markers are on `rod`",
        ),
        ({"forces": (PointForce(name="f", marker="tip", vector=(0, 0, 0)),)}, "there is no marker `tip`"),
        ({"forces": (Torque(name="f", body="tip", vector=(0, 0, 0)),)}, "forces.f.body: there is no body `tip`"),
        (
            {"forces": ({"name": "f", "type": "spring"},)},
            "the type `spring` is not known; did you mean `spring-damper`?",
        ),
        ({"forces": ({"name": "f"},)}, "`type` is missing"),
        (
            {
                "markers": (Marker(name="a", body="ground"),),
                "forces": (PointForce(name="f", marker="a", vector=(0, 0, 0)),),
            },
            "a force there moves nothing",
        ),
        ({"name": "a/b"}, "cannot be the name of a result file"),
        ({"name": " "}, "a name was expected"),
        ({"gravity": (0, 0, "1 N")}, "an acceleration (m/s^2) was expected"),
        ({"bodies": 5}, "a list was expected"),
    ],
)
def test_machines_refused(given, part):
    assert part in refused(machine, **given)


FULL = machine(
    description="with a bit of everything",
    gravity=(0, 0, "-9.81 m/s^2"),
    bodies=(
        CRANK,
        Body(name="rod", density=7850, shape=Box(from_=(0, 0, 0), to=(1, 1, 1), width=0.1, height="2 cm")),
        Body(
            name="pipe",
            mass=3,
            shape=Tube(outer_radius=2, inner_radius=1, length=3, along="z"),
            angular_velocity=("30 rpm", 0, 0),
        ),
        Body(
            name="block",
            mass=3,
            inertia={"xx": 1, "yy": 1, "zz": 1, "xy": 0.1},
            orientation={"euler": (1, 2, 3), "sequence": "123"},
        ),
    ),
    markers=(Marker(name="tip", body="rod", axis=(1, 0, 0), x_axis=(0, 1, 0)),),
    joints=(PIN, {"name": "weld", "type": "fixed", "markers": ("tip", {"body": "ground", "position": (1, 2, 3)})}),
    forces=(
        PointForce(name="f", marker="tip", vector=(1, "2 kN*time", Table((0, 1), (2, 3))), axes="body"),
        Torque(name="t", body="rod", vector=(0, 0, "exp(-time)")),
    ),
    simulation={"duration": 3, "stabilisation": "baumgarte", "baumgarte": {"alpha": 5, "beta": 5}},
)


def test_json_and_pickle_bring_a_machine_back():
    assert MachineRecord.model_validate_json(FULL.model_dump_json()) == FULL
    assert MachineRecord.model_validate_json(FULL.model_dump_json(exclude_none=True, by_alias=True)) == FULL
    assert pickle.loads(pickle.dumps(FULL)) == FULL
    assert FULL.replace(name="other").name == "other"


def test_numbers_beyond_all_bounds_are_refused_too():
    assert "too large" in refused(Body, name="a", mass=10**5000, inertia=(1, 1, 1))
    assert "more than 40 digits" in refused(machine, description=10**5000)
