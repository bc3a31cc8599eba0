"""Zeros by structure, told from slow motions beside fast ones, by closed forms: whatever the units, the slenderness and the direction."""

import numpy as np
import pytest

import nivel
from simulating import machine

YOUNG, DENSITY, HEIGHT = 210e9, 7850.0, 20e-3
STEEL = {"youngs_modulus": YOUNG, "poisson_ratio": 0.3, "density": DENSITY}
CLAMPED, FREE = 1.875104068711961, 4.730040744862704  # cos β cosh β = -1, = 1


def strip(thickness, direction, *, clamped=True, damping=0.0):
    """A steel strip, 1 m long, from the origin."""
    end = np.array(direction, dtype=float) / np.linalg.norm(direction)
    beam = {"from": [0, 0, 0], "to": end.tolist(), "section": rectangle(thickness, HEIGHT), "material": STEEL}
    wall = {"type": "fixed", "bodies": ["ground", "strip.start"], "point": [0, 0, 0]}
    joints = {"joints": {"wall": wall}} if clamped else {}
    return machine({"beams": {"strip": {**beam, "order": 2, "elements": 6, "damping": damping}}, **joints})


def rectangle(width, height):
    return {"type": "rectangle", "width": width, "height": height}


def bending(beta, thickness):
    """Euler's and Bernoulli's frequency β² √(E I/ρ A), l = 1 m."""
    return beta**2 * np.sqrt(YOUNG * thickness**2 / (12.0 * DENSITY))


def moving(model):
    return model.eigenvalues[~model.structural]


@pytest.mark.parametrize("direction", [(1, 0, 0), (1, 2, 3)])
@pytest.mark.parametrize("thickness", [2e-3, 2e-4])
def test_a_thin_strip_keeps_its_first_vibration(thickness, direction):
    """Its stiffness is a share of 1e-14 to 1e-16 of that of its fastest vibration."""
    model = strip(thickness, direction).linearise()
    assert not model.structural.any()
    np.testing.assert_allclose(np.abs(model.eigenvalues[:2]), bending(CLAMPED, thickness), rtol=3e-4)
    assert not np.any(model.eigenvalues.real)


def test_a_thin_strip_has_the_vibrations_of_statics():
    thin = strip(2e-3, (1, 0, 0))
    wanted = thin.statics(duration=0, modes=3).array("natural_frequency")[0]
    found = [mode.natural_frequency for mode in thin.linearise().modes[:3]]
    np.testing.assert_allclose(found, wanted, rtol=1e-7)
    np.testing.assert_allclose(found, [1.671, 10.473, 16.705], rtol=1e-3)


def test_a_damped_thin_strip_decays_as_slowly_as_its_material_says():
    """s² + c ω² s + ω² = 0."""
    damping, plain = 1e-4, strip(2e-3, (1, 2, 3)).linearise()
    model = strip(2e-3, (1, 2, 3), damping=damping).linearise()
    squares = np.sort(np.abs(plain.eigenvalues))[:6:2] ** 2
    np.testing.assert_allclose(-np.sort(-moving(model).real)[:6:2], -0.5 * damping * squares, rtol=1e-3)


@pytest.mark.parametrize("direction", [(1, 0, 0), (1, 2, 3)])
@pytest.mark.parametrize("thickness", [2e-3, 2e-4])
def test_a_free_thin_strip_has_twelve_zeros_and_no_more(thickness, direction):
    model = strip(thickness, direction, clamped=False).linearise()
    assert int(model.structural.sum()) == 12
    np.testing.assert_allclose(np.abs(moving(model)[:2]), bending(FREE, thickness), rtol=2e-3)
    assert model.stable


def free_ring(width, radius, elements):
    """Two half circles joined at both ends."""
    common = {"section": rectangle(width, width), "material": STEEL, "order": 2, "elements": elements}
    left, right, top, bottom = [-radius, 0, 0], [radius, 0, 0], [0, radius, 0], [0, -radius, 0]
    return {
        "beams": {
            "upper": {"from": right, "via": top, "to": left, **common},
            "lower": {"from": left, "via": bottom, "to": right, **common},
        },
        "joints": {
            "left": {"type": "fixed", "bodies": ["upper.end", "lower.start"], "point": left},
            "right": {"type": "fixed", "bodies": ["lower.end", "upper.start"], "point": right},
        },
    }


