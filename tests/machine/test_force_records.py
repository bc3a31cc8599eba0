"""Forces: what each kind takes, its units and defaults, and what it refuses."""

import numpy as np
import pytest
from refusals import refused

from nivel import (
    Bushing,
    Contact,
    Expression,
    Friction,
    JointSpringDamper,
    Marker,
    Motor,
    PairForce,
    SpringDamper,
    Stop,
    TorsionalSpringDamper,
)
from nivel.elements.beams.sections import Material as BeamMaterial
from nivel.elements.contacts.contact import Material
from nivel.elements.forces import FORCES
from nivel.errors import ModelError
from nivel.machine.core.element import GlobalPoint

LINE = {"markers": ("tip", "eye")}
POINTS = {"bodies": ("rod", "crank"), "points": ((0, 0, 0), (1, 0, 0))}
HINGE, SLIDE = {"coordinate": "hinge.angle"}, {"coordinate": "slide.displacement"}
SPRING = {**LINE, "stiffness": "2 kN/m", "free_length": "10 cm"}
COULOMB = {"model": "coulomb", "coefficient": 0.3, "transition_speed": "1 mm/s"}
STICTION, LUGRE = (
    {"model": "stiction", "coefficient": 0.3},
    {"model": "lugre", "coefficient": 0.3, "bristle_stiffness": 1e5},
)
BALL = {"body": "rod", "plane": "base", "stiffness": 1e6, "restitution": 0.5}
STEEL = {"youngs_modulus": "210 GPa", "poisson_ratio": 0.3}


def test_every_force_has_a_type_of_its_own_and_outputs():
    types = [force.model_fields["type"].default for force in FORCES.records]
    assert len(set(types)) == len(types) == 32
    assert all({"magnitude", "power"} <= set(force.outputs) for force in FORCES.records)


@pytest.mark.parametrize(
    ("make", "given"),
    [
        (SpringDamper, {**POINTS, "stiffness": "3 N/mm", "free_length": 0, "damping": "5 N s/m", "preload": "2 N"}),
        (SpringDamper, {**LINE, "damping": 3}),
        (SpringDamper, {**LINE, "free_length": 1, "table": {"deflections": (0, "1 cm"), "forces": (0, "2 kN")}}),
        (SpringDamper, {**LINE, "law": "2 kN/m * (length - 10 cm) + 5*rate^3 + tip.vx"}),
        (TorsionalSpringDamper, {**LINE, "stiffness": "3 N m/deg", "damping": "1 N m s/rad", "free_angle": "10 deg"}),
        (TorsionalSpringDamper, {**LINE, "table": {"deflections": (0, "10 deg"), "torques": (0, "2 N m")}}),
        (TorsionalSpringDamper, {**LINE, "law": "-3*sin(angle) - rate"}),
        (JointSpringDamper, {**HINGE, "stiffness": "3 N m/deg", "free_value": "10 deg", "preload": "1 N m"}),
        (JointSpringDamper, {**SLIDE, "stiffness": "3 N/m", "free_value": "10 mm", "damping": "3 N s/m"}),
        (JointSpringDamper, {"coordinate": "slide", "table": {"deflections": (0, "1 mm"), "efforts": (0, "5 N")}}),
        (JointSpringDamper, {**HINGE, "law": {"of": "value", "points": [0, 1], "values": [0, 5]}}),
        (Stop, {**HINGE, "lower": "-10 deg", "upper": 0.1, "stiffness": "5 N m/deg", "restitution": 1}),
        (Stop, {**SLIDE, "upper": 0, "stiffness": "5 N/m^1.5", "exponent": 1.5, "restitution": "1/2"}),
        (Friction, {**HINGE, **COULOMB, "radius": "1 cm", "viscous": "3 N m s/rad", "collar_radius": "2 cm"}),
        (Friction, {**HINGE, **STICTION, "radius": 0.01, "static_coefficient": 0.4, "stribeck_speed": "1 mm/s"}),
        (Friction, {**SLIDE, **LUGRE, "bristle_damping": "300 s/m", "normal_load": "50 N"}),
        (Motor, {**HINGE, "effort": "5 N m * sin(time)", "limit": "4 N m"}),
        (Motor, {**SLIDE, "speed": "0.1 m/s", "gain": "100 N s/m"}),
        (PairForce, {**LINE, "magnitude": "5 N / length"}),
        (PairForce, {**POINTS, "vector": (0, "2*time", "-3*tip.vx"), "axes": "first"}),
        (Bushing, {**LINE, "stiffness": ("3 N/m", 1, 1, "2 N m/rad", 0, 0)}),
        (Contact, {**BALL, "friction": 0.3, "static_friction": 0.4}),
        (Contact, {**BALL, "friction": 0.3, "friction_model": "coulomb", "friction_transition_speed": "1 mm/s"}),
        (Contact, {"bodies": ("rod", "crank"), "materials": (STEEL, STEEL), "restitution": 0.9}),
        (Contact, {**BALL, "stiffness": "2 N/um", "exponent": 1, "plane": {"body": "ground", "axis": (0, 0, 1)}}),
    ],
    ids=lambda value: value.__name__ if isinstance(value, type) else "",
)
def test_taken(make, given):
    force = make(name="f", **given)
    assert make.model_validate_json(force.model_dump_json()) == force


