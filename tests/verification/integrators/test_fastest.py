"""A failed explicit run names the force with the fastest rate, and the step that holds it: c/m of a damper, √(k/m) of a spring."""

import pytest

from nivel import SolveError
from nivel.judge.during.growth import fastest
from preparing import prepare
from simulating import machine, solid

RAIL = {"type": "translational", "bodies": ["ground", "cart"], "point": [0, 0, 0], "axis": [1, 0, 0]}
ARM = {"type": "revolute", "bodies": ["cart", "arm"], "point": [1, 0, 0], "axis": [0, 0, 1]}


def cart(**forces):
    return {
        "gravity": [0, -9.81, 0],
        "bodies": {"cart": solid(2.0), "arm": solid(1.0, 0.01, position=[1.3, 0, 0])},
        "joints": {"rail": RAIL, "wrist": ARM},
        "forces": {
            "slow": {
                "type": "joint-spring-damper",
                "coordinate": "rail.displacement",
                "stiffness": 50.0,
                "damping": 3.0,
            },
            **forces,
        },
        "simulation": {"duration": 1.0, "step": 1e-3},
    }


def inertia():
    """Of the arm about its wrist, on a cart that gives way across it: at the start it does not, the arm lies along the rail."""
    return 0.01 + 0.3**2


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
def test_damper_and_its_rate_are_named(coordinates):
    damper = {"type": "joint-spring-damper", "coordinate": "wrist.angle", "stiffness": 1.0, "damping": 800.0}
    with pytest.raises(SolveError) as caught:
        machine(cart(damper=damper)).simulate(coordinates=coordinates, integrator="rk4")
    rate = 800.0 / inertia()
    assert f"The fastest rate here is {rate:.2g}/s, of damper" in caught.value.advice
    assert f"steps below {2.7 / rate:.2g} s" in caught.value.advice


def test_rate_of_a_spring_is_its_frequency():
    spring = {"type": "joint-spring-damper", "coordinate": "wrist.angle", "stiffness": 1e5, "damping": 0.0}
    record = machine(cart(spring=spring)).record
    prepared = prepare(record, "newton-euler", "relative")
    found = fastest(prepared.motion, 0.0, prepared.start)
    assert found.part == "spring"
    assert found.rate == pytest.approx((1e5 / inertia()) ** 0.5, rel=1e-4)


def test_a_law_that_overflows_with_the_motion_is_not_blamed():
    """A spring by a law, 1e9 N/m at 3 kg: it is no number any more where the place is none."""
    law = {"type": "force", "body": "cart", "vector": ["-1e9*(rail.displacement - 0.01)", 0, 0]}
    with pytest.raises(SolveError) as caught:
        machine(cart(law=law)).simulate(coordinates="relative", integrator="rk4")
    assert "the motion has grown without bound" in caught.value.message
    assert "of law: rk4 holds it with steps below" in caught.value.advice
    assert "division by zero" not in caught.value.advice


def test_a_run_that_fails_for_another_reason_names_no_force():
    broken = {"type": "force", "body": "cart", "vector": ["sqrt(0.5 - time)", 0, 0]}
    with pytest.raises(SolveError) as caught:
        machine(cart(broken=broken)).simulate(integrator="rk4")
    assert "fastest rate" not in caught.value.advice


@pytest.mark.parametrize(
    ("sections", "part", "rate"),
    [
        # ẋ = (u - x)/T
        ({"control": {"filter": {"type": "low-pass", "input": "rail.displacement_rate", "time_constant": 2e-5}}}, "filter", 5e4),
        # dp/dt = -(β/V)(dQ/dp)(p - p₀) with Q = √2 K √(p - p₀), half open
        (
            {
                "fluids": {"oil": {"density": 870.0}},
                "hydraulics": {
                    "supply": {"type": "tank", "pressure": 100e5},
                    "tank": {"type": "tank", "pressure": 1e5},
                    "block": {"type": "volume", "volume": 1e-6},
                    "inlet": {"type": "orifice", "ports": {"A": "supply", "B": "block"}, "flow": 1e-4, "pressure_drop": 1e6},
                    "outlet": {"type": "orifice", "ports": {"A": "block", "B": "tank"}, "flow": 1e-4, "pressure_drop": 1e6},
                },
            },
            "block",
            1.5e9 / 1e-6 * 2 * 1e-4 / (2 * (1e6 * 49.5e5) ** 0.5),
        ),
        (
            {"hydraulics": {}, "forces": {"servo": {"type": "force", "body": "cart", "vector": ["-1e8*rail.displacement", 0, 0]}}},
            "servo",
            (1e8 / 3.0) ** 0.5,
        ),
    ],
    ids=["block of the control", "volume of a circuit", "force that a law gives"],
)  # fmt: skip
def test_states_of_circuits_and_controls_are_named(sections, part, rate):
    """The arm lies along the rail: cart and arm move as one of 3 kg. The modulus of oil at 50 bar is a little more."""
    record = machine({**cart(), **{key: value for key, value in sections.items() if value}}).record
    prepared = prepare(record, "newton-euler", "relative")
    found = fastest(prepared.motion, 0.0, prepared.start)
    assert found.part == part
    assert found.rate == pytest.approx(rate, rel=0.1)


def test_a_red_run_names_what_is_too_fast_for_its_steps():
    """A spring of 30 rad/s, 30.3 on a cart that gives way, in steps of 0.05 s is held by rk4, and not followed: 0.3/30.3 s."""
    spring = {
        "type": "joint-spring-damper",
        "coordinate": "wrist.angle",
        "stiffness": 900.0 * inertia(),
        "free_value": 0.5,
    }
    result = machine(cart(spring=spring)).simulate(
        step=0.05, output_interval=0.05, integrator="rk4", coordinates="relative"
    )
    assert result.trust.verdict == "red"
    (item,) = [item for item in result.trust.items if item.name == "steps"]
    assert (item.verdict, item.row) == ("amber", "spring")
    assert "rk4 follows it with steps below 0.00991 s, but the step is 0.05 s" in item.text
