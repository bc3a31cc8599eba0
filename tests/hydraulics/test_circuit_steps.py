"""Steps over circuits with derivatives by hand: the derivatives, and the motion beside that of steps with all tangents."""

from itertools import pairwise

import numpy as np
import pytest

from hydraulic_zoo import machine_whose_commands_wait
from nivel.analysis.assembly.implicit import ResidualOptions, find_tangent, with_residual
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run.dynamics import start_loop
from nivel.analysis.run.prepared_state import prepare
from nivel.integrate.loop.run import BUDGET
from nivel.kernels.core.status import BUDGET_SPENT, OK
from nivel.kernels.record.record import NONE
from simulating import hinge, machine, solid

FAST = {"integrator": "extrapolated-euler", "coordinates": "relative"}
FULL = {"integrator": "extrapolated-euler", "coordinates": "absolute"}


def after_one_step(built, step):
    """The prepared machine whose record has the derivatives of its start, and what they were found for."""
    settings = built.record.simulation.replace(duration=1.0, step=step, **FAST)
    plan = plan_run(built.record.replace(simulation=settings))
    prepared = prepare(plan.methods)
    assert prepared.integrator.needs == "circuits"
    loop = start_loop(prepared, plan.settings)
    loop.history.record.counter[BUDGET] = 1
    assert loop.advance() == BUDGET_SPENT
    return prepared, loop.history.record.previous.copy()


@pytest.fixture(scope="module")
def derivatives():
    """(circuit with the derivatives by hand, the same by complex steps for positions, velocities and states, number of velocities)."""
    prepared, y = after_one_step(machine_whose_commands_wait(), 1e-9)
    circuit = prepared.motion.system.record.circuit
    exact = with_residual(prepared.motion, y, "relative", ResidualOptions())
    status, rate = exact.evaluate(0.0, y)
    assert status == OK
    record = exact.system.record
    record.circuit.secant[:] = 1
    n, positions = len(record.residual.vdot), exact.system.positions
    record.residual.y[:] = y
    record.residual.vdot[:] = rate[positions : positions + n]
    shares = {"positions": (1.0, 0.0, 0.0), "velocities": (0.0, 1.0, 0.0), "states": (0.0, 0.0, 1.0)}
    none = find_tangent(exact, 0.0, 0.0, 0.0, 0.0)[1]
    return circuit, {name: none - find_tangent(exact, 0.0, *share)[1] for name, share in shares.items()}, n


def assert_rows_agree(found, exact, scale, share):
    """Entries differ by less than a share of the largest one of their row, for changes of the size `scale` of the columns."""
    found, exact = found * scale, exact * scale
    largest = np.max(np.abs(exact), axis=1, keepdims=True)
    assert np.max(largest) > 0.0
    assert np.max(np.abs(found - exact) / np.where(largest > 0.0, largest, 1.0)) < share


def test_rates_of_states_have_the_derivatives_of_complex_steps(derivatives):
    """But for those of densities in flows, which are Δp/β of the others, of cushions and of the openings that a load signal feels."""
    circuit, exact, n = derivatives
    tangent = circuit.tangent
    states = n + tangent.state.astype(int)
    count, scale = len(states), scales(circuit)
    of_states = exact["states"][np.ix_(states, states)]
    assert_rows_agree(tangent.slopes[:count, :count], of_states, scale, 0.05)
    for name, first in (("positions", count), ("velocities", count + len(tangent.coordinate))):
        along = tangent.slopes[:count, first : first + len(tangent.coordinate)] @ tangent.direction
        assert_rows_agree(along, exact[name][np.ix_(states, range(n))], 1.0, 0.05)


def test_efforts_have_the_derivatives_of_complex_steps(derivatives):
    circuit, exact, n = derivatives
    tangent = circuit.tangent
    states, count = n + tangent.state.astype(int), len(tangent.state)
    by_states = tangent.direction.T @ tangent.effort[:, :count]
    assert_rows_agree(by_states, exact["states"][np.ix_(range(n), states)], scales(circuit), 0.02)
    by_rates = tangent.direction.T @ tangent.effort[:, count + len(tangent.coordinate) :] @ tangent.direction
    # densities in the torque of the motor are left out
    assert by_rates == pytest.approx(exact["velocities"][:n, :n], abs=1e-3 * np.max(np.abs(by_rates)))