def test_quantities_are_in_si():
    assert SpringDamper(name="f", **SPRING).stiffness == 2000.0
    assert Stop(name="f", **SLIDE, upper=0, stiffness="5 N/mm^2", exponent=2, restitution=1).stiffness == pytest.approx(
        5e6
    )
    assert TorsionalSpringDamper(name="f", **LINE, stiffness="1 N m/deg").stiffness == pytest.approx(57.29577951308232)
    assert SpringDamper(name="f", **LINE, law="5 N/m*length - 1 mN").law == Expression("5.0*length - 0.001")


def test_ends_are_markers_or_points():
    inline = Marker(body="rod", position=(1, 0, 0))
    assert SpringDamper(name="f", markers=("tip", inline), damping=1).ends == ("tip", inline)
    first, second = SpringDamper(name="f", **POINTS, damping=1).ends
    assert (first, second) == (GlobalPoint("rod", (0.0, 0.0, 0.0)), GlobalPoint("crank", (1.0, 0.0, 0.0)))


def test_static_friction_is_kinetic_friction_unless_it_is_given():
    assert Friction(name="f", **SLIDE, **STICTION).static == 0.3
    assert Friction(name="f", **SLIDE, **STICTION, static_coefficient=0.5, stribeck_speed=1).static == 0.5


def test_a_bushing_has_matrices():
    bushing = Bushing(name="f", **LINE, stiffness=(1, 2, 3, 4, 5, 6))
    assert np.array_equal(bushing.stiffness_matrix, np.diag([1, 2, 3, 4, 5, 6]))
    assert np.array_equal(bushing.damping_matrix, np.zeros((6, 6)))
    full = np.diag([1.0, 2, 3, 4, 5, 6])
    full[0, 4] = full[4, 0] = -1.0
    assert np.array_equal(Bushing(name="f", **LINE, stiffness=full).stiffness_matrix, full)


def skew(value, at, mirrored=None):
    matrix = np.diag([1.0, 2, 3, 4, 5, 6]).tolist()
    matrix[at[0]][at[1]] = value
    matrix[at[1]][at[0]] = value if mirrored is None else mirrored
    return matrix


