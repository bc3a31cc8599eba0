"""True sticking with implicit methods: closed forms of blocks that stay, stop and break away, and the same motion as explicit methods."""

import numpy as np
import pytest
from scipy.optimize import brentq

import linked
import machines
import nivel
from nivel import Friction, Torque
from nivel.errors import ModelError
from references import stick_slip
from running import reference_run, run
from simulating import G, simulate, slide, solid
from test_friction import DRAWN, MASS, MU, PAIR, THICK, drawn, rubbing_pendulum, sled, two_sliders
from unknowns import Unknowns, moving

pytestmark = pytest.mark.covering

# each method and all coordinates by default
ALPHA = [("generalised-alpha", "independent"), ("newmark", "absolute"), ("hht", "relative")]
ALPHA += [pytest.param("generalised-alpha", each, marks=pytest.mark.full) for each in ("absolute", "relative")]
CHOSEN = [("radau", "relative"), ("bdf", "relative")]
FIXED = pytest.mark.parametrize(("integrator", "coordinates"), [*ALPHA, ("ros2", "relative")])
METHODS = pytest.mark.parametrize(("integrator", "coordinates"), [*ALPHA, ("ros2", "relative"), *CHOSEN])
SECOND_ORDER = pytest.mark.parametrize(("integrator", "coordinates"), ALPHA)


def on_incline(degrees):
    slope = np.radians(degrees)
    return G * np.sin(slope), -G * np.cos(slope), 0


def pulled(force, friction=None, **more):
    pull = {"pull": {"type": "force", "body": "block", "vector": [force, 0, 0]}}
    return sled({"model": "stiction", **(friction or {})}, forces=pull, **more)


# --- one block ---
@METHODS
def test_block_stays_below_the_static_angle(integrator, coordinates):
    """tan 16° < μ: in 10 s it has not moved, and friction is what holds it."""
    sections = sled({"model": "stiction"}, gravity=on_incline(16))
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 1e-3, "output_interval": 0.1}
    r = simulate(sections, duration=10.0, **settings)
    assert np.abs(r.array("rail.displacement")).max() < 1e-12
    assert np.abs(r.array("rail.displacement.rate")).max() < 1e-12
    np.testing.assert_allclose(r.array("force.rub.magnitude")[1:], -MASS * on_incline(16)[0], rtol=1e-9)


@METHODS
def test_block_slides_above_the_static_angle(integrator, coordinates):
    """a = g (sin α - μ cos α), constant, so every method has it to round-off, but radau and bdf, which end within a step of the start
    before they see it: to the tolerance 1e-6 of their speeds."""
    across, down, _ = on_incline(40)
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 1e-3}
    r = simulate(sled({"model": "stiction"}, gravity=(across, down, 0)), duration=1.5, **settings)
    tolerance = 1e-5 if integrator in ("radau", "bdf") else 1e-10
    np.testing.assert_allclose(r.array("rail.displacement.rate"), (across + MU * down) * r.time, atol=tolerance)


@METHODS
def test_block_brakes_and_stays(integrator, coordinates):
    """v = v0 - μ g t until v = μ g τ, from where it dies out as exp(-t/τ), τ = 2 h: it stops at v0²/(2 μ g) and μ g τ²/2 further."""
    for step in (1e-3, 5e-4):
        settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 1e-3}
        r = simulate(sled({"model": "stiction"}, 1.2), duration=1.0, **settings)
        before = r.time < 1.2 / (MU * G) - 2 * step
        rate = r.array("rail.displacement.rate")
        np.testing.assert_allclose(rate[before], 1.2 - MU * G * r.time[before], atol=1e-9)
        assert abs(r.array("rail.displacement")[-1] - 1.44 / (2 * MU * G)) < 2.5 * MU * G * step**2
        assert abs(rate[-1]) < (1e-7 if integrator in ("radau", "bdf") else 1e-12)
        # all of the motion is heat; the last step in which it slides misses at most μ g h of speed, as an energy
        np.testing.assert_allclose(
            r.array("dissipated_energy")[-1], 0.5 * MASS * 1.44, rtol=0, atol=MASS * (MU * G * step) ** 2
        )


