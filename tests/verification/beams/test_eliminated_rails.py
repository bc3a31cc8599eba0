"""Bodies that beams carry along which they slide: the same machine as with the joint kept, and what is kept all the same."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import beams
from assembled import TIME, random_states
from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.implicit import ResidualOptions, with_residual
from nivel.analysis.plan.choice import choose_coordinates
from nivel.errors import SolveError
from nivel.kernels.output.observe import observe
from nivel.system.beam_nodes import with_nodes
from nivel.system.states.relative import arrange
from preparing import prepare
from simulating import machine, simulate, solid
from test_rails import KINDS, bead, girder, loaded, spinning
from unknowns import Unknowns, at_state

pytestmark = pytest.mark.covering

SHOWN = ("position", "velocity", "acceleration", "angular_acceleration", "joint_force", "joint_torque", "joint_rate")
LOADS = {
    "push": {"type": "force", "body": "bead", "vector": [3, -5, 20]},
    "twist": {"type": "torque", "body": "bead", "vector": [2, 1, -1]},
}


def both(sections):
    """The machine with joints kept, and with joints eliminated, ready to be evaluated."""
    return tuple(beams.prepared(sections, coordinates) for coordinates in ("absolute", "relative"))


def frames(sections, rng, count=2, size=0.03):
    """Of random states: what frames show of the machine with joints kept and eliminated, by name, and the eliminated one's system."""
    kept, eliminated = both(sections)
    record = with_nodes(
        machine({**sections, "simulation": {**sections["simulation"], "coordinates": "relative"}}).record
    )
    for y in random_states(kept, rng, count, size=size):
        absolute = eliminated.absolute.system
        system, own = arrange(record, absolute, y, int(absolute.record.control.rank[0]), record.simulation)
        motion = MotionEquations(system, eliminated.motion.kernels)
        wanted = ResidualOptions(balance=True)
        yield (
            shown(with_residual(MotionEquations(kept.absolute.system, kept.motion.kernels), y, "absolute", wanted), y),
            shown(with_residual(motion, own, "relative", wanted), own),
            system,
        )


def shown(motion, y):
    status, _ = motion.evaluate(TIME, y)
    assert status == 0
    frame = np.zeros(motion.system.layout.width)
    observe(motion.handle.address, TIME, y, frame)
    return {each.name: frame[each.columns] for each in motion.system.layout.variables}


def assert_same(one, other):
    for name in SHOWN:
        size = np.abs(one[name]).max()
        assert_allclose(other[name], one[name], rtol=0, atol=1e-9 * size, err_msg=name)


def nodes_carried(system):
    """Names of the bodies that beams carry."""
    tree = system.record.tree
    return [system.bodies[int(tree.node[n, 0])] for n in tree.slider[:, 0]]


@pytest.mark.parametrize("mass", ["lumped", "consistent"])
@pytest.mark.parametrize("kind", KINDS)
def test_accelerations_and_reactions_are_those_of_the_joint_kept(kind, mass, rng):
    """On an arc that is bent, in motion, between two nodes."""
    sections = {**bead(kind), "forces": LOADS}
    sections["beams"]["rail"]["mass"] = mass
    for kept, eliminated, system in frames(sections, rng):
        assert nodes_carried(system) == ["bead"]
        assert len(system.record.saddle.row) == 0  # nothing is left to be violated
        assert_same(kept, eliminated)


def busy(kind):
    """A bead with a pendulum, on a rail; a spring, a motor and a driver act on its place, another one on the angle of the pendulum."""
    sections = {**bead(kind), "forces": dict(LOADS)}
    sections["bodies"]["bob"] = solid(0.5, 0.01, position=[0.186123, 0.184575, -0.1])
    point = sections["bodies"]["bead"]["position"]
    sections["joints"]["pin"] = {"type": "revolute", "bodies": ["bead", "bob"], "point": point, "axis": [1, 0.3, 0]}
    sections["forces"] |= {
        "coil": {
            "type": "joint-spring-damper",
            "coordinate": "pad.displacement",
            "stiffness": 300,
            "damping": 2,
            "free_value": 0.2,
        },
        "pull": {"type": "motor", "coordinate": "pad.displacement", "effort": "5*cos(3*time)"},
        "bend": {"type": "joint-spring-damper", "coordinate": "pin.angle", "stiffness": 3, "damping": 0.1},
    }
    return sections


@pytest.mark.parametrize("kind", KINDS)
def test_a_body_hinged_to_the_slider_and_efforts_on_its_place(kind, rng):
    for kept, eliminated, _ in frames(busy(kind), rng, 1):
        assert_same(kept, eliminated)


