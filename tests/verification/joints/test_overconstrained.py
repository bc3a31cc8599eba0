"""Overconstrained loops, whose dependent rows are not the same ones along the path, against the closed forms of their angles, through a
whole turn: by every family of methods, in all coordinates.

Sources: G. T. Bennett 1903; M. Goldberg 1943; F. E. Myard 1931 (two mirrored Bennett linkages); R. Bricard 1897, with threefold symmetry
cos θ + cos φ + cos θ cos φ = 0 (Y. Chen, Z. You, T. Tarnai 2005); P. F. Sarrus 1853.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import nivel
from lanes import tail
from nivel import Body, Joint, MachineRecord, SimulationSettings
from running import run

pytestmark = pytest.mark.covering

SPEED, TURN = 6.0, 2.0 * np.pi
# places of cranks of 0.3 m on the x axis, all of them on one rod [m]
CRANKS = ({"a": 0, "b": 1}, {"a": 0, "b": 1, "m": 0.5}, {"a": 0, "b": 1, "m": 0.3, "n": 0.6})
CHOSEN = {"dop853": 1e-9, "dopri5": 1e-8, "radau": 1e-7, "adams": 1e-9, "bdf": 1e-8}
FIXED = ("rk4", "abm4", "gear4", "generalised-alpha", "newmark", "ros2")
METHODS = pytest.mark.parametrize("integrator", tail((*CHOSEN, *FIXED), ("dop853", "generalised-alpha")))
COORDINATES = pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])


def moved(turn=0.0, length=0.0, twist=0.0):
    """Turned about z, then along and about the new x: from a hinge to the next one (Denavit & Hartenberg)."""
    out, slide = np.eye(4), np.eye(4)
    out[:3, :3] = Rotation.from_rotvec([0, 0, turn]).as_matrix()
    slide[:3, :3], slide[0, 3] = Rotation.from_rotvec([twist, 0, 0]).as_matrix(), length
    return out @ slide


def chain(links, angles):
    """Frames of the hinges of a closed chain."""
    frames = [np.eye(4)]
    for (length, twist), angle in zip(links, angles, strict=True):
        frames.append(frames[-1] @ moved(angle, length, twist))
    np.testing.assert_allclose(frames.pop(), np.eye(4), atol=1e-12)
    return frames


def loop(hinges):
    """A ring of bodies on these hinges, the first of which turns; no gravity, so that it turns for ever."""
    names = ("ground", *(f"link{k}" for k in range(1, len(hinges))))
    points = [frame[:3, 3] for frame in hinges]
    bodies, joints = [], []
    for k, frame in enumerate(hinges):
        start: Any = {"start_rates": {"angle": SPEED}} if k == 0 else {}
        ends = (names[k], names[(k + 1) % len(names)])
        axis = tuple(frame[:3, 2])
        joints.append(Joint(name=f"h{k}", type="revolute", bodies=ends, point=tuple(points[k]), axis=axis, **start))
        if k:
            middle = tuple((points[k - 1] + points[k]) / 2)
            bodies.append(Body(name=names[k], mass=1.0 + 0.2 * k, inertia=(0.1, 0.15, 0.2), position=middle))
    return MachineRecord(name="loop", bodies=tuple(bodies), joints=tuple(joints))


@dataclass(frozen=True)
class Bennett:
    """Links a, b, a, b with twists α, β, α, β and a/sin α = b/sin β; tan(θ1/2) tan(θ2/2) = sin((β + α)/2)/sin((β - α)/2)."""

    twist: float
    other: float
    length: float = 1.0

    @property
    def links(self):
        second = (self.length * np.sin(self.other) / np.sin(self.twist), self.other)
        return [(self.length, self.twist), second] * 2

    def second(self, first):
        ratio = np.sin((self.other + self.twist) / 2) / np.sin((self.other - self.twist) / 2)
        return np.unwrap(2 * np.arctan2(ratio * np.cos(first / 2), np.sin(first / 2)))

    def hinges(self, first):
        second = float(self.second(np.array([first]))[0])
        return chain(self.links, (first, second, -first, -second))


FIRST = 1.1


def bennett():
    """Its bars are in line twice a turn, where rows that were independent are not."""
    linkage = Bennett(0.7, 1.3)
    return loop(linkage.hinges(FIRST)), lambda turned: {1: linkage.second(FIRST + turned)}


def goldberg(one, two, shift):
    """Two Bennett linkages with a link in common, which is left out, and the links beside it made one: 1, 2, 1', 4', 4 are left.

    The angle of the two at the hinge left out, θ1 - θ1', is constant; at hinge 2 they turn by θ2 - θ2'.
    """
    a, b = one.hinges(FIRST), two.hinges(FIRST - shift)
    at = [one.second(np.array([FIRST]))[0], two.second(np.array([FIRST - shift]))[0]]
    placed = a[1] @ moved(at[0]) @ np.linalg.inv(b[1] @ moved(at[1]))
    hinges = [a[0], a[1], placed @ b[0], placed @ b[3], a[3]]
    return loop(hinges), lambda turned: {1: one.second(FIRST + turned) - two.second(FIRST - shift + turned)}


def bricard():
    """Six equal links of twists ±π/2."""
    first = 2.0
    second = np.arccos(-np.cos(first) / (1 + np.cos(first)))
    hinges = chain([(1.0, np.pi / 2), (1.0, -np.pi / 2)] * 3, (first, second) * 3)
    return loop(hinges), lambda turned: {2: first + turned, 4: first + turned}


def sarrus():
    """Two planes of three hinges each, across each other: the platform rises without turning."""
    across = {
        "y": Rotation.from_rotvec([-np.pi / 2, 0, 0]).as_matrix(),
        "x": Rotation.from_rotvec([0, np.pi / 2, 0]).as_matrix(),
    }
    places = [
        ("y", (1, 0, 0)),
        ("y", (1.5, 0, 0.3)),
        ("y", (1, 0, 0.6)),
        ("x", (0, 1, 0.6)),
        ("x", (0, 1.5, 0.3)),
        ("x", (0, 1, 0)),
    ]
    hinges = []
    for axis, point in places:
        frame = np.eye(4)
        frame[:3, :3], frame[:3, 3] = across[axis], point
        hinges.append(frame)
    return loop(hinges), lambda turned: {1: -2.0 * turned, 2: turned}


ZOO = {
    "bennett": bennett,
    "goldberg": lambda: goldberg(Bennett(0.7, 1.3), Bennett(0.5, 1.3, np.sin(0.5) / np.sin(0.7)), 0.4),
    "myard": lambda: goldberg(Bennett(0.7, np.pi / 2), Bennett(np.pi - 0.7, np.pi / 2), 0.9),
    "bricard": bricard,
    "sarrus": sarrus,
}
DURATION = {"sarrus": 0.05}


@METHODS
@COORDINATES
@pytest.mark.parametrize("name", ZOO)
def test_linkage_turns_through_all_its_positions(name, coordinates, integrator):
    """Without loads its energy stays; angles follow from each other, however exact the steps are."""
    machine, closed_form = ZOO[name]()
    steps = {"tolerance": CHOSEN[integrator]} if integrator in CHOSEN else {"step": 1e-3}
    settings = {"coordinates": coordinates, "duration": DURATION.get(name, 2.0), "output_interval": 5e-3, **steps}
    result = run(machine, integrator=integrator, **settings)
    assert result.finished.outcome == "done"
    change = result.joint_coordinate - result.joint_coordinate[0]
    assert name == "sarrus" or np.ptp(change[:, 0]) > (0.6 if name == "bricard" else 1.0) * TURN
    for k, angle in closed_form(change[:, 0]).items():
        np.testing.assert_allclose(change[:, k], angle - angle[0], atol=1e-9)
    assert np.abs(result.energy_error).max() < 5e-3 * result.kinetic_energy[0]
    if integrator in CHOSEN:
        assert np.abs(result.energy_error).max() < 1e2 * CHOSEN[integrator] * result.kinetic_energy[0]


@pytest.mark.parametrize("settings", [{"formulation": "lagrange"}, {"stabilisation": "none"}], ids=str)
def test_implicit_steps_meet_all_rows_in_other_equations_too(settings):
    """Of index 3 multipliers that do nothing would grow from step to step."""
    machine, closed_form = bricard()
    result = run(machine, integrator="generalised-alpha", coordinates="absolute", duration=2.0, step=1e-3, **settings)
    assert result.finished.outcome == "done"
    change = result.joint_coordinate - result.joint_coordinate[0]
    np.testing.assert_allclose(change[:, 2], closed_form(change[:, 0])[2] - closed_form(np.zeros(1))[2], atol=1e-9)


def test_a_position_where_the_motion_branches_is_named():
    """Two windows (IFToMM benchmark A02) fall flat, steps shrink there: no unit is wrong, and no driver contradicts another."""
    names = ("foot0", "left0", "right0", "foot1", "left1", "right1", "foot2")
    ends = [
        ("ground", "c0"),
        ("c0", "r0"),
        ("r0", "c1"),
        ("ground", "c1"),
        ("c1", "r1"),
        ("r1", "c2"),
        ("ground", "c2"),
    ]
    places = [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0), (1, 1, 0), (2, 1, 0), (2, 0, 0)]
    start: Any = {"start_rates": {"angle": -1.0}}
    joints = tuple(
        Joint(name=n, type="revolute", bodies=b, point=p, axis=(0, 0, 1), **(start if n == "foot0" else {}))
        for n, b, p in zip(names, ends, places, strict=True)
    )
    centres = {"c0": (0, 0.5, 0), "c1": (1, 0.5, 0), "c2": (2, 0.5, 0), "r0": (0.5, 1, 0), "r1": (1.5, 1, 0)}
    bodies = tuple(Body(name=n, mass=1.0, inertia=(0.08, 0.001, 0.08), position=p) for n, p in centres.items())
    settings: Any = {"coordinates": "absolute", "integrator": "dop853", "tolerance": 1e-9}
    machine = MachineRecord(
        name="windows",
        gravity=(0, -9.81, 0),
        bodies=bodies,
        joints=joints,
        simulation=SimulationSettings(duration=10.0, output_interval=0.1, **settings),
    )
    finished = run(machine).finished
    assert finished.outcome == "failed"
    assert "singular position" in finished.failure[0]
    assert "left0" in finished.failure[0]
    assert not any(word in " ".join(finished.failure[:2]) for word in ("driver", "unit"))


@pytest.mark.parametrize("cranks", CRANKS, ids=len)
def test_parallel_cranks_pass_flat_positions_by_default(cranks, tmp_path):
    """½ J ω² + W cos θ is constant with J = n (0.02 + 0.0225) + 2·0.09 kg m² and W = g (0.15 n + 2·0.3); the rod never turns.

    That the motion may branch there is told, and nothing else.
    """
    bodies = "\n".join(
        f"  {name}: {{mass: 1, inertia: [0.02, 0.02, 0.02], position: [{x}, 0.15, 0], angular_velocity: [0, 0, 9]}}"
        for name, x in cranks.items()
    )
    joints = "\n".join(
        f"  {name}0: {{type: revolute, bodies: [ground, {name}], point: [{x}, 0, 0], axis: [0, 0, 1]}}\n"
        f"  {name}1: {{type: revolute, bodies: [{name}, rod], point: [{x}, 0.3, 0], axis: [0, 0, 1]}}"
        for name, x in cranks.items()
    )
    path = tmp_path / "cranks.yaml"
    path.write_text(
        f"format: 1\ngravity: [0, -9.81, 0]\nbodies:\n{bodies}\n"
        "  rod: {mass: 2, inertia: [0.2, 0.2, 0.2], position: [0.5, 0.3, 0], velocity: [-2.7, 0, 0]}\n"
        f"joints:\n{joints}\nsimulation: {{duration: 3}}\n"
    )
    result = nivel.load(path).simulate(verify=True)
    angle, rate = result["a0.angle"].values, result["a0.angle_rate"].values
    n = len(cranks)
    energy = 0.5 * (n * 0.0425 + 0.18) * rate**2 + 9.81 * (0.15 * n + 0.6) * np.cos(angle)
    assert np.ptp(angle) > 4.0 * np.pi
    assert np.ptp(energy) < 1e-6 * energy[0]
    turned = result.array("orientation")[:, result.coordinates["body"].index("rod")]
    assert np.abs(turned[:, 1:]).max() < 1e-6
    assert {item.name for item in result.trust.items if item.verdict != "green"} <= {"redundancy", "singular"}