@pytest.mark.parametrize(
    ("make", "given", "part"),
    [
        (SpringDamper, {"damping": 1}, "forces.f: two `markers`, or two `bodies` and two `points`, are needed"),
        (SpringDamper, {"bodies": ("rod", "crank"), "damping": 1}, "are needed to say where it acts"),
        (SpringDamper, {**LINE, **POINTS, "damping": 1}, "forces.f.bodies: `bodies` must not be given with `markers`"),
        (SpringDamper, {**POINTS, "bodies": ("rod", "rod"), "damping": 1}, "forces.f.bodies: two different bodies"),
        (
            SpringDamper,
            {**POINTS, "points": ((0, 0, 0),) * 2, "damping": 1},
            "forces.f.points: the two `points` are the",
        ),
        (SpringDamper, {**LINE}, "a spring-damper needs a `stiffness`, a `table`, a `damping`, a `preload` or a `law`"),
        (SpringDamper, {**LINE, "stiffness": 3}, "forces.f: `free_length` is missing"),
        (SpringDamper, {**LINE, "damping": 3, "free_length": 1}, "forces.f.free_length: `free_length` belongs to a"),
        (SpringDamper, {**SPRING, "stiffness": -3}, "forces.f.stiffness: zero or more was expected, got `-3`"),
        (SpringDamper, {**SPRING, "free_length": "-1 m"}, "forces.f.free_length: zero or more was expected"),
        (SpringDamper, {**SPRING, "stiffness": "3 N m/rad"}, "a stiffness (N/m) was expected"),
        (SpringDamper, {**SPRING, "law": "length"}, "forces.f.stiffness: `stiffness` must not be given with a `law`"),
        (SpringDamper, {**LINE, "law": "length", "damping": 1}, "forces.f.damping: `damping` must not be given"),
        (SpringDamper, {**LINE, "law": "2*angle"}, "forces.f.law"),
        (
            SpringDamper,
            {**SPRING, "table": {"deflections": (0, 1), "forces": (0, 1)}},
            "forces.f.table: `table` stands in",
        ),
        (
            SpringDamper,
            {**LINE, "free_length": 1, "table": {"deflections": (0, 1, 1), "forces": (0, 1, 2)}},
            "forces.f.table.deflections.2: deflections increase; 1 does not come after 1",
        ),
        (
            SpringDamper,
            {**LINE, "free_length": 1, "table": {"deflections": (0, 1), "forces": (0,)}},
            "forces.f.table.forces: a table needs as many forces as deflections; got 1 and 2",
        ),
        (
            SpringDamper,
            {**LINE, "free_length": 1, "table": {"deflections": (0,), "forces": (0,)}},
            "forces.f.table.deflections: two or more deflections were expected, got 1",
        ),
        (
            SpringDamper,
            {**LINE, "free_length": 1, "table": {"deflections": (0, 1), "torques": (0, 1)}},
            "forces.f.table.torques: the key `torques` is not known; did you mean `forces`?",
        ),
        (TorsionalSpringDamper, {"stiffness": 1}, "forces.f: `markers` is missing"),
        (TorsionalSpringDamper, {**LINE, "free_angle": 1}, "needs a `stiffness`"),
        (TorsionalSpringDamper, {**LINE, "stiffness": "3 N/m"}, "a torsional stiffness (N*m/rad) was expected"),
        (JointSpringDamper, {**HINGE, "stiffness": "3 N/m"}, "a torsional stiffness (N*m/rad) was expected"),
        (JointSpringDamper, {**SLIDE, "stiffness": "3 N m/rad"}, "a stiffness (N/m) was expected"),
        (
            JointSpringDamper,
            {"coordinate": "slide", "stiffness": "3 kg"},
            "(N/m) or a torsional stiffness (N*m/rad) was",
        ),
        (JointSpringDamper, {**HINGE, "stiffness": 1, "free_value": "1 mm"}, "forces.f.free_value: `1 mm` is a length"),
        (JointSpringDamper, {**HINGE, "law": "2 N"}, "forces.f.law: `2 N` is a force (N); a torque (N*m) was expected"),
        (
            JointSpringDamper,
            {**HINGE, "table": {"deflections": (0, "1 mm"), "efforts": ("1 N", 0)}},
            "forces.f.table.efforts.0: `1 N` is a force (N); a torque (N*m) was expected",
        ),
        (JointSpringDamper, {"stiffness": 1}, "`coordinate` is missing"),
        (Stop, {**HINGE, "stiffness": 1, "restitution": 1}, "forces.f: `lower` or `upper` is missing"),
        (
            Stop,
            {**HINGE, "lower": 1, "upper": 1, "stiffness": 1, "restitution": 1},
            "forces.f.upper: `upper` 1 must be",
        ),
        (
            Stop,
            {**HINGE, "upper": 1, "stiffness": 0, "restitution": 1},
            "forces.f.stiffness: a stiffness greater than zero",
        ),
        (Stop, {**HINGE, "upper": 1, "stiffness": 1}, "`restitution` is missing"),
        (
            Stop,
            {**HINGE, "upper": 1, "stiffness": 1, "restitution": 1.2},
            "forces.f.restitution: a number above 0 and up",
        ),
        (Stop, {**HINGE, "upper": 1, "stiffness": 1, "restitution": 1, "exponent": 0.5}, "a number of 1 or more was"),
        (Stop, {**SLIDE, "upper": 1, "stiffness": "1 N/m", "exponent": 2, "restitution": 1}, "N/m^2 was expected"),
        (Stop, {**HINGE, "upper": 1, "stiffness": "1 N/m", "restitution": 1}, "N*m/rad was expected"),
        (Friction, {**HINGE, **COULOMB}, "forces.f: `radius` is missing: of the surface that rubs"),
        (Friction, {**SLIDE, **COULOMB, "coefficient": 0}, "forces.f.coefficient: a number greater than zero"),
        (Friction, {**SLIDE, "model": "coulomb", "coefficient": 1}, "`transition_speed` is missing"),
        (
            Friction,
            {**SLIDE, **STICTION, "transition_speed": 1},
            "forces.f.transition_speed: `transition_speed` belongs to",
        ),
        (Friction, {**SLIDE, **STICTION, "static_coefficient": 0.4}, "`stribeck_speed` is missing"),
        (Friction, {**SLIDE, **STICTION, "static_coefficient": 0.2}, "`static_coefficient` 0.2 is smaller than"),
        (Friction, {**SLIDE, "model": "lugre", "coefficient": 1}, "`bristle_stiffness` is missing"),
        (
            Friction,
            {**SLIDE, **STICTION, "bristle_damping": 1},
            "forces.f.bristle_damping: `bristle_damping` belongs to",
        ),
        (
            Friction,
            {**SLIDE, **STICTION, "collar_radius": 1},
            "forces.f.collar_radius: `collar_radius` belongs to an angle",
        ),
        (Friction, {**SLIDE, **STICTION, "viscous": "1 N m s/rad"}, "a damping coefficient (N*s/m) was expected"),
        (
            Friction,
            {**SLIDE, **STICTION, "normal_load": 1, "preload": 1},
            "forces.f.preload: `preload` must not be given",
        ),
        (Friction, {**SLIDE, **STICTION, "normal_load": 1, "radius": 1}, "forces.f.radius: `radius` must not be given"),
        (Friction, {**SLIDE, "coefficient": 1}, "`model` is missing"),
        (
            Friction,
            {**STICTION, "coordinate": "table.x"},
            "`normal_load` is missing: no reaction loads `table.x` alone",
        ),
        (Friction, {**SLIDE, "model": "dahl", "coefficient": 1}, "there are coulomb, stiction, lugre"),
        (Motor, {**HINGE}, "forces.f: a motor needs an `effort`, or a `speed` and a `gain`"),
        (Motor, {**HINGE, "effort": 1, "speed": 1, "gain": 1}, "forces.f.speed: `speed` stands in place of `effort`"),
        (Motor, {**HINGE, "speed": 1}, "`gain` is missing"),
        (Motor, {**HINGE, "effort": 1, "gain": 1}, "forces.f.gain: `gain` belongs to a `speed`"),
        (Motor, {**HINGE, "effort": 1, "limit": 0}, "forces.f.limit: a value greater than zero was expected"),
        (Motor, {**HINGE, "effort": "1 N"}, "a torque (N*m) was expected"),
        (Motor, {**SLIDE, "speed": "3 rad/s", "gain": 1}, "a velocity (m/s) was expected"),
        (PairForce, {**LINE}, "forces.f: a pair-force needs a `magnitude` along the line, or a `vector`"),
        (PairForce, {**LINE, "magnitude": 1, "vector": (0, 0, 0)}, "forces.f.vector: `vector` stands in place of"),
        (PairForce, {**LINE, "magnitude": 1, "axes": "first"}, "forces.f.axes: `axes` belongs to a `vector`"),
        (PairForce, {**LINE, "vector": (0, 0, 0), "axes": "body"}, "there are global, first"),
        (PairForce, {**LINE, "vector": (0, "length", 0)}, "forces.f.vector.1"),
        (
            Bushing,
            {**LINE, "stiffness": (1, 2, 3)},
            "forces.f.stiffness: six numbers, or six rows of six, were expected",
        ),
        (
            Bushing,
            {**LINE, "stiffness": [[1] * 6] * 5 + [[1]]},
            "forces.f.stiffness.5: a row of six numbers was expected",
        ),
        (
            Bushing,
            {**LINE, "stiffness": (1, 2, "3 N m/rad", 1, 1, 1)},
            "forces.f.stiffness.2: `3 N m/rad` is a torsional",
        ),
        (
            Bushing,
            {**LINE, "stiffness": skew("1 N m", (0, 4))},
            "forces.f.stiffness.0.4: `1 N m` is a torque (N*m); a force",
        ),
        (
            Bushing,
            {**LINE, "stiffness": skew(1, (0, 4), 0.5)},
            "forces.f.stiffness: `stiffness` is symmetric; 1 and 0.5",
        ),
        (Bushing, {**LINE, "stiffness": skew(3, (0, 4))}, "some motion stores negative energy"),
        (Bushing, {**LINE, "stiffness": (1,) * 6, "damping": (-1,) * 6}, "some motion loses negative energy"),
        (Bushing, {**LINE}, "`stiffness` is missing"),
        (
            Contact,
            {"stiffness": 1, "restitution": 1},
            "forces.f: a contact needs a `body` and a `plane`, or two `bodies`",
        ),
        (Contact, {**BALL, "bodies": ("rod", "crank")}, "forces.f.body: `body` must not be given with `bodies`"),
        (Contact, {"bodies": ("rod", "rod"), "stiffness": 1, "restitution": 1}, "two different bodies are needed"),
        (Contact, {**BALL, "body": "ground"}, "forces.f.body: `ground` has no shape"),
        (Contact, {**BALL, "stiffness": None}, "`stiffness` is missing"),
        (Contact, {**BALL, "materials": (STEEL, STEEL)}, "forces.f.materials: `materials` stands in place of"),
        (Contact, {**BALL, "stiffness": "5 N/m"}, "N/m^1.5 was expected"),
        (Contact, {**BALL, "friction": 0.3, "friction_model": "coulomb"}, "`friction_transition_speed` is missing"),
        (
            Contact,
            {**BALL, "friction": 0.3, "static_friction": 0.2},
            "static friction is at least as strong as kinetic",
        ),
        (Contact, {**BALL, "static_friction": 0.2}, "`friction` is missing, the coefficient of kinetic friction"),
        (Contact, {**BALL, "friction": -0.3}, "forces.f.friction: zero or more was expected"),
        (
            Contact,
            {"bodies": ("rod", "crank"), "materials": (STEEL, {**STEEL, "poisson_ratio": 0.6}), "restitution": 1},
            "forces.f.materials.1.poisson_ratio: a number above -1 and up to 0.5 was expected, got `0.6`",
        ),
        (
            Contact,
            {"bodies": ("rod", "crank"), "materials": (STEEL, STEEL), "restitution": 1, "exponent": 2},
            "forces.f.exponent: `exponent` is 1.5 with `materials` (Hertz)",
        ),
    ],
    ids=lambda value: value.__name__ if isinstance(value, type) else "",
)
def test_refused(make, given, part):
    assert part in refused(make, name="f", **given)


