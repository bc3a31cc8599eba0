"""Relative coordinates with flexible bodies: at equal states all is as in absolute ones, and so are motions."""

from dataclasses import replace
from importlib import import_module
from types import SimpleNamespace

import numpy as np
import pytest

import flexible_reference as reference
import simulating
from nivel import PointForce, SimulationSettings
from nivel.analysis.assembly.implicit import evaluate_residual
from nivel.analysis.plan.choice import choose_coordinates
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run.simulate import simulate
from nivel.analysis.statics.newton import Iteration
from nivel.analysis.statics.run import prepare_statics
from nivel.analysis.statics.search import settle
from nivel.flexible.body.body_file import read_body
from nivel.machine.settings.analyses import StaticsSettings
from observing import assert_same_frame, observed, of_absolute
from preparing import prepare
from running import reference_run, run
from tree_machines import MACHINES, beam, hinge, machine, write_beams
from unknowns import Unknowns

pytestmark = pytest.mark.covering

EACH = pytest.mark.parametrize("name", MACHINES)


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    return write_beams(tmp_path_factory.mktemp("tree"))


def prepared_in(record, coordinates, integrator="generalised-alpha"):
    settings = SimulationSettings(integrator=integrator, stabilisation="direct", coordinates=coordinates)
    return prepare(record.replace(simulation=settings), "newton-euler", coordinates)


def moving(record, rng):
    """A state in relative coordinates in motion, on its constraints, with accelerations and multipliers."""
    prepared = prepared_in(record, "relative")
    motion, path = prepared.motion, prepared.path
    system, y = motion.system, prepared.start.copy()
    positions, states = system.positions, len(system.record.elements.state)
    n = len(y) - positions - states - 2
    modal = np.array(system.map.units)[: positions + n]
    # loops are closed again from not too far: what is least in the mass metric bends the bodies
    spread = 0.01 if len(system.record.saddle.row) > len(record.drivers) else 1.0
    y[:positions] += spread * np.where(modal[:positions] == "kg^0.5 m", 0.01, 0.3) * rng.uniform(-1, 1, positions)
    y[positions : positions + n] += np.where(modal[positions:] == "kg^0.5 m/s", 0.3, 1.0) * rng.uniform(-1, 1, n)
    system.record.control.stabilise[2:] = 1e-14
    correct = import_module(path.correction).correct
    for _ in range(6):
        assert correct(motion.handle.address, 0.1, y) == 0
    status, rate = motion.evaluate(0.1, y)
    assert status == 0
    constraints = system.record.constraints
    left = system.record.saddle.row
    assert np.abs(constraints.C[left]).max(initial=0.0) < 1e-12
    assert np.abs(constraints.Cdot[left]).max(initial=0.0) < 1e-11
    return SimpleNamespace(
        record=record,
        prepared=prepared,
        motion=motion,
        y=y,
        size=system.size,
        positions=positions,
        n=n,
        states=states,
        rows=len(system.record.residual.row),
        vdot=rate[positions : positions + n].copy(),
        xdot=rate[positions + n : positions + n + states].copy(),
        lam=constraints.lam[system.record.residual.row].copy(),
    )


@EACH
def test_accelerations_at_equal_states(folder, rng, name):
    """Of bodies and modes, reactions, energies and sensors: the frame as a whole."""
    record = MACHINES[name](folder)
    for _ in range(3):
        here = moving(record, rng)
        seen = observed(here.motion, 0.1, here.y)
        absolute = prepared_in(record, "absolute")
        expected = observed(absolute.motion, 0.1, of_absolute(seen, here.states))
        assert expected.status == 0
        assert np.abs(expected.pddot).max() > 1.0
        np.testing.assert_allclose(seen.pddot, expected.pddot, rtol=0, atol=1e-9 * np.abs(expected.pddot).max())
        assert_same_frame(here.motion.system.layout, seen.frame, expected.frame)


