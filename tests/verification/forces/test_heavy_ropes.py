"""Ropes with mass per length, against motions of the whole rope along its way in closed form."""

import numpy as np
import pytest

from nivel.errors import ModelError, SolveError
from simulating import G, hinge, machine, simulate, slide, solid

PER_LENGTH, RADIUS = 2.0, 0.05
STIFF = {"stiffness": 2e7, "damping": 2e3}  # of the rope: it stretches by 1e-5


def atwood(first=3.0, second=5.0, drops=(1.0, 2.0), **more):
    """Two loads on vertical rails, and a heavy rope over a pulley on the ground."""
    places = [[-RADIUS, -drops[0], 0], [0, 0, 0], [RADIUS, -drops[1], 0]]
    return {
        "gravity": [0, -G, 0],
        "bodies": {"a": solid(first, position=places[0]), "b": solid(second, position=places[2])},
        "joints": {
            "ra": slide("ground", "a", (0, 1, 0), point=places[0]),
            "rb": slide("ground", "b", (0, 1, 0), point=places[2]),
        },
        "forces": {
            "rope": {
                "type": "rope",
                "bodies": ["a", "ground", "b"],
                "points": places,
                # up on the left side, over the pulley, down on the right: left-handed about z
                "radii": [0, -RADIUS, 0],
                "axis": [0, 0, 1],
                "mass_per_length": PER_LENGTH,
                **STIFF,
                **more,
            }
        },
    }


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("integrator", ["radau", "generalised-alpha"])
def test_atwoods_machine_with_a_heavy_rope(integrator, coordinates):
    """x'' = ((m₂ - m₁) + m' (l₂ - l₁)) g/(m₁ + m₂ + m' L) with l₂ - l₁ = d + 2 x: x = (d + D)/2 (cosh κt - 1), κ² = 2 m' g/M."""
    first, second, drops = 3.0, 5.0, (1.0, 2.0)
    steps = {"tolerance": 1e-8} if integrator == "radau" else {"step": 1e-3}
    settings = {"duration": 0.6, "output_interval": 0.1, "integrator": integrator, "coordinates": coordinates}
    result = simulate(atwood(first, second, drops), **settings, **steps)
    length = sum(drops) + np.pi * RADIUS
    whole = first + second + PER_LENGTH * length
    kappa = np.sqrt(2.0 * PER_LENGTH * G / whole)
    lead = 0.5 * ((second - first) / PER_LENGTH + drops[1] - drops[0])
    x = lead * (np.cosh(kappa * result.time) - 1.0)
    # the rope is longer by T/k, 3e-6 m
    np.testing.assert_allclose(-result.array("rb.displacement"), x, atol=2e-5)
    np.testing.assert_allclose(result.array("ra.displacement"), x, atol=2e-5)
    np.testing.assert_allclose(
        result.array("state.rope.run")[1:], (lead * kappa * np.sinh(kappa * result.time))[1:], rtol=1e-3
    )
    # m₂ (g - x'') is what holds the second load
    pull = second * (G - lead * kappa**2 * np.cosh(kappa * result.time))
    np.testing.assert_allclose(result.array("force.rope.last_tension")[1:], pull[1:], rtol=2e-3)
    assert np.abs(result.array("energy_error")).max() < 2e-2


def test_a_rope_slides_from_a_table():
    """(m₁ + m₂ + m' L) s'' = (m' (h + R + s) + m₂) g: the rope on the table is R higher than the axle, and pulls with m₁ s'' only."""
    first, second, on, hangs, radius = 0.2, 0.05, 1.2, 0.3, 0.1
    sections = atwood(first, second)
    places = [[-on, radius, 0], [0, 0, 0], [radius, -hangs, 0]]
    for name, joint, place, axis in (("a", "ra", places[0], (1, 0, 0)), ("b", "rb", places[2], (0, -1, 0))):
        sections["bodies"][name]["position"] = place
        sections["joints"][joint] = slide("ground", name, axis, point=place)
    sections["forces"]["rope"] |= {"points": places, "radii": [0, -radius, 0], "stiffness": 1e6, "damping": 1e3}
    result = simulate(sections, duration=0.5, output_interval=0.05, integrator="radau", tolerance=1e-8)
    whole = first + second + PER_LENGTH * (on + hangs + 0.5 * np.pi * radius)
    kappa, lead = np.sqrt(PER_LENGTH * G / whole), hangs + radius + second / PER_LENGTH
    s = lead * (np.cosh(kappa * result.time) - 1.0)
    np.testing.assert_allclose(result.array("ra.displacement"), s, atol=5e-5)
    np.testing.assert_allclose(result.array("rb.displacement"), s, atol=5e-5)
    pull = first * lead * kappa**2 * np.cosh(kappa * result.time)
    np.testing.assert_allclose(result.array("force.rope.magnitude")[2:], pull[2:], rtol=1e-3)
    assert np.abs(result.array("energy_error")).max() < 1e-4