@FIXED
def test_block_is_held_for_seconds_and_breaks_away(integrator, coordinates):
    """μ_s > μ_d, P = 2 t: it holds until P = μ_s N, then m v = (t - t0)² + (μ_s - μ_d) N (t - t0). t0 is known to a step."""
    static, kinetic, step = 0.4, 0.25, 1e-3
    friction = {"coefficient": kinetic, "static_coefficient": static, "stribeck_speed": 1e-5}
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step}
    r = simulate(pulled("2*time", friction), duration=3.5, **settings)
    load = MASS * G
    t0, drop = static * load / 2, (static - kinetic) * load
    before, after = r.time < t0 - 2 * step, r.time > t0 + 2 * step
    # what ε leaves of acceleration while the effort changes by P' h, for τ
    assert np.abs(r.array("rail.displacement.rate")[before]).max() < 1.1e-4 * 2 * step / MASS * 2 * step
    late = r.time[after] - t0
    np.testing.assert_allclose(
        r.array("rail.displacement.rate")[after], (late**2 + drop * late) / MASS, atol=2 * drop * step / MASS
    )
    np.testing.assert_allclose(r.array("force.rub.magnitude")[before], -2 * r.time[before], atol=1e-3)


@FIXED
def test_changing_load_below_the_static_limit_is_held_without_creep(integrator, coordinates):
    """0.95 μ N to and fro. ε of what the effort changes by in a step is left as acceleration, for τ: the place follows the load by
    1e-4 h τ F/m at most, and nothing adds up."""
    force, step = 0.95 * MU * MASS * G, 1e-3
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.1}
    r = simulate(pulled(f"{force}*sin(2*pi*time)"), duration=10.0, **settings)
    way = r.array("rail.displacement")
    assert np.abs(way).max() < 1.2e-4 * step * 2 * step * force / MASS
    assert np.abs(way[::10]).max() < 1e-13 * len(way)  # after every whole period


# --- stick-slip ---
SHARP = stick_slip.Drawn(**{**DRAWN.__dict__, "stribeck": 0.0})


def slipping(stribeck):
    return {"model": "stiction", "coefficient": 0.25, "static_coefficient": 0.4, "stribeck_speed": stribeck}


@SECOND_ORDER
def test_stick_slip_with_stribecks_curve_is_of_order_two(integrator, coordinates):
    """Several cycles on a driven spring against the piecewise solution with an event at every rest."""
    steps, errors, energies = [1e-3, 5e-4, 2.5e-4], [], []
    for step in steps:
        settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.01}
        r = simulate(drawn(slipping(DRAWN.stribeck), DRAWN.speed, DRAWN.stiffness), duration=2.0, **settings)
        way, rests = DRAWN.integrated(r.time)
        assert len(rests) >= 4
        errors.append(np.abs(r.array("rail.displacement") - way).max())
        energies.append(np.abs(r.array("energy_error")).max())
    assert errors[-1] < 1e-5  # one cycle moves it by 2 cm
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] > 1.8, errors
    assert energies[-1] < 1e-5 * DRAWN.static * DRAWN.load * 0.06, energies  # of the heat of 6 cm of way
    assert np.polyfit(np.log(steps), np.log(energies), 1)[0] > 1.5, energies


@pytest.mark.parametrize(("step", "tolerance"), [(2e-3, 2e-4), (1e-3, 1e-4), (1e-4, 1e-4)])
@SECOND_ORDER
def test_stick_slip_in_closed_form(integrator, coordinates, step, tolerance):
    """Stribeck's speed of 1e-5 m/s is none for the block, and far below what a step changes its speed by; 0 is none."""
    settings = {"integrator": integrator, "coordinates": coordinates, "step": step, "output_interval": 0.01}
    r = simulate(drawn(slipping(0 if step == 1e-3 else 1e-5), SHARP.speed, SHARP.stiffness), duration=1.0, **settings)
    assert SHARP.first_slip + 2 * SHARP.slip_duration + SHARP.stick_duration < 1.0
    np.testing.assert_allclose(r.array("rail.displacement"), SHARP.closed_form(r.time), atol=tolerance)


