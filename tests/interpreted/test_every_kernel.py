"""A few steps of every method on every kind of machine, in plain Python: no index leaves its array, and every kernel takes part."""

import ast
from pathlib import Path

import numpy as np
import pytest

import beams
import cart
import force_zoo
import gradient_beams
import hydraulic_zoo
import linked
import machines
import mixed_machines
import nivel
import plain
import stiff_machines
import tangent_zoo
import test_capstan_ropes
import test_contact_location
import test_drive_trains
import test_driver_corners
import test_eliminated_rails
import test_friction
import test_rails
import test_statics_closed_forms
import test_thermal_accumulator
import tree_machines
from circuits import circuit
from lanes import tail
from nivel import PointForce, Table
from nivel.analysis.assembly import circuit_start
from nivel.analysis.assembly.implicit import find_tangent
from nivel.analysis.curves.functions import ExpressionCurve
from nivel.analysis.preparation import preparation
from nivel.files import parse_machine
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.loop import paced as paced_loop
from nivel.integrate.loop.repeated import halt, repeat_evaluation, repeat_family, repeat_rows
from nivel.kernels.core.status import BUDGET_SPENT, DONE, OK
from nivel.live.preparation import live_plan, prepared_run
from nivel.live.shared import bytes_of, live_in
from nivel.machine.laws.varying_value import Expression, expression_of
from nivel.machine.units.tree import Lookup, Time
from nivel.motion.catalogue import FLEXIBLE, PATHS
from running import run
from simulating import hinge, machine, solid
from test_end_stops import ram
from unknowns import SHARES, TIME

ROOT = Path(__file__).parents[2]
STEP = 1e-3
EXPLICIT = "rk4"
# formulations and stabilisations that share the equations of a path
WAYS = {
    "penalty": {"formulation": "penalty"},
    "augmented": {"formulation": "augmented-lagrangian"},
    "geometric": {"stabilisation": "geometric"},
    "baumgarte": {"stabilisation": "baumgarte", "baumgarte": {"alpha": 100.0, "beta": 100.0}},
}
LAW = """
import math


def pull(value, rate):
    return -math.copysign(math.hypot(value, rate + 2.0), rate + 0.1) - (rate + 3.0) % 2.0
"""
# what no short run reaches, and why
FAILURES = ["direct.are_open", "direct.name_lost", "step_control.too_small"]
HARD_NEWTON = [f"friction_turns.{name}" for name in ("freeze", "next_seed", "release", "turn_some")]
HARD_NEWTON += ["residual_newton.is_round_off"]
FOR_TESTS = ["tangent_entries.solve_shifted"]
# joints of other packages move by an address, which plain Python has not: test_extending_page runs them
BY_ADDRESS = [f"joints.{name}" for name in ("call_motion", "carry_child", "joint_at")]
# so are functions of FMUs and C: tests/fmu runs what calls them
BY_ADDRESS += [f"fmu.{name}" for name in ("failed", "go_on", "initialise", "take_step", "transfer")]
BY_ADDRESS += [f"c_function.{name}" for name in ("call", "give_environment_back", "keep_environment")]
# what only slopes of whole runs need, which are compiled: tests/analysis/test_gradients.py
OF_SLOPES = [f"{name}.settle_slopes" for name in ("residual_newton", "friction", "balance", "variable_order")]
OF_SLOPES += ["lanes.steepest", "direct.are_steep", "independent.is_steep", "crossing.root", "shifted_along.add_slopes"]
OF_SLOPES += ["samples.fit_part"]
OF_SLOPES += ["residual_newton.steepness_of_change", "residual_newton.end_correction"]
OF_SLOPES += ["radau.settle_slopes", "radau.settle_coupled", "radau.change_slopes_of_pair"]
OF_SLOPES += [
    f"shifted_along.{name}"
    for name in ("keep_base", "bring_back", "move_far_along", "find_missed", "load_missed", "settle_solution")
]
OF_SLOPES += [
    f"correction_slopes.{name}"
    for name in (
        "begin_moved",
        "forget_moved",
        "copy_unknowns",
        "keep_made_at",
        "add_moved",
        "size_of_moved",
        "move_made_at",
        "load_missed",
        "product",
        "use_directions",
        "find_along",
        "learn_direction",
        "settle_correction",
    )
]
OF_SLOPES += [f"alpha_start.{name}" for name in ("move_here", "add_mixed", "follow_matrices")]
OF_SLOPES += [
    "element_crossing.load_missed",
    "element_crossing.settle_change",
    "tangent.take_values",
    "tangent.carry_over",
]
LEFT_OUT = {*FAILURES, *HARD_NEWTON, *FOR_TESTS, *BY_ADDRESS, *OF_SLOPES}


def settings_of(path):
    """The words of a path of the catalogue."""
    coordinates, velocities, rotations = path
    more = {"rotations": rotations} if velocities == "lagrange" else {}
    return {"coordinates": coordinates, "formulation": velocities, **more}


def short(record, integrator=EXPLICIT, *, steps=3, step=STEP, **settings):
    """A run of a few steps."""
    facts = INTEGRATORS[integrator]
    given = {"tolerance": 1e-3} if facts.chooses_steps else {"step": step}
    given |= {"stabilisation": "none"} if facts.needs == "whole steps" else {}
    given |= {"coordinates": "absolute", "integrator": integrator}
    r = run(record, **{**given, "duration": steps * step, "output_interval": 2 * step, **settings})
    assert r.finished.outcome == "done", r.finished.failure
    return r


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    return tree_machines.write_beams(tmp_path_factory.mktemp("tree"))