@EACH
def test_residual_vanishes_at_these_accelerations(folder, rng, name):
    here = moving(MACHINES[name](folder), rng)
    residual = here.motion.system.record.residual
    residual.y[:], residual.vdot[:], residual.lam[:] = here.y, here.vdot, 0.0
    assert evaluate_residual(here.motion, 0.1) == 0
    largest = np.abs(residual.value[: here.n]).max()
    residual.vdot[:] = 0.0
    residual.lam[:] = here.lam
    assert evaluate_residual(here.motion, 0.1) == 0
    largest = max(largest, np.abs(residual.value[: here.n]).max())
    residual.vdot[:] = here.vdot
    assert evaluate_residual(here.motion, 0.1) == 0
    n, states, rows = here.n, here.states, here.rows
    assert np.abs(residual.value[:n]).max() < 1e-11 * largest
    gamma = residual.value[n + states + 2 * rows :]
    assert np.abs(gamma).max(initial=0.0) < 1e-10 * np.abs(here.vdot).max()


@EACH
def test_matrix_is_the_derivative_of_the_residual(folder, rng, name):
    here = moving(MACHINES[name](folder), rng)
    for change in (None, 0.2 * rng.uniform(-1, 1, here.n)):
        unknowns = Unknowns(here, change)
        widths = unknowns.widths()
        units = here.motion.system.map.units[here.positions : here.positions + here.n]
        # a modal coordinate of one bends these bodies by about their length
        widths[: here.n] *= np.where(np.array(units) == "kg^0.5 m/s", 0.5, 1.0)
        if change is not None:
            unknowns = Unknowns(here, np.where(np.array(units) == "kg^0.5 m/s", 0.02, 1.0) * change)
        unknowns.widths = lambda widths=widths: widths
        assert unknowns.error() < 1e-10


@pytest.mark.parametrize("name", ["pendulum", "chain", "flying", "loop"])
def test_motion_is_that_of_absolute_coordinates(folder, name):
    """What is left between them falls with the fourth power of the step."""
    record = MACHINES[name](folder)
    common = {"integrator": "rk4", "duration": 0.04, "output_interval": 0.01}
    differences = []
    for step in (4e-5, 2e-5, 1e-5):
        a, r = (run(record, coordinates=each, step=step, **common) for each in ("absolute", "relative"))
        differences.append(np.abs(a.modal_rate - r.modal_rate).max() / np.abs(a.modal_rate).max())
        assert np.abs(a.position - r.position).max() < 1e-9
    # until round-off of stiff modes
    assert differences[0] < 1e-5
    assert differences[-1] < max(differences[0] / 100.0, 1e-10)


@EACH
def test_energy_is_kept(folder, name):
    record = MACHINES[name](folder)
    errors = []
    for step in (4e-5, 2e-5):
        r = run(record, coordinates="relative", integrator="rk4", step=step, duration=0.05, output_interval=0.01)
        assert r.finished.outcome == "done"
        errors.append(np.abs(r.energy_error).max() / max(r.kinetic_energy.max(), 1e-3))
    assert errors[1] < max(errors[0] / 10.0, 1e-11)
    assert errors[0] < 1e-5


@pytest.mark.parametrize("name", ["chain", "loop"])
@pytest.mark.parametrize(
    ("integrator", "settings"),
    [
        ("newmark", {"step": 2e-4}),
        ("hht", {"step": 2e-4, "hht": {"alpha": 0.05}}),
        ("generalised-alpha", {"step": 2e-4}),
        ("generalised-alpha", {"step": 2e-4, "stabilisation": "none"}),
        ("ros2", {"step": 1e-4}),
        ("bdf", {"tolerance": 1e-7}),
        ("radau", {"tolerance": 1e-7}),
        ("dopri5", {"tolerance": 1e-8}),
    ],
)
def test_all_integrators_agree(folder, name, integrator, settings):
    record = MACHINES[name](folder)
    common = {"duration": 0.1, "output_interval": 0.02, "coordinates": "relative"}
    expected = reference_run(record, integrator="dop853", tolerance=1e-10, **common)
    r = run(record, integrator=integrator, **settings, **common)
    assert r.finished.outcome == "done"
    assert np.abs(r.position - expected.position).max() < 2e-4
    assert np.abs(r.energy_error).max() < 1e-3 * max(r.kinetic_energy.max(), 1.0)