@pytest.mark.parametrize("integrator", ["radau", "bdf", "ros2", "generalised-alpha"])
def test_stick_slip_with_chosen_steps(integrator):
    control = {"step_control": "error"} if integrator == "generalised-alpha" else {}
    control |= {} if integrator == "ros2" else {"tolerance": 1e-6}
    settings = {"integrator": integrator, "coordinates": "relative", "step": 2.5e-4, "output_interval": 0.01, **control}
    r = simulate(drawn(slipping(DRAWN.stribeck), DRAWN.speed, DRAWN.stiffness), duration=2.0, **settings)
    np.testing.assert_allclose(r.array("rail.displacement"), DRAWN.integrated(r.time)[0], atol=1e-4)


# --- several frictions, loads by reactions ---
@METHODS
def test_two_frictions_hold_one_motion_together(integrator, coordinates):
    """Loads of 20 and 40 N: the block holds until P = μ (20 + 40) N, then m v = (t - t0)²/2 dP/dt."""
    sections = pulled("10*time", {"normal_load": 20.0})
    sections["forces"]["second"] = {**sections["forces"]["rub"], "normal_load": 40.0}
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 1e-3, "tolerance": 1e-8}
    if integrator not in ("radau", "bdf"):
        del settings["tolerance"]
    r = simulate(sections, duration=3.0, **settings)
    t0 = MU * 60 / 10
    before, after = r.time < t0 - 5e-3, r.time > t0 + 5e-3
    # ε 10 N/s h τ/m for the time until it breaks away, and more where steps are chosen
    assert np.abs(r.array("rail.displacement")[before]).max() < (1e-6 if integrator in ("radau", "bdf") else 1e-8)
    np.testing.assert_allclose(
        r.array("rail.displacement.rate")[after], 5 * (r.time[after] - t0) ** 2 / MASS, atol=1e-4
    )
    efforts = r.array("force.rub.magnitude") + r.array("force.second.magnitude")
    np.testing.assert_allclose(efforts[before], -10 * r.time[before], atol=0.02)
    assert np.all(np.abs(r.array("force.rub.magnitude")) <= MU * 20 * (1 + 1e-9))


@pytest.mark.parametrize(("beyond", "moves"), [(-0.05, False), (0.1, True)])
@SECOND_ORDER
def test_self_locking_is_where_the_tangent_is_the_coefficient(integrator, coordinates, beyond, moves):
    """Pushed by a force that grows to 200 weights: below tan θ = μ no force lifts B, above it one does. Two frictions, each loaded by
    what the other one makes, hold one motion."""
    sections = two_sliders(np.arctan(PAIR.coefficient) + beyond, "-2000*time", {"model": "stiction"})
    settings = {"integrator": integrator, "coordinates": coordinates, "step": 5e-4}
    r = simulate(sections, duration=0.2 if moves else 1.0, **settings)
    height = r.array("b.position.y")
    rise = height[-1] - height.min()
    assert rise > 0.01 if moves else rise < 1e-7


@METHODS
def test_short_guide_jams_where_its_length_is_twice_the_lever_times_the_coefficient(integrator, coordinates):
    """v̇ = (P - μ 2 P h/l)/m; with 2 μ h ≥ l no force moves the drawer, whatever it is."""
    push, lever, span = 10.0, 0.2, 0.5

    def run(length):
        force = {"push": {"type": "force", "body": "block", "position": [0, lever, 0], "vector": [push, 0, 0]}}
        sections = sled({"model": "stiction", "bearing_length": length}, forces=force, gravity=(0, 0, 0))
        return simulate(sections, duration=0.5, step=1e-3, integrator=integrator, coordinates=coordinates)

    free = run(span)
    acceleration = (push - MU * 2 * push * lever / span) / MASS
    np.testing.assert_allclose(free.array("rail.displacement.rate"), acceleration * free.time, atol=1e-8)
    assert np.abs(run(2 * MU * lever * 0.95).array("rail.displacement")).max() < 1e-12


@SECOND_ORDER
def test_block_and_plank_come_to_one_speed(integrator, coordinates):
    """A block thrown onto a plank that slides freely: both end at m1 v0/(m1 + m2), and what is lost is heat."""
    m1, m2, mu, v0, step = 1.0, 3.0, 0.25, 2.0, 1e-3
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"block": solid(m1, 0.01, velocity=[v0, 0, 0]), "plank": solid(m2, 0.1)},
        "joints": {"ice": slide("ground", "plank"), "top": slide("plank", "block")},
        "forces": {"rub": {"type": "friction", "coordinate": "top", "coefficient": mu, "model": "stiction"}},
    }
    r = simulate(sections, duration=1.0, step=step, integrator=integrator, coordinates=coordinates)
    together = m1 * v0 / (m1 + m2)
    np.testing.assert_allclose([r.array("block.velocity.x")[-1], r.array("plank.velocity.x")[-1]], together, atol=1e-12)
    reduced = m1 * m2 / (m1 + m2)
    loss = 0.5 * reduced * v0**2
    deceleration = mu * G * (1 + m1 / m2)
    assert abs(r.array("dissipated_energy")[-1] - loss) < reduced * (deceleration * step) ** 2