def test_a_closed_free_ring_is_stable():
    """ω² = n² (n² - 1)²/(n² + 1) E I/(ρ A R⁴) of its ovals, n = 2, 3 (Love 1927, section 293)."""
    width, radius = 20e-3, 1.0
    model = machine(free_ring(width, radius, 5)).linearise()
    assert int(model.structural.sum()) == 12
    assert model.stable
    n = np.array([2.0, 3.0])
    ovals = np.sqrt(n**2 * (n**2 - 1.0) ** 2 / (n**2 + 1.0) * YOUNG * width**2 / (12.0 * DENSITY * radius**4))
    found = moving(model).imag
    for oval in ovals:
        assert np.sum(np.abs(found / oval - 1.0) < 1e-2) == 2


def test_a_ring_that_is_only_free_as_a_whole_is_no_mechanism():
    """Alone it rests as drawn; squeezed by a spring it has an equilibrium whose place nothing determines: it stays about where it is."""
    ring = free_ring(20e-3, 1.0, 4)
    trust = machine(ring).statics(duration=0, verify=False).trust
    assert trust.verdict == "amber"
    assert "nothing holds the machine as a whole in 6 motions" in str(trust)
    ends = [{"body": "upper.start"}, {"body": "upper.end"}]
    spring = {"type": "spring-damper", "markers": ends, "stiffness": 1000.0, "free_length": 1.9}
    squeezed = machine({**ring, "forces": {"spring": spring}}).statics(duration=0, verify=False)
    assert "nothing holds the machine as a whole in 6 motions" in str(squeezed.trust)


def test_a_closed_free_ring_of_many_elements_is_stable_in_statics_too():
    """Its six rigid motions are no directions of negative stiffness, as counted by pivots where a machine is large."""
    result = machine(free_ring(20e-3, 1.0, 12)).statics(duration=0, modes=8)
    np.testing.assert_array_equal(result.array("unstable_directions"), [0])
    np.testing.assert_array_equal(result.array("natural_frequency")[0, :6], 0.0)


@pytest.mark.parametrize(("share", "unstable"), [(0.9, 0), (1.1, 2), (10.0, 4)])
def test_a_large_column_is_unstable_in_as_many_directions_as_loads_are_passed(share, unstable):
    """P = π² E I/4 l² and 9 times that, in both planes of a square section; 43 nodes."""
    width, length = 20e-3, 2.0
    beam = {"from": [0, 0, 0], "to": [0, 0, length], "section": rectangle(width, width), "material": STEEL}
    load = share * np.pi**2 * YOUNG * width**4 / (48.0 * length**2)
    column = machine(
        {
            "beams": {"column": {**beam, "order": 2, "elements": 21}},
            "joints": {"wall": {"type": "fixed", "bodies": ["ground", "column.start"], "point": [0, 0, 0]}},
            "forces": {"weight": {"type": "force", "body": "column.end", "vector": [0, 0, -load]}},
        }
    )
    np.testing.assert_array_equal(column.statics(duration=0).array("unstable_directions"), [unstable])


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_a_column_below_its_flutter_load_does_not_grow(share):
    """Beck's column flutters at 20.05 E I/l². Below it vibrates without damping beside motions of 6e5/s, also where the load is put on at
    once and round-off parts its two planes."""
    radius, length = 0.01, 1.0
    load = share * 20.05 * YOUNG * np.pi * radius**4 / (4.0 * length**2)
    round_bar = {"type": "circle", "radius": radius}
    column = machine(
        {
            "beams": {"column": {"from": [0, 0, 0], "to": [0, 0, length], "section": round_bar, "material": STEEL, "elements": 8}},
            "joints": {"wall": {"type": "fixed", "bodies": ["ground", "column.start"], "point": [0, 0, 0]}},
            "forces": {"follower": {"type": "force", "body": "column.end", "vector": [0, 0, -load], "axes": "body"}},
        }
    )  # fmt: skip
    for about in ("start", "equilibrium"):
        found = column.linearise(about=about, verify=False)
        assert found.stable
        assert {mode.kind for mode in found.modes} == {"undamped vibration"}


