"""Integrators that choose their steps keep what the tolerance promises: the motion within ten times of it, on machines with known motions.

Errors are measured as the tolerance is: lengths by the size of the machine, angles by a radian.
"""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import machines
import nivel
from lanes import tail
from nivel import Body, Joint, MachineRecord, Marker, PairForce, SimulationSettings
from nivel.api import Machine
from nivel.judge.after.checks.accuracy import error_from_finer
from references import andrews, four_bar, heavy_top, kepler, pendulum, slider_crank
from running import run
from test_mechanisms import EXAMPLES

pytestmark = pytest.mark.covering

INTEGRATORS = ["dopri5", "dop853", "adams", "gear"]
TOLERANCES = [1e-4, 1e-6, 1e-8, 1e-10]
MEETS = pytest.mark.parametrize("integrator", INTEGRATORS)
ASKED = pytest.mark.parametrize("tolerance", tail(TOLERANCES, [1e-4, 1e-8]))


def machine_size(result):
    return result.prepared.motion.system.size


@cache
def closing_angle():
    x, y, _ = run(machines.four_bar(), duration=1e-3).position[0, 0]
    return np.arctan2(y, x)


@MEETS
@ASKED
@pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
def test_slider_crank(integrator, tolerance, formulation):
    """2 s, through its first top dead centre, where 8 J decide whether it gets over: frames inside steps too."""
    settings = {"duration": 2.0, "output_interval": 0.013, "formulation": formulation}
    result = run(machines.slider_crank(), integrator=integrator, tolerance=tolerance, **settings)
    expected = slider_crank.solve(result.time)
    assert np.abs(result.position - expected.position).max() < 10 * tolerance * machine_size(result)
    assert np.abs(result.external_work - expected.work).max() < 10 * tolerance * result.kinetic_energy.max()
    assert np.abs(result.energy_error).max() < 10 * tolerance * result.kinetic_energy.max()
    assert np.abs(result.constraint_violation).max() < 1e-12


@MEETS
@ASKED
def test_four_bar(integrator, tolerance):
    result = run(machines.four_bar(), integrator=integrator, tolerance=tolerance, output_interval=0.05)
    expected = four_bar.solve(result.time, crank_angle=closing_angle())
    assert np.abs(result.position - expected.position).max() < 10 * tolerance * machine_size(result)


@cache
def top_rotation(times):
    return heavy_top.solve(np.array(times)).rotation


@MEETS
@ASKED
def test_heavy_top(integrator, tolerance):
    """48 turns at 150 rad/s."""
    settings = {"duration": 2.0, "output_interval": 0.1}
    result = run(machines.heavy_top(), integrator=integrator, tolerance=tolerance, **settings)
    found = Rotation.from_quat(result.orientation[:, 0], scalar_first=True).as_matrix()
    assert np.abs(found - top_rotation(tuple(result.time))).max() < 10 * tolerance


def swinging():
    """A pendulum released at the horizontal, for 10 s."""
    return MachineRecord(
        name="pendulum",
        gravity=(0, -9.81, 0),
        bodies=(Body(name="bob", mass=1, inertia=(0.01, 0.02, 0.02), position=(-1, 0, 0)),),
        joints=(Joint(name="pivot", type="revolute", bodies=("ground", "bob"), point=(0, 0, 0), axis=(0, 0, 1)),),
        simulation=SimulationSettings(duration=10.0, output_interval=0.05),
    )


@MEETS
@ASKED
def test_pendulum(integrator, tolerance):
    """10 s, closed form by elliptic functions."""
    result = run(swinging(), integrator=integrator, tolerance=tolerance)
    expected = pendulum.solve(result.time, pendulum.Pendulum(inertia=0.02))
    assert np.abs(result.position[:, 0] - expected.position).max() < 10 * tolerance
    assert np.abs(result.energy_error).max() < 20 * tolerance * result.kinetic_energy.max()


def test_iftomm_pendulum_meets_the_benchmark():
    """A01: 5e-5 J and 1e-5 m over 10 s; the ball's inertia of 1e-8 kg m² is what makes it a point."""
    from test_motion import pendulum as machine

    for integrator in INTEGRATORS:
        result = run(machine(), integrator=integrator, tolerance=1e-7, output_interval=0.05)
        expected = pendulum.solve(result.time, pendulum.IFTOMM_A01)
        assert np.abs(result.energy_error).max() < 5e-6
        assert np.abs(result.position[:, 0] - expected.position).max() < 1e-6


@cache
def squeezer():
    return nivel.load(EXAMPLES / "mechanisms" / "andrews-squeezer.yaml").record