def test_block_keeps_its_speed_where_that_of_its_carriage_jumps():
    """A table of straight lines makes the carriage jump from 0 to 1 m/s: friction of a given load is a force and no impulse. The block on
    it starts to move then, v̇ = μ N/m, until both are one."""
    load, step, jump = 12.0, 1e-3, 0.1
    sections = {
        "bodies": {"carriage": solid(2.0, 0.1), "block": solid(MASS, 0.01)},
        "joints": {"track": slide("ground", "carriage"), "top": slide("carriage", "block")},
        "drivers": {
            "winch": {
                "coordinate": "track",
                "value": {"times": [0, jump, 1.0], "values": [0, 0, 1.0 - jump], "interpolation": "linear"},
            }
        },
        "forces": {
            "rub": {
                "type": "friction",
                "coordinate": "top",
                "coefficient": MU,
                "model": "stiction",
                "normal_load": load,
            }
        },
    }
    r = simulate(sections, duration=0.9, step=step, integrator="generalised-alpha", coordinates="absolute")
    expected = np.clip(MU * load / MASS * (r.time - jump), 0.0, 1.0)
    bend = jump + MASS / (MU * load)
    bends = (r.time > bend - 2 * step) & (r.time < bend + 60 * step)
    np.testing.assert_allclose(r.array("block.velocity.x")[~bends], expected[~bends], atol=1e-9)


# --- the motion of explicit methods ---
@SECOND_ORDER
def test_pendulum_on_a_thick_pin_comes_to_rest_aside_without_ringing(integrator, coordinates):
    """The load depends on the acceleration, which jumps at reversals. Order one at least, as of explicit methods; once it sticks, every
    step leaves 0.6 of what the reaction and the effort still change by, as τ of two steps asks for, and its sign."""
    times = np.linspace(0, 6, 121)
    expected, turns = THICK.dry(times, 1.2)
    assert len(turns) > 4
    steps, errors = [2e-3, 1e-3, 5e-4], []
    for step in steps:
        settings = {"integrator": integrator, "coordinates": coordinates, "step": step}
        r = simulate(rubbing_pendulum({"model": "stiction", "radius": THICK.radius}, 1.2), duration=6.0, **settings)
        errors.append(np.abs(np.interp(times, r.time, r.array("pin.angle")) - expected).max())
        rests = np.flatnonzero(np.abs(r.array("pin.angle.rate")) > 1e-3)[-1] + 1
        for history in (r.array("pin.force")[:, 1], r.array("force.rub.magnitude"), r.array("pin.angle.rate")):
            left, round_off = history[rests:] - history[-1], 1e-8 * np.abs(history).max()
            bound = 0.65 ** np.arange(len(left)) * np.abs(left[0])
            assert np.all(np.abs(left) <= bound + round_off)
            assert np.all(left * np.sign(left[0]) >= -round_off)
    assert errors[-1] < 2e-3
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] > 0.9, errors


def rubbing_crank(**settings):
    """The spatial slider-crank of report 44 with dry friction, loaded by the reactions, at its hinge and its slide: a closed loop. Driven
    from rest, its crank rests and turns back several times."""
    pin = Friction(
        name="pin",
        coordinate="hinge.angle",
        model="stiction",
        radius=0.02,
        coefficient=0.3,
        static_coefficient=0.35,
        stribeck_speed=0.02,
    )
    way = Friction(name="way", coordinate="slide.displacement", model="stiction", coefficient=0.15)
    record = machines.slider_crank()
    simulation = record.simulation.replace(duration=3.0, output_interval=0.02, **settings)
    drive = Torque(name="drive", body="crank", vector=(-50.0, 0.0, 0.0))
    return nivel.Machine.from_record(record.replace(forces=(drive, pin, way), simulation=simulation)).simulate()


