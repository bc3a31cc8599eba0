"""Rows that repeat others in every position: found, proven aside, left out of the factor; multipliers of least length in frames."""

from typing import Any

import numpy as np
import pytest

from nivel import Body, Joint, MachineRecord, SimulationSettings
from nivel.analysis.assembly.redundancy import dependent_rows
from nivel.analysis.preparation import preparation
from nivel.kernels.solve.saddle import LEFT_OUT, PIVOTED, RANK
from preparing import prepare
from running import run


def windows(count, **settings: Any):
    """N four-bars side by side, all joints revolute (IFToMM benchmark A02), with gravity out of the plane too."""
    bodies, joints = [], []
    start: dict[str, Any] = {"start_rates": {"angle": -1.0}}
    inertia: Any = (0.08, 0.001, 0.08)
    for k in range(count + 1):
        bodies.append(Body(name=f"crank{k}", mass=1.0, inertia=inertia, position=(k, 0.5, 0)))
        joints.append(pin(f"foot{k}", ("ground", f"crank{k}"), (k, 0, 0), **(start if k == 0 else {})))
    for k in range(count):
        bodies.append(Body(name=f"rod{k}", mass=1.0, inertia=inertia, position=(k + 0.5, 1, 0)))
        joints.append(pin(f"left{k}", (f"crank{k}", f"rod{k}"), (k, 1, 0)))
        joints.append(pin(f"right{k}", (f"rod{k}", f"crank{k + 1}"), (k + 1, 1, 0)))
    return MachineRecord(
        name="windows",
        gravity=(0.3, -9.81, 5.0),
        bodies=tuple(bodies),
        joints=tuple(joints),
        simulation=SimulationSettings(**{"duration": 0.3, "step": 1e-3, "output_interval": 0.1, **settings}),
    )


def pin(name, bodies, point, **start: Any):
    return Joint(name=name, type="revolute", bodies=bodies, point=point, axis=(0, 0, 1), **start)


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_three_rows_of_each_window_are_left_out(coordinates):
    prepared = prepare(windows(3), coordinates=coordinates)
    control, saddle = prepared.motion.system.record.control, prepared.motion.system.record.saddle
    prepared.motion.evaluate(0.0, prepared.start)
    assert control.rank[LEFT_OUT] == len(saddle.row) - control.rank[RANK] == 9
    assert control.rank[PIVOTED] == 0


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_multipliers_in_frames_are_those_of_least_length(coordinates):
    """λ = D⁻¹ (C_qᵀ D⁻¹)⁺ f with D² = diag(C_q M⁻¹ C_qᵀ), by NumPy from the bodies' masses; f = C_qᵀ λ is what the machine needs."""
    machine = windows(3, coordinates=coordinates)
    result = run(machine)
    prepared = prepare(machine)
    motion = prepared.absolute
    theta = result.orientation
    for k in range(len(result.time)):
        y = motion.system.state(
            np.hstack([result.position[k], theta[k]]).ravel(), result.velocity[k], np.zeros((len(theta[k]), 3))
        )
        motion.evaluate(0.0, y)
        C_q, bodies = motion.jacobian(), motion.system.record.bodies
        # frames at the centres of mass: M is diag(m, J) in body axes
        inverse = np.concatenate(
            [np.r_[1 / m, 1 / m, 1 / m, 1 / np.diag(J)] for m, J in zip(bodies.mass, bodies.inertia_b, strict=True)]
        )
        D = np.sqrt(np.einsum("ri,i,ri->r", C_q, inverse, C_q))
        found = result.constraint_force[k]
        least = np.linalg.pinv(C_q.T / D, rcond=1e-9) @ (C_q.T @ found) / D
        np.testing.assert_allclose(found, least, atol=1e-7 * np.abs(found).max())
        # gravity pushes out of the plane: nothing here is zero by symmetry
        assert np.abs(found).min() < np.abs(found).max()
        assert np.abs(result.joint_force[k][:, 2]).max() > 1.0


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
def test_the_motion_is_that_of_rows_chosen_by_pivots(coordinates, monkeypatch):
    """Through flat positions (0.9 s), near which rows are chosen by pivots, and in which freedoms split."""
    settings = {"coordinates": coordinates, "duration": 1.2, "stabilisation": "direct"}
    sparse = run(windows(2, **settings))
    monkeypatch.setattr(preparation, "leave_out", lambda system, rows: None)
    pivoted = run(windows(2, **settings))
    assert sparse.finished.outcome == pivoted.finished.outcome == "done"
    np.testing.assert_allclose(sparse.position, pivoted.position, atol=1e-9)
    np.testing.assert_allclose(sparse.joint_force, pivoted.joint_force, atol=1e-6 * np.abs(pivoted.joint_force).max())


def test_a_choice_of_rows_that_fails_in_some_positions_gives_way_to_another(monkeypatch):
    """About parallel axes one of two tilts is left out twice and the other never; once the crank has turned, both are once."""
    machine = windows(1, coordinates="absolute")
    right = run(machine)
    names = prepare(machine).absolute.system.rows
    rows = [names.index(name) for name in ("foot0.d1.xz", "left0.d1.xz", "right0.s.z")]
    monkeypatch.setattr(preparation, "rows_everywhere", lambda *_: rows)
    prepared = prepare(machine)
    control, saddle = prepared.motion.system.record.control, prepared.motion.system.record.saddle
    prepared.motion.evaluate(0.0, prepared.start)
    assert control.rank[LEFT_OUT] == 3
    assert control.rank[PIVOTED] == 0
    left_out = saddle.row[saddle.order[saddle.least < 0.0]]
    assert len(left_out) == 3
    assert set(left_out.tolist()) != set(rows)
    result = run(machine)
    np.testing.assert_allclose(result.position, right.position, atol=1e-9)
    np.testing.assert_allclose(result.joint_force, right.joint_force, atol=1e-6 * np.abs(right.joint_force).max())


@pytest.mark.parametrize("seed", range(4))
def test_dependent_rows_are_those_that_add_nothing_to_the_rows_before_them(seed):
    rng = np.random.default_rng(seed)
    J = rng.standard_normal((12, 9))
    J[4], J[9] = J[1] - J[3], J[0] + 2.0 * J[4] + J[7]
    J /= np.linalg.norm(J, axis=1, keepdims=True)
    ranks = [np.linalg.matrix_rank(J[:k]) for k in range(13)]
    dependent, N = dependent_rows(J)
    assert dependent == [k for k in range(12) if ranks[k + 1] == ranks[k]]
    np.testing.assert_allclose(N.T @ J, 0.0, atol=1e-12)
