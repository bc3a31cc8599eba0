"""A failed explicit run names the force with the fastest rate, and the step that holds it: c/m of a damper, √(k/m) of a spring."""

import pytest

from nivel import SolveError
from nivel.analysis.fastest import fastest
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
        machine(cart(damper=damper)).simulate(coordinates=coordinates)
    rate = 800.0 / inertia()
    assert f"The fastest rate here is {rate:.2g}/s, of damper" in caught.value.advice
    assert f"steps below {2.7 / rate:.2g} s" in caught.value.advice


def test_rate_of_a_spring_is_its_frequency():
    spring = {"type": "joint-spring-damper", "coordinate": "wrist.angle", "stiffness": 1e5, "damping": 0.0}
    record = machine(cart(spring=spring)).record
    prepared = prepare(record, "newton-euler", "relative")
    found = fastest(prepared.motion, 0.0, prepared.start)
    assert found.force == "spring"
    assert found.rate == pytest.approx((1e5 / inertia()) ** 0.5, rel=1e-4)


def test_a_run_that_fails_for_another_reason_names_no_force():
    broken = {"type": "force", "body": "cart", "vector": ["sqrt(0.5 - time)", 0, 0]}
    with pytest.raises(SolveError) as caught:
        machine(cart(broken=broken)).simulate()
    assert "fastest rate" not in caught.value.advice
