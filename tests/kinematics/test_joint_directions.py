"""Velocities of the spanning tree by name, for joints that carry their second body and joints that carry their first.

The reference is the result of a run: joint coordinates, their rates, velocities of bodies and energy are measured from markers there. Where
the tree carries the first body of a planar joint, its coordinates are not x and y of the joint, but those of the first point as seen from
the second marker: with the turn R(φ), d' = -R(φ)ᵀ d.
"""

import numpy as np
import pytest

import nivel
from nivel.elements.joints import JOINTS
from nivel.system.elimination.topology import carries

# of every joint of a tree that has coordinates: those that are its velocities, where it carries its second body, and its first
CARRIED = {
    "planar": (("x", "y", "angle"), ("x_from_second", "y_from_second", "angle")),
    "universal": (("angle_1", "angle_2"), ("angle_2", "angle_1")),
    "screw": (("angle",), ("angle",)),
    "cylindrical": (("angle", "displacement"), ("angle", "displacement")),
    "translational": (("displacement",), ("displacement",)),
    "revolute": (("angle",), ("angle",)),
}
EFFORTS = {"planar.x": 3.0, "planar.y": -2.0, "planar.angle": 5.0, "universal.angle_1": 7.0, "universal.angle_2": -4.0}
EFFORTS |= {"screw.angle": 2.5, "cylindrical.angle": 1.5, "cylindrical.displacement": -6.0}
EFFORTS |= {"translational.displacement": 8.0, "revolute.angle": -1.0}


class Chain:
    """A chain of all these joints from the ground in a random position and motion, by its result and as robotics knows it."""

    def __init__(self, backwards):
        rng = np.random.default_rng(3)
        bodies, joints, before = [], [], "ground"
        for kind in CARRIED:
            at, z, x = rng.uniform(-1.0, 1.0, (3, 3))
            inertia = tuple(rng.uniform(1.0, 1.4, 3))
            bodies.append(nivel.Body(name=f"b_{kind}", mass=rng.uniform(1, 3), inertia=inertia, position=tuple(at)))
            axes = {"axes": (tuple(z), tuple(np.cross(z, x)))} if kind == "universal" else {"axis": tuple(z)}
            free = ["angle"] if kind == "screw" else JOINTS[kind].coordinates
            joints.append(
                nivel.Joint(
                    name=kind,
                    type=kind,
                    bodies=(bodies[-1].name, before) if backwards else (before, bodies[-1].name),
                    point=tuple(rng.uniform(-1.0, 1.0, 3)),
                    **axes,
                    **({"pitch": 0.7} if kind == "screw" else {}),
                    start={name: rng.uniform(0.3, 1.2) for name in free},
                    start_rates={name: rng.uniform(-2.0, 2.0) for name in free},
                )
            )
            before = bodies[-1].name
        parts = {"bodies": bodies, "joints": joints, "gravity": (1.0, 2.0, -9.81)}
        self.machine = nivel.Machine("chain", **parts)
        motors = [nivel.Motor(name=f"m{k}", coordinate=name, effort=e) for k, (name, e) in enumerate(EFFORTS.items())]
        self.pulled = nivel.Machine("chain", forces=motors, **parts)
        self.bodies = [body.name for body in bodies]
        self.result = self.machine.simulate(duration="1 us", step="1 us", coordinates="absolute")
        self.mechanics = self.machine.mechanics(coordinates="relative")
        coordinates = [f"{kind}.{name}" for kind in CARRIED for name in JOINTS[kind].coordinates]
        self.value = {name: self.result.array(name)[0] for name in coordinates}
        self.rate = {name: self.result.array(f"{name}.rate")[0] for name in coordinates}
        x, y, angle = (self.value[f"planar.{name}"] for name in ("x", "y", "angle"))
        u, v, omega = (self.rate[f"planar.{name}"] for name in ("x", "y", "angle"))
        c, s = np.cos(angle), np.sin(angle)
        self.value |= {"planar.x_from_second": -c * x - s * y, "planar.y_from_second": s * x - c * y}
        self.rate |= {
            "planar.x_from_second": -c * u - s * v + omega * (s * x - c * y),
            "planar.y_from_second": s * u - c * v + omega * (c * x + s * y),
        }
        self.v = np.array([self.rate[name] for name in self.mechanics.names])


@pytest.fixture(scope="module", params=[False, True], ids=["second body carried", "first body carried"])
def backwards(request):
    return request.param


@pytest.fixture(scope="module")
def chain(backwards):
    return Chain(backwards)


def test_every_joint_of_a_tree_with_coordinates_is_here():
    assert set(CARRIED) == {kind for kind, words in JOINTS.items() if words.coordinates and carries(kind)}