@pytest.mark.parametrize(
    ("given", "meant"),
    [
        ({**LINE, "stifness": 5, "free_length": 1}, "stifness"),  # that a force needs one is told by `problems`
        ({"markers": ("a", "b"), "stiffness": "3 N/m", "free_lenght": 1}, "free_lenght"),
    ],
)
def test_a_misspelt_key_is_told_once(given, meant):
    with pytest.raises(ModelError) as caught:
        SpringDamper(name="f", **given)
    (fault,) = caught.value.faults
    assert f"`{meant}` is not known; did you mean" in fault.message


def test_a_misspelt_key_that_must_be_there_is_told_once():
    with pytest.raises(ModelError) as caught:
        Contact(
            name="f",
            bodies=("a", "b"),
            restitution=0.5,
            materials=({"youngs_module": 1e9, "poisson_ratio": 0.3}, STEEL),
        )
    (fault,) = caught.value.faults
    assert fault.message == "the key `youngs_module` is not known; did you mean `youngs_modulus`?"


def test_youngs_modulus_is_understood_by_its_other_name():
    other = {"young_modulus": "210 GPa", "poisson_ratio": 0.3}
    assert Material.model_validate(other) == Material(**STEEL)
    assert BeamMaterial.model_validate({**other, "density": 7850}) == BeamMaterial(**STEEL, density=7850)
    with pytest.raises(ModelError, match="`young_modulus` is not known; did you mean `youngs_modulus`"):
        Material(**STEEL, young_modulus=1e9)
