"""What is refused before a run because its numbers would mean nothing."""

from cProfile import Profile

import numpy as np
import pytest

import machines
from nivel import (
    Body,
    Contact,
    Driver,
    Friction,
    Joint,
    Machine,
    MachineRecord,
    Marker,
    SimulationSettings,
    SpringDamper,
    Stop,
)
from nivel.analysis.assembly import redundancy
from nivel.analysis.plan.plan import plan_run
from nivel.errors import ModelError
from nivel.machine.laws.time_function import Expression, PythonLaw, Table
from nivel.system.joint_frames import tilted_axes
from preparing import prepare
from running import run

RUB = {"model": "coulomb", "coefficient": 0.2, "transition_speed": 1e-3, "radius": 0.02}


def four_revolutes():
    """The planar four-bar with revolutes everywhere: three rows too many."""
    machine = machines.four_bar()
    joints = tuple(
        Joint(name=joint.name, type="revolute", markers=joint.markers)
        if joint.markers is not None
        else joint.replace(type="revolute")
        for joint in machine.joints
    )
    return machine.replace(joints=joints)


def test_friction_loaded_by_a_reaction_that_is_not_unique_is_refused():
    machine = four_revolutes()
    joint = machine.joints[1].name
    rubbing = machine.replace(forces=(*machine.forces, Friction(name="rub", coordinate=f"{joint}.angle", **RUB)))
    with pytest.raises(ModelError, match="is not unique") as caught:
        prepare(rubbing, "newton-euler")
    assert caught.value.faults[0].path == "forces.rub.coordinate"
    assert "give a `normal_load`, or make " in caught.value.faults[0].message
    assert "spherical and " in caught.value.faults[0].message


def test_friction_with_its_own_load_runs_in_a_redundant_machine():
    machine = four_revolutes()
    rub = Friction(name="rub", coordinate=f"{machine.joints[1].name}.angle", normal_load=100.0, **RUB)
    assert prepare(machine.replace(forces=(*machine.forces, rub)), "newton-euler").redundancy.redundant_rows


@pytest.mark.parametrize(("times", "refused"), [((0, 0.5, 1), False), ((0, 0.5, 0.9), True), ((0.1, 0.5, 1), True)])
def test_table_of_a_driver_holds_for_the_whole_run(times, refused):
    body = Body(name="wheel", mass=1, inertia=(1, 1, 1))
    hub = Joint(name="hub", type="revolute", bodies=("ground", "wheel"), point=(0, 0, 0), axis=(0, 0, 1))
    drive = Driver(name="drive", coordinate="hub.angle", value=Table(times, (0, 0.2, 0.1), "cubic"))
    settings = SimulationSettings(duration=1.0)
    machine = MachineRecord(name="m", bodies=(body,), joints=(hub,), drivers=(drive,), simulation=settings)
    if refused:
        with pytest.raises(ModelError, match="speed jumps to zero") as caught:
            plan_run(machine)
        assert caught.value.faults[0].path == "drivers.drive.value"
    else:
        plan_run(machine)


def wheel(**sections):
    """A wheel on a hinge at the origin."""
    body = Body(name="wheel", mass=1, inertia=(1, 1, 1))
    hub = Joint(name="hub", type="revolute", bodies=("ground", "wheel"), point=(0, 0, 0), axis=(0, 0, 1))
    settings = SimulationSettings(duration=1.0)
    return MachineRecord(name="m", bodies=(body,), joints=(hub,), simulation=settings, **sections)


@pytest.mark.parametrize(
    ("law", "wrong"),
    [
        ("t * t, 2 * t, 2.0", ""),
        ("t * t, 5 * t, 5.0", "its rate is"),
        ("t * t, 2 * t, 7.0", "its acceleration is"),
        ("0.1 * (t > 0.5), 0.0, 0.0", "its value jumps from 0 to 0.1"),
        ("np.sin(3000 * t), 3000 * np.cos(3000 * t), -9e6 * np.sin(3000 * t)", ""),
        ("max(t - 0.5, 0.0) ** 2, 2 * max(t - 0.5, 0.0), 2.0 * (t > 0.5)", ""),
    ],
)
def test_law_of_a_driver_returns_its_own_derivatives(law, wrong):
    source = f"import numpy as np\n\n\ndef motion(t):\n    return {law}\n"
    machine = wheel(
        drivers=(Driver(name="drive", coordinate="hub.angle", value=PythonLaw(source, "motion", ("time",))),)
    )
    if wrong:
        with pytest.raises(ModelError, match=wrong) as caught:
            plan_run(machine)
        assert caught.value.faults[0].path == "drivers.drive.value"
    else:
        plan_run(machine)


def test_stop_that_starts_far_inside_is_refused():
    stop = Stop(name="end", coordinate="hub.angle", lower=0.5, stiffness=1e4, restitution=0.5)
    with pytest.raises(ModelError, match=r"starts 0\.5 rad inside") as caught:
        prepare(wheel(forces=(stop,)), "newton-euler")
    assert caught.value.faults[0].path == "forces.end"
    prepare(wheel(forces=(stop.replace(lower=0.01),)), "newton-euler")