# --- elements ---


def differentiate(here):
    """Derivatives of the residual, found at a state in motion."""
    tangent_zoo.residual_of(here)
    status, matrix = find_tangent(here.motion, TIME, *SHARES)
    assert status == 0
    assert np.isfinite(matrix).all()


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_mechanics(coordinates):
    """What robotics asks for, of a loop in coordinates with Euler parameters and in those of joints, at two states."""
    mechanics = nivel.load(ROOT / "examples/mechanisms/four-bar.yaml").mechanics(coordinates=coordinates)
    q, v = np.tile(mechanics.start, (2, 1)), np.array([[0.3], [0.4]])
    efforts = mechanics.inverse_dynamics(q, v, v)
    np.testing.assert_allclose(mechanics.forward_dynamics(q, v, efforts), v, rtol=1e-9)
    (by_q, by_v), body = mechanics.inverse_dynamics_derivatives(q, v, v), mechanics._machine.bodies[0].name
    for each in (by_q, by_v, mechanics.jacobian(body, q)):
        assert np.isfinite(each).all()


@pytest.mark.parametrize("name", force_zoo.ELEMENTS)
def test_elements(name, rng):
    """Forces, couplings and drivers, and their exact derivatives."""
    differentiate(tangent_zoo.state_of(name, "absolute", rng))


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("kind", machines.KINDS)
def test_joints(kind, coordinates, rng):
    differentiate(tangent_zoo.state_of(kind, coordinates, rng))


@pytest.mark.parametrize("model", ["coulomb", "lugre"])
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_everything_at_once(model, coordinates):
    short(linked.record(linked.every_element(model)), steps=2, coordinates=coordinates)


@pytest.mark.parametrize("integrator", ["rk4", "generalised-alpha", "radau", "bdf", "ros2"])
def test_stiction(integrator):
    """A block that slides to rest."""
    sections = test_friction.sled({"model": "stiction", "static_coefficient": 0.4, "stribeck_speed": 0.1}, 0.03)
    short(machine(sections).record, integrator, steps=20)


@pytest.mark.parametrize("integrator", [EXPLICIT, "generalised-alpha"])
@pytest.mark.parametrize("model", [{"model": "coulomb", "transition_speed": 1e-3}, {"model": "stiction"}])
def test_frictions_that_load_each_other(model, integrator):
    sections = test_friction.two_sliders(0.9, -40.0, model)
    short(machine(sections).record, integrator, steps=5)


def test_feet_that_share_a_load():
    """More patches than one motion needs hold a body that rests on a plane."""
    feet = {
        f"foot_{k}": {"body": "table", "position": [*place, 0.0], "shape": {"type": "sphere", "radius": 0.05}}
        for k, place in enumerate([(0.3, 0.2), (0.3, -0.2), (-0.3, 0.2)])
    }
    touch = {"type": "contact", "plane": "floor", "stiffness": 1e6, "damping": 1.0, "friction": 0.5}
    sections = {
        "gravity": [0, 0, -9.81],
        "bodies": {"table": solid(position=[0, 0, 0.0499])},
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}, **feet},
        "forces": {name: {**touch, "body": name} for name in feet},
    }
    short(machine(sections).record)


@pytest.mark.parametrize("integrator", [EXPLICIT, "generalised-alpha"])
def test_drive_trains_that_hold(integrator):
    """A clutch, a freewheel and the loss of a gear; a brake on what a driver moves."""
    forces = {
        "clutch": {"type": "clutch", "coordinate": "p", "against": "q", "capacity": "0.1 + 0.1*time"},
        "backstop": {"type": "freewheel", "coordinate": "q"},
        "loss": {"type": "transmission-loss", "coupling": "g", "coordinate": "p", "efficiency": 0.7},
    }
    couplings = {"g": {"type": "linear", "coordinates": ["p", "q"], "factors": [1, -2]}}
    short(machine(test_drive_trains.shafts(forces, (2.0, 1.0), couplings=couplings)).record, integrator)
    driven = {"turn": {"coordinate": "p", "speed": 3.0}}
    brake = {"brake": {"type": "brake", "coordinate": "p", "capacity": 1.0}}
    short(machine(test_drive_trains.shafts(brake, drivers=driven)).record, integrator)


def test_belts():
    """One that slips, and a chain that is slack on both sides."""
    belt = {"type": "belt-drive", "coordinate": "p", "against": "q", "radii": [0.1, 0.1], "stiffness": 1e5}
    for more, speeds in (({"pretension": 1.0, "friction": 0.3}, (9.0, 0.0)), ({"slack": 1e-4}, (0.0, 1.0))):
        short(machine(test_drive_trains.shafts({"belt": {**belt, **more}}, speeds)).record)


def test_a_rope_that_slips_on_its_wheel():
    short(machine(test_capstan_ropes.loads(10.0, 3.0)).record, steps=5)


def test_functions_of_laws():
    """Those that a law may name in Python are made analytic for exact derivatives."""
    law = {"source": LAW, "function": "pull", "arguments": ["value", "rate"]}
    spring = {"type": "joint-spring-damper", "coordinate": "j.angle", "law": law}
    record = force_zoo.bed(force_zoo.Case(spring))
    for integrator in (EXPLICIT, "generalised-alpha"):
        short(record, integrator, steps=1)


