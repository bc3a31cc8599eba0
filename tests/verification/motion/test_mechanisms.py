"""The mechanisms of the examples against published numbers, closed loops and independent equations."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import nivel
from example_files import rigid_example
from references import andrews, dyads, rssr
from simulating import G

pytestmark = pytest.mark.covering

EXAMPLES = Path(__file__).parents[3] / "examples"
FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])


def example(name, **settings):
    return nivel.load(rigid_example(name), allow_code=True).simulate(**settings)


def turned(result, body):
    """(n, 3, 3) rotation matrices of a body."""
    return Rotation.from_quat(result.array(f"{body}.orientation"), scalar_first=True).as_matrix()


# --- Andrews' squeezing mechanism ---


@pytest.fixture(scope="module", params=["newton-euler", "lagrange"])
def squeezer(request):
    return example("andrews-squeezer", formulation=request.param, integrator="rk4")


def about_z(result, body):
    """Angle about Z over time, without jumps; the frames are stored often enough."""
    A = turned(result, body)
    return np.unwrap(np.arctan2(A[:, 1, 0], A[:, 0, 0]))


def relative(angles):
    """q of the test set from the angles of K1 … K7: (β, Θ, γ, Φ, δ, Ω, ε)."""
    k1, k2, k3, k4, k5, k6, k7 = angles
    return np.array([k1, k2 - k1, k3, k4 - k5, k5, k6 - k7, k7])


def test_andrews_squeezer_meets_all_published_end_values(squeezer):
    """q at 0.03 s: the test set asks for 1e-6; the method at 10 µs gives 1e-9."""
    bodies = [f"K{k}" for k in range(1, 8)]
    q = relative([about_z(squeezer, body) for body in bodies])[:, -1]
    np.testing.assert_allclose(q, andrews.PUBLISHED, rtol=1e-9)
    rates = relative([squeezer.array(f"{body}.angular_velocity.z") for body in bodies])[:, -1]
    np.testing.assert_allclose(rates, andrews.PUBLISHED_RATES, rtol=1e-6)
    second = relative([squeezer.array(f"{body}.angular_acceleration.z") for body in bodies])[:, -1]
    # the published ones have six digits (they came from a method that holds positions only); the reference has more
    np.testing.assert_allclose(second, andrews.PUBLISHED_ACCELERATIONS, rtol=2e-6)
    end = andrews.solve(np.array([0.0, 0.03]), spring=True)
    np.testing.assert_allclose(second, andrews.accelerations(end.q[-1], end.qdot[-1], spring=True), rtol=3e-8)


def test_andrews_squeezer_follows_the_reference_all_the_way(squeezer):
    expected = andrews.solve(squeezer.time, spring=True)
    q = relative([about_z(squeezer, f"K{k}") for k in range(1, 8)]).T
    np.testing.assert_allclose(q, expected.q, atol=2e-9)


def test_reactions_of_the_andrews_squeezer_are_the_published_multipliers(squeezer):
    """At E the end of K2 stands in all three loop equations with +, K3, K4 and K6 in one each with -. So with
    M q̈ + Gᵀλ = f the forces on them are -Σ λ, λ₁, λ₂, λ₃; a joint of the file reports that on its first body, K3."""
    end = andrews.solve(np.array([0.0, 0.03]), spring=True)
    computed = andrews.solved(end.q[-1], end.qdot[-1], spring=True)[1]
    # as published to six digits, as computed to more
    for multipliers, digits in ((andrews.PUBLISHED_MULTIPLIERS, 2e-6), (computed, 1e-8)):
        first, second, third = multipliers.reshape(3, 2)
        for joint, force in (("E2", first + second + third), ("E4", -second), ("E6", -third)):
            np.testing.assert_allclose(squeezer.array(f"{joint}.force")[-1, :2], force, rtol=digits)


# --- Watt's six-bar ---
JOINTS = {
    "A": (80, 0),
    "B": (250, 170),
    "C": (290, 0),
    "D": (330, 110),
    "E": (530, 190),
    "F": (590, 0),
}  # mm, at the start


def six_bar():
    p = {name: 1e-3 * np.array(place) for name, place in JOINTS.items()}

    def length(a, b):
        return float(np.hypot(*(p[a] - p[b])))

    def side(start, tip, end):
        return int(np.sign(np.linalg.det([p[end] - p[start], p[tip] - p[start]])))

    u, w = (complex(*(p[name] - p["C"])) for name in "BD")
    return dyads.SixBar(
        crank=float(np.hypot(*p["A"])),
        coupler=length("A", "B"),
        bc=length("B", "C"),
        cd=length("C", "D"),
        offset=float(np.angle(w / u)),
        second_coupler=length("D", "E"),
        rocker=length("E", "F"),
        C=tuple(p["C"]),
        F=tuple(p["F"]),
        sides=(side("A", "B", "C"), side("D", "E", "F")),
    )


# bars of the file: ends, width; 10 mm of steel
BARS = {
    "crank": ("O", "A", 0.040),
    "coupler": ("A", "B", 0.025),
    "link": ("D", "E", 0.025),
    "rocker": ("F", "E", 0.040),
}


def kinetic_and_potential(points):
    """Callable φ (n,) -> kinetic energy at φ̇ = 1, potential energy, of all five bodies by complex steps."""

    def energies(angle):
        step = 1e-30
        at = points(angle + 1j * step)
        at["O"] = np.zeros_like(at["A"])
        kinetic, potential = 0.0, 0.0
        for first, second, width in BARS.values():
            d = at[second] - at[first]
            length = np.sqrt(np.sum(d.real[:, 0] ** 2))
            mass = 7850 * length * width * 0.010
            inertia = mass * (length**2 + width**2) / 12
            turn = (d[0].real * d[1].imag - d[1].real * d[0].imag) / step / length**2
            centre = 0.5 * (at[first] + at[second])
            speed = centre.imag / step
            kinetic += 0.5 * mass * np.sum(speed**2, axis=0) + 0.5 * inertia * turn**2
            potential += mass * G * centre[1].real
        # the triangle: centre of mass 93.3 mm above C as drawn, upright at the start, when B is at (-40, 170) from C
        d = at["B"] - at["C"]
        upright = np.array([-0.040, 0.170])
        cos = (d[0] * upright[0] + d[1] * upright[1]) / np.sum(upright**2)
        sin = (d[1] * upright[0] - d[0] * upright[1]) / np.sum(upright**2)
        centre = np.array([-0.0933 * sin, 0.0933 * cos])
        turn = (cos.real * sin.imag - sin.real * cos.imag) / step
        kinetic += 0.5 * (0.44 * 0.0933**2 + 6.62e-4) * turn**2
        potential += 0.44 * G * centre[1].real
        return kinetic, potential

    return energies


@FORMULATIONS
def test_six_bar_closes_its_loops_and_its_driver_gives_the_power(formulation):
    r = example("watt-six-bar", formulation=formulation)
    linkage = six_bar()
    angle = 6 * np.pi * r.time
    points = linkage.points(angle)
    # the frame of a bar is at its middle
    for name, (first, second, _) in BARS.items():
        start = np.zeros_like(points["A"]) if first == "O" else points[first]
        np.testing.assert_allclose(r.array(f"{name}.position")[:, :2], (0.5 * (start + points[second])).T, atol=1e-9)
        direction = (points[second] - start) / np.hypot(*(points[second] - start))
        np.testing.assert_allclose(turned(r, name)[:, :2, 0], direction.T, atol=1e-8)
    # 3 rev/s: τ = dT/dφ + dV/dφ
    energies, h = kinetic_and_potential(linkage.points), 1e-4
    kinetic, potential = (
        (high - low) / (2 * h) for high, low in zip(energies(angle + h), energies(angle - h), strict=True)
    )
    effort = (6 * np.pi) ** 2 * kinetic + potential
    np.testing.assert_allclose(r.array("driver.motor.effort"), effort, atol=1e-6 * np.abs(effort).max())


# --- RSSR ---
CRANK = rssr.Arm((0, 0, 0), (0, 0, 1), (0.06, 0, 0))
ROCKER = rssr.Arm((0.3, 0.1, 0.2), (0, 1, 0), (0.28, 0.1, 0.35))
ROD = float(np.linalg.norm(np.subtract(ROCKER.ball, CRANK.ball)))


@FORMULATIONS
@pytest.mark.parametrize("name", ["rssr", "rssr-with-rod"])
def test_rssr_obeys_its_input_output_equation(name, formulation):
    """Both machines: ψ(φ) and its slope from |Q - P| = L; the rocker is driven, so no time integration spoils it."""
    r = example(name, formulation=formulation)
    angle = 3 * np.pi * r.time
    out = rssr.output(CRANK, ROCKER, ROD, angle, -1)
    np.testing.assert_allclose(r.array("axle.angle"), out, atol=1e-9)
    slope = rssr.slopes(CRANK, ROCKER, angle, out)
    np.testing.assert_allclose(r.array("axle.angle.rate"), 3 * np.pi * slope, atol=1e-8)


def test_rod_of_the_rssr_pulls_with_what_moves_the_rocker():
    """The massless rod is a two-force member: its force S along it balances the rocker, S (Q - P)·Q'/L = -(J ψ̈ + c ψ̇ + …)."""
    r = example("rssr")
    angle = 3 * np.pi * r.time
    h = 1e-4
    out = {k: rssr.output(CRANK, ROCKER, ROD, angle + k * h, -1) for k in (-2, -1, 0, 1, 2)}
    omega = 3 * np.pi
    rate = omega * rssr.slopes(CRANK, ROCKER, angle, out[0])
    second = omega**2 * (-out[-2] + 16 * out[-1] - 30 * out[0] + 16 * out[1] - out[2]) / (12 * h**2)
    # aluminium cylinder of radius 15 mm, held at one end
    length = np.linalg.norm(np.subtract(ROCKER.ball, ROCKER.pivot))
    mass = 2700 * np.pi * 0.015**2 * length
    inertia = mass * (length**2 / 3 + 0.015**2 / 4)
    place, arm = ROCKER.at(out[0]), ROCKER.rate(out[0])
    needed = inertia * second + 0.2 * rate + 0.5 * mass * G * arm[:, 2]
    along = (place - CRANK.at(angle)) / ROD
    # `rod.force` acts on the crank, towards the rocker where the rod pulls; on the rocker its opposite
    pull = np.sum(r.array("rod.force") * along, axis=1)
    np.testing.assert_allclose(r.array("rod.force"), pull[:, None] * along, atol=1e-7)
    np.testing.assert_allclose(-pull * np.sum(along * arm, axis=1), needed, atol=1e-6 * np.abs(needed).max())


