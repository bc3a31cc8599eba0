"""A rope on the wrong side of a wheel begins the run stretched by tens of per cent, which `check` and the trust report say."""

from __future__ import annotations

from nivel import Machine
from nivel.files import parse_machine

MACHINE = """
format: 1
gravity: [0, 0, -9.81]
bodies:
  bob: {position: [-0.8660254, 0, -0.5], mass: 1, inertia: [1e-4, 1e-4, 1e-4]}
joints:
  plane: {type: planar, bodies: [ground, bob], point: [-0.8660254, 0, -0.5], axis: [0, 1, 0]}
forces:
  rope: {type: rope, bodies: [ground, ground, bob], points: [[0, 0, 0], [0.2, 0, -0.5], [-0.8660254, 0, -0.5]],
         radii: [0, RADIUS, 0], axis: [0, 1, 0], stiffness: 1e6, damping: 50, length: LENGTH}
simulation: {duration: 2 ms, step: 10 us, integrator: rk4, output_interval: 1 ms}
"""


def machine(radius: str, length: str, stiffness: str = "1e6") -> Machine:
    text = MACHINE.replace("RADIUS", radius).replace("LENGTH", length).replace("1e6", stiffness)
    return Machine.from_record(parse_machine(text))


def test_the_other_sign_of_a_radius_is_named() -> None:
    said = str(machine("0.2", "1.5 m").check())
    assert "longer than `length`" in said
    assert "on the other side of the wheel at point 2" in said
    assert "`radii: [0, -0.2, 0]`" in said
    assert "longer than `length`" not in str(machine("-0.2", "1.5 m").check())


def test_rubber_may_be_stretched() -> None:
    assert "longer than `length`" not in str(machine("0.2", "1.5 m", "1e3").check())


def test_the_light_is_not_green() -> None:
    trust = machine("0.2", "1.5 m").simulate(verify=False).trust
    assert trust.verdict != "green"
    assert "longer than `length`" in str(trust)
