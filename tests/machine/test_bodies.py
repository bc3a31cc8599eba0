"""Bodies beyond the usual: point masses, what the assembly may do to them, densities out of this world."""

import pytest
from refusals import BEAD, CRANK, MARKERS, ROD, faults, refused

from nivel import Body, MachineRecord, Marker
from nivel.machine.bodies.shape import Box, Sphere

SPHERE = Sphere(radius=0.1)


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"mass": 1, "inertia": (1, 1, 1), "hold": 1}, "bodies.a.hold: true or false was expected, got `1`"),
        (
            {"mass": 1, "inertia": (1, 1, 1), "assembly_weight": 0},
            "bodies.a.assembly_weight: a number greater than zero",
        ),
        ({"point_mass": True}, "bodies.a: `mass` is missing: a point mass is given by its `mass`"),
        (
            {"point_mass": True, "mass": 1, "inertia": (1, 1, 1)},
            "bodies.a.inertia: `inertia` does not belong to a point",
        ),
        ({"point_mass": True, "mass": 1, "orientation": {}}, "bodies.a.orientation: "),
        ({"point_mass": True, "mass": 1, "angular_velocity": (0, 0, 0)}, "bodies.a.angular_velocity: "),
        ({"point_mass": True, "mass": 1, "centre_of_mass": (0, 0, 0)}, "bodies.a.centre_of_mass: "),
        ({"point_mass": True, "density": 1, "shape": SPHERE}, "bodies.a.density: "),
        ({"point_mass": True, "mass": 1, "inertia_about": "origin"}, "bodies.a.inertia_about: "),
        (
            {"point_mass": True, "mass": 1, "shape": Box(size=(1, 1, 1))},
            "bodies.a.shape: a point mass is drawn as a sphere",
        ),
        (
            {"point_mass": True, "mass": 1, "shape": {"type": "sphere", "radius": 1, "centre": (0, 0, 1)}},
            "a.shape.centre: ",
        ),
        (
            {"density": "7850 g/cm^3", "shape": SPHERE},
            "bodies.a.density: a density of 7.85e+06 kg/m^3: a slip of a unit?",
        ),
        ({"density": 1e-3, "shape": SPHERE}, "bodies.a.density: a density of 0.001 kg/m^3: a slip of a unit?"),
        (
            {"mass": "3 t", "shape": Sphere(radius="2 cm")},
            "bodies.a.mass: a mass of 3000 kg with this shape gives a density of 8.95e+07 kg/m^3: a slip of a unit?",
        ),
        ({"mass": 1, "shape": Sphere(radius=9)}, "gives a density of 0.000327 kg/m^3"),
    ],
)
def test_refused(given, part):
    assert part in refused(Body, name="a", **given)


@pytest.mark.parametrize("radius", ["1 mm", "9 m"])
def test_a_shape_for_looks_only_may_have_any_size(radius):
    Body.model_validate({"name": "a", "mass": 1, "inertia": (1, 1, 1), "shape": {"type": "sphere", "radius": radius}})


def test_all_faults_of_a_body_come_at_once():
    text = refused(
        Body,
        name="ground",
        density=7850,
        mass=1,
        inertia=(1, 1, 9),
        shape=SPHERE,
        angular_velocity=(0, 0, 0),
        angular_velocity_body=(0, 0, 0),
    )
    for part in ("fixed world", "`mass` follows", "`inertia` follows", "not both", "exceeds the sum"):
        assert part in text


def test_point_masses_are_taken_with_a_sphere_of_any_density():
    assert Body(name="a", mass=1000, point_mass=True, shape=Sphere(radius=0.01), position=(1, 0, 0)).mass == 1000


def machine(**given):
    return MachineRecord(**{"name": "m", "bodies": (CRANK, ROD, BEAD), "markers": MARKERS, **given})


ON_BEAD = {"body": "bead"}


@pytest.mark.parametrize("type_", ["spherical", "distance", "spherical-spherical"])
@pytest.mark.parametrize("at", [0, 1])
def test_joints_that_hold_points_hold_point_masses_at_either_end(type_, at):
    ends = ("tip", ON_BEAD) if at else (ON_BEAD, "tip")
    assert machine(joints=({"name": "j", "type": type_, "markers": ends},))


