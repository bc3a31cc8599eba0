"""A failed iteration is told by joint and coordinate."""

import machines
from nivel.analysis.dynamics import prepare
from nivel.analysis.unknowns import unknown_name
from running import run


def names(coordinates):
    machine = machines.slider_crank(integrator="generalised-alpha")
    system = prepare(machine, coordinates=coordinates).motion.system
    return [unknown_name(system, k) for k in range(len(system.record.newton.b))]


def test_every_unknown_has_its_name():
    absolute, relative = names("absolute"), names("relative")
    assert absolute[:6:5] == ["crank, x of its position", "crank, its turn about its z axis"]
    assert len(set(absolute)) == len(absolute)
    assert relative[0] == "the joint hinge, coordinate hinge.angle"
    assert any(name.startswith("the constraint ") for name in relative)


def test_a_failed_iteration_keeps_the_result_and_names_where_it_stalls():
    """A step of a tenth of a turn of the crank and more."""
    r = run(machines.slider_crank(), integrator="generalised-alpha", step=0.04, coordinates="relative", cut=("hinge",))
    assert r.finished.outcome == "failed"
    message, advice, time = r.finished.failure
    assert "stalls at the joint" in message
    assert "--step" in advice
    assert 0.0 < time < 8.0
    assert len(r.time) > 1