def test_euler_angles():
    sensors = {
        name: {"marker": "tip", "quantity": "euler_angles", "sequence": name, **more}
        for name, more in (("zxz", {}), ("xyz", {"relative_to": "eye"}))
    }
    case = force_zoo.Case({"type": "motor", "coordinate": "axle", "effort": 1}, more={"sensors": sensors})
    short(force_zoo.bed(case), steps=1)


# --- methods ---


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_integrators(integrator, coordinates):
    if INTEGRATORS[integrator].needs == "whole steps" and coordinates != "absolute":
        pytest.skip("absolute coordinates alone")
    short(machines.slider_crank(), integrator, steps=6, coordinates=coordinates)


@pytest.mark.parametrize("integrator", [name for name, facts in INTEGRATORS.items() if facts.kind == "corrector"])
def test_newton(integrator):
    """The corrector with a matrix."""
    facts = INTEGRATORS[integrator]
    coordinates = "absolute" if facts.needs == "whole steps" else "relative"
    short(machines.slider_crank(), integrator, steps=2, coordinates=coordinates, corrector={"iteration": "newton"})


@pytest.mark.parametrize("integrator", [EXPLICIT, "generalised-alpha", "radau"])
@pytest.mark.parametrize("stabilisation", ["none", "direct"])
@pytest.mark.parametrize("path", PATHS, ids="-".join)
def test_paths(path, stabilisation, integrator):
    if integrator != EXPLICIT and not PATHS[path].residual:
        pytest.skip("there is no residual")
    short(machines.slider_crank(), integrator, steps=2, stabilisation=stabilisation, **settings_of(path))


@pytest.mark.parametrize("integrator", [EXPLICIT, "generalised-alpha", "radau"])
@pytest.mark.parametrize("way", WAYS)
def test_ways(way, integrator):
    short(machines.slider_crank(), integrator, steps=2, **WAYS[way])


def test_dependent_positions_of_lagrange_equations_move():
    """Steps so long that the loop opens, and closes again."""
    short(machines.slider_crank(), steps=3, step=0.02, coordinates="independent", formulation="lagrange")


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
def test_redundant_joints(coordinates):
    for integrator in (EXPLICIT, "generalised-alpha"):
        short(machines.four_bar("revolute", "revolute"), integrator, steps=2, coordinates=coordinates)


def test_redundant_joints_by_pivots(monkeypatch):
    """As where rows do not repeat each other everywhere."""
    monkeypatch.setattr(preparation, "leave_out", lambda system, rows: None)
    short(machines.four_bar("revolute", "revolute"), EXPLICIT, steps=2, coordinates="absolute")


def test_redundant_rows_chosen_anew(monkeypatch):
    """Where those that stay depend on each other."""
    monkeypatch.setattr(preparation, "rows_everywhere", lambda *_: (0, 1, 2))
    short(machines.four_bar("revolute", "revolute"), EXPLICIT, steps=2, coordinates="absolute")


def test_steps_chosen_by_the_error():
    """Of a stiff machine, with steps that are too long for its springs, and with a first one that is too long for all."""
    short(stiff_machines.elastic_pendulum(1e8), "generalised-alpha", steps=40, step_control="error", tolerance=1e-3)
    for integrator in ("dopri5", "radau", "bdf", "adams", "generalised-alpha"):
        more = {"step_control": "error"} if INTEGRATORS[integrator].optional_control else {}
        short(machines.heavy_top(), integrator, step=2e-2, tolerance=1e-5, **more, duration=0.02)


def test_corners():
    """Of drivers, whose speed jumps there, and of forces."""
    times, values = (0.0, 3.3e-3, 5.037e-3, 8.013e-3), (0.0, 3.3e-3, -1e-3, 1e-3)
    driven = test_driver_corners.cart_and_arm(Table(times, values))
    push = PointForce(name="push", body="cart", vector=(Table(times, values, "linear"), 0, 0))
    for record in (driven, driven.replace(drivers=(), forces=(push,))):
        short(record, "generalised-alpha", steps=8)
        short(record, "generalised-alpha", steps=8, step_control="error", tolerance=1e-4)
    short(driven.replace(drivers=(), forces=(push,)), steps=8)


@pytest.mark.parametrize("integrator", [EXPLICIT, "dopri5", "generalised-alpha", "abm4"])
def test_states_and_samples(integrator):
    """Continuous states, and samples at given times and at an event."""
    sections = {
        "bodies": {"wheel": solid(angular_velocity=[0, 0, 3])},
        "joints": {"axle": hinge("ground", "wheel")},
        "states": {
            "slow": {"rate": "axle.angle - slow.value"},
            "held": {"update": "slow.value + axle.angle_rate", "every": 2 * STEP},
            "count": {"update": "count.value + 1", "event": "passed"},
        },
        "events": {
            "passed": {"when": "axle.angle - 0.005"},
            "twice": {"when": "abs(axle.angle - 0.0045) - 0.0002", "direction": "rising"},
        },
    }
    short(machine(sections).record, integrator, steps=5)


