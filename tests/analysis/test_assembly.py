"""Assembly: least change, named gaps, consistent velocities."""

import re

import numpy as np
import pytest

import machines
from nivel import AssemblySettings, Body, Joint, MachineRecord, Marker
from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.equations import equations
from nivel.elements.joints import JOINTS
from nivel.elements.joints.kind import Combination
from nivel.errors import ModelError

pytestmark = pytest.mark.covering


def test_data_rounded_to_a_millimetre_are_closed():
    """The four-bar with positions and angles of three decimals, as a report would print them."""
    machine = machines.four_bar()
    rounded = tuple(
        body.replace(
            position=tuple(np.round(body.position, 3)),
            orientation={"axis": [0, 0, 1], "angle": round(body.orientation.angle, 3)},
        )
        for body in machine.bodies
    )
    machine = machine.replace(bodies=rounded)
    motion = equations(machine, "newton-euler")
    assembly = assemble(machine, motion)
    assert 1e-4 < assembly.gap < 3e-3
    assert assembly.gap_row.split(".")[0] in ("hinge", "pin", "sleeve", "pivot")
    motion.evaluate(0.0, assembly.y)
    assert np.abs(motion.system.record.constraints.C).max() < 1e-11
    assert all(distance < 3e-3 and angle < 3e-3 for _, distance, angle in assembly.moved)


def test_given_values_move_least():
    """Two free points pinned together meet in the middle: the change is orthogonal to the null space of C_q."""
    machine = MachineRecord(
        name="two",
        bodies=tuple(
            Body(name=n, mass=m, inertia=(1, 1, 1), position=(x, 0, 0)) for n, m, x in (("a", 1, 0), ("b", 50, 0.02))
        ),
        joints=(Joint(name="pin", type="spherical", markers=(Marker(body="a"), Marker(body="b"))),),
        assembly=AssemblySettings(largest_gap=0.03),
    )
    motion = equations(machine, "newton-euler")
    q = assemble(machine, motion).y[:14].reshape(2, 7)
    np.testing.assert_allclose(q[:, 0], 0.01, atol=1e-12)


@pytest.mark.parametrize("kind", machines.BETWEEN_BODIES)
@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
def test_disturbed_positions_and_velocities_become_consistent(kind, formulation, rng):
    machine = machines.pair(kind, rng)
    body = machine.bodies[1]
    near = body.replace(position=tuple(np.add(body.position, rng.uniform(-0.05, 0.05, 3))))
    frames = MachineRecord(
        name="near",
        bodies=(machine.bodies[0], near),
        joints=(machine.joints[0].replace(**_by_markers(machine)),),
    )
    motion = equations(frames, formulation)
    assembly = assemble(frames, motion)
    motion.evaluate(0.0, assembly.y)
    constraints = motion.system.record.constraints
    assert np.abs(constraints.C).max(initial=0.0) < 2e-12
    assert np.abs(constraints.Cdot).max(initial=0.0) < 1e-11
    # what keeps the value that it has as placed is not open
    if not all(isinstance(basic, Combination) for basic in JOINTS[kind].composition.constraints):
        assert assembly.gap > 1e-4


def _by_markers(machine):
    """The fields of its joint with markers in place of points and axes."""
    places = dict.fromkeys(("bodies", "point", "points", "axis", "axes", "x_axis"))
    return places | {"markers": tuple(_as_marker(machine, k) for k in range(2))}


def _as_marker(machine, side):
    from nivel.system.joint_frames import joint_frames

    body, point, axes = joint_frames(machine, machine.joints[0])[side]
    return Marker(body=body, position=tuple(point), orientation={"matrix": axes.tolist()})