def test_stiff_modes_are_a_rigid_body(tmp_path):
    """The difference falls with one over the stiffness."""
    differences = []
    for modulus in (400, 1600):
        folder = write_beams(tmp_path, modulus)
        bars = [beam(folder, name, (k, 0, 0)) for k, name in enumerate("ab")]
        bars = [each.replace(flexible=each.flexible.replace(damping_ratio=0.6)) for each in bars]
        record = machine("stiff", bars, [hinge("r", "ground", "a", 0.0), hinge("e", "a", "b", 1.0)])
        body = read_body(folder / "beam.nc")
        rigid = {"mass": body.mass, "centre_of_mass": tuple(body.centre_of_mass), "inertia": body.inertia.tolist()}
        solid = record.replace(bodies=tuple(each.replace(flexible=None, **rigid) for each in bars))
        common = {"duration": 0.2, "output_interval": 0.05, "coordinates": "relative"}
        expected = reference_run(solid, integrator="dop853", tolerance=1e-11, **common)
        r = run(record, integrator="radau", tolerance=1e-9, **common)
        differences.append(np.abs(r.position - expected.position).max())
    assert differences[1] == pytest.approx(differences[0] / 4.0, rel=0.15)


def test_start_positions_of_joints_are_taken(folder):
    """Beside flexible bodies too: the machine is assembled before it bends."""
    record = MACHINES["pendulum"](folder)
    turned = record.replace(
        joints=tuple(each.replace(start={"angle": 0.7}, start_rates={"angle": 2.0}) for each in record.joints)
    )
    a, r = (
        run(turned, coordinates=each, step=1e-5, duration=1e-3, integrator="rk4") for each in ("absolute", "relative")
    )
    assert r.joint_coordinate[0, 0] == pytest.approx(0.7)
    assert r.joint_rate[0, 0] == pytest.approx(2.0)
    np.testing.assert_allclose(r.position, a.position, atol=1e-10)


def test_start_from_equilibrium(folder):
    """A bent beam at rest stays where it is, in both coordinates."""
    record = machine(
        "clamped",
        [beam(folder, "a", (0, 0, 0)), beam(folder, "b", (1, 0, 0))],
        [hinge("w", "ground", "a", 0.0, kind="fixed", axis=None), hinge("e", "a", "b", 1.0, kind="fixed", axis=None)],
    )
    out = {}
    for coordinates in ("absolute", "relative"):
        out[coordinates] = r = run(
            record, coordinates=coordinates, start="equilibrium", integrator="rk4", step=1e-5, duration=0.01
        )
        assert np.abs(r.modal_coordinate[0]).max() > 1e-4
        assert np.abs(r.modal_coordinate - r.modal_coordinate[0]).max() < 1e-8 * np.abs(r.modal_coordinate[0]).max()
        assert np.abs(r.position - r.position[0]).max() < 1e-10
    np.testing.assert_allclose(out["relative"].position[0], out["absolute"].position[0], atol=1e-12)