@pytest.mark.parametrize("type_", ["point-on-line", "point-on-plane", "revolute-spherical"])
def test_joints_with_axes_on_the_first_body_hold_point_masses_at_the_second(type_):
    assert machine(joints=({"name": "j", "type": type_, "markers": ("tip", ON_BEAD)},))
    assert "joints.j.markers.0: `bead`: a point mass does not turn; in a " in refused(
        machine, joints=({"name": "j", "type": type_, "markers": (ON_BEAD, "tip")},)
    )


@pytest.mark.parametrize(
    ("given", "fault"),
    [
        (
            {"joints": ({"name": "j", "type": "revolute", "markers": ("tip", ON_BEAD)},)},
            "joints.j.markers.1: `bead`: a point",
        ),
        (
            {"joints": ({"name": "j", "type": "fixed", "bodies": ("bead", "rod"), "point": (0, 0, 0)},)},
            "joints.j.bodies.0: `bead`: a point mass does not turn; it can be in the joints distance, spherical",
        ),
        (
            {"joints": ({"name": "j", "type": "spherical", "bodies": ("rod", "bead"), "point": (0, "1 cm", 0)},)},
            "joints.j.bodies.1: the point is 0.01 m from the point mass `bead`",
        ),
        (
            {"joints": ({"name": "j", "type": "spherical", "markers": ("tip", {**ON_BEAD, "position": (1, 0, 0)})},)},
            "joints.j.markers.1.position: `bead` is a point mass: only its origin is on it",
        ),
        (
            {"markers": (*MARKERS, Marker(name="a", body="bead", position=(0, 0, 1)))},
            "markers.a.position: `bead` is a point",
        ),
        (
            {"forces": ({"name": "f", "type": "torque", "body": "bead", "vector": (0, 0, 1)},)},
            "forces.f.body: `bead`: a point",
        ),
        (
            {"forces": ({"name": "f", "type": "bushing", "markers": ("tip", ON_BEAD), "stiffness": (1,) * 6},)},
            "forces.f.markers.1: `bead`: a point mass does not turn; a bushing cannot act on it",
        ),
        (
            {"forces": ({"name": "f", "type": "force", "body": "bead", "position": (0, 0, 1), "vector": (0, 0, 1)},)},
            "forces.f.position: `bead` is a point mass: only its origin is on it",
        ),
        (
            {
                "forces": (
                    {
                        "name": "f",
                        "type": "spring-damper",
                        "bodies": ("bead", "rod"),
                        "points": ((1, 0, 0), (0, 0, 0)),
                        "damping": 1,
                    },
                )
            },
            "forces.f.bodies.0: the point is 1 m from the point mass `bead`",
        ),
        (
            {
                "markers": (*MARKERS, Marker(name="a", body="bead")),
                "sensors": ({"name": "s", "marker": "a", "quantity": "angular_velocity"},),
            },
            "sensors.s.marker: the marker is on `bead`: a point mass does not turn",
        ),
        (
            {
                "markers": (*MARKERS, Marker(name="a", body="bead")),
                "drivers": ({"name": "s", "marker": "a", "about": "z", "value": 1},),
            },
            "drivers.s.marker: the marker is on `bead`: a point mass does not turn",
        ),
        ({"sensors": ({"name": "s", "angle": ("tip", ON_BEAD)},)}, "sensors.s.angle.1: the marker is on `bead`"),
        ({"sensors": ({"name": "s", "value": "bead.wx"},)}, "sensors.s.value: `bead` has no `wx`; did you mean"),
    ],
)
def test_point_masses_have_no_turn(given, fault):
    found = faults(machine, **given)
    assert len(found) == 1, found
    assert found[0].startswith(fault)


def test_what_acts_at_the_origin_of_a_point_mass_is_taken():
    forces = (
        {"name": "f", "type": "force", "body": "bead", "vector": (0, 0, "bead.vx")},
        {"name": "s", "type": "spring-damper", "markers": ("tip", ON_BEAD), "damping": 1},
        {"name": "p", "type": "pair-force", "markers": ("tip", ON_BEAD), "magnitude": 1},
    )
    assert machine(forces=forces, sensors=({"name": "d", "distance": ("tip", ON_BEAD)},))