@pytest.mark.parametrize(
    "integrator", tail([EXPLICIT, "dopri5", "generalised-alpha", "radau"], [EXPLICIT, "dopri5", "generalised-alpha"])
)
def test_control_and_drives(integrator):
    """Signals, samples with latency, smooth steps, linear and other functions; both drives with their limits and an elastic gear."""
    elastic = {"rotor_inertia": 1e-3, "gear_stiffness": 100, "gear_damping": 0.1}
    motor = {"coordinate": "axle", "torque_constant": 0.1, "resistance": 1, "friction_torque": 0.1}
    curve = {"speeds": [0, 1, 10], "torques": [1, 1, 0]}
    rotor = {"coordinate": "axle", "resistance": 1, "rotor_resistance": 1, "inductance": 0.1}
    rotor |= {"stator_leakage": 0.01, "rotor_leakage": 0.01}
    sections = {
        "bodies": {"wheel": solid(angular_velocity=[0, 0, 3]), "driven": solid(position=[0, 1, 0])},
        "joints": {"axle": hinge("ground", "wheel"), "turn": hinge("ground", "driven", point=(0, 1, 0))},
        "drivers": {"smooth": {"coordinate": "turn", "value": "step(time, 0, 0, 0.01, 0.1)"}},
        "control": {
            "wish": {"type": "signal", "value": "step(time, 0, 0, 0.003, 1)"},
            "speed": {"type": "signal", "value": "dc.speed", "sample_time": STEP},
            "drive": {"type": "pid", "input": "wish.value - axle.angle", "kp": 9, "ki": 3, "kd": 1, "limits": [-2, 2]},
            "held": {"type": "gain", "input": "drive.value", "gain": 2, "sample_time": 2 * STEP, "latency": 3 * STEP},
            "turned": {"type": "lookup", "input": "held.value", "points": [-1, 1], "values": [0, 1]},
        },
        "forces": {
            "dc": {
                "type": "dc-motor",
                "voltage": "turned.value*1e3",
                "inductance": 1e-3,
                "current_limit": 1,
                **motor,
                **elastic,
            },
            "plain": {"type": "dc-motor", "voltage": 3, "voltage_limit": 2, **motor},
            "servo": {"type": "servo-motor", "effort": "-50*drive.value", "torque_speed": curve, **motor},
            "field": {
                "type": "synchronous-motor",
                "effort": "-50*drive.value",
                "current_limit": 5,
                "inductance": 1e-2,
                **motor,
                "battery": {"charges": [0, 1], "voltages": [9, 12], "capacity": 100, "resistance": 0.1},
            },
            "grid": {"type": "induction-motor", "voltage": 10, "frequency": 5, **rotor},
            "flux": {
                "type": "induction-motor",
                "effort": 1,
                "current_limit": 5,
                "current_d": 1,
                "dc_voltage": 9,
                **rotor,
            },
        },
    }
    # radau begins with a hundred steps of less than a microsecond; the held value of fixed steps comes three steps later
    few = {"radau": {"steps": 1, "step": 1e-6}, "dopri5": {"steps": 2}}.get(integrator, {"steps": 5})
    short(machine(sections).record, integrator, **few)


def test_soil_is_pressed_cut_and_carried():
    """A wheel that sinks in, a blade with more than it keeps, one that catches it, a track that sinks in and one on hard ground."""
    level = {"size": [3, 3], "function": "0", "points": [31, 31]}
    soil = {"plane": "floor", "heights": level, "soil": {"cohesion": 1e3, "period": STEP}}
    hub = {"body": "roller", "axis": [0, 1, 0]}

    def belt(name):
        ends = [{"body": name, "position": [x, 0, 0]} for x in (0.4, -0.4)]
        return {"type": "track", "contact": ends, "sprocket": hub, "radius": 0.2, "width": 0.2, "patches": 2}

    edge = [{"body": "bucket", "position": [0.1, y, 0]} for y in (0.2, -0.2)]
    tail = [{"body": "box", "position": [-0.9, y, 0]} for y in (0.2, -0.2)]
    opening = [{"body": "box", "position": [x, y, 0]} for x, y in ((-0.8, -0.5), (0.8, 0.5))]
    sections = {
        "bodies": {
            "roller": solid(position=[-0.5, 0, 0.25], velocity=[1, 0, 0], angular_velocity=[0, 3, 0]),
            "bucket": solid(position=[0.4, 0, -0.15], velocity=[5, 0, 0]),
            "box": solid(position=[0.5, 0, -0.9]),
            "crawler": solid(position=[0, 1, -0.02], velocity=[0.5, 0, 0]),
            "tractor": solid(position=[0, -1, -0.01], velocity=[-0.5, 0, 0]),
        },
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {
            "rolls": {"type": "soil-wheel", "wheel": hub, "radius": 0.3, "width": 0.2, **soil},
            "digs": {"type": "blade", "edge": edge, "capacity": 1e-3, **soil},
            "catches": {"type": "blade", "edge": tail, "capacity": 1.0, "opening": opening, **soil},
            "crawls": {**belt("crawler"), **soil},
            "drives": {**belt("tractor"), "plane": "floor", "heights": level},
        },
    }
    short(machine(sections).record, steps=8)


@pytest.mark.parametrize("integrator", ["dopri5", "dop853", "adams", "gear", "radau", "bdf", "generalised-alpha"])
def test_contacts_and_events(integrator):
    """A ball that falls on a floor, where steps end."""
    sections = test_contact_location.bouncing(1e4, 1.5)
    sections["bodies"]["ball"] |= {"position": [0, 0, test_contact_location.RADIUS + 1e-4], "velocity": [0, 0, -1]}
    more = {"step_control": "error", "tolerance": 1e-4} if INTEGRATORS[integrator].optional_control else {}
    short(machine(sections).record, integrator, steps=10, **more)


