"""What is refused before a run because its numbers would mean nothing."""

import numpy as np
import pytest

import machines
from nivel.analysis.dynamics import prepare
from nivel.errors import ModelError
from nivel.machine import Body, Driver, Friction, Joint, MachineRecord, SimulationSettings
from nivel.machine.time_function import Table

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
    assert "normal_load" in caught.value.faults[0].message


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
        with pytest.raises(ModelError, match="speed would jump") as caught:
            prepare(machine, "newton-euler")
        assert caught.value.faults[0].path == "drivers.drive.value"
    else:
        prepare(machine, "newton-euler")


def test_point_mass_counts_three_freedoms_and_never_turns():
    bob = Body(name="bob", mass=2.0, point_mass=True, position=(1, 0, 0))
    rope = Joint(name="rope", type="distance", bodies=("ground", "bob"), points=((0, 0, 0), (1, 0, 0)))
    machine = MachineRecord(name="m", bodies=(bob,), joints=(rope,), gravity=(0, -9.81, 0))
    prepared = prepare(machine, "newton-euler")
    assert prepared.redundancy.degrees_of_freedom == 2
    prepared.motion.evaluate(0.0, prepared.assembly.y)
    record = prepared.motion.system.record
    np.testing.assert_array_equal(record.bodies.alpha_b[0], 0.0)
    np.testing.assert_allclose(record.bodies.Rddot[0], [0, -9.81, 0], atol=1e-12)
