"""Elements of drive trains against closed forms: clutches, brakes, freewheels, shafts with play, losses of gears and screws, belts."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import force_zoo
from nivel.errors import ModelError
from simulating import G, hinge, machine, simulate, slide, solid, wheel
from unknowns import Unknowns, moving

pytestmark = pytest.mark.covering

EXPLICIT = {"integrator": "rk4", "step": "1 ms", "coordinates": "absolute"}
CHOSEN = {"integrator": "dopri5", "coordinates": "relative"}
IMPLICIT = {"integrator": "generalised-alpha", "step": "1 ms", "coordinates": "absolute"}
FIXED_COST = {"integrator": "ros2", "step": "0.25 ms", "coordinates": "relative"}
METHODS = pytest.mark.parametrize(
    "method", [EXPLICIT, CHOSEN, IMPLICIT, FIXED_COST], ids=["explicit", "chosen", "implicit", "fixed cost"]
)
SOLID = 1e-6  # of what is at rest


def shafts(forces, speeds=(0.0, 0.0), inertias=(0.02, 0.05), **sections):
    """Two wheels on the ground, `p` and `q`, with moments of inertia [kg m²] and speeds [rad/s]."""
    bodies = {
        name: wheel(inertia, position=[k, 0, 0], angular_velocity=[0, 0, speed])
        for k, (name, inertia, speed) in enumerate(zip("ab", inertias, speeds, strict=True))
    }
    joints = {"p": hinge("ground", "a"), "q": hinge("ground", "b", (1, 0, 0))}
    return {"gravity": [0, 0, 0], "bodies": bodies, "joints": joints, "forces": forces, **sections}


def rates(result):
    """(2, frames) speeds of both wheels."""
    return result.array("joint_rate").T


def balance(result):
    """Largest error of the energy balance."""
    return np.abs(result.array("energy_error")).max()


@METHODS
def test_clutch_engages_two_inertias(method):
    # slip s = ω₁ - 2 ω₂, of which ṡ = -T (1/J₁ + 4/J₂) = -T/J: it takes J s₀/T and loses J s₀²/2
    result = simulate(shafts({"c": {"type": "clutch", "coordinate": "p", "against": "q", "ratio": 2, "capacity": 2}}, (20.0, 0.0)),
                      **method, duration=0.4, output_interval="10 ms")  # fmt: skip
    J = 1 / (1 / 0.02 + 4 / 0.05)
    end = J * 20.0 / 2.0
    slip, loss = result.array("force.c.slip"), result.array("dissipated_energy")
    before = result.time < end - 2e-3
    assert slip[before] == pytest.approx(20.0 - 2.0 / J * result.time[before], abs=1e-6)
    assert np.abs(slip[result.time > end + 0.05]).max() < SOLID
    assert loss[-1] == pytest.approx(0.5 * J * 20.0**2, rel=1e-3)
    assert rates(result)[0, -1] == pytest.approx(20.0 - 2.0 / 0.02 * end, rel=1e-5)
    assert balance(result) < 1e-3 * loss[-1]


@METHODS
def test_brake_holds_to_its_capacity_and_no_further(method):
    # torque 4 t against 1 N m, statically 1.5 N m: it leaves at t = 0.375 s, and then ω̇ = (4 t - 1)/J
    forces = {"m": {"type": "motor", "coordinate": "p", "effort": "4*time"},
              "b": {"type": "brake", "coordinate": "p", "capacity": 1, "static_ratio": 1.5}}  # fmt: skip
    result = simulate(shafts(forces), **method, duration=0.5, output_interval="5 ms")
    angle, rate = result.array("joint_coordinate")[:, 0], rates(result)[0]
    still = result.time < 0.374
    assert np.abs(angle[still]).max() < 1e-7  # the torque grows: it gives way by a trace of its change
    assert result.array("force.b.magnitude")[still] == pytest.approx(-4.0 * result.time[still], abs=1e-5)
    t = result.time[-1]
    exact = (2.0 * (t**2 - 0.375**2) - (t - 0.375)) / 0.02
    assert rate[-1] == pytest.approx(exact, rel=0.02)


def test_capacity_below_zero_is_open():
    forces = {"b": {"type": "brake", "coordinate": "p", "capacity": "-3 N m + 0*time"}}
    result = simulate(shafts(forces, (7.0, 0.0)), duration=0.1, **EXPLICIT)
    assert rates(result)[0] == pytest.approx(7.0, abs=1e-12)
    assert result.array("force.b.capacity") == pytest.approx(0.0, abs=0.0)


@METHODS
@pytest.mark.parametrize("stiffness", [{}, {"stiffness": 4000}], ids=["rigid", "elastic"])
def test_freewheel_takes_along_and_lets_overrun(method, stiffness):
    # the motor turns both with ω = T t/(J₁ + J₂) up to 0.2 s, then it brakes its own shaft alone, while the other runs on
    forces = {"m": {"type": "motor", "coordinate": "p", "effort": {"times": [0, 0.2, 0.2000001, 9], "values": [3, 3, -3, -3]}},
              "f": {"type": "freewheel", "coordinate": "q", "against": "p", **stiffness}}  # fmt: skip
    result = simulate(shafts(forces), **method, duration=0.3, output_interval="5 ms")
    together, (driver, driven) = 3.0 * 0.2 / 0.07, rates(result)
    sway = 0.0 if not stiffness else 3.0 / (0.07 * math.sqrt(4000 * (1 / 0.02 + 1 / 0.05)))
    at = np.searchsorted(result.time, 0.195)
    assert driver[at] == pytest.approx(driven[at], abs=3.5 * sway + SOLID)
    assert driven[-1] == pytest.approx(together, abs=1.2 * sway + 0.04)
    assert driver[-1] == pytest.approx(together - 3.0 / 0.02 * 0.1, abs=2.6 * sway + 0.15)
    assert driven[-1] == pytest.approx(driven[at + 5], abs=1e-6 + 1.5 * sway)
    assert result.array("force.f.magnitude").min() > -1e-9
    assert result.array("force.f.magnitude")[-1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_freewheel_that_would_fall_behind_begins_by_an_impulse(coordinates):
    # J₁ ω₁ is kept: both begin with J₁ ω₁/(J₁ + J₂), and nothing slips
    forces = {"f": {"type": "freewheel", "coordinate": "q", "against": "p"}}
    result = simulate(shafts(forces, (7.0, 0.0)), **{**EXPLICIT, "coordinates": coordinates}, duration=0.05)
    assert rates(result) == pytest.approx(0.02 * 7.0 / 0.07, rel=1e-8)
    assert result.array("joint_coordinate")[-1] == pytest.approx(0.1, rel=1e-7)
    # what runs ahead, and what has a capacity, begins as it was given
    for speeds, more in (((0.0, 7.0), {}), ((7.0, 0.0), {"capacity": 1e3})):
        result = simulate(shafts({"f": {**forces["f"], **more}}, speeds), **EXPLICIT, duration=0.002)
        assert rates(result)[:, 0] == pytest.approx(speeds, abs=1e-12)


def test_freewheel_behind_a_driver_that_swings():
    """The shaft p is driven by 0.2 sin(10 t); q, braked by ω/2, is taken along while it would be slower alone, then runs on."""

    def driver(t):
        return 2.0 * np.cos(10.0 * t)

    end, at, angle = 3.0, 0.0, 0.0
    while at < end:
        left = (np.arctan(0.05) + 2.0 * np.pi * round(10.0 * at / (2.0 * np.pi))) / 10.0  # -20 sin 10 t = -cos 10 t
        angle += 0.2 * (np.sin(10.0 * min(left, end)) - np.sin(10.0 * at))
        if left > end:
            break
        times = np.linspace(left + 0.1, left + 0.7, 5000)
        first = int(np.argmax(driver(times) > driver(left) * np.exp(-0.5 * (times - left))))
        taken = brentq(
            lambda t, left=left: driver(left) * np.exp(-0.5 * (t - left)) - driver(t), *times[first - 1 : first + 1]
        )
        at = min(taken, end)
        angle += 2.0 * driver(left) * (1.0 - np.exp(-0.5 * (at - left)))
    forces = {"f": {"type": "freewheel", "coordinate": "q", "against": "p"},
              "drag": {"type": "joint-spring-damper", "coordinate": "q", "damping": 0.5}}  # fmt: skip
    sections = shafts(forces, inertias=(1.0, 1.0), drivers={"d": {"coordinate": "p", "value": "0.2*sin(10*time)"}})
    # the lag of each cycle goes with the square of the step
    for step, error in ((1e-3, 2e-4), (2.5e-4, 1.3e-5)):
        result = simulate(sections, integrator="rk4", step=step, duration=end, output_interval="10 ms")
        assert result.array("q.angle")[-1] == pytest.approx(angle, abs=error)


def test_backstop_never_goes_backwards():
    # thrown up against a torque, it stands where it has come to: t = J ω/T, φ = J ω²/(2 T)
    forces = {"w": {"type": "motor", "coordinate": "p", "effort": -2}, "f": {"type": "freewheel", "coordinate": "p"}}
    result = simulate(shafts(forces, (10.0, 0.0)), **IMPLICIT, duration=0.5)
    angle = result.array("joint_coordinate")[:, 0]
    assert angle[-1] == pytest.approx(0.02 * 100.0 / 4.0, rel=1e-3)
    assert np.ptp(angle[result.time > 0.2]) < 1e-6
    assert result.array("force.f.magnitude")[-1] == pytest.approx(2.0, rel=1e-9)


@METHODS
def test_torsional_vibration_of_a_shaft_with_a_ratio(method):
    # twist φ₁ - 3 φ₂: ω² = k (1/J₁ + 9/J₂), conserving energy
    forces = {"s": {"type": "shaft", "coordinate": "p", "against": "q", "ratio": 3, "stiffness": 30}}
    result = simulate(shafts(forces, (1.0, 0.0)), **method, duration=0.2, output_interval="2 ms")
    omega = math.sqrt(30 * (1 / 0.02 + 9 / 0.05))
    # a step of 1 ms turns the phase by 0.08; of second order its frequency errs by ω² h²/12
    far = 0.5 * 0.083**2 * omega * 0.2 / omega if method in (IMPLICIT, FIXED_COST) else 1e-5 / omega
    assert result.array("force.s.twist") == pytest.approx(np.sin(omega * result.time) / omega, abs=max(far, 1e-6))
    assert balance(result) < 0.01 * 0.01


@METHODS
def test_play_of_a_shaft(method):
    # free flight of b/v, then half a vibration on the flank: a period is twice both
    forces = {"s": {"type": "shaft", "coordinate": "p", "against": "q", "stiffness": 200, "backlash": 0.04}}
    result = simulate(shafts(forces, (2.0, 0.0)), **method, duration=0.2, output_interval="1 ms")
    half = 0.04 / 2.0 + math.pi / math.sqrt(200 * (1 / 0.02 + 1 / 0.05))
    twist = result.array("force.s.twist")
    turns = result.time[1:][np.diff(np.sign(twist)) != 0]
    # it begins in the middle of the play
    assert np.diff(turns) == pytest.approx(half, rel=0.06)
    assert len(turns) in (4, 5)
    assert np.abs(result.array("force.s.magnitude")[np.abs(twist) < 0.0199]).max() < 1e-12
    assert balance(result) < 0.01 * 0.5 * 0.02 * 4.0


def geared(torque, load, efficiency, inertia=1e-3, **more):
    """A worm, which turns 20 times while its wheel turns once, with a torque on each."""
    forces = {"m": {"type": "motor", "coordinate": "p", "effort": torque},
              "l": {"type": "motor", "coordinate": "q", "effort": load},
              "loss": {"type": "transmission-loss", "coupling": "g", "coordinate": "p", "efficiency": efficiency, **more}}  # fmt: skip
    couplings = {"g": {"type": "linear", "coordinates": ["p", "q"], "factors": [1, -20]}}
    return shafts(forces, (0.0, 0.0), (inertia, 2.0), couplings=couplings)


@METHODS
def test_efficiency_of_a_gear_that_drives(method):
    # J₁ α = T - s/η, J₂ α/20 = 20 s - L
    result = simulate(geared(2.0, -8.0, 0.7), **method, duration=0.1, output_interval="10 ms")
    alpha = (2.0 - 8.0 / 20 / 0.7) / (1e-3 + 2.0 / 400 / 0.7)
    transmitted = (2.0 * alpha / 20 + 8.0) / 20
    assert rates(result)[0, -1] == pytest.approx(alpha * 0.1, rel=1e-6)
    assert result.array("force.loss.transmitted")[-1] == pytest.approx(transmitted, rel=1e-6)
    assert result.array("force.loss.magnitude")[-1] == pytest.approx(-transmitted * (1 / 0.7 - 1), rel=1e-6)
    assert balance(result) < 1e-6 * np.abs(result.array("kinetic_energy")).max()


@METHODS
@pytest.mark.parametrize("backward", [None, 0.3])
def test_efficiency_of_a_gear_that_is_driven(method, backward):
    # J₁ α = s η', J₂ α/20 = L - 20 s, with η' = 2 - 1/η unless it is given
    more = {} if backward is None else {"backward_efficiency": backward}
    result = simulate(geared(0.0, 8.0, 0.7, **more), **method, duration=0.1, output_interval="10 ms")
    eta = 2 - 1 / 0.7 if backward is None else backward
    alpha = 8.0 / 20 / (1e-3 / eta + 2.0 / 400)
    assert rates(result)[0, -1] == pytest.approx(alpha * 0.1, rel=1e-6)


@METHODS
def test_worm_locks_itself_below_the_critical_efficiency(method):
    # η = 0.45 < 1/2: however large the load, the worm does not turn; driven down by hand it takes T = s (1/η - 2) > 0
    still = simulate(geared(0.0, 800.0, 0.45, 5e-3), **method, duration=0.1)
    assert np.abs(still.array("joint_coordinate")).max() < 1e-12
    result = simulate(geared(9.0, 800.0, 0.45, 5e-3), **method, duration=0.1)
    # the load pushes on: s = (L + …)/20 < 0 in the direction of the motion, friction is μ' |s| with μ' = 1/η - 1
    mu = 1 / 0.45 - 1
    # J₁ α = T + |s| - μ |s|, J₂ α/20 = L - 20 |s|
    alpha = (9.0 + (1 - mu) * 800.0 / 20) / (5e-3 + (1 - mu) * 2.0 / 400)
    assert alpha > 0.0
    assert rates(result)[0, -1] == pytest.approx(alpha * 0.1, rel=1e-6)


@METHODS
@pytest.mark.parametrize(("efficiency", "falls"), [(0.9, True), (0.45, False)])
def test_ball_screw_is_driven_back_by_a_weight(method, efficiency, falls):
    # m a = m g - F, J α = η' F p with the lead p: a = g/(1 + J/(m p² η')), p α = a
    lead, mass, inertia = 0.01 / (2 * math.pi), 20.0, 4e-4
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"nut": wheel(inertia) | {"mass": mass}},
        "joints": {"s": {"type": "screw", "bodies": ["ground", "nut"], "point": [0, 0, 0], "axis": [0, 0, 1], "pitch": 0.01}},
        "forces": {"loss": {"type": "transmission-loss", "coupling": "s", "coordinate": "s.angle", "efficiency": efficiency}},
    }  # fmt: skip
    result = simulate(sections, **method, duration=0.1, output_interval="10 ms")
    height = result.array("position")[:, 0, 2]
    if not falls:
        assert np.abs(height).max() < 1e-12
        return
    a = G / (1 + inertia / (mass * lead**2 * (2 - 1 / efficiency)))
    assert height == pytest.approx(-0.5 * a * result.time**2, rel=1e-3, abs=1e-9)


@METHODS
def test_belt_slips_as_euler_and_eytelwein_have_it(method):
    # the second pulley stands; the first slips with T₁ = T₂ exp(μ φ), T₁ + T₂ = 2 T₀
    forces = {"belt": {"type": "belt-drive", "coordinate": "p", "against": "q", "radii": [0.1, 0.2], "stiffness": 2e4, "damping": 40,
                       "pretension": 100, "friction": 0.3, "wrap": 2.5},
              "m": {"type": "motor", "coordinate": "p", "effort": {"times": [0, 0.2, 0.3, 0.31, 9], "values": [0, 5, 5, 12, 12]}},
              "hold": {"type": "brake", "coordinate": "q", "capacity": 1e4}}  # fmt: skip
    result = simulate(shafts(forces), **method, duration=0.5, output_interval="5 ms")
    first, second = result.array("force.belt.first_tension"), result.array("force.belt.second_tension")
    m = math.exp(0.3 * 2.5)
    pull = 200.0 * (m - 1) / (m + 1)
    holds = np.searchsorted(result.time, 0.295)
    assert (first - second)[holds] == pytest.approx(5.0 / 0.1, rel=0.02)  # it sticks below that
    assert abs(result.array("force.belt.slip")[holds]) < 1e-9
    assert first[-1] / second[-1] == pytest.approx(m, rel=1e-3)
    assert (first - second)[-1] == pytest.approx(pull, rel=1e-3)
    slipping = result.time > 0.45
    slope = np.polyfit(result.time[slipping], rates(result)[0, slipping], 1)[0]
    assert slope == pytest.approx((12.0 - 0.1 * pull) / 0.02, rel=1e-3)
    assert balance(result) < 5e-3 * result.array("dissipated_energy")[-1]


def test_chain_with_slack_pulls_one_strand():
    # each strand sags by 4 mm: the sprockets turn 4 mm on their rims before one pulls; then T = k (e - 4 mm), the other nothing
    forces = {"chain": {"type": "belt-drive", "coordinate": "p", "against": "q", "radii": [0.1, 0.1], "stiffness": 1e5, "slack": 0.004,
                        "damping": 900},
              "m": {"type": "motor", "coordinate": "p", "effort": 6},
              "hold": {"type": "brake", "coordinate": "q", "capacity": 1e4}}  # fmt: skip
    result = simulate(shafts(forces), **CHOSEN, duration=0.6)
    assert result.array("joint_coordinate")[-1, 0] * 0.1 == pytest.approx(0.004 + 60.0 / 1e5, rel=1e-4)
    assert result.array("force.chain.first_tension")[-1] == pytest.approx(60.0, rel=1e-3)
    assert result.array("force.chain.second_tension") == pytest.approx(0.0, abs=0.0)


def slipped(time, force, stiffness, damping, end, inertia, step=2e-5):
    """Slip of a belt between a free rim and one that stands, by the return mapping in small steps."""
    way, rate, slip, out, t = 0.0, 0.0, 0.0, [], 0.0
    for wanted in time:
        while t < wanted - 0.5 * step:
            strain = way - slip
            pull = min(max(stiffness * strain + damping * rate, -end), end)
            rate += step * (force(t + 0.5 * step) - 2.0 * pull) / inertia
            way += step * rate
            slip = way - min(max(way - slip, -end / stiffness), end / stiffness)
            t += step
        out.append(slip)
    return np.array(out)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6])
def test_steps_end_where_a_belt_begins_and_ceases_to_slip(tolerance):
    """A belt that is drawn to and fro slips at each turn, by the same with any tolerance."""
    belt = {"type": "belt-drive", "coordinate": "p", "against": "q", "radii": [0.1, 0.2], "stiffness": 2e4, "damping": 4,
            "pretension": 100, "friction": 0.3, "wrap": 2.5}  # fmt: skip
    forces = {"belt": belt, "m": {"type": "motor", "coordinate": "p", "effort": "12*sin(20*time)"}}
    result = simulate(
        shafts(forces, inertias=(0.02, 1e9)),
        integrator="dopri5",
        tolerance=tolerance,
        duration=0.8,
        output_interval=0.05,
    )
    m = math.exp(0.3 * 2.5)
    wanted = slipped(
        result.time, lambda t: 12.0 * math.sin(20.0 * t) / 0.1, 2e4, 4.0, 100.0 * (m - 1) / (m + 1), 0.02 / 0.1**2
    )
    assert np.ptp(wanted) > 0.03
    np.testing.assert_allclose(result.array("force.belt.slip"), wanted, atol=5e-3 * np.ptp(wanted))


HELD = {
    "clutch": {"type": "clutch", "coordinate": "p", "against": "q", "ratio": 0.6,
               "capacity": "2 + sin(s.displacement) + base.vx*s.displacement_rate", "static_ratio": 1.3, "stribeck_rate": 0.5},
    "brake": {"type": "brake", "coordinate": "s", "capacity": "3 + 0.2*p.angle"},
    "freewheel": {"type": "freewheel", "coordinate": "p", "against": "q"},
    "loss": {"type": "transmission-loss", "coupling": "g", "coordinate": "p", "efficiency": 0.6},
}  # fmt: skip


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("element", HELD)
def test_matrix_is_the_derivative_of_the_residual(element, coordinates, rng):
    """Rows and columns of efforts, sliding and sticking; tolerance as in `test_residual_and_tangent`."""
    couplings = {"g": {"type": "linear", "coordinates": ["p", "s"], "factors": [1, -0.3]}}
    record = force_zoo.two_shafts({"forces": {"f": HELD[element]}, "couplings": couplings})
    branches = set()
    for here in moving(record, coordinates, rng, 6):
        residual = here.motion.system.record.residual
        for share in (0.05, 1.0, 40.0):
            here.lam[here.rows :] *= share
            assert Unknowns(here, rng.uniform(-0.5, 0.5, here.n)).error(3) < 5e-11
            branches |= set(np.sign(residual.branch).tolist())
    assert len(branches) > 1


@pytest.mark.parametrize("kind", ["shaft", "chain"])
def test_without_an_integrator_play_is_known_before_it_is_used_up(kind):
    """The flank of a stiff shaft, or the strand of a chain, is apart at the start; its rate is that of k (1/J₁ + 1/J₂)."""
    ends = {"coordinate": "p", "against": "q"}
    forces = {
        "shaft": {"type": "shaft", **ends, "stiffness": 1e6, "damping": 30, "backlash": 0.01},
        "chain": {"type": "belt-drive", **ends, "radii": [0.1, 0.1], "stiffness": 1e7, "damping": 3e3, "slack": 5e-4},
    }
    result = simulate(shafts({"it": forces[kind]}, (2.0, 0.0)), duration=0.1, tolerance=1e-8)
    assert result.settings["integrator"] == "dopri5"
    assert balance(result) < 1e-3 * 0.5 * 0.02 * 4.0
    # angular momentum stays, and the blow is soon over
    assert 0.02 * rates(result)[0] + 0.05 * rates(result)[1] == pytest.approx(0.04, rel=1e-6)


def test_equilibrium_of_a_shaft_with_play():
    # the torque of 2 N m goes through both springs, and the flank is half of the play away
    forces = {
        "s": {"type": "shaft", "coordinate": "p", "against": "q", "stiffness": 100, "backlash": 0.01},
        "spring": {"type": "joint-spring-damper", "coordinate": "q", "stiffness": 10},
        "twist": {"type": "motor", "coordinate": "p", "effort": 2},
    }
    found = machine(shafts(forces)).statics().array("joint_coordinate")[-1]
    assert found == pytest.approx([0.2 + 0.02 + 0.005, 0.2], rel=1e-9)


@pytest.mark.parametrize("analysis", ["statics", "linearise"])
def test_what_holds_has_no_equilibrium_and_no_derivative(analysis):
    held = machine(shafts({"c": {"type": "clutch", "coordinate": "p", "against": "q", "capacity": 3}}))
    with pytest.raises(ModelError, match=r"forces\.c: a clutch (holds at rest|has no derivative)"):
        getattr(held, analysis)()


def test_a_second_loss_of_a_coupling_is_refused():
    loss = {"type": "transmission-loss", "coupling": "g", "coordinate": "p", "efficiency": 0.9}
    gear = {"g": {"type": "gear", "joints": ["p", "q"], "ratio": 3}}
    with pytest.raises(ModelError, match=r"`one` is the loss of `g` already.*`efficiency: 0\.72`"):
        simulate(shafts({"one": loss, "two": {**loss, "efficiency": 0.8}}, couplings=gear), duration=0.01)


@pytest.mark.parametrize(
    ("force", "said"),
    [
        ({"type": "clutch", "coordinate": "p", "against": "p", "capacity": 3}, "is the `coordinate` itself"),
        ({"type": "clutch", "coordinate": "p", "against": "r", "capacity": 3}, "there is no joint `r`"),
        ({"type": "clutch", "coordinate": "p", "against": "q", "capacity": 3, "ratio": 0}, "`ratio` is zero"),
        ({"type": "brake", "coordinate": "p", "capacity": 3, "static_ratio": 0.5}, "smaller than one"),
        ({"type": "brake", "coordinate": "p", "capacity": -3}, "so it never holds"),
        ({"type": "one-way-clutch", "coordinate": "p", "against": "q"}, "did you mean `freewheel`"),
        ({"type": "clutch", "coordinate": "p", "against": "q", "torque": 3}, "did you mean `capacity`"),
        ({"type": "belt-drive", "coordinate": "p", "against": "q", "radii": [1, 1], "stiffness": 1, "wrap": 3}, "belongs to a `friction`"),
        ({"type": "belt-drive", "coordinate": "p", "against": "q", "radii": [1, 1], "stiffness": 1, "pretension": 1, "friction": 1,
          "wrap": 180}, "`180 deg`"),
        ({"type": "freewheel", "coordinate": "p", "damping": 1}, "belongs to a `stiffness`"),
        ({"type": "transmission-loss", "coupling": "x", "coordinate": "p", "efficiency": 0.9}, "no coupling or screw joint `x`"),
        ({"type": "belt-drive", "coordinate": "p", "against": "q", "radii": [1, 1], "stiffness": 1, "friction": 0.3},
         "`pretension` is missing"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_where_it_stands(force, said):
    with pytest.raises(ModelError, match=said):
        simulate(shafts({"f": force}), duration=0.01)


def test_a_belt_to_a_slide_is_refused_where_it_stands():
    """It ended in a traceback."""
    sections = {
        "bodies": {"a": wheel(1.0), "b": wheel(1.0)},
        "joints": {"p": hinge("ground", "a"), "s": slide("ground", "b")},
        "forces": {"f": {"type": "belt-drive", "coordinate": "p", "against": "s", "radii": [1, 1], "stiffness": 1}},
    }
    with pytest.raises(ModelError, match=r"forces\.f\.against: `s\.displacement` is a length; an angle was expected"):
        machine(sections)


@pytest.mark.parametrize(
    "method", [{"step": 1e-4}, {"integrator": "dopri5", "tolerance": 1e-9}, {"integrator": "radau", "tolerance": 1e-8}]
)
def test_a_chain_pulls_when_its_slack_is_gone_and_not_before(method):
    """J₁ ω̇₁ = -r₁ F, J₂ ω̇₂ = r₂ F, F = max(0, k (e - s) + d ė) for e = r₁ φ₁ - r₂ φ₂ > s, and against it at e < -s. The damper pulled
    before. A fixed step is late by itself at most: d ė r₁/J₁ h."""
    k, d, slack, r1, r2 = 2e4, 60.0, 2e-3, 0.1, 0.2

    def pull(e, speed):
        return max(0.0, k * (e - slack) + d * speed) if e > slack else 0.0

    def motion(_, y):
        e, speed = r1 * y[0] - r2 * y[1], r1 * y[2] - r2 * y[3]
        force = pull(e, speed) - pull(-e, -speed)
        return [y[2], y[3], -r1 * force / 0.02, r2 * force / 0.05]

    chain = {"type": "belt-drive", "coordinate": "p", "against": "q", "radii": [r1, r2], "stiffness": k, "damping": d}
    result = simulate(
        shafts({"c": {**chain, "slack": slack}}, (3.0, 0.0)), duration=0.2, output_interval=1e-3, **method
    )
    found = solve_ivp(motion, (0, 0.2), [0, 0, 3, 0], t_eval=result.time, rtol=1e-10, atol=1e-12, max_step=1e-4)
    e, tension = r1 * found.y[0] - r2 * found.y[1], result.array("force.c.first_tension")
    assert np.ptp(e) > 2.0 * slack
    assert tension[e < slack - 1e-6].max() == 0.0
    np.testing.assert_allclose(
        rates(result), found.y[2:], atol=d * 0.3 * r1 / 0.02 * 1e-4 if "step" in method else 1e-5
    )


def test_a_screw_that_locks_itself_is_green():
    """What the method takes from a screw at rest is less than what counts there; 1e-15 J were amber."""
    sections = {
        "gravity": [0, 0, -G],
        "bodies": {"nut": solid(20.0, (0.01, 0.01, 0.003))},
        "joints": {
            "s": {"type": "screw", "bodies": ["ground", "nut"], "point": [0, 0, 0], "axis": [0, 0, 1], "pitch": 0.01}
        },
        "forces": {"loss": {"type": "transmission-loss", "coupling": "s", "coordinate": "s.angle", "efficiency": 0.45}},
        "simulation": {"duration": 1.0, "integrator": "radau"},
    }
    result = machine(sections).simulate(verify=True)
    assert np.abs(result.array("joint_coordinate")).max() < 1e-9
    assert result.trust.verdict == "green", str(result.trust)
