"""Tyres against closed forms: curves at their points, rolling, sliding, standing, and the linear single track."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import fsolve

import nivel
from nivel.elements.contacts.height_field import HeightField
from nivel.elements.forces.tyre import ACROSS, ALONG, CARCASS_TIME, SLOW, SOFTER, TyreRow, fluidities, over_slip
from nivel.errors import SolveError
from simulating import G, machine

P, R, C, W = 4e3, 0.315, 190e3, 0.195
TYRE = {"type": "tyre", "plane": "road", "radius": R, "width": W, "nominal_load": P, "stiffness": C, "damping": 400.0}
CAR = Path(__file__).parents[3] / "examples" / "vehicles" / "car.yaml"


def at_load(pair, q):
    """A force by P at the load q P: the parabola through zero and two."""
    return q * P * (2 * pair[0] - pair[1] / 2 + (pair[1] / 2 - pair[0]) * q)


def curve(guess, q=1.0):
    """(slope, s_M, F_M, s_S, F_S) of the guessed tyre."""
    slips = [guess[key][0] + (guess[key][1] - guess[key][0]) * (q - 1.0) for key in ("peak_slip", "sliding_slip")]
    peak = at_load(guess["peak"], q)
    return at_load(guess["slope"], q), slips[0], peak, slips[1], min(at_load(guess["sliding"], q), peak)


def test_curves_go_through_their_points_without_corners():
    for guess in (ALONG, ACROSS):
        for q in (0.5, 1.0, 2.0):
            slope, s_m, f_m, s_s, f_s = its = curve(guess, q)

            def force(s, its=its):
                return s * over_slip(s, its)

            assert over_slip(0.0, its) == pytest.approx(slope, rel=1e-14)
            assert force(s_m) == pytest.approx(f_m, rel=1e-14)
            assert force(s_s) == pytest.approx(f_s, rel=1e-14)
            for s in np.linspace(0.3 * s_m, 1.5 * s_s, 400):
                e = 1e-7
                left, right = (force(s) - force(s - e)) / e, (force(s + e) - force(s)) / e
                assert abs(left - right) < 1e-4 * slope
            assert abs(force(s_m + 1e-6) - force(s_m - 1e-6)) < 1e-9 * f_m
            assert max(force(s) for s in np.linspace(0.01, 2.0, 500)) <= f_m * (1 + 1e-12)


def numbers():
    """The row of the guessed tyre."""
    row = TyreRow(output=0, wheel=0, plane=0, stretch=[0] * 4, radius=R, width=W, load=P, c=C, d=400.0, cx=1e5, dx=400.0, cy=1e5,
                  dy=400.0, friction=0, rolling=0.0, rolling_share=0.375, trail=[0.1] * 6,
                  along=[v * (P if "slip" not in k else 1) for k, pair in ALONG.items() for v in pair],
                  across=[v * (P if "slip" not in k else 1) for k, pair in ACROSS.items() for v in pair])  # fmt: skip
    return np.array(row.numbers)


def test_slips_together_have_the_ellipse_of_peaks_and_slide_along_their_velocity():
    n, none = numbers(), (0.0, 0.0, 0.0)
    x, y = curve(ALONG), curve(ACROSS)
    for angle in np.linspace(0.0, 2.0 * math.pi, 17):
        v = 10.0 * x[1] * math.cos(angle), 10.0 * y[1] * math.sin(angle), 0.0
        a, b = fluidities(n, 1.0, 10.0, v, none)
        assert (v[0] / a / x[2]) ** 2 + (v[1] / b / y[2]) ** 2 == pytest.approx(1.0, rel=1e-13)
        small = 1e-9 * v[0], 1e-9 * v[1], 0.0
        assert fluidities(n, 1.0, 10.0, small, none) == pytest.approx((10.0 / x[0], 10.0 / y[0]), rel=1e-6)
        v = math.cos(angle), math.sin(angle), 0.0
        assert fluidities(n, 1.0, 0.1, v, none) == pytest.approx((1.0 / x[4], 1.0 / y[4]), rel=1e-13)


def sled(
    turn=0.0, gravity=(0, 0, -G), locked=True, speed=0.0, rolling=0.0, forces=None, heights=None, grip=1.0, **simulation
):
    """A body on four tyres at its corners, its centre of mass on the road: no load is transferred. Locked wheels are one with it."""
    mass = 1600.0
    sag = mass / 4 * -gravity[2] / C
    r = R - (1 - 0.375 * sag * C / P) * sag
    bodies, joints, markers, tyres = {}, {}, {"road": {"body": "ground", "axis": [0, 0, 1]}}, {}
    axle = [-math.sin(turn), math.cos(turn), 0.0]
    for k, (x, y) in enumerate(((1.2, 0.7), (1.2, -0.7), (-1.2, 0.7), (-1.2, -0.7))):
        at = [x, y, R - sag]
        if locked:
            markers[f"m{k}"] = {"body": "sled", "position": at, "axis": axle}
        else:
            bodies[f"w{k}"] = {"mass": 1e-3, "inertia": [1.0] * 3, "position": at, "velocity": [speed, 0, 0],
                               "angular_velocity": [0, speed / r, 0]}  # fmt: skip
            joints[f"j{k}"] = {"type": "revolute", "bodies": ["sled", f"w{k}"], "point": at, "axis": axle}
            markers[f"m{k}"] = {"body": f"w{k}", "axis": axle}
        tyres[f"t{k}"] = {**TYRE, "wheel": f"m{k}", "rolling_resistance": rolling, "grip": grip}
        if heights is not None:
            tyres[f"t{k}"]["heights"] = heights
    bodies["sled"] = {"mass": mass, "inertia": [900.0, 900.0, 1500.0], "velocity": [speed, 0, 0]}
    return machine({"gravity": list(gravity), "bodies": bodies, "joints": joints, "markers": markers,
                    "forces": {**tyres, **(forces or {})}, "simulation": {"step": 1e-3, **simulation}})  # fmt: skip


def slope(grade, across=False):
    """Gravity on a slope along x, or y."""
    angle = math.atan(grade)
    down = -G * math.sin(angle)
    return (0.0, down, -G * math.cos(angle)) if across else (down, 0.0, -G * math.cos(angle))


IDLING = {"idling": {"type": "force", "body": "sled", "vector": ["400*sin(2*pi*25*time)", "300*sin(2*pi*25*time)", 0]}}


@pytest.mark.parametrize("across", [False, True])
def test_a_machine_parked_on_ten_per_cent_does_not_creep_while_its_engine_idles(across):
    """At whole periods of the engine, once the first vibration has died out."""
    run = sled(gravity=slope(0.1, across), forces=IDLING, start="equilibrium", duration=60, output_interval=0.04)
    place = run.simulate(verify=False).array("position")[:, 0]
    assert np.abs(place[-1] - place[1000]).max() < 1e-9


@pytest.mark.parametrize(("across", "name"), [(False, "along"), (True, "across")])
def test_an_equilibrium_is_that_of_the_carcass_and_none_is_beyond_the_grip(across, name):
    gravity = slope(0.1, across)
    found = sled(gravity=gravity).statics().array("position")[-1, 0]
    moved = 1600.0 * (gravity[1] if across else gravity[0]) / (4.0 * SOFTER[name] * C)
    assert found[1 if across else 0] == pytest.approx(moved, rel=1e-4)
    with pytest.raises(SolveError):
        sled(gravity=slope(1.3, across)).statics()


def test_a_standing_machine_vibrates_on_its_carcass():
    """√(4 c/m) along, across and up; turns have other inertias. Damping takes less than a thousandth."""
    linear = sled(gravity=slope(0.02), start="equilibrium", duration=1).linearise()
    found = np.abs(np.imag(linear.eigenvalues))
    for c in (SOFTER["along"] * C, SOFTER["across"] * C, C):
        assert np.abs(found / math.sqrt(4.0 * c / 1600.0) - 1.0).min() < 2e-3


@pytest.mark.parametrize("turn", [0.0, math.pi / 2])
def test_locked_wheels_stop_in_the_distance_of_their_sliding_force(turn):
    """v²/(2 a), a = 4 F_S/m; the carcass stretches by some centimetres first."""
    speed, q = 40.0, 1600.0 * G / 4 / P
    a = 4.0 * curve(ACROSS if turn else ALONG, q)[4] / 1600.0
    run = sled(turn=turn, speed=speed, duration=1.1 * speed / a).simulate(verify=False)
    assert run.array("position")[:, 0, 0].max() == pytest.approx(0.5 * speed**2 / a, rel=1e-3)


def on_rig(speed, slip=0.0, way=0.0, rolling=0.0, duration=1.0, **tyre):
    """The run of a wheel under P on a carriage that moves along the angle `way`, with the spin of a slip."""
    sag = P / C
    r = R - (1 - 0.375) * sag
    moves = [speed * math.cos(way), speed * math.sin(way), 0.0]
    spin, at = moves[0] / (1.0 + slip) / r, {"position": [0, 0, R - sag], "velocity": moves}
    return machine({
        "bodies": {"carriage": {"mass": 9, "inertia": [1, 1, 1], **at},
                   "wheel": {"mass": 9, "inertia": [1, 1, 1], "angular_velocity": [0, spin, 0], **at}},
        "joints": {"rail": {"type": "translational", "bodies": ["ground", "carriage"], "point": at["position"], "axis": moves},
                   "axle": {"type": "revolute", "bodies": ["carriage", "wheel"], "point": at["position"], "axis": [0, 1, 0]}},
        "drivers": {"pull": {"coordinate": "rail.displacement", "value": f"{speed!r}*time"},
                    "turn": {"coordinate": "axle.angle", "value": f"{spin!r}*time"}},
        "markers": {"road": {"body": "ground", "axis": [0, 0, 1]}, "hub": {"body": "wheel", "axis": [0, 1, 0]}},
        "forces": {"tyre": {**TYRE, "wheel": "hub", "rolling_resistance": rolling, **tyre}},
        "simulation": {"step": duration / 500, "output_interval": duration / 500, "duration": duration},
    }).simulate(verify=False)  # fmt: skip


@pytest.mark.parametrize("speed", [1.0, 30.0])
@pytest.mark.parametrize(("name", "guess"), [("along", ALONG), ("across", ACROSS)])
def test_a_small_slip_has_63_per_cent_of_its_force_after_the_way_of_slope_by_stiffness(name, guess, speed):
    slope, c, small = curve(guess)[0], SOFTER[name] * C, 1e-5
    slips = {"slip": small} if name == "along" else {"way": small}
    found = on_rig(speed, **slips, duration=2.0 * slope / c / speed, **{name: {"damping": 1e-3}})
    force = found.array("force.tyre.longitudinal" if name == "along" else "force.tyre.lateral")
    ways = found.time * speed * c / slope
    assert abs(force[250]) == pytest.approx((1.0 - math.exp(-1.0)) * slope * small, rel=1e-3)
    np.testing.assert_allclose(np.abs(force), (1.0 - np.exp(-ways)) * slope * small, atol=1e-3 * slope * small)


@pytest.mark.parametrize(("share", "sense"), [("peak", -1.0), ("peak", 1.0), ("sliding", 1.0)])
def test_power_of_the_drive_is_that_of_the_way_and_of_slip_and_rolling(share, sense):
    """A wheel at the slip of its peak, or where it slides: T = r (F_x + f P), T Ω = F_x v + F_x (r Ω - v) + f P r Ω."""
    f, speed, q = 0.02, 20.0, curve(ALONG)
    slip, force = sense * (q[1] if share == "peak" else q[3]), -sense * (q[2] if share == "peak" else q[4])
    found, r = on_rig(speed, slip, rolling=f), R - (1 - 0.375) * P / C
    tread = speed / (1.0 + slip)
    last = {
        name: found.array(name)[-1] for name in ("driver.turn.effort", "driver.pull.effort", "force.tyre.slip_loss")
    }
    drive, pull, lost = last.values()
    assert found.array("force.tyre.longitudinal")[-1] == pytest.approx(force, rel=1e-9)
    assert drive == pytest.approx(r * (force + f * P), rel=1e-9)
    assert lost == pytest.approx(force * (tread - speed) + f * P * tread, rel=1e-9)
    assert drive * tread / r + pull * speed == pytest.approx(lost, rel=1e-9)


@pytest.mark.parametrize("rate", [0.5, 20.0])
def test_a_standing_tyre_that_is_turned_is_held_by_its_carcass_and_then_by_the_sliding_force_on_the_lever_of_the_bore(
    rate,
):
    """R_B (c R_B ψ + d R_B ω) below 70 % of F_S where it turns slowly, and R_B F_S in the end, R_B = (L + b)/6."""
    sag, c = P / C, SOFTER["across"] * C
    lever, most = (2.0 * math.sqrt(R * sag) + W) / 6.0, curve(ACROSS)[4]
    turned = 12.0 * most / (c * lever)
    at = [0, 0, R - sag]
    found = machine({
        "bodies": {"wheel": {"mass": 9, "inertia": [1, 1, 1], "position": at, "angular_velocity": [0, 0, rate]}},
        "joints": {"king": {"type": "revolute", "bodies": ["ground", "wheel"], "point": at, "axis": [0, 0, 1]}},
        "drivers": {"steer": {"coordinate": "king.angle", "value": f"{rate}*time"}},
        "markers": {"road": {"body": "ground", "axis": [0, 0, 1]}, "hub": {"body": "wheel", "axis": [0, 1, 0]}},
        "forces": {"tyre": {**TYRE, "wheel": "hub"}},
        "simulation": {"step": turned / rate / 2000, "output_interval": turned / rate / 2000, "duration": turned / rate},
    }).simulate(verify=False)  # fmt: skip
    moment = -found.array("force.tyre.moment")
    assert moment[-1] == pytest.approx(lever * most, rel=1e-4)
    assert found.array("driver.steer.effort")[-1] == pytest.approx(moment[-1], rel=1e-9)
    if rate * lever < 0.5 * SLOW:
        held = lever**2 * c * (rate * found.time + CARCASS_TIME * rate)
        early = held < 0.69 * lever * most
        np.testing.assert_allclose(moment[early], held[early], rtol=1e-9)


def test_locked_wheels_brake_by_the_sliding_forces_of_their_transferred_loads():
    """Height, pitch and deceleration from the balance of loads C (R - height of the hub) and of their sliding forces, which act at the
    rolling radius, 0.375 q of the deflection below the ground; at the ground itself 0.13 % more would be left."""
    mass, high = 1600.0, 0.55
    hub = R - mass / 4 * G / C - high

    def balance(unknown):
        z, pitch, a = unknown
        load, force, moment = 0.0, 0.0, 0.0
        for x in (1.2, -1.2):
            sag = R - (z - x * math.sin(pitch) + hub * math.cos(pitch))
            q = C * sag / P
            slides = 2.0 * curve(ALONG, q)[4]
            load, force = load + 2.0 * q * P, force + slides
            moment += 2.0 * q * P * (x * math.cos(pitch) + hub * math.sin(pitch)) - slides * (z + 0.375 * q * sag)
        return load - mass * G, force - mass * a, moment

    a = fsolve(balance, [high, 0.0, G], xtol=1e-13)[2]
    assert abs(a - 4.0 * curve(ALONG, mass / 4 * G / P)[4] / mass) > 0.01 * a
    damped = {f"forces.t{k}.damping": 2e4 for k in range(4)}
    run = sled(speed=40.0, duration=2.0).with_values({"bodies.sled.centre_of_mass": [0, 0, high], **damped})
    run = run.simulate(verify=False)
    v, late = run.array("velocity")[:, 0, 0], run.time > 1.5
    assert -np.polyfit(run.time[late], v[late], 1)[0] == pytest.approx(a, rel=1e-5)


def test_rolling_resistance_slows_by_its_force_and_loses_what_it_takes():
    """a = f m g/(m + 4 J/r²) for wheels whose torques are in balance with the force at the rolling radius; power in is power lost."""
    f, speed, mass = 0.01, 20.0, 1600.0
    run = sled(locked=False, speed=speed, rolling=f, duration=10).simulate()
    sag = mass / 4 * G / C
    r = R - (1 - 0.375 * sag * C / P) * sag
    v = run.array("velocity")[:, -1, 0]
    a = f * (mass + 4e-3) * G / (mass + 4e-3 + 4.0 / r**2)
    assert (v[200] - v[-1]) / (run.time[-1] - run.time[200]) == pytest.approx(a, rel=1e-4)
    kinetic = 0.5 * mass * speed**2
    assert np.abs(run.array("energy_error")).max() < 1e-9 * kinetic
    assert np.abs(run.array("force.t0.lateral")).max() == 0.0


def test_free_wheels_stay_on_a_slope_below_their_rolling_resistance_and_leave_on_a_steeper_one():
    at = sled(locked=False, rolling=0.01, gravity=slope(0.005), start="equilibrium", duration=20).simulate(verify=False)
    x = at.array("position")[:, -1, 0]
    assert abs(x[-1] - x[len(x) // 2]) < 1e-9
    at = sled(locked=False, rolling=0.01, gravity=slope(0.02), duration=10).simulate(verify=False)
    v = at.array("velocity")[:, -1, 0]
    mass, r = 1600.004, R - 0.01
    a = mass * G * (0.02 - 0.01) * math.cos(math.atan(0.02)) / (mass + 4.0 / r**2)
    assert (v[len(v) // 2] - v[-1]) / (0.5 * at.time[-1]) == pytest.approx(a, rel=2e-3)
    with pytest.raises(SolveError):
        sled(locked=False, rolling=0.01, gravity=slope(0.02)).statics()


def test_a_car_that_steers_to_the_other_side_moves_in_the_mirror():
    left, right = (
        nivel.load(CAR, overrides={"parameters.turn": turn}).simulate(duration=2.5, verify=False)
        for turn in ("1.5 deg", "-1.5 deg")
    )
    one, other = left.array("position")[:, 0], right.array("position")[:, 0]
    assert np.abs(one[:, 1]).max() > 0.5
    np.testing.assert_allclose(one * [1, -1, 1], other, atol=1e-13)  # some last bits of 50 m


def test_a_road_has_the_spectrum_of_its_class_and_another_seed_another_road():
    """Mean over lines of the one-sided spectrum: G₀ (n/n₀)⁻², 256e-6 m³ of class C at 0.1 cycles/m (ISO 8608:1995, table C.1)."""
    made = {
        seed: HeightField(size=(100.0, 4.0), points=(2001, 41), roughness="C", seed=seed).heights for seed in (1, 2)
    }
    step = 100.0 / 2000
    power = 2.0 * np.mean(np.abs(np.fft.rfft(made[1], axis=1)) ** 2, axis=0) * step / 2001
    n = np.fft.rfftfreq(2001, step)
    there = n > 0.011
    # half of the lines that repeat: their mean varies by chance, and not its mean over the waves
    share = power[there] / (256e-6 * (n[there] / 0.1) ** -2.0)
    assert np.mean(share) == pytest.approx(1.0, abs=0.05)
    assert np.abs(made[1] - made[2]).max() > 0.01
    # slopes of lines beside each other are alike, and not those of both sides of the road
    slopes = np.diff(made[1], axis=1)
    near, far = (np.mean(slopes[0] * slopes[k]) / np.mean(slopes[0] ** 2) for k in (1, 40))
    assert near > 0.3
    assert abs(far) < 0.1


def test_on_heights_energy_is_kept_and_on_a_ramp_of_heights_the_tyre_is_that_of_the_ramp():
    hills = {"size": [60.0, 20.0], "function": "0.04*sin(0.8*x)*cos(0.5*y)", "points": [241, 81]}
    run = sled(locked=False, speed=8.0, duration=3.0, heights=hills).simulate(verify=False)
    assert np.ptp(run.array("position")[:, -1, 2]) > 0.05
    assert np.abs(run.array("energy_error")).max() < 1e-6 * 0.5 * 1600.0 * 64.0
    flat, ramp = (
        sled(gravity=slope(0.1), duration=1.0, **more).simulate(verify=False).array("position")[-1, 0]
        for more in ({}, {"heights": {"size": [50.0, 50.0], "values": [[0.0] * 3] * 3}})
    )
    np.testing.assert_allclose(flat, ramp, atol=1e-12)


@pytest.mark.parametrize("seed", [1, 2])
def test_energy_is_kept_on_rough_roads(seed):
    """The plane turns about the place where the disc comes to the mean ground; about the one of the ground itself, 2e-4 are lost."""
    heights = {"size": [60.0, 4.0], "points": [1201, 41], "roughness": "C", "seed": seed}
    run = sled(locked=False, speed=12.0, duration=2.0, heights=heights, integrator="radau", tolerance=1e-8).simulate(
        verify=False
    )
    assert np.ptp(run.array("force.t0.magnitude")) > 0.5 * 1600.0 / 4.0 * G
    assert np.abs(run.array("energy_error")).max() < 1e-5 * 0.5 * 1600.0 * 12.0**2


def test_wheels_on_ice_slide_where_it_lies():
    """Grip 0.2 for y > 0: the retarding force of both sides, and the yaw that splits them."""
    run = sled(speed=10.0, duration=0.5, grip="if(y > 0, 0.2, 1)").simulate(verify=False)
    q = 1600.0 * G / 4 / P
    forces = [np.abs(run.array(f"force.t{k}.longitudinal")[-1]) for k in range(4)]
    assert forces[0] < 0.25 * forces[1]
    assert forces[1] == pytest.approx(curve(ALONG, q)[4], rel=0.05)
    assert run.array("angular_velocity")[-1, 0, 2] < -0.1


def test_a_load_beyond_the_curves_is_amber():
    """A sled that weighs 2.5 times as much as at rest bears more than twice the nominal load."""
    for gravity, verdict in (((0, 0, -G), "green"), ((0, 0, -2.5 * G), "amber")):
        run = sled(gravity=gravity, duration=0.1).simulate(verify=False)
        lines = [item for item in run.trust.items if item.name == "laden"]
        assert [item.verdict for item in lines] == ([verdict] * 4 if verdict == "amber" else [])


SIDE, FRONT, REAR, YAW, SPEED, STEERED = 1600.0, 1.2, -1.5, 2000.0, 20.0, 2e-4  # kg, m, m, kg m², m/s, rad


def single_track():
    """A body that a planar joint holds on the road, with a wheel steered a little in front and one behind, both under P."""
    sag = P / C
    r = R - (1 - 0.375) * sag
    bodies = {
        "body": {"mass": SIDE, "inertia": [1500.0, 1500.0, YAW], "position": [0, 0, 0.5], "velocity": [SPEED, 0, 0]}
    }
    joints = {"plane": {"type": "planar", "bodies": ["ground", "body"], "point": [0, 0, 0.5], "axis": [0, 0, 1]}}
    markers, forces = {"road": {"body": "ground", "axis": [0, 0, 1]}}, {}
    for name, x, turn in (("front", FRONT, STEERED), ("rear", REAR, 0.0)):
        axle, at = [-math.sin(turn), math.cos(turn), 0.0], [x, 0.0, R - sag]
        bodies[name] = {"mass": 1e-3, "inertia": [1.0] * 3, "position": at, "velocity": [SPEED, 0, 0],
                        "angular_velocity": [SPEED / r * each for each in axle]}  # fmt: skip
        joints[name] = {"type": "revolute", "bodies": ["body", name], "point": at, "axis": axle}
        markers[f"{name}_axle"] = {"body": name, "axis": axle}
        forces[name] = {**TYRE, "wheel": f"{name}_axle", "rolling_resistance": 0.0}
    return machine({"bodies": bodies, "joints": joints, "markers": markers, "forces": forces,
                    "simulation": {"step": 1e-3, "duration": 1.5, "output_interval": 0.01}})  # fmt: skip


def test_a_step_of_steering_is_that_of_the_linear_single_track():
    """States v_y, r, and of each wheel the stretches across and of the bore:

    ż = -(s + A c z)/(1 + A d), F = c z + d ż; s = v_y + (x - n) r - δ v across, R_B r of the bore; A = v/slope; n trail, R_B = (L + b)/6.
    """
    sag = P / C
    length = 2.0 * math.sqrt(R * sag)
    c = SOFTER["across"] * C
    d, fluid = CARCASS_TIME * c, SPEED / curve(ACROSS)[0]
    trail, lever = 0.178 * length, (length + W) / 6.0
    A, b = np.zeros((6, 6)), np.zeros(6)
    forces = np.zeros((4, 6)), np.zeros(4)
    for k, (x, turn) in enumerate(((FRONT, STEERED), (REAR, 0.0))):
        for m, (slide, steer) in enumerate((((1.0, x - trail), -turn * SPEED), ((0.0, lever), 0.0))):
            row = 2 + 2 * k + m
            A[row, :2] -= np.array(slide) / (1 + fluid * d)
            A[row, row] -= fluid * c / (1 + fluid * d)
            b[row] -= steer / (1 + fluid * d)
            forces[0][2 * k + m] = d * A[row]
            forces[0][2 * k + m, row] += c
            forces[1][2 * k + m] = d * b[row]
    for k, x in enumerate((FRONT, REAR)):
        for row, across, bore in ((0, 1.0 / SIDE, 0.0), (1, (x - trail) / YAW, lever / YAW)):
            for m, factor in ((0, across), (1, bore)):
                A[row] += factor * forces[0][2 * k + m]
                b[row] += factor * forces[1][2 * k + m]
    A[0, 1] -= SPEED
    run = single_track().simulate(verify=False)
    steady = -np.linalg.solve(A, b)
    expected = np.array([steady - expm(A * t) @ steady for t in run.time])
    found = run.array("angular_velocity")[:, 0, 2]
    # the slopes of the curves fall by 0.3 % per thousandth of slip
    np.testing.assert_allclose(found, expected[:, 1], atol=2e-3 * abs(steady[1]))


def test_the_example_stands_still_in_the_end_and_keeps_its_energy():
    run = nivel.load(CAR).simulate(verify=False)
    place, late = run.array("position")[:, 0], run.time > 7.5
    assert place[-1, 0] > 70.0
    assert np.ptp(place[late], axis=0).max() < 1e-3
    assert np.abs(run.array("energy_error")).max() < 1e-6 * 0.5 * 1480.0 * 20.0**2
    # both sides of the road: the lane change
    assert place[:, 1].max() > 0.5