@pytest.mark.parametrize("kind", KINDS)
def test_a_driver_of_the_place(kind, rng):
    sections = busy(kind)
    sections["drivers"] = {"run": {"coordinate": "pad.displacement", "value": "0.303 + 0.1*time"}}
    for kept, eliminated, system in frames(sections, rng, 1):
        assert_same(kept, eliminated)
        assert len(system.record.saddle.row) == 1
        assert_allclose(eliminated["driver.run.effort"], kept["driver.run.effort"], rtol=1e-8)


def telescope():
    """Three beams in each other: the second slides on the first, the third on the second; both also in pads, which close loops."""
    section = beams.general(1e5, 1e5, 500.0, 500.0, 2.0, (0.01, 0.01, 0.01))
    beam = {"elements": 4, "section": section}
    return {
        "gravity": [0, 0.5, -9.81],
        "beams": {
            "outer": {"from": [0, 0, 0], "to": [1, 0, 0], **beam},
            "middle": {"from": [0.31, 0, 0], "to": [1.3, 0, 0], **beam},
            "inner": {"from": [0.53, 0, 0], "to": [1.5, 0, 0], **beam},
        },
        "joints": {
            "root": {"type": "fixed", "bodies": ["ground", "outer.start"], "point": [0, 0, 0]},
            "rear": {"type": "keyed-on-beam", "bodies": ["middle.start", "outer"], "point": [0.31, 0, 0]},
            "front": {"type": "point-on-beam", "bodies": ["outer.end", "middle"], "point": [1, 0, 0]},
            "next": {"type": "translational-on-beam", "bodies": ["inner.start", "middle"], "point": [0.53, 0, 0]},
        },
        "simulation": {"duration": 0.1, "step": 1e-3, "integrator": "generalised-alpha"},
    }


def test_beams_that_slide_on_beams(rng):
    """One pad of the middle beam closes a loop and is kept; the inner one is carried by a beam that is carried."""
    for kept, eliminated, system in frames(telescope(), rng, 2, size=0.01):
        assert nodes_carried(system) == ["middle.start", "inner.start"]
        assert {system.row_owner[row] for row in system.record.saddle.row} == {"front"}
        assert_same(kept, eliminated)


@pytest.mark.parametrize("sections", [busy("keyed-on-beam"), telescope()], ids=["busy", "telescope"])
def test_matrix_is_the_derivative_of_the_residual(sections, rng):
    record, prepared = with_nodes(machine(sections).record), beams.prepared(sections, "relative")
    (y,) = random_states(prepared, rng, 1, size=0.01)
    here = at_state(record, prepared, "relative", y, rng)
    unknowns = Unknowns(here, rng.uniform(-0.05, 0.05, here.n))
    assert unknowns.error() < 1e-10


@pytest.mark.parametrize("kind", KINDS)
def test_equilibria_are_the_same(kind):
    """Under a load on the slider, which is held between two nodes by a spring."""
    sections = bead(kind, point=(0.5, 0.3, 0.2))
    sections["forces"] = {
        **LOADS,
        "coil": {
            "type": "joint-spring-damper",
            "coordinate": "pad.displacement",
            "stiffness": 5e3,
            "damping": 0,
            "free_value": 0.66,
        },
        "hold": {
            "type": "bushing",
            "bodies": ["ground", "bead"],
            "points": [[0.5, 0.3, 0.2], [0.5, 0.3, 0.2]],
            "stiffness": [10, 10, 10, 5, 5, 5],
        },
    }
    kept, eliminated = (machine(sections).statics(coordinates=each).dataset for each in ("absolute", "relative"))
    for name in ("position", "joint_force", "joint_torque", "joint_coordinate"):
        one, other = kept[name].values, eliminated[name].values
        # of reactions no more is known than of the stiff forces that they balance
        tolerance = 1e-10 if name in ("position", "joint_coordinate") else 1e-7
        assert_allclose(other, one, rtol=0, atol=tolerance * np.abs(one).max(), err_msg=name)
    moved = np.abs(kept["position"].values[0, 0] - [0.5, 0.3, 0.2])
    assert moved.max() > 1e-3


@pytest.mark.parametrize("kind", KINDS)
def test_motions_differ_by_the_square_of_the_step(kind):
    """Over two nodes of a rail that swings: a quarter of the step leaves a sixteenth, or at least less than an eighth."""
    apart = []
    for step in (2e-3, 5e-4):
        places = []
        for coordinates in ("absolute", "relative"):
            sections = bead(kind, step=step, duration=0.2, coordinates=coordinates, output_interval=0.02)
            sections["gravity"] = [20, 2, -9.81]
            result = simulate(sections)
            places.append(result.array("position"))
            assert np.ptp(result.array("joint_coordinate")[:, -1]) > 0.25
        apart.append(np.abs(places[1] - places[0]).max())
    assert apart[0] < 1e-4
    assert apart[1] < apart[0] / 8.0