def test_rod_of_a_body_makes_the_same_motion_and_heavier_forces():
    light, heavy = example("rssr"), example("rssr-with-rod")
    np.testing.assert_allclose(light.array("rocker.position"), heavy.array("rocker.position"), atol=1e-10)
    assert np.abs(heavy.array("driver.motor.effort")).max() != pytest.approx(
        np.abs(light.array("driver.motor.effort")).max(), rel=1e-3
    )


# --- the others ---


@FORMULATIONS
def test_four_bar_of_revolutes_moves_as_the_one_without_redundant_rows(formulation):
    """The same with a spherical and a cylindrical joint at the coupler: forces in the plane agree, too."""
    machine = nivel.load(EXAMPLES / "mechanisms" / "four-bar-revolutes.yaml")
    record = machine.record
    free = {"crank_pin": "spherical", "rocker_pin": "cylindrical"}
    joints = tuple(
        joint.replace(type=free[joint.name], **({"axis": None} if free[joint.name] == "spherical" else {}))
        if joint.name in free
        else joint
        for joint in record.joints
    )
    plain = nivel.Machine.from_record(record.replace(joints=joints)).simulate(formulation=formulation)
    r = machine.simulate(formulation=formulation)
    assert len(r.trust.redundant_rows) == 3
    assert plain.trust.redundant_rows == ()
    np.testing.assert_allclose(r.array("position"), plain.array("position"), atol=1e-10)
    scale = np.abs(plain.array("joint_force")).max()
    np.testing.assert_allclose(
        r.array("joint_force")[:, :, :2], plain.array("joint_force")[:, :, :2], atol=1e-8 * scale
    )


