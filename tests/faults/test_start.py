"""Starts that are not what the machine file says: amber, with what was changed and by how much."""

from pathlib import Path

import pytest

import nivel
from simulating import hinge, machine, solid

FAULT = Path(__file__).parent / "t10-start.yaml"


def lines(trust):
    return [item for item in trust.items if item.name == "start"]


def test_a_moved_body_and_a_changed_velocity_are_amber():
    """8 rad/s given and 6.94 taken, a body moved by 86 mm."""
    result = nivel.load(FAULT).simulate(verify=False)
    moved, changed = lines(result.trust)
    assert (moved.verdict, changed.verdict) == ("amber", "amber")
    assert "b was moved by 0.0862 m" in moved.text
    assert "1.06 rad/s" in changed.text
    assert result.array("a.angular_velocity")[0, 2] == pytest.approx(8.0 - 1.06, abs=5e-3)


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ({"angular_velocity": [0, 0, 8], "velocity": [0, 4, 0]}, []),  # ω r = 8 · 0.5
        ({"angular_velocity": [0, 0, 8], "velocity": [0, 4.004, 0]}, []),  # rounded
        ({"angular_velocity": [0, 0, 8]}, []),  # the velocity follows
        ({"angular_velocity": [0, 0, 8], "velocity": [0, 1, 0]}, ["amber"]),
        ({}, []),
    ],
)
def test_velocities_that_fit_the_joints_are_green(given, expected):
    pendulum = machine(
        {"bodies": {"rod": solid(1.0, position=[0.5, 0, 0], **given)}, "joints": {"pin": hinge("ground", "rod")}}
    )
    trust = pendulum.simulate(verify=False, duration=0.01).trust
    assert [item.verdict for item in lines(trust)] == expected


ROCKER = """\
format: 1
gravity: [0, 0, -9.81]
bodies:
  bar: {{mass: 1, inertia: [0.1, 0.1, 0.1], position: [0.1, 0, 1]}}
joints:
  hinge: {{type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 1, 0]}}
forces:
  spring: {{type: joint-spring-damper, coordinate: hinge.angle, stiffness: {stiffness} N*m/rad, damping: 10}}
simulation: {{duration: 0.02, step: 1 ms, start: equilibrium}}
"""


@pytest.mark.parametrize(("stiffness", "verdict"), [(1.0, "amber"), (200.0, "green")])
def test_an_equilibrium_that_snapped_through_is_a_line(tmp_path, stiffness, verdict):
    """A bar that stands on a spring is stable for k > m g l = 9.9 N m; with less it falls to the other side."""
    path = tmp_path / "rocker.yaml"
    path.write_text(ROCKER.format(stiffness=stiffness), encoding="utf-8")
    result = nivel.load(path).simulate(verify=False)
    angle = abs(float(result.array("hinge.angle")[0]))
    assert (angle > 0.5) == (verdict == "amber")
    lines = [item for item in result.trust.items if item.name == "start"]
    assert [item.verdict for item in lines] == (["amber"] if verdict == "amber" else [])
    assert all("snapped through" in item.text and item.row == "bar" for item in lines)


@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_a_ball_begins_at_rest_on_a_plane_with_friction(friction):
    """K δ^1.5 = m g, and no effort of friction: the machine of the equilibrium has none, and rows of another number."""
    record = machine(
        {
            "gravity": [0, 0, -9.81],
            "bodies": {"ball": {"shape": {"type": "sphere", "radius": 0.3}, "mass": 20, "position": [0, 0, 0.3]}},
            "joints": {"p": {"type": "planar", "bodies": ["ground", "ball"], "point": [0, 0, 0.3], "axis": [0, 1, 0]}},
            "forces": {
                "road": {
                    "type": "contact",
                    "body": "ball",
                    "plane": {"body": "ground", "axis": [0, 0, 1]},
                    "stiffness": 1e6,
                }
                | {"restitution": 0.3, "friction": friction}
            },
            "simulation": {"duration": 0.05, "start": "equilibrium", "free": ["p.x", "p.angle"]},
        }
    )
    result = record.simulate(verify=False)
    depth = (20 * 9.81 / 1e6) ** (2 / 3)
    assert result.array("ball.position")[:, 2] == pytest.approx(0.3 - depth, abs=1e-9)
    assert abs(result.array("ball.velocity")).max() < 1e-8


def test_friction_that_alone_holds_a_body_is_told_where_no_equilibrium_is_found():
    """A box on a slope lies still in a run; equilibria have no friction of contacts."""
    sections = {
        "gravity": [0, 0, -9.81],
        "bodies": {"box": {"shape": {"type": "box", "size": [0.3, 0.2, 0.2]}, "mass": 2, "position": [0, 0, 0.1]}},
        "forces": {
            "floor": {
                **{"type": "contact", "body": "box", "plane": {"body": "ground", "axis": [0.1, 0, 1]}},
                **{"stiffness": 1e5, "exponent": 1, "restitution": 0.3, "friction": 0.5},
            }
        },
        "simulation": {"duration": 0.05, "start": "equilibrium"},
    }
    with pytest.raises(nivel.SolveError, match="begins with `start: as-given`"):
        machine(sections).simulate(verify=False)


SLIP = """\
format: 1
gravity: [0, -9.81, 0]
bodies:
  boom: {position: [0, 1, 0], mass: 600 kg, centre_of_mass: [2, 0, 0], inertia: [20, 900, 900]}
joints:
  hinge: {type: revolute, bodies: [ground, boom], point: [0, 1, 0], axis: [0, 0, 1]}
hydraulics:
  tank: {type: tank}
  leak: {type: orifice, ports: {A: lift.B, B: tank}, flow: 1 L/min, pressure_drop: 10 bar}
  lift: {type: cylinder, bodies: [ground, boom], points: [[0.3, 0, 0], [0.3, 0.9, 0]], piston: 100 mm, rod: 56 mm, start_A: 60,
    stroke: 550 mm, retracted_length: 700 mm}
simulation: {duration: 0.01}
"""


def test_a_chamber_is_tried_at_no_pressure_below_zero(tmp_path):
    """60 Pa under a piston for 60 bar: what would hold it on the other side is below a vacuum."""
    (tmp_path / "slip.yaml").write_text(SLIP, encoding="utf-8")
    result = nivel.load(tmp_path / "slip.yaml").simulate(verify=False)  # where NumPy warns, tests fail
    assert result.array("hydraulics.lift.pressure_A")[0] == pytest.approx(60.0)
    assert result.array("hydraulics.lift.pressure_B")[0] > 0.0