def loop_angles(result):
    """q of the IVP test set (7,) at the end of the squeezer's run [rad]."""
    A = Rotation.from_quat(result.orientation.reshape(-1, 4), scalar_first=True).as_matrix()
    A = A.reshape(len(result.time), -1, 3, 3)
    names = list(result.prepared.motion.system.bodies)
    first = [names.index(f"K{k}") for k in range(1, 8)]
    k1, k2, k3, k4, k5, k6, k7 = np.unwrap(np.arctan2(A[:, first, 1, 0], A[:, first, 0, 0]), axis=0)[-1]
    return np.array([k1, k2 - k1, k3, k4 - k5, k5, k6 - k7, k7])


@cache
def squeezed():
    return andrews.solve(np.array([0.0, 0.03]), spring=True).q[-1]


@MEETS
@ASKED
def test_andrews_squeezer(integrator, tolerance):
    """30 ms, q of the IVP test set at the end (its own values have seven digits: the reference has more)."""
    result = run(squeezer(), integrator=integrator, tolerance=tolerance, step=1e-4, output_interval=1e-4)
    assert np.abs(loop_angles(result) - squeezed()).max() < 10 * tolerance


@MEETS
@ASKED
def test_kepler_orbit(integrator, tolerance):
    """Eccentricity 0.5, one period: steps follow the speed."""
    m1, m2, k = 1.5, 1.0, 3.0
    orbit = kepler.Orbit(strength=k, reduced_mass=m1 * m2 / (m1 + m2), semi_axis=1.4, eccentricity=0.5)

    def body(name, mass, share):
        place = {"position": (share * orbit.pericentre, 0, 0), "velocity": (0, share * orbit.speed_at_pericentre, 0)}
        return Body(name=name, mass=mass, inertia=(0.01,) * 3, **place)

    markers = (Marker(body="a"), Marker(body="b"))
    machine = MachineRecord(
        name="orbit",
        bodies=(body("a", m1, -m2 / (m1 + m2)), body("b", m2, m1 / (m1 + m2))),
        forces=(PairForce(name="pull", markers=markers, magnitude=f"-{k}/length^2"),),
        simulation=SimulationSettings(duration=orbit.period, output_interval=orbit.period / 40),
    )
    result = run(machine, integrator=integrator, tolerance=tolerance)
    apart = result.position[:, 1] - result.position[:, 0]
    assert np.abs(apart[:, :2] - orbit.position(result.time)).max() < 10 * tolerance * orbit.semi_axis


WAYS = {
    "relative": {"coordinates": "relative"},
    "independent": {"coordinates": "independent"},
    "euler-angles": {"formulation": "lagrange", "rotations": "euler-angles"},
    "rotation-vector": {"formulation": "lagrange", "rotations": "rotation-vector"},
    "penalty": {"formulation": "penalty"},
    "augmented-lagrangian": {"formulation": "augmented-lagrangian"},
}


@MEETS
@pytest.mark.parametrize("tolerance", [1e-5, 1e-8])
@pytest.mark.parametrize("way", WAYS)
def test_other_equations_of_motion(integrator, tolerance, way):
    """The slider-crank for 1 s, before a rotation vector comes to a full turn. Penalties of 1e8 are off by 1e-8 themselves."""
    if way == "penalty" and tolerance < 1e-6:
        tolerance = 1e-6
    settings = {"duration": 1.0, "output_interval": 0.05, "tolerance": tolerance, **WAYS[way]}
    result = run(machines.slider_crank(), integrator=integrator, **settings)
    expected = slider_crank.solve(result.time)
    assert np.abs(result.position - expected.position).max() < 10 * tolerance * machine_size(result)
    chunks = run(machines.slider_crank(), integrator=integrator, chunk_steps=3, **settings)
    assert np.array_equal(result.frames, chunks.frames)


@MEETS
@pytest.mark.parametrize("stabilisation", ["none", "direct", "geometric", "baumgarte"])
def test_all_stabilisations(integrator, stabilisation):
    """With none the constraints drift, by no more than the tolerance allows here."""
    own = {"baumgarte": {"alpha": 20, "beta": 20}} if stabilisation == "baumgarte" else {}
    settings = {"duration": 1.0, "output_interval": 0.1, "tolerance": 1e-7, "stabilisation": stabilisation}
    result = run(machines.slider_crank(), integrator=integrator, **settings, **own)
    expected = slider_crank.solve(result.time)
    assert np.abs(result.position - expected.position).max() < 10 * 1e-7 * machine_size(result)


def test_verification_estimates_the_error_from_a_tenth_of_the_tolerance():
    """The estimate is the true error within a factor two, and says what it compared."""
    settings = {"duration": 2.0, "integrator": "dopri5", "output_interval": 0.05}
    result = Machine.from_record(machines.slider_crank(tolerance=1e-5, **settings)).simulate(verify=True)
    exact = Machine.from_record(machines.slider_crank(tolerance=1e-11, **settings)).simulate()
    true = error_from_finer(result, exact, 0.0).value
    assert 0.5 * true < result.trust.accuracy_estimate < 2 * true
    assert "by a second run with a tolerance of 1e-06 and other, irregular steps" in str(result.trust)
