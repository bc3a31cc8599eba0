"""A failed iteration is told by joint and coordinate."""

import pytest

import machines
from nivel import Friction
from nivel.analysis.assembly.unknown_groups import unknown_name
from preparing import prepare
from running import run


def names(coordinates, formulation="newton-euler", rotations="euler-parameters", forces=()):
    settings = {"integrator": "generalised-alpha", "formulation": formulation, "rotations": rotations}
    machine = machines.slider_crank(**settings).replace(forces=forces)
    system = prepare(machine, formulation, coordinates).motion.system
    return [unknown_name(system, k) for k in range(len(system.record.newton.b))]


def test_every_unknown_has_its_name():
    absolute, relative = names("absolute"), names("relative")
    assert absolute[:6:5] == ["crank, x of its position", "crank, its turn about its z axis"]
    assert len(set(absolute)) == len(absolute)
    assert relative[0] == "the joint hinge, coordinate hinge.angle"
    assert any(name.startswith("the constraint ") for name in relative)
    way = Friction(name="way", model="stiction", coordinate="slide.displacement", coefficient=0.1)
    assert names("absolute", forces=(way,)) == [*absolute, "the effort of way"]


@pytest.mark.parametrize(
    ("kind", "wanted"),
    [
        ("universal", ["the joint j, coordinate j.angle_2", "the joint j, coordinate j.angle_1"]),
        # x and y of the first point along axes of the second marker are no coordinates of the result
        ("planar", ["the joint j", "the joint j", "the joint j, coordinate j.angle"]),
        ("screw", ["the joint j, coordinate j.angle"]),
    ],
)
def test_unknowns_of_a_joint_that_carries_its_first_body_have_their_names(kind, wanted, rng):
    record = machines.pair(kind, rng, ground=True).replace(simulation={"integrator": "generalised-alpha"})
    system = prepare(record, "newton-euler", "relative").motion.system
    assert [unknown_name(system, k) for k in range(len(system.record.residual.vdot))] == wanted


@pytest.mark.parametrize(("rotations", "last"), [("euler-parameters", 4), ("euler-angles", 3), ("rotation-vector", 3)])
def test_rotation_coordinates_have_their_names(rotations, last):
    found = names("absolute", "lagrange", rotations)
    assert found[3 : 3 + last : last - 1] == [f"crank, its rotation coordinate {k}" for k in (1, last)]
    assert len(set(found)) == len(found)
    assert ("the constraint crank.euler_parameters" in found) == (rotations == "euler-parameters")


def test_a_failed_iteration_keeps_the_result_and_names_where_it_stalls():
    """Two iterations are too few for 1e-10."""
    r = run(
        machines.slider_crank(), integrator="generalised-alpha", step=5e-3, coordinates="relative",
        corrector={"most_iterations": 2},
    )  # fmt: skip
    assert r.finished.outcome == "failed"
    message, advice, _ = r.finished.failure
    assert "stalls at the joint" in message
    assert "--step" in advice
    assert len(r.time) >= 1
