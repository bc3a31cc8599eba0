"""What the plan of the derivatives knows of a machine, and the structure that the matrix has: couplings, colouring, mass, symmetry."""

from dataclasses import replace

import numpy as np

import linked
from assembled import mass_matrix
from nivel.analysis.assembly.implicit import evaluate_residual, find_tangent
from nivel.system.tables import index_array
from simulating import G, solid
from tangent_zoo import COORDINATES, EACH, state_of
from unknowns import SHARES, TIME, moving


def put(here):
    """Let the residual's record have the state and its unknowns."""
    residual = here.motion.system.record.residual
    here.motion.system.record.newton.change[:] = 0.0
    residual.y[:], residual.vdot[:], residual.lam[:] = here.y, here.vdot, here.lam
    return here.motion.system.record


def coupled(record):
    """(N, N) whether the plan has an entry there."""
    newton, size = record.newton, len(record.newton.b)
    out = np.zeros((size, size), dtype=bool)
    out[np.repeat(np.arange(size), np.diff(newton.row_start.astype(np.int64))), newton.column] = True
    return out


@COORDINATES
@EACH
def test_columns_found_together_are_those_found_one_by_one(name, coordinates, rng):
    """To the last bit: what is moved together meets in no row."""
    here = state_of(name, coordinates, rng)
    record = put(here)
    _, together = find_tangent(here.motion, TIME, *SHARES)
    single = record.newton._replace(group_start=np.arange(len(record.newton.group) + 1, dtype=np.uint32))
    one_by_one = replace(here.motion, system=replace(here.motion.system, record=record._replace(newton=single)))
    _, alone = find_tangent(one_by_one, TIME, *SHARES)
    np.testing.assert_array_equal(together, alone)


@EACH
def test_what_is_not_a_number_in_one_body_stays_within_what_is_coupled_to_it(name, rng):
    """NaN in the position, rotation or velocities of one body reaches only rows that the plan has for its unknowns."""
    here = state_of(name, "absolute", rng)
    record = put(here)
    known, n, states, rows = coupled(record), here.n, here.states, here.rows
    for body in range(here.motion.system.body_count):
        for first, count in ((7 * body, 3), (7 * body + 3, 4), (here.positions + 6 * body, 6)):
            put(here)
            record.residual.y[first : first + count] = np.nan
            evaluate_residual(here.motion, TIME)
            value = record.residual.value
            reached = np.append(
                np.isnan(value[: n + states]), np.isnan(value[n + states :].reshape(3, rows)).any(axis=0)
            )
            assert not np.any(reached & ~known[:, 6 * body : 6 * body + 6].any(axis=1))
    for k in range(rows):
        put(here)
        record.residual.lam[k] = np.nan
        evaluate_residual(here.motion, TIME)
        assert not np.any(np.isnan(record.residual.value[: n + states]) & ~known[: n + states, n + states + k])
    put(here)
    evaluate_residual(here.motion, TIME)
    assert np.isfinite(record.residual.value).all()


@COORDINATES
@EACH
def test_mass_matrix_is_symmetric_and_positive_and_rows_of_constraints_are_transposed(name, coordinates, rng):
    """With unknowns that move next to nothing the matrix is [M C_qᵀ; C_q 0]; friction that its joint's reaction loads bends C_qᵀ."""
    here = state_of(name, coordinates, rng)
    record = put(here)
    status, matrix = find_tangent(here.motion, TIME, 1e-20, 1e-20, 1e-20)
    assert status == 0
    n, first = here.n, here.n + here.states
    M = matrix[:n, :n]
    if n:
        np.testing.assert_allclose(M, M.T, atol=1e-14 * np.abs(M).max())
        scale = np.sqrt(np.diag(M))
        assert np.linalg.eigvalsh(M / np.outer(scale, scale))[0] > 0.0
    if coordinates == "absolute":
        np.testing.assert_allclose(M, mass_matrix(here.motion.system), atol=1e-13 * np.abs(M).max())
    np.testing.assert_allclose(matrix[n:first, n:first], np.eye(here.states), atol=1e-15)
    np.testing.assert_array_equal(matrix[first:, first:], 0.0)
    if not len(record.friction.columns):
        np.testing.assert_array_equal(matrix[:n, first:], matrix[first:, :n].T)


def springs():
    """A tree of joints with two freedoms at most, so that positions are coordinates; springs of all kinds that store energy."""
    kinds = ("revolute", "universal", "cylindrical", "translational", "screw", "planar")
    bodies, joints, _ = linked.chain(6, kinds)
    joints["j4"]["pitch"] = 0.3
    table = {"deflections": [-0.5, 0.0, 0.3, 3.0], "forces": [-60, -4, 7, 90]}
    ends = [{"body": "b1", "position": [0.1, 0, 0.1]}, {"body": "b4", "position": [0, 0.2, 0.1]}]
    forces = {
        "linear": {"type": "spring-damper", "markers": ends, "stiffness": 80, "free_length": 0.3, "preload": 4},
        "table": {
            "type": "spring-damper",
            "markers": [{"body": "ground"}, ends[1]],
            "free_length": 0.5,
            "table": table,
        },
        "mount": {
            "type": "bushing",
            "markers": [{"body": "b0"}, {"body": "b3", "orientation": {"axis": [1, 2, 0], "angle": 1.2}}],
            "stiffness": [40, 60, 80, 5, 8, 6],
            "damping": [0.0] * 6,
        },
        "coil": {"type": "joint-spring-damper", "coordinate": "j0", "stiffness": 4.0, "free_value": 0.1},
        "weight": {"type": "force", "body": "b5", "position": [0.1, 0, 0.2], "vector": [3, -2, 5]},
    }
    return linked.record({"gravity": [1, -G, 2], "bodies": bodies, "joints": joints, "forces": forces})


def test_stiffness_of_what_has_a_potential_is_symmetric(rng):
    """K = ∂²V/∂q² in joint coordinates, at rest: v = 0, v̇ = 0, not in equilibrium."""
    here = next(moving(springs(), "relative", rng))
    here.y[here.positions : here.positions + here.n] = 0.0
    here.vdot[:] = 0.0
    put(here)
    _, M = find_tangent(here.motion, TIME, 1e-20, 1e-20, 1e-20)
    _, both = find_tangent(here.motion, TIME, 1.0, 1e-20, 1e-20)
    K = both - M
    np.testing.assert_allclose(K, K.T, atol=1e-12 * np.abs(K).max())
    assert np.abs(K).max() > 10.0


def test_bodies_that_are_all_fixed_have_an_empty_matrix(rng):
    bodies = {"a": solid(), "b": solid(position=[1, 0, 0])}
    joints = {name: {"type": "fixed", "bodies": ["ground", name], "point": [0, 0, 0]} for name in bodies}
    here = next(moving(linked.record({"bodies": bodies, "joints": joints}), "relative", rng))
    record = put(here)
    assert here.motion.system.record.residual.acceleration.shape == (3, 6)
    assert evaluate_residual(here.motion, TIME) == 0
    assert find_tangent(here.motion, TIME, *SHARES)[1].shape == (0, 0)
    assert index_array([], 1).size == len(record.newton.group)