def test_contacts_of_all_shapes(monkeypatch):
    """Ellipsoids, capsules on parts of others, ground with heights, and spheres that cells find."""
    monkeypatch.setattr("nivel.elements.contacts.heap.MANY", 2)
    egg = {"type": "ellipsoid", "semi_axes": [0.3, 0.2, 0.1]}
    bar, block = {"type": "capsule", "radius": 0.1, "length": 0.4}, {"type": "box", "size": [0.3, 0.3, 0.2]}
    ball, hills = {"type": "sphere", "radius": 0.1}, {"size": [2, 2], "function": "0.1*x^2", "points": [5, 5]}
    prism = {"type": "extrusion", "outline": [[-0.1, -0.1], [0.1, -0.1], [0, 0.1]], "length": 0.2}
    disc = {"type": "cylinder", "radius": 0.1, "length": 0.2}
    point = {"type": "contact", "stiffness": 1e4, "exponent": 1, "restitution": 0.5, "friction": 0.3}
    pairs = {
        "edge": (egg, block, [0.33, 0.28, 0.02]),
        "eggs": (egg, egg, [0.2, 0.1, 0.15]),
        "bars": (bar, bar, [0.3, 0, 0.19]),
    }
    pairs |= {"lies": (bar, block, [0.1, 0, 0.19]), "egg_and_ball": (egg, ball, [0.3, 0, 0.1])}
    bodies, forces = {}, {}
    for k, (name, (first, second, apart)) in enumerate(pairs.items()):
        bodies |= {
            f"a{k}": {"mass": 1, "inertia": [1, 1, 1], "position": [apart[0], apart[1] + k, apart[2]], "shape": first}
        }
        bodies |= {f"b{k}": {"mass": 1, "inertia": [1, 1, 1], "position": [0, k, 0], "shape": second}}
        forces[name] = {**point, "bodies": [f"a{k}", f"b{k}"]}
    for k, shape in enumerate((egg, ball, bar, block, prism, disc)):
        bodies[f"c{k}"] = {"mass": 1, "inertia": [1, 1, 1], "position": [0.2, 0, 0.095], "shape": shape}
        forces[f"ground_{k}"] = {**point, "body": f"c{k}", "plane": "floor", **({"heights": hills} if k else {})}
    for k, place in enumerate(([9, 0, 0.05], [9.05, 0, 0.14], [9, 0.3, 2])):
        bodies[f"s{k}"] = {"mass": 1, "inertia": [1, 1, 1], "position": place, "shape": ball}
    heap = {
        "type": "contacts",
        "between": ["s0", "s1", "s2"],
        "planes": ["floor"],
        "stiffness": 1e4,
        "restitution": 0.5,
    }
    floor = {"body": "ground", "axis": [0, 0, 1], "x_axis": [1, 0, 0]}
    sections = {"bodies": bodies, "markers": {"floor": floor}, "forces": {**forces, "heap": heap}}
    short(machine(sections).record, steps=2, step=1e-5)


@pytest.mark.parametrize("integrator", [EXPLICIT, "dopri5", "radau"])
def test_ways_over_hills(integrator):
    """A ball that flies towards a ridge, beside one that rolls up to it: chosen steps end there, fixed ones note what they pass."""
    ball = {"mass": 0.5, "inertia": [1e-3, 1e-3, 1e-3], "shape": {"type": "sphere", "radius": 0.05}}
    hills = {"size": [20, 2], "function": "1 - 10*x^2", "points": [41, 3]}
    point = {"type": "contact", "plane": "floor", "stiffness": 1e5, "exponent": 1, "restitution": 1, "heights": hills}
    bodies = {
        "flies": {**ball, "position": [-1, 0, 0.5], "velocity": [20, 0, 0]},
        "climbs": {**ball, "position": [-0.6, 0.5, -2.5], "velocity": [1, 0, -2]},
    }
    sections = {
        "bodies": bodies,
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1], "x_axis": [1, 0, 0]}},
        "forces": {name: {**point, "body": name} for name in bodies},
    }
    fixed = {"step": 0.1} if integrator == EXPLICIT else {"step": 1e-3}
    short(machine(sections).record, integrator, duration=0.1, output_interval=0.1, **fixed)


def test_a_place_beyond_a_crest():
    """Among crests as steep as these the place that the search finds lies behind one: it begins anew on the side of the ball."""
    heights = 3.0 * np.random.default_rng(3).standard_normal((9, 9))
    ball = {"mass": 1, "inertia": [1e-3, 1e-3, 1e-3], "shape": {"type": "sphere", "radius": 0.01}}
    ground = {"size": [2, 2], "values": heights.tolist()}
    point = {"type": "contact", "plane": "floor", "stiffness": 1e3, "exponent": 1, "restitution": 1}
    sections = {
        "bodies": {"ball": {**ball, "position": [0.4188, 0.2308, 1.7141]}},
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1], "x_axis": [1, 0, 0]}},
        "forces": {"touch": {**point, "body": "ball", "heights": ground}},
    }
    short(machine(sections).record, steps=1, step=1e-6)