def test_positions_and_velocities_have_the_names_and_values_of_the_result(chain, backwards):
    names = tuple(f"{kind}.{name}" for kind, both in CARRIED.items() for name in both[backwards])
    assert chain.mechanics.names == chain.mechanics.position_names == names
    np.testing.assert_allclose(chain.mechanics.start, [chain.value[name] for name in names], atol=1e-12)
    lengths = [name.rpartition(".")[2][0] in "xyd" for name in names]
    assert chain.mechanics.units == tuple("m" if length else "rad" for length in lengths)


def test_bodies_move_as_in_the_result_at_the_rates_of_its_coordinates(chain):
    """J v is the velocity of the result, and the derivative of the place along q̇ = v."""
    own = chain.mechanics
    for body in chain.bodies:
        motion = own.jacobian(body) @ chain.v
        np.testing.assert_allclose(own.pose(body)[0], chain.result.array(f"{body}.position")[0], atol=1e-11)
        np.testing.assert_allclose(motion[:3], chain.result.array(f"{body}.velocity")[0], atol=1e-10)
        np.testing.assert_allclose(motion[3:], chain.result.array(f"{body}.angular_velocity")[0], atol=1e-10)
    size = 1e-5
    ahead, behind = (own.pose(chain.bodies[-1], own.start + sign * size * chain.v)[0] for sign in (1.0, -1.0))
    # h² of the third derivative
    np.testing.assert_allclose((ahead - behind) / (2.0 * size), motion[:3], atol=1e-6)


def test_the_mass_matrix_has_the_kinetic_energy_of_the_result(chain):
    M = chain.mechanics.mass_matrix()
    assert 0.5 * chain.v @ M @ chain.v == pytest.approx(chain.result.array("kinetic_energy")[0], rel=1e-11)


def test_efforts_are_power_per_rate(chain):
    """Motors: their efforts where the coordinate is a velocity of that name; in any case the power Σ F ċ."""
    own, pulled = chain.mechanics, chain.pulled.mechanics(coordinates="relative")
    a = np.linspace(-1.0, 1.0, len(chain.v))
    tau = own.inverse_dynamics(own.start, chain.v, a) - pulled.inverse_dynamics(own.start, chain.v, a)
    for name, effort in zip(own.names, tau, strict=True):
        if not name.startswith("planar") or "planar.x" in own.names:
            assert effort == pytest.approx(EFFORTS[name], abs=1e-9)
    assert tau @ chain.v == pytest.approx(sum(F * chain.rate[name] for name, F in EFFORTS.items()), abs=1e-9)


def test_states_of_a_linear_model_are_the_coordinates_that_it_names(chain):
    """The output of a coordinate that is a state is that state, and nothing else; so is its rate."""
    names = [name for name in chain.mechanics.names if not name.endswith("_from_second")]
    outputs = [*names, *(f"{name}.rate" for name in names)]
    model = chain.machine.linearise(coordinates="relative", outputs=outputs, about="start")
    wanted = np.array([[state == output for state in model.states] for output in outputs], dtype=float)
    assert wanted.sum() == len(outputs)
    np.testing.assert_allclose(model.C, wanted, atol=1e-11)


def test_efforts_on_a_cross_are_those_of_inverse_dynamics_in_absolute_coordinates(backwards):
    """`inverse` knows no tree: its efforts at the motions of two drivers are τ at the same q, v and a."""
    cross = {"type": "universal", "point": (0, 0, 0), "axes": ((1, 0, 0), (0, 1, 0))}
    joint = nivel.Joint(name="cross", bodies=("b", "ground") if backwards else ("ground", "b"), **cross)
    parts = {
        "bodies": [nivel.Body(name="b", mass=2.0, inertia=(1.0, 1.2, 1.4), position=(0.3, 0.1, -0.2))],
        "joints": [joint],
        "gravity": (1.0, 2.0, -9.81),
    }
    laws = {"cross.angle_1": "0.4*sin(2*time)", "cross.angle_2": "0.3*time^2"}
    drivers = [nivel.Driver(name=f"d{k}", coordinate=name, value=law) for k, (name, law) in enumerate(laws.items())]
    wanted = nivel.Machine("driven", drivers=drivers, simulation={"duration": 1}, **parts).inverse(positions=3)
    t = wanted.time[1]
    state = {
        "cross.angle_1": (0.4 * np.sin(2 * t), 0.8 * np.cos(2 * t), -1.6 * np.sin(2 * t)),
        "cross.angle_2": (0.3 * t**2, 0.6 * t, 0.6),
    }
    own = nivel.Machine("free", **parts).mechanics(coordinates="relative")
    tau = own.inverse_dynamics(*np.array([state[name] for name in own.names]).T)
    efforts = dict(zip(wanted.coordinates, wanted.effort[1], strict=True))
    np.testing.assert_allclose(tau, [efforts[name] for name in own.names], rtol=1e-10)