def test_spheres_with_one_centre_overlap_by_both_radii():
    ball = {"mass": 1, "shape": {"type": "sphere", "radius": 0.05}}
    bodies = (Body(name="a", **ball), Body(name="b", **ball))
    touch = Contact(name="touch", bodies=("a", "b"), stiffness=1e4, restitution=0.5)
    with pytest.raises(ModelError, match=r"starts 0\.1 m inside"):
        prepare(MachineRecord(name="m", bodies=bodies, forces=(touch,)), "newton-euler")


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_drivers_that_part_on_the_way_stop_the_run_with_their_names(coordinates):
    """Both start alike; at 0.1 s they differ by 1e-3 rad."""
    drivers = (
        Driver(name="one", coordinate="hub.angle", value=Expression("time")),
        Driver(name="two", marker="rim", about="z", value=Expression("time + time^3")),
    )
    machine = wheel(drivers=drivers, markers=(Marker(name="rim", body="wheel"),))
    finished = run(machine, coordinates=coordinates).finished
    assert finished.outcome == "failed"
    message, advice, time = finished.failure
    assert 0.09 < time < 0.15
    assert "contradicts them now" in message
    assert "one" in message
    assert "two" in message
    assert "two drivers" in advice


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_driver_that_is_no_number_is_named(coordinates):
    machine = wheel(drivers=(Driver(name="drive", coordinate="hub.angle", value=Expression("sqrt(0.25 - time)")),))
    message, advice, time = run(machine, coordinates=coordinates).finished.failure
    assert time == pytest.approx(0.25, abs=2e-3)
    assert "the motion of drive is not a number" in message
    assert "drive" in advice


def test_point_mass_counts_three_freedoms_and_never_turns():
    bob = Body(name="bob", mass=2.0, point_mass=True, position=(1, 0, 0))
    rope = Joint(name="rope", type="distance", bodies=("ground", "bob"), points=((0, 0, 0), (1, 0, 0)))
    machine = MachineRecord(name="m", bodies=(bob,), joints=(rope,), gravity=(0, -9.81, 0))
    prepared = prepare(machine, "newton-euler")
    assert prepared.redundancy.degrees_of_freedom == 2
    prepared.motion.evaluate(0.0, prepared.start)
    record = prepared.motion.system.record
    np.testing.assert_array_equal(record.bodies.alpha_b[0], 0.0)
    np.testing.assert_allclose(record.bodies.Rddot[0], [0, -9.81, 0], atol=1e-12)


def many(shape: str, count: int) -> MachineRecord:
    """`count` bodies that fly freely, in a chain, in a tree whose axes are nearly parallel here and there, or between springs."""
    places = [(1.0 * k, 0.0, 0.0) for k in range(count)]
    bodies = tuple(Body(name=f"b{k}", mass=1.0, inertia=(1.0, 1.0, 1.0), position=places[k]) for k in range(count))
    names = ["ground", *(body.name for body in bodies)]
    if shape == "free":
        return MachineRecord(name=shape, bodies=bodies)
    if shape == "springs":
        pairs = [(Marker(body=names[k + 1]), Marker(body=names[k + 2])) for k in range(count - 1)]
        springs = [
            SpringDamper(name=f"s{k}", markers=pairs[k], stiffness=1.0, free_length=1.0) for k in range(len(pairs))
        ]
        return MachineRecord(name=shape, bodies=bodies, forces=tuple(springs))
    before = range(count) if shape == "chain" else [(k + 1) // 2 for k in range(count)]
    turned = [0.0 if shape == "chain" else 1.0 * k for k in range(count)]
    joints = [
        Joint(
            name=f"j{k}",
            type="revolute",
            bodies=(names[before[k]], names[k + 1]),
            point=places[k],
            axis=(0.0, np.sin(turned[k]), np.cos(turned[k])),
        )
        for k in range(count)
    ]
    return MachineRecord(name=shape, bodies=bodies, joints=tuple(joints))


@pytest.mark.parametrize(
    "shape", ["springs", *(pytest.param(each, marks=pytest.mark.full) for each in ("free", "chain"))]
)
def test_calls_of_a_run_grow_as_its_bodies(shape):
    """Of 512 bodies less those of 256 they are twice those of 256 less those of 128, and four times where something is quadratic."""
    calls = []
    for count in (8, 128, 256, 512):  # the first imports
        machine, seen = Machine.from_record(many(shape, count)), Profile()
        seen.runcall(machine.simulate, verify=False, duration=0.01, step=0.01, output_interval=0.01, integrator="rk4")
        seen.create_stats()
        calls.append(sum(each[0] for each in seen.stats.values()))
    assert calls[3] - calls[2] < 2.1 * (calls[2] - calls[1])


def test_nearly_parallel_axes_of_a_tree_need_no_dense_matrix(monkeypatch):
    machine = many("tree", 80)
    assert tilted_axes(machine, redundancy.MEANT)
    monkeypatch.setattr(redundancy, "scaled_jacobian", None)
    assert prepare(machine, "newton-euler").motion.system.machine_rows == 5 * 80