def test_hoist_falls_is_caught_and_held():
    """Free: a = (m g r - τ)/(m r + J/r) with the pin's friction τ = μ r_p m_d g; later at rest for good, the brake carrying
    m g r."""
    r = example("friction-brake")
    radius, load, g = 0.15, 120.0, G
    drum = 2500 * np.pi * radius**2 * 0.3
    inertia = 0.5 * drum * radius**2
    t = r.time
    falling = (t > 0.1) & (t < 0.25)
    # well above the Stribeck speed the coefficient is the kinetic one
    friction = 0.35 * 0.02 * drum * g
    a = (load * g * radius - friction) / (load * radius + inertia / radius)
    np.testing.assert_allclose(r.array("load.acceleration.z")[falling], -a, rtol=2e-4)
    resting = t > 0.6
    assert np.ptp(r.array("shaft.displacement")[resting]) < 1e-9
    assert np.abs(r.array("bearing.angle.rate")[resting]).max() < 1e-9
    np.testing.assert_allclose(r.array("force.brake.magnitude")[resting], load * g * radius, rtol=1e-6)
    assert r.array("dissipated_energy")[-1] == pytest.approx(-load * g * r.array("shaft.displacement")[-1], rel=1e-4)


def test_planetary_gear_reduces_by_willis():
    r = example("gear-train")
    sun, carrier = (r.array(f"{name}.angular_velocity.z") for name in ("sun", "carrier"))
    np.testing.assert_allclose(sun, (1 + 66 / 24) * carrier, atol=1e-9 * sun.max())
    # in the end the motor's torque is what the load takes, reduced: 1.5 - 0.005 ω = 0.08 ω/3.75²
    assert sun[-1] == pytest.approx(1.5 / (0.005 + 0.08 / 3.75**2), rel=1e-3)
    for k in (1, 2, 3):
        planet = r.array(f"planet_{k}.angular_velocity.z")
        np.testing.assert_allclose(planet, (1 - 66 / 21) * carrier, atol=1e-9 * sun.max())