@pytest.mark.parametrize("name", ["flying", "loop"])
def test_ros2_by_modes_is_of_order_two(folder, name):
    """Without any matrix; the longest steps are past the bound of stability of RK4, ω h = 2.8."""
    record = MACHINES[name](folder)
    common = {"duration": 0.2, "output_interval": 0.05, "coordinates": "relative"}
    fine = reference_run(record, integrator="dop853", tolerance=1e-11, **common)
    highest = np.sqrt(fine.prepared.motion.system.record.flexible.stiffness.max())
    errors = []
    for step in (1e-3, 5e-4, 2.5e-4, 1.25e-4):
        r = run(record, integrator="ros2", step=step, **common)
        assert len(r.prepared.motion.system.record.residual.vdot) == 0
        errors.append(np.abs(r.position - fine.position).max())
    assert 1e-3 * highest > 2.8
    slopes = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.all(slopes[1:] > 1.7)
    assert errors[-1] < 1e-4


def test_ros2_goes_by_modes_only_without_other_stiffness(folder):
    """A spring is in the exact matrix, and then absolute coordinates are the ones that are chosen."""
    chain = MACHINES["chain"](folder)
    free = chain.replace(forces=tuple(each for each in chain.forces if each.type == "force"))
    for record, coordinates in ((chain, "absolute"), (free, "relative")):
        settings = SimulationSettings(integrator="ros2")
        assert choose_coordinates(record.replace(simulation=settings)) == coordinates
    common = {"integrator": "ros2", "coordinates": "relative", "step": 1e-4, "duration": 1e-3}
    assert len(run(chain, **common).prepared.motion.system.record.residual.vdot) > 0
    assert len(run(free, **common).prepared.motion.system.record.residual.vdot) == 0


@pytest.mark.parametrize("formulation", ["penalty", "augmented-lagrangian"])
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_penalties_hold_flexible_bodies(folder, formulation, coordinates):
    record = MACHINES["loop"](folder)
    common = {"integrator": "rk4", "step": 2e-5, "duration": 0.02, "output_interval": 0.01, "coordinates": coordinates}
    expected = reference_run(record, **common)
    r = run(record, formulation=formulation, **common)
    assert r.finished.outcome == "done"
    assert np.abs(r.position - expected.position).max() < 1e-6
    assert np.abs(r.constraint_violation).max() < 1e-6


@EACH
def test_neglected_invariants_cost_what_is_said_and_no_energy(folder, name):
    """Without I5 and I9 the equations still are those of an energy that is kept."""
    record = MACHINES[name](folder)
    less = record.replace(
        bodies=tuple(
            each.replace(flexible=each.flexible.replace(neglect=("I5", "I9"))) if each.flexible else each
            for each in record.bodies
        )
    )
    common = {"coordinates": "relative", "integrator": "rk4", "duration": 0.05, "output_interval": 0.01}
    whole = run(record, step=2e-5, **common)
    errors = []
    for step in (4e-5, 2e-5):
        r = run(less, step=step, **common)
        errors.append(np.abs(r.energy_error).max() / max(r.kinetic_energy.max(), 1e-3))
    assert errors[1] < max(errors[0] / 10.0, 1e-11)
    own = r.prepared.motion.system.record.flexible
    assert not own.terms[:, 0].any()
    # not nothing, and little
    assert 0.0 < np.abs(r.modal_coordinate - whole.modal_coordinate).max() < 1e-2 * np.abs(whole.modal_coordinate).max()


def test_neglect_is_told_by_the_trust_report(folder):
    """As a share of the mass matrix, which is that of the reference."""
    body = beam(folder, "a", (0, 0, 0), angular_velocity=(0.0, 1.0, 2.0), modes=3)
    record = machine("free", [body.replace(flexible=body.flexible.replace(neglect=("I5", "I9")))], [])
    record = record.replace(simulation=SimulationSettings(duration=0.1, step=1e-4, output_interval=0.01))
    result = simulate(plan_run(record))
    item = next(item for item in result.trust.items if item.name == "neglected")
    assert "without I5 and I9 the mass matrix of a lacks" in item.text
    its = read_body(folder / "beam.nc").keeping([0, 1, 2]).invariants
    none = replace(its, I5=0.0 * its.I5, I9=0.0 * its.I9)
    largest = 0.0
    for q in result.array("modal_coordinate"):
        lack = np.abs(reference.mass_matrix(its, np.eye(3), q) - reference.mass_matrix(none, np.eye(3), q))
        scale = np.abs(its.I7).max()
        largest = max(largest, lack[3:6, 3:6].max() / scale, lack[3:6, 6:].max() / np.sqrt(scale))
    assert item.fraction == pytest.approx(largest, rel=1e-9)