# --- slow motions of few masses ---


def masses(soft, stiff, soft_damping=0.0, push=0.0):
    """Two masses of 2 kg on a rail, `soft` and its damper to the ground, `stiff` between them. push : times both speeds."""
    bodies = [nivel.Body(name=name, mass=2.0, inertia=(1, 1, 1)) for name in ("a", "b")]
    joints = [
        nivel.Joint(name=f"rail_{name}", type="translational", bodies=("ground", name), point=(0, 0, 0), axis=(1, 0, 0))
        for name in ("a", "b")
    ]
    forces = [
        nivel.JointSpringDamper(name="soft", coordinate="rail_a", stiffness=soft, damping=soft_damping),
        nivel.Motor(name="right", coordinate="rail_b", effort=f"{stiff!r}*(rail_a.displacement - rail_b.displacement)"),
        nivel.Motor(name="left", coordinate="rail_a", effort=f"{stiff!r}*(rail_b.displacement - rail_a.displacement)"),
    ]
    if push:
        speed = "(rail_a.displacement_rate + rail_b.displacement_rate)"
        forces.append(nivel.Motor(name="push", coordinate="rail_a", effort=f"{push!r}*{speed}"))
    return nivel.Machine("masses", bodies=bodies, joints=joints, forces=forces)


def test_a_soft_spring_beside_a_stiff_one_is_no_zero():
    model = masses(0.04, 1e9).linearise()
    assert not model.structural.any()
    np.testing.assert_allclose(np.abs(model.eigenvalues[:2]), 0.1, rtol=1e-3)
    np.testing.assert_allclose(np.abs(model.eigenvalues[2:]), np.sqrt(1e9), rtol=1e-9)


def test_growth_that_round_off_hides_is_told():
    """4 kg on 0.04 N/m under a push c (v + v) grow by c/4 beside 3e4 rad/s, of whose forces 1e9 N the last digit is 1e-7 N."""
    grows = masses(0.04, 1e9, push=8e-4).linearise()
    np.testing.assert_allclose(grows.eigenvalues[0].real, 2e-4, atol=grows.round_off[0])
    assert not grows.stable
    assert grows.trust.light == "green"
    unsure = masses(0.04, 1e9, push=8e-6).linearise()
    np.testing.assert_allclose(unsure.eigenvalues[0].real, 2e-6, atol=unsure.round_off[0])
    assert unsure.stable
    assert [item.name for item in unsure.trust.items if item.verdict == "amber"] == ["growth"]


def test_a_slow_decay_beside_a_fast_vibration_is_no_zero():
    """Both masses together are slowed by the damper: λ = 0, by the place, and λ = -d/(2 m)."""
    model = masses(0.0, 1e9, 4e-5).linearise()
    assert int(model.structural.sum()) == 1
    np.testing.assert_allclose(min(moving(model), key=abs), -1e-5, rtol=1e-6)


def test_masses_that_nothing_holds_have_two_zeros():
    model = masses(0.0, 1e9).linearise()
    assert int(model.structural.sum()) == 2
    np.testing.assert_allclose(np.abs(moving(model)), np.sqrt(1e9), rtol=1e-9)


def test_a_slow_state_beside_a_fast_vibration_is_no_zero():
    """ẋ = (displacement - x)/τ with τ of a year."""
    record = masses(10.0, 1e9).record
    slow = nivel.State(name="slow", rate="(rail_a.displacement - slow.value)/3e7", start=0.0, scale=1.0)
    model = nivel.Machine.from_record(record.replace(states=(slow,))).linearise()
    assert not model.structural.any()
    np.testing.assert_allclose(model.eigenvalues[0], -1.0 / 3e7, rtol=1e-9)