def test_valve_leaves_its_cam_at_a_higher_speed():
    """Effort m (s̈ + g) + k (s + 6 mm) + c ṡ of the spline; positive at 3000 rpm, negative at 5000."""
    from scipy.interpolate import CubicSpline

    lifts = 1e-3 * np.array([0] * 5 + [0.3, 1.5, 3.6, 5.9, 7.6, 8.2, 7.6, 5.9, 3.6, 1.5, 0.3] + [0] * 5)
    lowest = []
    for turn in (0.020, 0.012):
        r = nivel.load(EXAMPLES / "mechanisms" / "cam.yaml", {"parameters.turn": f"{turn} s"}).simulate()
        spline = CubicSpline(np.linspace(0, turn, 21), lifts, bc_type="natural")
        t = r.time[:-1]
        effort = 0.12 * (spline(t, 2) + G) + 25e3 * (spline(t) + 6e-3) + 15 * spline(t, 1)
        np.testing.assert_allclose(r.array("driver.cam.effort")[:-1], effort, atol=1e-6 * effort.max())
        lowest.append(effort.min())
    assert lowest[0] > 0 > lowest[1]


def test_quarter_car_with_its_python_damper():
    """The two equations of motion, with the function of the file itself called by SciPy's integrator."""
    damper = runpy.run_path(str(EXAMPLES / "vehicles" / "python-law.py"))["damper"]
    r = example("python-law")
    car, wheel, tyre, suspension, g = 320.0, 38.0, 190e3, 18e3, 9.81

    def slope(t, y):
        w, c, dw, dc = y  # from the places at rest
        bump = 0.06 * np.exp(-(((t - 0.6) / 0.05) ** 2))
        rise = bump * -2 * (t - 0.6) / 0.05**2
        below = tyre * (bump - w) + 150 * (rise - dw)  # beyond the static load
        between = suspension * (w - c) - damper(dc - dw, 0.4 + c - w, 0.32)
        return [dw, dc, (below - between) / wheel, between / car]

    # the damper's law has corners
    found = solve_ivp(slope, (0, 3), [0, 0, 0, 0], "DOP853", t_eval=r.time, rtol=1e-10, atol=1e-12, max_step=1e-3)
    # at the static position the tyre carries both weights: nothing but the bump moves the car
    assert g == G
    np.testing.assert_allclose(r.array("wheel_guide.displacement"), found.y[0], atol=1e-6)
    np.testing.assert_allclose(r.array("car_guide.displacement"), found.y[1], atol=1e-6)


def test_ball_leaves_the_floor_with_its_restitution():
    """Speed up over speed down at every bounce, each from the height of flight before and after."""
    r = example("bouncing-ball", output_interval="1 ms")
    height, speed = r.array("sensor.height"), r.array("ball.velocity.z")
    total = 0.5 * speed**2 + G * np.maximum(height, 0)  # per mass, constant in flight
    flying = height > 0.03
    starts = np.flatnonzero(flying & ~np.roll(flying, 1))
    levels = [total[max(k, 1)] for k in starts][:5]
    levels[0] = total[0]
    ratios = np.sqrt(np.divide(levels[1:], levels[:-1]))
    # the weight works on the way through the contact, 11 mm deep: half a percent
    np.testing.assert_allclose(ratios, 0.75, atol=0.01)
    assert r.array("ball.velocity.x")[-1] < 0 < r.array("ball.velocity.x")[0]