@SECOND_ORDER
def test_friction_in_a_closed_loop_moves_it_as_explicit_methods_do(integrator, coordinates):
    """dopri5 with chosen steps and the same τ has the same law, so fixed steps differ from it by their own error: of order two in the
    balance of energy; in the motion of order one at least, as the crank turns back somewhere within a step."""
    steps, errors, energies = [2e-3, 1e-3, 5e-4], [], []
    for step in steps:
        exact = rubbing_crank(
            integrator="dopri5", step=10 * step, tolerance=1e-8
        )  # τ is two steps at 1e-6 and goes as its root
        r = rubbing_crank(integrator=integrator, coordinates=coordinates, step=step)
        errors.append(np.abs(r.array("hinge.angle") - exact.array("hinge.angle")).max())
        energies.append(np.abs(r.array("energy_error")).max())
    assert np.all(np.array(errors) < 0.3 * np.array(steps)), errors
    assert np.polyfit(np.log(steps), np.log(energies), 1)[0] > 1.5, energies


@pytest.mark.parametrize(("integrator", "coordinates"), [*CHOSEN, ("radau", "absolute")])
def test_methods_of_the_rates_agree_with_explicit_ones_in_a_closed_loop(integrator, coordinates):
    """The same law and the same τ with chosen steps: τ is 10 µs at 1e-8, and a tenth of two steps of an explicit method."""
    exact = rubbing_crank(integrator="dopri5", step=5e-5, tolerance=1e-8)
    r = rubbing_crank(integrator=integrator, coordinates=coordinates, step=1e-3, tolerance=1e-8)
    np.testing.assert_allclose(r.array("hinge.angle"), exact.array("hinge.angle"), atol=3e-5)
    np.testing.assert_allclose(r.array("force.way.magnitude"), exact.array("force.way.magnitude"), atol=1e-2 * 20)


# --- what goes with it ---
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_matrix_is_the_derivative_of_the_residual(coordinates, rng):
    """Rows of efforts, at the level of accelerations, sliding and sticking, and columns; TOLERANCE as in `test_residual_and_tangent`."""
    branches = set()
    for here in moving(linked.record(linked.every_element("stiction")), coordinates, rng, 4):
        residual = here.motion.system.record.residual
        for sticks in (False, True):
            # far within the cone, with the same accelerations
            here.lam[here.rows :] *= 0.3 if sticks else 1.0
            unknowns = Unknowns(here, rng.uniform(-0.5, 0.5, here.n))
            assert unknowns.error(3) < 5e-11
            branches |= set(np.sign(residual.branch).tolist())
    assert len(branches) > 1


@SECOND_ORDER
def test_machine_with_every_element_runs_as_with_an_explicit_method(integrator, coordinates):
    """Friction beside everything else there is, against dopri5 with the same τ: the method's own error is of order two."""
    record = linked.record(linked.every_element("stiction"))
    errors, steps = [], [1e-3, 5e-4]
    for step in steps:
        settings = {"duration": 0.1, "step": step, "output_interval": 0.01}
        exact = reference_run(record, integrator="dopri5", tolerance=1e-9, coordinates="absolute", **settings)
        r = run(record, integrator=integrator, coordinates=coordinates, **settings)
        errors.append(max(np.abs(getattr(r, name) - getattr(exact, name)).max() for name in ("position", "velocity")))
    assert errors[-1] < 0.4 * errors[0] < 1e-2, errors