def test_edges_that_pass_each_other():
    """Two square bars across each other, edge to edge: no face keeps them apart, the edges do by 1.6 mm."""
    bodies = {
        "lower": {
            "shape": {"type": "box", "size": [0.6, 0.1, 0.1]},
            "orientation": {"axis": [1, 0, 0], "angle": "45 deg"},
        },
        "upper": {
            "shape": {"type": "box", "size": [0.1, 0.6, 0.1]},
            "orientation": {"axis": [0, 1, 0], "angle": "45 deg"},
        },
    }
    bodies = {name: {"mass": 1, "inertia": [1, 1, 1], **more} for name, more in bodies.items()}
    bodies["upper"]["position"] = [0, 0, 0.143]
    forces = {"touch": {"type": "contact", "bodies": ["lower", "upper"], "foundation_modulus": 1e8, "damping": 0.1}}
    short(machine({"bodies": bodies, "forces": forces}).record, steps=1, step=1e-6)


def test_steps_that_stability_bounds():
    """A run that names no method goes on with an implicit one where it is stiff."""
    spring = {"type": "joint-spring-damper", "coordinate": "rail", "stiffness": 1e8, "damping": 1e5}
    rail = {"type": "translational", "bodies": ["ground", "block"], "point": [0, 0, 0], "axis": [1, 0, 0]}
    sections = {
        "bodies": {"block": {"mass": 2, "inertia": [1, 1, 1]}},
        "joints": {"rail": {**rail, "start_rates": {"displacement": 1.0}}},
        "forces": {"spring": spring},
    }
    result = machine({**sections, "simulation": {"duration": 0.02}}).simulate(verify=False)
    assert result.settings["went_on"]["integrator"] == "radau"


# --- bodies that bend, beams, rails ---


@pytest.mark.parametrize("integrator", [EXPLICIT, "generalised-alpha", "radau"])
@pytest.mark.parametrize("stabilisation", ["none", "direct"])
@pytest.mark.parametrize("path", FLEXIBLE, ids="-".join)
def test_paths_of_flexible_bodies(folder, path, stabilisation, integrator):
    if stabilisation == "none" and integrator != EXPLICIT:
        pytest.skip("as with direct")
    record = tree_machines.MACHINES["pendulum"](folder)
    short(record, integrator, steps=1, step=1e-5, stabilisation=stabilisation, **settings_of(path))


@pytest.mark.parametrize("way", WAYS)
def test_ways_of_flexible_bodies(folder, way):
    short(tree_machines.MACHINES["pendulum"](folder), steps=1, step=1e-5, **WAYS[way])


def test_flexible_bodies_by_energy_and_momenta(folder):
    short(tree_machines.MACHINES["loop"](folder), "energy-momentum", steps=2, step=1e-5)


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
@pytest.mark.parametrize("name", ["chain", "loop", "flying", "spinning"])
def test_flexible_machines(folder, name, coordinates):
    short(tree_machines.MACHINES[name](folder), steps=1, step=1e-5, coordinates=coordinates, stabilisation="direct")


def test_a_correction_of_a_flexible_loop_in_relative_coordinates(folder):
    """A step long enough that the loop opens."""
    short(tree_machines.MACHINES["loop"](folder), steps=1, step=1e-3, coordinates="relative", stabilisation="direct")


@pytest.mark.parametrize("integrator", ["ros2", "bdf", "radau"])
def test_stiffness_of_modes_alone(folder, integrator):
    short(tree_machines.MACHINES["pendulum"](folder), integrator, steps=2, step=1e-4, coordinates="relative")


@pytest.mark.parametrize("integrator", [EXPLICIT, "generalised-alpha", "radau", "energy-momentum"])
@pytest.mark.parametrize("mass", ["lumped", "consistent"])
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_beams(integrator, mass, coordinates):
    if INTEGRATORS[integrator].needs == "whole steps" and coordinates != "absolute":
        pytest.skip("absolute coordinates alone")
    short(machine(beams.flying(2, mass, elements=2)).record, integrator, steps=2, step=1e-4, coordinates=coordinates)


@pytest.mark.parametrize(
    ("model", "integrator"),
    [("ancf-beam", "generalised-alpha"), *(("ancf-cable", each) for each in ("generalised-alpha", "radau", "ros2"))],
)
def test_beams_in_absolute_nodal_coordinates(model, integrator):
    short(machine(gradient_beams.flying(model, elements=1)).record, integrator, steps=1, step=1e-4)


@pytest.mark.parametrize(
    ("kind", "integrator"),
    [
        *((kind, "generalised-alpha") for kind in test_rails.KINDS),
        *((test_rails.KINDS[-1], each) for each in ("radau", "ros2")),
    ],
)
@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_sliders(kind, integrator, coordinates):
    short(machine(test_rails.bead(kind)).record, integrator, steps=1, coordinates=coordinates)


def test_nodes_that_are_driven_and_joined():
    short(machine(beams.hinged(4)).record, "generalised-alpha", steps=2)


@pytest.mark.parametrize("model", ["segments", "damped", "total", "long"])
def test_further_beams(model):
    """Springs between rigid segments; elements with damping, of another interpolation, of four nodes."""
    more = {
        "segments": {"model": "segments", "order": 1},
        "damped": {"damping": 0.01},
        "total": {"interpolation": "total"},
        "long": {"order": 3, "elements": 1, "angular_velocity": [0.0, 0.0, 0.0]},
    }
    record = machine(beams.flying(**{"order": 2, "mass": "lumped", "elements": 2, **more[model]})).record
    short(record, "generalised-alpha", steps=2, step=1e-4)