def test_loop_that_cannot_be_closed_is_named_with_its_gap():
    """Links of 1 m and 1 m cannot span 3 m: one metre stays open."""

    def link(name, x):
        return Body(name=name, mass=1, inertia=(0.1, 0.1, 0.1), position=(x, 0.1, 0))

    machine = MachineRecord(
        name="short",
        bodies=(link("a", 0.5), link("b", 2.5)),
        joints=(
            Joint(
                name="left", type="spherical", markers=(Marker(body="ground"), Marker(body="a", position=(-0.5, 0, 0)))
            ),
            Joint(
                name="middle",
                type="spherical",
                markers=(Marker(body="a", position=(0.5, 0, 0)), Marker(body="b", position=(-0.5, 0, 0))),
            ),
            Joint(
                name="right",
                type="spherical",
                markers=(Marker(body="b", position=(0.5, 0, 0)), Marker(body="ground", position=(3, 0, 0))),
            ),
        ),
        assembly=AssemblySettings(largest_gap=2.0),
    )
    motion = equations(machine, "newton-euler")
    with pytest.raises(ModelError) as caught:
        assemble(machine, motion)
    gaps = [float(re.search(r"a gap of ([\d.]+) m", fault.message)[1]) for fault in caught.value.faults]
    assert sum(gaps) == pytest.approx(1.0, abs=1e-3)
    assert {fault.path for fault in caught.value.faults} == {"joints.left", "joints.middle", "joints.right"}


def test_opposite_axes_are_refused():
    machine = MachineRecord(
        name="wrong",
        bodies=(Body(name="a", mass=1, inertia=(1, 1, 1)),),
        joints=(
            Joint(
                name="hinge",
                type="revolute",
                markers=(Marker(body="ground", axis=(0, 0, 1)), Marker(body="a", axis=(0, 0, -1))),
            ),
        ),
    )
    with pytest.raises(ModelError, match="opposite"):
        assemble(machine, equations(machine, "newton-euler"))


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e3])
def test_closing_does_not_depend_on_the_size_of_the_machine(size):
    """Two links of one size, fixed ends 0.05 % too close or too far: the first closes to round-off, the second is refused."""

    def link(name, x):
        inertia = (0.1 * size**2,) * 3
        return Body(name=name, mass=1, inertia=inertia, position=(x * size, 0.1 * size, 0))

    def at(body, x):
        return Marker(body=body, position=(x * size, 0, 0))

    def chain(span):
        return MachineRecord(
            name="chain",
            bodies=(link("a", 0.5), link("b", 1.5)),
            joints=(
                Joint(name="left", type="spherical", markers=(Marker(body="ground"), at("a", -0.5))),
                Joint(name="middle", type="spherical", markers=(at("a", 0.5), at("b", -0.5))),
                Joint(name="right", type="spherical", markers=(at("b", 0.5), at("ground", span))),
            ),
        )

    short = chain(1.9)
    motion = equations(short, "newton-euler")
    motion.evaluate(0.0, assemble(short, motion).y)
    assert np.abs(motion.system.record.constraints.C).max() < 1e-11 * size
    long = chain(2.001)
    with pytest.raises(ModelError, match="cannot be closed"):
        assemble(long, equations(long, "newton-euler"))


def test_parallel_arms_of_a_universal_joint_say_which_marker_to_turn():
    machine = MachineRecord(
        name="cross",
        bodies=(Body(name="a", mass=1, inertia=(1, 1, 1)),),
        joints=(Joint(name="u", type="universal", markers=(Marker(body="ground"), Marker(body="a"))),),
    )
    with pytest.raises(ModelError, match=r"u\.d1\.zz is open by 90 deg.*turn one of its markers"):
        assemble(machine, equations(machine, "newton-euler"))


def test_numbers_out_of_range_are_refused():
    machine = MachineRecord(
        name="far",
        bodies=(Body(name="a", mass=1, inertia=(1, 1, 1), position=(1e200, 0, 0)),),
        joints=(Joint(name="j", type="revolute", bodies=("ground", "a"), point=(0, 0, 0), axis=(0, 0, 1)),),
    )
    with pytest.raises(ModelError):
        assemble(machine, equations(machine, "newton-euler"))