@pytest.mark.parametrize(
    ("integrator", "angle", "energy"),
    [("generalised-alpha", 1e-5, 1e-6), ("ros2", 1e-5, 4e-7), ("radau", 1e-4, 1e-6)],
)
@pytest.mark.parametrize("rotations", ["euler-parameters", "euler-angles", "rotation-vector"])
def test_in_rotation_coordinates_friction_is_the_same(integrator, angle, energy, rotations):
    """The loop with two frictions as Lagrange equations, whose normalisations stand between the rows of joints and of efforts: the same
    law in other unknowns. Fixed steps differ by round-off that moves when a friction turns within a step, of up to a hundredth of what
    they miss; chosen ones by ten times the tolerance of the angle of 3 rad. Energy as a share of the largest kinetic energy."""
    steps = {"integrator": integrator, "step": 1e-3, "tolerance": 1e-6}
    same = rubbing_crank(coordinates="absolute", **steps)
    r = rubbing_crank(coordinates="absolute", formulation="lagrange", rotations=rotations, **steps)
    np.testing.assert_allclose(r.array("hinge.angle"), same.array("hinge.angle"), rtol=0, atol=angle)
    missed = energy * same.array("kinetic_energy").max()
    assert np.abs(r.array("energy_error")).max() < np.abs(same.array("energy_error")).max() + missed


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("integrator", ["rk4", "generalised-alpha"])
def test_friction_of_a_prescribed_motion_acts_against_it(integrator, coordinates):
    """What a driver turns no effort moves: friction is -μ N r all the time, and the driver makes up for it."""
    links = {"a": solid(position=[0.5, 0, 0]), "b": solid(position=[1.5, 0, 0])}
    pivots = {"main": ("ground", "a", 0), "pin": ("a", "b", 1)}
    joints = {
        name: {"type": "revolute", "bodies": [first, second], "point": [x, 0, 0], "axis": [0, 0, 1]}
        for name, (first, second, x) in pivots.items()
    }
    rub = {"type": "friction", "coordinate": "pin", "coefficient": 0.5, "model": "stiction", "radius": 0.1}
    sections = {
        "bodies": links,
        "joints": joints,
        "drivers": {"turn": {"coordinate": "pin", "value": "10*time"}},
        "forces": {"rub": {**rub, "normal_load": 100}},
    }
    r = simulate(sections, integrator=integrator, coordinates=coordinates, duration=0.5, step=1e-3)
    np.testing.assert_allclose(r.array("force.rub.magnitude"), -5.0, rtol=1e-12)


@pytest.mark.parametrize("integrator", ["generalised-alpha", "radau"])
def test_regularised_friction_of_a_fast_block(integrator):
    """Sliding at 700 times the transition speed, where tanh of complex numbers overflows: it stops at v0²/(2 μ g)."""
    sections = sled({"model": "coulomb", "transition_speed": 1e-3}, 0.7)
    r = simulate(sections, integrator=integrator, duration=0.5, step=1e-3)
    assert abs(r.array("rail.displacement")[-1] - 0.49 / (2 * MU * G)) < 1e-3


def test_balances_over_whole_steps_refuse_it():
    settings = {"integrator": "energy-momentum", "coordinates": "absolute", "stabilisation": "none", "step": 1e-3}
    with pytest.raises(ModelError, match="'stiction' does not go with `integrator: energy-momentum`"):
        simulate(sled({"model": "stiction"}), duration=1.0, **settings)


def test_what_breaks_away_again_and_again_is_known_within_the_tolerance():
    """1 kg under 30 N sin ωt, ω = 6/s, and friction of 20 N: it leaves when sin ωt₁ = 2/3, stops where 5 (cos ωt₁ - cos ωt₂) = 20 (t₂ - t₁)
    and goes the same way back after half a period.

    What held at the begin of a step and slides at its end is not stiff any more: the estimate of the error has to know it.
    """
    rub = {"type": "friction", "coordinate": "rail", "model": "stiction", "coefficient": 0.2, "normal_load": 100.0}
    pull = {"type": "motor", "coordinate": "rail", "effort": "30*sin(6*time)"}
    sections = {"bodies": {"block": solid(1.0)}, "joints": {"rail": slide("ground", "block")}}
    r = simulate({**sections, "forces": {"pull": pull, "rub": rub}}, duration=6.0)
    half, first = np.pi / 6.0, np.arcsin(2.0 / 3.0) / 6.0
    last = brentq(
        lambda t: 5.0 * (np.cos(6.0 * first) - np.cos(6.0 * t)) - 20.0 * (t - first), half / 2.0, half + first
    )
    way = 5.0 * np.cos(6.0 * first) * (last - first) - 5.0 / 6.0 * (np.sin(6.0 * last) - np.sin(6.0 * first))
    way -= 10.0 * (last - first) ** 2
    turn, since = np.divmod(r.time - last - 1e-3, half)
    rests = (r.time > last) & (since < first + half - last - 1e-3)
    expected = np.where(turn[rests] % 2 == 0.0, way, 0.0)
    assert rests.sum() > 100
    assert r.settings["integrator"] == "radau"
    np.testing.assert_allclose(r.array("rail.displacement")[rests], expected, atol=5e-7)