@pytest.mark.parametrize("coordinates", tail(["absolute", "relative"], ["relative"]))
def test_a_slider_passes_a_node(coordinates):
    sections = test_rails.spinning(7, STEP)
    place = 4.0 / 7 - 2e-3
    sections["bodies"]["bead"] |= {"position": [place, 0, 0], "velocity": [1.0, 3 * place, 0]}
    sections["joints"]["pad"]["point"] = [place, 0, 0]
    short(machine(sections).record, "generalised-alpha", steps=5, coordinates=coordinates)


def test_beams_that_slide_on_beams():
    record = machine(test_eliminated_rails.telescope()).record
    short(record, "generalised-alpha", steps=1, step=1e-2, coordinates="relative", stabilisation="direct")


@pytest.mark.parametrize("coordinates", tail(["absolute", "relative"], ["relative"]))
def test_flexible_bodies_beams_and_sliders(folder, coordinates):
    record = machine(mixed_machines.mixed(folder, closed=True)).record
    short(record, "generalised-alpha", steps=1, step=1e-4, coordinates=coordinates)


@pytest.mark.parametrize("coordinates", tail(["absolute", "relative"], ["relative"]))
def test_statics(coordinates):
    machine(test_statics_closed_forms.four_bar()).statics(coordinates=coordinates)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_kinematics_and_linear_equations(coordinates):
    machine = nivel.load(ROOT / "examples" / "mechanisms" / "four-bar.yaml")
    machine.kinematics(drive="crank_pivot", positions=3, end="1 rad", coordinates=coordinates)
    machine.linearise(inputs=["crank_pivot"], coordinates=coordinates)


# --- live operation ---


class Clock:
    """The clocks of the system in Python; none sleeps."""

    def __init__(self, live):
        self.live, self.now = live, 10**9

    def read(self, _clock, _address):
        self.now += 400_000
        self.live.now[:] = divmod(self.now, 10**9)

    def sleep(self, *_):
        pass


@pytest.mark.parametrize("paced", [0, 1])
def test_live_ticks(paced):
    """Ticks that are late, an operator within and beyond the range, and one who is lost."""
    plan, pace = live_plan(cart.machine().record, {}, 2e-3)
    live_run = prepared_run(plan, pace)
    live = live_in(bytearray(bytes_of(live_run.sizes)), live_run.sizes)
    loop, clock = live_run.begin(live), Clock(live)
    live.address[[paced_loop.CLOCK, paced_loop.SLEEP]] = plain.address_of(clock.read), plain.address_of(clock.sleep)
    live.control[paced_loop.PACED], live.control[paced_loop.TICKS] = paced, 3
    for target in (0.5, 7.0, float("nan")):
        live.target[:] = target
        live.control[paced_loop.HEARD] = clock.now
        assert loop() == BUDGET_SPENT
    live.control[paced_loop.FROM_TAPE] = 1
    assert loop() == BUDGET_SPENT
    assert live.control[paced_loop.DONE] == 12
    motion, run = live_run.prepared.motion, live_run.run
    code, family = motion.kernels.evaluate.address, motion.system.record.elements.address[0]
    assert repeat_evaluation(code, motion.handle.address, 0.0, run.y.copy(), run.rate.copy(), 2) == OK
    assert repeat_family(family, motion.handle.address, 0, 0.0, 2) == OK
    assert repeat_rows(motion.handle.address, 2) == OK
    # an evaluation that ends before its forces
    motion.system.record.elements.address[0] = halt.address
    assert repeat_evaluation(code, motion.handle.address, 0.0, run.y.copy(), run.rate.copy(), 2) == DONE


# --- circuits ---


@pytest.fixture
def unsteady(monkeypatch):
    """Pressures start where they are written: their way to rest calls nothing but what the steps call, thousands of times."""
    monkeypatch.setattr(circuit_start, "MOST", 1)


@pytest.mark.parametrize("integrator", [EXPLICIT, "extrapolated-euler", "radau"])
@pytest.mark.usefixtures("unsteady")
def test_circuits(integrator):
    """Every family of components, in a circuit with a cylinder, a telescope and a rotary actuator."""
    # so short that none is divided, of pressures that are not at rest
    few = {"steps": 2, "step": 1e-7}
    short(hydraulic_zoo.machine_with_circuits().record, integrator, **few)
    short(hydraulic_zoo.machine_with_gas().record, integrator, **few)
    short(hydraulic_zoo.machine_with_warm_oil().record, integrator, **few)