def test_unit_efforts_are_answered_by_the_mass_matrix(derivatives):
    """M times the response is the direction of the effort; the zoo has one degree of freedom a body."""
    tangent, n = derivatives[0].tangent, derivatives[2]
    assert tangent.compliance == pytest.approx(tangent.direction @ tangent.response.T, rel=1e-12)
    masses = np.abs(tangent.direction).sum(axis=0) / np.maximum(np.abs(tangent.response).sum(axis=0), 1e-300)
    assert sorted(masses) == pytest.approx(sorted([100.0, 80.0, 3.0]), rel=1e-9)
    assert n == 3


def scales(circuit):
    """What a state of the circuit changes by for 1 bar, or 1."""
    out = np.ones(len(circuit.tangent.state))
    for node, state in enumerate(circuit.node[:, 1]):
        if state != NONE:
            out[circuit.tangent.unknown[state]] = 1e5 / circuit.tangent.by_mass[node]
        elif circuit.tangent.signal[node] != NONE:
            out[circuit.tangent.signal[node]] = 1e5
    return out


def end(built, name, **settings):
    result = built.simulate(duration=0.02, output_interval=0.02, **settings)
    assert result.trust.outcome == "done"
    return np.asarray(result.array(name))[-1]


def test_steps_by_hand_are_of_order_two_and_end_where_those_of_all_tangents_end():
    built = machine_whose_commands_wait()
    places = [end(built, "position", step=step, **FAST) for step in (2e-4, 1e-4, 5e-5)]
    coarse, fine = (np.max(np.abs(a - b)) for a, b in pairwise(places))
    assert np.log2(coarse / fine) > 1.6
    full = end(built, "position", step=5e-5, **FULL)
    assert np.max(np.abs(full - places[-1])) < 2.0 * fine


def four_bar_with_a_cylinder():
    """A parallelogram whose crank a cylinder turns: in relative coordinates one joint is cut, and its rows hold the answers to efforts."""
    return machine(
        {
            "gravity": [0, -9.81, 0],
            "bodies": {
                "crank": solid(20.0, 2.0, position=[0, 0.5, 0]),
                "coupler": solid(30.0, 5.0, position=[1, 1, 0]),
                "rocker": solid(20.0, 2.0, position=[2, 0.5, 0]),
            },
            "joints": {
                "a": hinge("ground", "crank"),
                "b": hinge("crank", "coupler", [0, 1, 0]),
                "c": {"type": "spherical", "bodies": ["coupler", "rocker"], "point": [2, 1, 0]},
                "d": {"type": "universal", "bodies": ["ground", "rocker"], "point": [2, 0, 0], "axes": [[1, 0, 0], [0, 0, 1]]},
            },
            "hydraulics": {
                "supply": {"type": "tank", "pressure": "60 bar"},
                "tank": {"type": "tank", "pressure": "2 bar"},
                "valve": {
                    "type": "directional-valve", "ways": "4/3", "frequency": "20 Hz", "flow": "20 L/min", "pressure_drop": "7 bar",
                    "ports": {"P": "supply", "T": "tank", "A": "ram.A", "B": "ram.B"}, "command": "0.5*sin(8*time)",
                },
                "ram": {
                    "type": "cylinder", "bodies": ["ground", "crank"], "points": [[-0.8, 0, 0], [0, 0.5, 0]], "piston": "40 mm",
                    "rod": "25 mm", "stroke": 0.5, "retracted_length": 0.7, "start_A": "20 bar", "start_B": "20 bar",
                },
            },
        }
    )  # fmt: skip


def test_joints_that_are_cut_hold_while_cylinders_push():
    built = four_bar_with_a_cylinder()
    by_hand = end(built, "position", step=2e-4, **FAST)
    full = end(built, "position", step=2e-4, **FULL)
    halved = end(built, "position", step=1e-4, **FAST)
    assert np.max(np.abs(by_hand - halved)) < 2e-6
    assert np.max(np.abs(by_hand - full)) < 4.0 * max(np.max(np.abs(by_hand - halved)), 1e-9)