def test_static_equilibria_are_those_of_absolute_coordinates(folder):
    record = machine(
        "hung",
        [beam(folder, "a", (0, 0, 0), file="soft", modes=4), beam(folder, "b", (1, 0, 0), file="soft", modes=4)],
        [hinge("w", "ground", "a", 0.0, kind="fixed", axis=None), hinge("e", "a", "b", 1.0, kind="fixed", axis=None)],
    )
    found = []
    for coordinates in ("absolute", "relative"):
        prepared, equations = prepare_statics(record, StaticsSettings(duration=0.0, step=1.0, coordinates=coordinates))
        settled = settle(equations, equations.start(prepared.start), Iteration())
        equations.evaluate(settled.state)
        own = prepared.motion.system.record
        found.append((own.flexible.p.copy(), equations.record.bodies.R[:2].copy()))
    assert np.abs(found[0][0]).max() > 1e-3
    np.testing.assert_allclose(found[1][0], found[0][0], atol=1e-9)


def with_beam(folder, mass, **simulation):
    """A flexible body on a hinge that carries a beam by its tip."""
    section = {"type": "circle", "radius": 0.008}
    material = {"youngs_modulus": 210e9, "poisson_ratio": 0.3, "density": 7850}
    flexible = {"file": str(folder / "beam.nc"), "modes": 3, "damping_ratio": 0.01}
    rod = {"from": [1, 0, 0], "to": [2, 0, 0], "section": section, "material": material, "elements": 2, "mass": mass}
    return simulating.machine(
        {
            "name": "both",
            "gravity": [0, -9.81, 0],
            "bodies": {"a": {"flexible": flexible}},
            "beams": {"rod": rod},
            "joints": {
                "root": {"type": "revolute", "bodies": ["ground", "a"], "point": [0, 0, 0], "axis": [0, 0.6, 0.8]},
                "weld": {"type": "fixed", "bodies": ["a", "rod.start"], "point": [1, 0, 0]},
            },
            "simulation": simulation,
        }
    ).record


@pytest.mark.parametrize("mass", ["lumped", "consistent"])
def test_a_flexible_body_carries_a_beam(folder, mass):
    """Nodes of a beam are bodies of the tree, which modes of the flexible body move."""
    common = {"integrator": "generalised-alpha", "step": 2e-4, "duration": 0.02, "output_interval": 0.004}
    a, r = (run(with_beam(folder, mass, coordinates=each, **common)) for each in ("absolute", "relative"))
    assert r.finished.outcome == "done"
    np.testing.assert_allclose(r.position, a.position, atol=1e-6)
    here = moving(with_beam(folder, mass), np.random.default_rng(5))
    unknowns = Unknowns(here)
    units = here.motion.system.map.units[here.positions : here.positions + here.n]
    widths = unknowns.widths()
    widths[: here.n] *= np.where(np.array(units) == "kg^0.5 m/s", 0.5, 1.0)
    unknowns.widths = lambda: widths
    assert unknowns.error() < 1e-9


def test_force_that_becomes_infinite_is_named_beside_modes(folder):
    record = MACHINES["pendulum"](folder)
    push = PointForce(name="push", body="a", position=(0.5, 0, 0), vector=("sqrt(0.01 - time)", 0, 0))
    result = run(record.replace(forces=(push,)), integrator="rk4", step=5e-5, duration=0.02, coordinates="absolute")
    assert result.finished.outcome == "failed"
    assert "the force push is not a number at t = 0.01" in result.finished.failure[0]
