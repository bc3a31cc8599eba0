"""Relative coordinates of machines that have flexible bodies, beams of consistent mass and sliders at once: all is as in absolute ones."""

from importlib import import_module
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import gradient_beams
import simulating
from mixed_machines import mixed, sprung
from nivel.kernels.record.record import TANGENT
from observing import assert_same_frame, observed, of_absolute
from preparing import prepare
from test_rails import KINDS
from tree_machines import write_beams
from unknowns import Unknowns

pytestmark = pytest.mark.covering

TIME = 0.1


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_beams(tmp_path_factory.mktemp("mixed"))


def prepared_in(sections, coordinates):
    settings = {"integrator": "generalised-alpha", "stabilisation": "direct", **sections.get("simulation", {})}
    record = simulating.machine({**sections, "simulation": {**settings, "coordinates": coordinates}}).record
    return prepare(record, "newton-euler", coordinates)


def moving(sections, rng, size=1e-3):
    """A state in relative coordinates in motion, on its constraints, with accelerations and multipliers. size : of what moves it from the
    start, small enough that velocities count beside the strains of beams."""
    prepared = prepared_in(sections, "relative")
    motion, system, y = prepared.motion, prepared.motion.system, prepared.start.copy()
    positions, n = system.positions, len(system.record.residual.vdot)
    units = np.array(system.map.units)[: positions + n]
    scale = np.ones(positions + n)
    scale[np.char.startswith(units, "kg^0.5 m")] = np.tile(system.modal_sizes(), 2)
    y[: positions + n] += (
        scale * rng.uniform(-1, 1, positions + n) * np.where(np.arange(len(scale)) < positions, size, 1)
    )
    system.record.control.stabilise[2:] = 1e-14
    correct = import_module(prepared.path.correction).correct
    for _ in range(6):
        assert correct(motion.handle.address, TIME, y) == 0
    status, rate = motion.evaluate(TIME, y)
    assert status == 0
    constraints, left = system.record.constraints, system.record.saddle.row
    assert np.abs(constraints.C[left]).max(initial=0.0) < 1e-12
    assert np.abs(constraints.Cdot[left]).max(initial=0.0) < 1e-11
    return SimpleNamespace(
        motion=motion,
        y=y,
        size=system.size,
        positions=positions,
        n=n,
        states=0,
        rows=len(system.record.residual.row),
        vdot=rate[positions : positions + n].copy(),
        xdot=np.zeros(0),
        lam=constraints.lam[system.record.residual.row].copy(),
        modal=np.char.startswith(units[positions:], "kg^0.5 m"),
    )


def assert_as_in_absolute_coordinates(sections, here):
    """Of bodies, modes and frames at interfaces, reactions and energies: the frame as a whole."""
    seen = observed(here.motion, TIME, here.y)
    expected = observed(prepared_in(sections, "absolute").motion, TIME, of_absolute(seen, here.states))
    assert expected.status == 0
    assert_allclose(seen.pddot, expected.pddot, rtol=0, atol=1e-9 * np.abs(expected.pddot).max())
    assert_same_frame(here.motion.system.layout, seen.frame, expected.frame)


def error_of_matrix(here):
    unknowns = Unknowns(here)
    widths = unknowns.widths()
    widths[: here.n][here.modal] *= here.motion.system.modal_sizes()
    unknowns.widths = lambda: widths
    return unknowns.error()


def carried(here):
    """Owners of the rows that are left, and how many beams carry a body."""
    system = here.motion.system
    return {system.row_owner[row] for row in system.record.saddle.row}, len(system.record.tree.slider)


@pytest.mark.parametrize("closed", [False, True], ids=["tree", "loop"])
@pytest.mark.parametrize("kind", KINDS)
def test_accelerations_and_reactions_at_equal_states(folder, rng, kind, closed):
    sections = mixed(folder, kind, closed=closed)
    here = moving(sections, rng)
    assert carried(here) == ({"line"} if closed else set(), 1)
    assert_as_in_absolute_coordinates(sections, here)