@pytest.mark.parametrize("integrator", ["radau", "extrapolated-euler"])
def test_lines_and_gas_that_cools(integrator):
    """A hose in segments, liquid with dissolved air, a valve that switches, and an accumulator that takes the temperature around it."""
    rated = {"flow": "40 L/min", "pressure_drop": "8 bar"}
    curve = {"pressures": ["100 bar", "200 bar"], "volumes": ["4 cm^3/m", "6 cm^3/m"]}
    hydraulics = {
        "tank": {"type": "tank", "pressure": "60 bar"},
        "drain": {"type": "tank", "pressure": "1 bar"},
        "end": {"type": "volume", "volume": "100 cm^3"},
        "hose": {"type": "volume", "volume": "100 cm^3"},
        "line": {"type": "line", "ports": {"A": "tank", "B": "end"}, "diameter": "20 mm", "length": 2, "segments": 2,
                 "expansion": curve},
        "valve": {"type": "directional-valve", "ways": "2/2", "ports": {"P": "end", "A": "hose"}, "command": "time > 5e-5",
                  "switching": {"on_delay": "20 us", "off_delay": "40 ms", "time": "10 ms"}, **rated},
        "orifice": {"type": "orifice", "ports": {"A": "hose", "B": "drain"}, **rated},
        "store": {**test_thermal_accumulator.STORE, "ports": {"A": "hose"}, "piston_friction": "0.5 bar"},
    }  # fmt: skip
    fluids = {"oil": {"grade": "HLP 46", "air": 0.01, "dissolved_air": 0.05, "isothermal": False}}
    short(circuit(hydraulics, fluids=fluids).record, integrator, steps=2, step=1e-4, coordinates="relative")


@pytest.mark.usefixtures("unsteady")
def test_circuits_with_derivatives_by_hand():
    short(
        hydraulic_zoo.machine_whose_commands_wait().record,
        "extrapolated-euler",
        steps=2,
        step=1e-4,
        coordinates="relative",
    )


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_an_end_stop_that_is_met_within_the_first_half_of_a_step(coordinates):
    """0.2 m/s for half a millisecond are 0.1 mm."""
    short(ram(100, 5e-5).record, "extrapolated-euler", steps=2, step=1e-3, coordinates=coordinates)


BOOM = """
format: 1
gravity: [0, 0, -9.81]
bodies:
  boom: {{flexible: {{file: {file}, modes: 2}}, position: [-0.090, 0, 1.426]}}
joints:
  luffing: {{type: revolute, bodies: [ground, boom], point: [-0.090, 0, 1.426], axis: [0, -1, 0]}}
hydraulics:
  high: {{type: tank, pressure: 100 bar}}
  low: {{type: tank, pressure: 2 bar}}
  small: {{type: volume, volume: 1 cm^3, start: 2 bar}}
  inlet: {{type: orifice, ports: {{A: high, B: small}}, diameter: 5 mm}}
  feed: {{type: orifice, ports: {{A: small, B: lift.A}}, diameter: 5 mm}}
  back: {{type: orifice, ports: {{A: lift.B, B: low}}, diameter: 5 mm}}
  lift:
    {{type: cylinder, bodies: [ground, boom], points: [[0.170, 0, 0.386], [0.214, 0, 1.326]], piston: 100 mm, rod: 56 mm,
     stroke: 0.55, retracted_length: 0.82, start_A: 20 bar, start_B: 2 bar}}
"""


def test_circuits_with_derivatives_by_hand_and_flexible_bodies():
    """The small volume fills at once, so that steps are made in parts."""
    file = ROOT / "examples" / "hydraulics" / "booms" / "boom.nc"
    record = parse_machine(BOOM.format(file=file))
    done = short(record, "extrapolated-euler", steps=2, step=1e-3, coordinates="relative")
    assert done.finished.timing["rejected"] > 0


# --- nothing is left out ---


def kernels():
    """(file, first line) → name of all functions that are compiled."""
    found = {}
    for package in ("kernels", "elements", "motion", "integrate"):
        for path in sorted((Path(nivel.__file__).parent / package).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.FunctionDef) and any(_name(each) in COMPILERS for each in node.decorator_list):
                    found[str(path), node.decorator_list[0].lineno] = f"{path.stem}.{node.name}"
    return found


COMPILERS = ("leaf", "stage", "shared", "entry", "address", "family", "element")


ONE = ["sin", "cos", "tan", "atan", "sqrt", "abs", "floor", "tanh", "exp", "log", "asin", "acos", "sign"]
TWO = (
    "time^3",
    "1/time",
    "atan2(time, 0.2)",
    "min(time, 0.3)",
    "max(time, 0.3)",
    "if(time < 0.1, 1, time)",
    "time <= 0.2",
    "time^time",
)
CURVE = Lookup(Time(), "linear", (0.0, 0.2, 0.5), (1.0, 3.0, -1.0))


@pytest.mark.parametrize(
    "expression",
    [Expression(text) for text in (*(f"-{name}(2*time - 0.1)" for name in ONE), *TWO)] + [expression_of(CURVE)],
)
def test_bounds_of_programs_hold(expression):
    curve, time = ExpressionCurve(expression), np.linspace(-0.3, 0.7, 8)
    low, high = curve.bounds({"time": time[:-1]}, {"time": time[1:]})
    for share in (0.0, 0.4, 1.0):
        inside = curve.values({"time": (1.0 - share) * time[:-1] + share * time[1:]})
        known = np.isfinite(inside)
        assert np.all((low[known] <= inside[known] + 1e-12) & (inside[known] <= high[known] + 1e-12))


def _name(decorator):
    return getattr(decorator.func if isinstance(decorator, ast.Call) else decorator, "id", "")


def test_every_kernel_was_called(request):
    """The last test, where all others ran before it."""
    if request.config.option.keyword or any("::" in each for each in request.config.args):
        pytest.skip("not all tests ran")
    idle = {name for place, name in kernels().items() if place not in plain.CALLED}
    assert not idle - LEFT_OUT, " ".join(sorted(idle - LEFT_OUT))