def test_the_weight_of_a_rope_tilts_its_wheels():
    """Two wheels on a body that turns about a point, in a gravity in no direction of theirs: nothing is lost while the rope is taut."""
    ends = {"a": [-1.0, 0.05, -0.3], "b": [0.3, 0.1, -1.0]}
    sections = {
        "gravity": [0.5, 1.0, -9.0],
        "bodies": {
            "carrier": {**solid(6.0, (0.2, 0.3, 0.2), position=[0, 0, 0.1]), "angular_velocity": [0.7, 0, 0]},
            "a": solid(4.0, position=ends["a"]),
            "b": solid(6.0, position=ends["b"]),
        },
        "joints": {"ball": {"type": "spherical", "bodies": ["ground", "carrier"], "point": [0, 0, 0.05]}},
        "forces": {
            "rope": {
                "type": "rope",
                "bodies": ["a", "carrier", "carrier", "b"],
                "points": [ends["a"], [-0.2, 0, 0], [0.1, 0, -0.1], ends["b"]],
                "radii": [0, 0.12, 0.07, 0],
                "axis": [0, 1, 0],
                "mass_per_length": PER_LENGTH,
                "stiffness": 3e3,
                "length": 1.9,
            }
        },
    }
    result = simulate(sections, duration=0.04, output_interval=0.005, integrator="radau", tolerance=1e-9)
    assert np.ptp(result.array("potential_energy")) > 10.0
    assert result.array("force.rope.stretch").min() > 0.0
    assert np.abs(result.array("energy_error")).max() < 1e-7


def held(second=5.0, **more):
    """The same with the first end on the ground."""
    sections = atwood(second=second, **more)
    del sections["bodies"]["a"], sections["joints"]["ra"]
    sections["forces"]["rope"]["bodies"] = ["ground", "ground", "b"]
    return sections


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_a_rope_hangs_by_its_weight(coordinates):
    """The tension grows by m' g with the height: at the load it is m g, at the first end, a metre higher, m g + m' g · 1 m."""
    result = machine(held(length=3.0 + np.pi * RADIUS - 1e-5)).statics(coordinates=coordinates)
    assert result.array("force.rope.last_tension")[-1] == pytest.approx(5.0 * G, rel=1e-8)
    assert result.array("force.rope.magnitude")[-1] == pytest.approx((5.0 + PER_LENGTH) * G, rel=1e-4)


def test_turns_on_a_drum_turn_with_it():
    """A drum of inertia I with all of a rope on it but what hangs, and a load: (m + m' L + I/R²) x'' = (m + m' l) g, l = l₀ + x."""
    turns, inertia, mass, hangs = 3.0, 0.02, 4.0, 0.5
    sections = {
        "gravity": [0, -G, 0],
        "bodies": {"drum": solid(10.0, (0.02, 0.02, inertia)), "load": solid(mass, position=[RADIUS, -hangs, 0])},
        "joints": {
            "axle": hinge("ground", "drum"),
            "rail": slide("ground", "load", (0, 1, 0), point=[RADIUS, -hangs, 0]),
        },
        "forces": {
            "rope": {
                "type": "rope",
                "bodies": ["drum", "load"],
                "points": [[0, 0, 0], [RADIUS, -hangs, 0]],
                "radii": [-RADIUS, 0],
                "wound": [turns, 0],
                "axis": [0, 0, 1],
                "mass_per_length": PER_LENGTH,
                **STIFF,
            }
        },
    }
    result = simulate(sections, duration=0.3, output_interval=0.05, integrator="radau", tolerance=1e-8)
    length = hangs + turns * 2.0 * np.pi * RADIUS
    kappa = np.sqrt(PER_LENGTH * G / (mass + PER_LENGTH * length + inertia / RADIUS**2))
    x = (mass / PER_LENGTH + hangs) * (np.cosh(kappa * result.time) - 1.0)
    np.testing.assert_allclose(-result.array("rail.displacement"), x, atol=2e-5)
    np.testing.assert_allclose(np.abs(result.array("axle.angle")), x / RADIUS, atol=2e-5 / RADIUS)


def test_a_winch_feeds_rope_that_runs():
    """A winch that pays rope out evenly over the pulley: the load goes down at v, and the rope's mass at the first end grows with m' v."""
    speed = 0.4
    sections = held(speed=speed, start_speed=speed)
    sections["joints"]["rb"]["start_rates"] = {"displacement": -speed}
    result = simulate(sections, duration=0.5, output_interval=0.05, integrator="radau", tolerance=1e-8)
    np.testing.assert_allclose(-result.array("rb.displacement"), speed * result.time, atol=3e-5)
    np.testing.assert_allclose(result.array("force.rope.last_tension")[-1], 5.0 * G, rtol=1e-2)
    assert np.abs(result.array("energy_error")).max() < 1e-2


def test_an_end_within_a_wheel_is_told():
    sections = held()
    sections["bodies"]["b"] |= {"position": [0.5 * RADIUS, -0.2, 0], "velocity": [0, 3.0, 0]}
    sections["joints"]["rb"] = slide("ground", "b", (0, 1, 0), point=[0.5 * RADIUS, -0.2, 0])
    sections["forces"]["rope"]["points"][-1] = [0.5 * RADIUS, -0.2, 0]
    with pytest.raises(SolveError, match="an end of rope come into one of its wheels"):
        simulate(sections, duration=0.2, integrator="rk4", step=1e-4)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"friction": 0.2}, "goes without `mass_per_length`"),
        ({"radii": None, "axis": None, "length": 3.0}, "belongs to `radii`"),
        ({"mass_per_length": None, "start_speed": 1.0}, "belongs to `mass_per_length`"),
    ],
    ids=["friction", "no wheels", "no mass"],
)
def test_what_a_heavy_rope_cannot_be_is_told(change, said):
    sections = atwood(**change)
    sections["forces"]["rope"] = {key: value for key, value in sections["forces"]["rope"].items() if value is not None}
    with pytest.raises(ModelError, match=said):
        machine(sections)