@pytest.mark.parametrize("root", ["arm", "ground"])
@pytest.mark.parametrize(("kind", "mass"), [("keyed-on-beam", "consistent"), ("point-on-beam", "lumped")])
def test_matrix_is_the_derivative_of_the_residual(folder, rng, kind, mass, root):
    """Derivatives of elements are found by hand where no modes move their nodes."""
    here = moving(mixed(folder, kind, mass=mass, root=root, closed=True), rng)
    assert bool(here.motion.system.record.hooks.address[TANGENT]) == (root == "ground")
    assert error_of_matrix(here) < 1e-10


def test_a_slider_that_is_cut_stays_kept(folder, rng):
    sections = mixed(folder, "cylindrical-on-beam", cut=["pad"])
    here = moving(sections, rng)
    assert carried(here) == ({"pad"}, 0)
    assert_as_in_absolute_coordinates(sections, here)


@pytest.mark.parametrize("closed", [False, True], ids=["tree", "loop"])
def test_equilibria_are_the_same(folder, closed):
    sections = sprung(mixed(folder, closed=closed))
    kept, found = (simulating.machine(sections).statics(coordinates=each).dataset for each in ("absolute", "relative"))
    assert np.abs(kept["modal_coordinate"].values).max() > 1e-3
    for name in ("position", "modal_coordinate", "joint_coordinate", "joint_force", "joint_torque"):
        one, other = kept[name].values, found[name].values
        assert_allclose(other, one, rtol=0, atol=1e-10 * np.abs(one).max(), err_msg=name)


def test_a_run_from_equilibrium_stays_there(folder):
    sections = sprung(mixed(folder, closed=True, coordinates="relative", start="equilibrium"))
    result = simulating.simulate(sections, duration=0.02, step=1e-3, output_interval=5e-3)
    for name in ("position", "modal_coordinate"):
        values = result.array(name)
        assert np.abs(values - values[0]).max() < 1e-12 * np.abs(values[0]).max()


def undamped(folder):
    """On its way over a node of the beam."""
    sections = mixed(folder)
    sections["gravity"] = [20.0, -9.81, 0.5]
    for name in ("arm", "runner"):
        sections["bodies"][name]["flexible"]["damping_ratio"] = 0.0
    sections["forces"]["rope"]["damping"] = 0
    sections["bodies"]["runner"]["velocity"] = sections["bodies"]["block"]["velocity"] = [2.0, 0, 0]
    return sections


def test_motions_and_energies_differ_by_the_square_of_the_step(folder):
    """A quarter of the step leaves a sixteenth, or at least less than an eighth."""
    apart, errors = [], []
    for step in (4e-4, 1e-4):
        common = {"integrator": "newmark", "duration": 0.1, "step": step, "output_interval": 0.01}
        kept, found = (simulating.simulate(undamped(folder), coordinates=c, **common) for c in ("absolute", "relative"))
        assert np.ptp(found.array("joint_coordinate")[:, 1]) > 0.15
        apart.append(np.abs(found.array("position") - kept.array("position")).max())
        errors.append(np.abs(found.array("energy_error")).max() / found.array("kinetic_energy").max())
    assert apart[0] < 1e-3
    assert apart[1] < apart[0] / 8.0
    assert errors[0] < 1e-4
    assert errors[1] < errors[0] / 8.0


# --- beams whose nodes have gradients ---


@pytest.mark.parametrize("model", gradient_beams.MODELS)
def test_nodes_with_gradients_are_bodies_of_the_tree(model, rng):
    """A joint on a node is one on its frame, beside its origin too."""
    sections = {**gradient_beams.cantilever(model, None, 3, damping=0.01), "gravity": [1, 2, -3]}
    sections["beams"]["rod"]["section"] = gradient_beams.section(model, 100.0, 50.0, 8.0, 10.0)
    point, length = [0.1, 0.2, -0.3], gradient_beams.LENGTH
    sections["joints"]["wall"] = {"type": "spherical", "bodies": ["ground", "rod.start"], "point": point}
    sections["bodies"] = {"bob": simulating.solid(2.0, 0.05, position=[length, 0, 0])}
    hinge = {"type": "revolute", "bodies": ["rod.end", "bob"], "point": [length + 0.1, 0, 0], "axis": [0, 0.6, 0.8]}
    sections["joints"]["hinge"] = hinge
    here = moving(sections, rng, 0.02)
    assert carried(here) == (set(), 0)
    assert_as_in_absolute_coordinates(sections, here)
    assert error_of_matrix(here) < 1e-10