@pytest.mark.parametrize("integrator", ["newmark", "radau", "rk4"])
def test_a_bead_is_flung_out_along_a_turning_bar(integrator):
    """r = r₀ cosh ωt over three nodes; rk4 on a bar that is soft enough for it."""
    sections = spinning(5, 1e-3)
    settings = {"coordinates": "relative", "integrator": integrator, "duration": 0.9}
    if integrator == "rk4":
        sections["beams"]["bar"]["section"] = beams.general(1e6, 1e6, 1e6, 1e6, 1.0, (1.0, 1.0, 1.0))
        settings["step"] = 2e-4
    if integrator == "radau":
        del sections["simulation"]["step"]
        settings |= {"tolerance": 1e-6}
    result = simulate(sections, **settings)
    place = result.array("joint_coordinate")[:, -1]
    assert place[-1] > 2.0
    expected = 0.3 * np.cosh(3.0 * result.time)
    stretched = 1e-3 if integrator == "rk4" else 1e-5
    assert_allclose(place, expected, atol=stretched)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("place", [2.0, 2.61])
def test_a_held_load_bends_a_cantilever(place, coordinates):
    """The slider's reaction is the load, in both kinds of coordinates."""
    result = machine(loaded(place, 8)).statics(coordinates=coordinates)
    force = dict(zip(result.dataset["joint"].values, result.array("joint_force")[0], strict=True))
    assert_allclose(force["pad"], [0, 0, 1e-3], atol=1e-7)  # across the beam, which leans by 3e-5


def test_a_slider_that_leaves_its_beam_ends_the_run():
    sections = spinning(4, 2e-3)
    sections["simulation"] |= {"duration": 1.5, "coordinates": "relative"}
    with pytest.raises(SolveError, match=r"pad\.displacement leaves its beam at the end") as caught:
        simulate(sections)
    assert caught.value.time > 1.0


def carried_in(sections, **simulation):
    record = machine(
        {**sections, "simulation": {**sections["simulation"], "coordinates": "relative", **simulation}}
    ).record
    return nodes_carried(prepare(record, record.simulation.formulation, "relative").motion.system)


def test_what_does_not_go_stays_kept():
    plain = bead("translational-on-beam")
    assert carried_in(plain) == ["bead"]
    assert carried_in(plain, cut=["pad"]) == []
    assert carried_in(plain, formulation="penalty", integrator="rk4") == []
    # the body hangs on the ground already
    held = bead("point-on-beam")
    point = held["bodies"]["bead"]["position"]
    held["joints"]["ball"] = {"type": "spherical", "bodies": ["ground", "bead"], "point": point}
    assert carried_in(held) == []
    # the reaction is the load of a friction
    assert carried_in(girder()) == []
    # explicit methods with friction
    loose = girder(integrator="rk4")
    loose["beams"]["girder"]["mass"] = "lumped"
    loose["forces"]["rub"]["normal_load"] = 100
    assert carried_in(loose) == []
    assert carried_in(loose, integrator="generalised-alpha") == ["trolley"]


def test_explicit_methods_are_left_the_accelerations_of_single_bodies():
    """Lumped masses have them, unless a beam carries a body."""
    plain = with_nodes(machine(bead("translational-on-beam")).record)
    explicit = plain.replace(simulation=plain.simulation.replace(integrator="rk4"))
    assert (choose_coordinates(plain), choose_coordinates(explicit)) == ("relative", "absolute")


def test_the_ends_of_the_tree_are_no_circle():
    """Two beams with a body on each that slides on the other: one of the joints stays."""
    section = beams.general(1e5, 1e5, 500.0, 500.0, 2.0, (0.01, 0.01, 0.01))
    beam = {"elements": 3, "section": section}
    sections = {
        "beams": {"a": {"from": [0, 0, 0], "to": [1, 0, 0], **beam}, "b": {"from": [0.5, 0, 0], "to": [1.5, 0, 0], **beam}},
        "joints": {
            "first": {"type": "keyed-on-beam", "bodies": ["b.start", "a"], "point": [0.5, 0, 0]},
            "second": {"type": "point-on-beam", "bodies": ["a.end", "b"], "point": [1, 0, 0]},
        },
        "simulation": {"duration": 0.1, "step": 1e-3, "integrator": "generalised-alpha"},
    }  # fmt: skip
    assert carried_in(sections) in (["b.start"], ["a.end"])
