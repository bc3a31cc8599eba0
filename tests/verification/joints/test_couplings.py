"""Gears, belts, racks and linear couplings: ratios, accelerations and efforts in closed form."""

import numpy as np
import pytest

from simulating import G, hinge, machine, simulate, slide, solid, turning_error, wheel

FORMULATIONS = pytest.mark.parametrize("formulation", ["newton-euler", "lagrange"])
J1, J2, TORQUE = 0.02, 0.5, 3.0


def two_wheels(coupling, *, turned=False):
    """A torque on the first of two wheels; `turned`: the second one's joint is from the wheel to the ground."""
    second = ("two", "ground") if turned else ("ground", "two")
    return {
        "bodies": {"one": wheel(J1), "two": wheel(J2, position=[0.4, 0, 0])},
        "joints": {"a": hinge("ground", "one"), "b": hinge(*second, (0.4, 0, 0))},
        "couplings": {"mesh": coupling},
        "forces": {"drive": {"type": "torque", "body": "one", "vector": [0, 0, TORQUE]}},
    }


# second angle per first, with the coupling as it stands in a file
PAIRS = {
    "gear": ({"type": "gear", "joints": ["a", "b"], "teeth": [17, 51]}, -1 / 3),
    "gear-by-ratio": ({"type": "gear", "joints": ["a.angle", "b.angle"], "ratio": 3}, -1 / 3),
    "internal": ({"type": "gear", "joints": ["a", "b"], "teeth": [17, 51], "internal": True}, 1 / 3),
    "belt": ({"type": "belt", "joints": ["a", "b"], "radii": [0.04, 0.1]}, 0.4),
    "crossed-belt": ({"type": "belt", "joints": ["a", "b"], "radii": [0.04, 0.1], "crossed": True}, -0.4),
    "linear": ({"type": "linear", "coordinates": ["a.angle", "b.angle"], "factors": [2.0, 5.0]}, -0.4),
}


@FORMULATIONS
@pytest.mark.parametrize("name", PAIRS)
def test_two_coupled_wheels(name, formulation):
    """α1 = T/(J1 + r² J2), α2 = r α1; the coupling's effort on the first is what T lacks: J1 α1 - T."""
    coupling, ratio = PAIRS[name]
    r = simulate(two_wheels(coupling), duration=2.0, step=1e-3, formulation=formulation)
    t = r.time
    alpha = TORQUE / (J1 + ratio**2 * J2)
    angle = 0.5 * alpha * t**2
    assert angle[-1] > 8 * np.pi  # the coupling counts whole turns
    share = turning_error(alpha * 2.0, 1e-3)
    np.testing.assert_allclose(r.array("a.angle"), angle, rtol=share, atol=1e-11)
    np.testing.assert_allclose(r.array("b.angle"), ratio * angle, rtol=share, atol=1e-11)
    # the coupling itself is closed to round-off
    np.testing.assert_allclose(r.array("b.angle"), ratio * r.array("a.angle"), atol=1e-12 * angle[-1])
    np.testing.assert_allclose(r.array("b.angle.rate"), ratio * alpha * t, rtol=share, atol=1e-10)
    np.testing.assert_allclose(r.array("coupling.mesh.effort"), J1 * alpha - TORQUE, rtol=1e-9)
    np.testing.assert_allclose(r.array("energy_error"), 0, atol=2 * share * r.array("kinetic_energy")[-1])


def test_a_joint_the_other_way_round_turns_the_sense():
    """b counts the ground against the wheel: the wheel turns with the opposite sense."""
    r = simulate(two_wheels(PAIRS["gear"][0], turned=True), duration=1.0, step=1e-3)
    alpha = TORQUE / (J1 + J2 / 9)
    np.testing.assert_allclose(r.array("two.angular_velocity.z"), alpha * r.time / 3, rtol=1e-10, atol=1e-10)


def test_bearings_of_a_gear_feel_no_tooth_force():
    """A coupling of coordinates is an ideal gear without a pitch circle: its efforts are torques, bearings are free."""
    r = simulate(two_wheels(PAIRS["gear"][0]), duration=0.5, step=1e-3)
    np.testing.assert_allclose(r.array("joint_force"), 0, atol=1e-10)


@FORMULATIONS
@pytest.mark.parametrize("radius", [0.05, -0.05])
def test_pinion_pulls_its_rack_up(radius, formulation):
    """Mass m on a vertical slide: T = (J + m r²) α + m g r for displacement = r angle."""
    m = 4.0
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"pinion": wheel(J1), "bar": solid(m, 0.1)},
        "joints": {"p": hinge("ground", "pinion"), "s": slide("ground", "bar", (0, 1, 0))},
        "couplings": {"mesh": {"type": "rack", "joints": ["p", "s"], "radius": radius}},
        "forces": {"drive": {"type": "torque", "body": "pinion", "vector": [0, 0, TORQUE]}},
    }
    r = simulate(sections, duration=1.5, step=1e-3, formulation=formulation)
    alpha = (TORQUE - m * G * radius) / (J1 + m * radius**2)
    angle = 0.5 * alpha * r.time**2
    share = turning_error(alpha * 1.5, 1e-3)
    np.testing.assert_allclose(r.array("p.angle"), angle, rtol=share, atol=1e-11)
    np.testing.assert_allclose(r.array("s.displacement"), radius * angle, rtol=share, atol=1e-11)


def planetary(sun=24, ring=66):
    """Sun driven, ring fixed, carrier out. One planet, turning on the carrier; angles are seen from the carrier."""
    planet = (ring - sun) // 2
    module = 2e-3
    arm = module * (sun + planet) / 2
    sections = {
        "bodies": {
            "sun": wheel(1e-3),
            "carrier": wheel(8e-3),
            "planet": solid(0.2, (5e-5, 5e-5, 8e-5), position=[arm, 0, 0]),
        },
        "joints": {
            "carrier_ring": hinge("carrier", "ground"),
            "carrier_sun": hinge("carrier", "sun"),
            "carrier_planet": hinge("carrier", "planet", (arm, 0, 0)),
        },
        "couplings": {
            "outer": {"type": "gear", "joints": ["carrier_sun", "carrier_planet"], "teeth": [sun, planet]},
            "inner": {
                "type": "gear",
                "joints": ["carrier_planet", "carrier_ring"],
                "teeth": [planet, ring],
                "internal": True,
            },
        },
        "forces": {"drive": {"type": "torque", "body": "sun", "vector": [0, 0, 0.1]}},
    }
    return sections, planet, arm


@FORMULATIONS
def test_planetary_gear_obeys_willis(formulation):
    """(ω_s - ω_c)/(ω_r - ω_c) = -n_r/n_s with ω_r = 0; torque 0.1 N m against all inertias reflected to the sun."""
    sun, ring = 24, 66
    sections, planet, arm = planetary(sun, ring)
    r = simulate(sections, duration=1.0, step=1e-3, formulation=formulation)
    carrier = 1 / (1 + ring / sun)  # ω_c/ω_s
    spin = carrier * (1 - ring / planet)  # ω_p/ω_s: the planet rolls in the ring
    reflected = 1e-3 + carrier**2 * (8e-3 + 0.2 * arm**2) + spin**2 * 8e-5
    omega = 0.1 / reflected * r.time
    share = turning_error(omega[-1], 1e-3)
    np.testing.assert_allclose(r.array("sun.angular_velocity.z"), omega, rtol=share, atol=1e-9)
    np.testing.assert_allclose(r.array("carrier.angular_velocity.z"), carrier * omega, rtol=share, atol=1e-9)
    np.testing.assert_allclose(r.array("planet.angular_velocity.z"), spin * omega, rtol=share, atol=1e-9)


@FORMULATIONS
def test_differential_shares_the_torque(formulation):
    """2 c = l + r on three shafts: with the multiplier κ, J_c α_c = T + 2 κ, J_l α_l = -κ, J_r α_r = -κ - T_r."""
    Jc, Jl, Jr, T, brake = 0.05, 0.02, 0.03, 2.0, 0.5
    sections = {
        "bodies": {"cage": wheel(Jc), "left": wheel(Jl), "right": wheel(Jr)},
        "joints": {name[0]: hinge("ground", name) for name in ("cage", "left", "right")},
        "couplings": {"diff": {"type": "linear", "coordinates": ["c", "l.angle", "r.angle"], "factors": [2, -1, -1]}},
        "forces": {
            "drive": {"type": "torque", "body": "cage", "vector": [0, 0, T]},
            "brake": {"type": "torque", "body": "right", "vector": [0, 0, -brake]},
        },
    }
    r = simulate(sections, duration=1.0, step=1e-3, formulation=formulation)
    # 2 α_c = α_l + α_r: 2 (T + 2 κ)/Jc = -κ/Jl - (κ + brake)/Jr
    kappa = -(2 * T / Jc + brake / Jr) / (4 / Jc + 1 / Jl + 1 / Jr)
    expected = np.array([(T + 2 * kappa) / Jc, -kappa / Jl, (-kappa - brake) / Jr])
    found = np.stack([r.array(f"{name}.angle.rate") for name in "clr"], axis=1)
    share = turning_error(np.abs(expected).max(), 1e-3)
    np.testing.assert_allclose(found, np.outer(r.time, expected), rtol=share, atol=share * np.abs(expected).max())
    np.testing.assert_allclose(r.array("coupling.diff.effort"), 2 * kappa, rtol=1e-9)


def test_coupling_takes_one_freedom():
    assert machine(two_wheels(PAIRS["gear"][0])).check().degrees_of_freedom == 1
    assert machine(planetary()[0]).check().degrees_of_freedom == 1


def test_coupled_start_rates_are_made_consistent():
    """The first wheel turns at the start, the second is said to stand still: together they keep the coupling."""
    sections = two_wheels(PAIRS["gear"][0])
    sections["bodies"]["one"]["angular_velocity"] = [0, 0, 9.0]
    del sections["forces"]
    r = simulate(sections, duration=0.1, step=1e-3)
    a, b = r.array("a.angle.rate"), r.array("b.angle.rate")
    np.testing.assert_allclose(17 * a + 51 * b, 0, atol=1e-11)
    assert abs(a[0]) > 0.1
