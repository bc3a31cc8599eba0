"""Residual and tangent of implicit methods in prepared states: every joint, force, coupling, driver and machine, in motion.

An item is a state of a machine in one kind of coordinates, which is prepared once; what is claimed of it is in `CLAIMS`.
"""

from dataclasses import replace

import numpy as np

import claims
from assembled import mass_matrix
from force_zoo import CASES
from lanes import FULL
from nivel.analysis.assembly.implicit import evaluate_residual, find_tangent
from nivel.integrate.newmark.newton_state import set_state
from nivel.kernels.elements.friction import COORDINATE, FIRST, JOINT, MODEL, PATCH
from nivel.kernels.record.record import NONE
from tangent_zoo import FORMULATED, residual_of, state_of, tangent_rests
from unknowns import ROTATIONS, SHARES, TIME, Unknowns, value_at

# round-off, and what friction's iteration is closed to
ROUND_OFF = 1e-12
# some units in the last place of the largest term of a sum
LAST_PLACES = 1e-14
# of the largest entry in each row; the differences are good for 2e-11, mostly for 1e-12
DIFFERENCES = 5e-11


def residual_vanishes(here, rng):
    """M v̇ + C_qᵀ λ = Q, C = 0, Ċ = 0, C̈ = 0, the laws of efforts with stiction and the rates of states; each as a share of the largest
    term in it."""
    none, nothing, rows = np.zeros(here.n), np.zeros(len(here.lam)), here.rows
    r, rates, C, Cdot, second = value_at(here, here.y, here.vdot, here.lam)
    forces, _, _, _, gamma = value_at(here, here.y, none, nothing)
    inertia = value_at(here, here.y, here.vdot, nothing)[0] - forces
    constraint = value_at(here, here.y, none, here.lam)[0] - forces
    largest = max(np.abs(term).max(initial=1e-300) for term in (forces, inertia, constraint))
    assert np.abs(r).max(initial=0.0) < ROUND_OFF * largest
    C_q = find_tangent(here.motion, TIME, 1.0, 1.0, 1.0)[1][here.n + here.states :, : here.n][:rows]
    speed = np.abs(here.y[here.positions : here.positions + here.n]).max(initial=0.0)
    across, most = np.abs(C_q).sum(axis=1), np.abs(here.vdot).max(initial=0.0)
    bias = np.abs(gamma[:rows]).max(initial=0.0)
    # multipliers solve C_q M⁻¹ C_qᵀ λ = …, to round-off of these terms: large for light bodies, whose accelerations are small by cancelling
    terms = np.abs(C_q) @ np.abs(np.linalg.pinv(inertia_of(here))) @ np.abs(C_q.T) @ np.abs(here.lam[:rows])
    scale = ROUND_OFF * (across * most + bias + 1.0 + speed**2) + LAST_PLACES * terms
    assert np.all(np.abs(second[:rows]) <= scale)
    assert np.all(np.abs(Cdot[:rows]) <= ROUND_OFF * (1.0 + across * speed))
    assert np.all(np.abs(C[:rows]) < 1e-8 * max(here.size, 1.0))
    assert np.all(np.abs(second[rows:]) <= ROUND_OFF * largest)
    np.testing.assert_allclose(rates, here.xdot, rtol=1e-13)


def inertia_of(here):
    """M: the derivative of the residual where unknowns move next to nothing."""
    residual_of(here)
    return find_tangent(here.motion, TIME, 1e-20, 1e-20, 1e-20)[1][: here.n, : here.n]


def matrix_is_the_derivative(here, rng):
    """∂(r, ẋ - rates, C/cq)/∂(v̇, ẋ, λ) with positions, velocities and states moved by v̇ and ẋ; rotations once as they are, once in the
    middle of a step, where v̇ moves the rotation vector of the step and columns are for turns after it."""
    # all unknowns together may take bodies off surfaces that they touch
    touches = here.name in CASES and CASES[here.name].touches is not None
    looked_at = {"columns": 8} if touches else {"count": 3}
    for change in (None, rng.uniform(-0.5, 0.5, here.n)):
        assert Unknowns(here, change).error(**looked_at) < DIFFERENCES


def newton_moves_the_state(here, rng):
    """q = base ∘ exp(turn + cq v̇), v = speed + cv v̇, x = state + cx ẋ."""
    unknowns = Unknowns(here, rng.uniform(-0.5, 0.5, here.n))
    newton, residual = here.motion.system.record.newton, here.motion.system.record.residual
    (cq, cv, cx), n, p = SHARES, here.n, here.positions
    newton.base[:p] = unknowns.base
    newton.turn[:], newton.correction[:] = unknowns.change - cq * here.vdot - 0.25, 0.25
    newton.speed[:] = here.y[p : p + n] - cv * here.vdot
    newton.state[:] = here.y[p + n : -2] - cx * here.xdot
    z = unknowns.z + rng.uniform(-1, 1, len(unknowns.z))
    residual.vdot[:], newton.rate[:] = z[:n], z[n : n + here.states]
    set_state(here.motion.handle.address, cq, cv, cx)
    largest = 1.0 + np.abs(z).max(initial=0.0)
    np.testing.assert_allclose(residual.y[:-2], unknowns.state(z)[:-2], atol=1e-14 * largest)


def columns_found_together_are_those_found_one_by_one(here, rng):
    """What is moved together meets in no row. One by one a column is always the first slope of a dual number, together it may be the
    seventh, and slopes that share a vector are rounded otherwise than those left over: an entry may differ by round-off of the largest
    one in its row."""
    record = residual_of(here)
    _, together = find_tangent(here.motion, TIME, *SHARES)
    single = record.newton._replace(group_start=np.arange(len(record.newton.group) + 1, dtype=np.uint32))
    one_by_one = replace(here.motion, system=replace(here.motion.system, record=record._replace(newton=single)))
    _, alone = find_tangent(one_by_one, TIME, *SHARES)
    largest = np.abs(alone).max(axis=1, keepdims=True, initial=0.0)
    assert np.all(np.abs(together - alone) <= LAST_PLACES * largest)


def mass_matrix_is_symmetric_and_positive(here, rng):
    """With unknowns that move next to nothing the matrix is [M C_qᵀ; C_q 0]; friction that its joint's reaction loads bends C_qᵀ.

    The rows of efforts, behind those of constraints, are these efforts where surfaces are apart; the derivative of those that touch is
    another claim.
    """
    record = residual_of(here)
    status, matrix = find_tangent(here.motion, TIME, 1e-20, 1e-20, 1e-20)
    assert status == 0
    n, first = here.n, here.n + here.states
    last = first + here.rows
    M = matrix[:n, :n]
    if n:
        np.testing.assert_allclose(M, M.T, atol=1e-14 * np.abs(M).max())
        scale = np.sqrt(np.diag(M))
        assert np.linalg.eigvalsh(M / np.outer(scale, scale))[0] > 0.0
    if here.coordinates == "absolute":
        np.testing.assert_allclose(M, mass_matrix(here.motion.system), atol=1e-13 * np.abs(M).max())
    np.testing.assert_allclose(matrix[n:first, n:first], np.eye(here.states), atol=1e-15)
    np.testing.assert_array_equal(matrix[first:last, first:], 0.0)
    frictions = record.friction.columns
    # without frictions one half is found as the mirror of the other
    if all(columns[JOINT] == NONE for columns in frictions):
        round_off = 1e-15 * np.abs(matrix[first:last, :n]).max(initial=0.0) if len(frictions) else 0.0
        np.testing.assert_allclose(matrix[:n, first:last], matrix[first:last, :n].T, rtol=0.0, atol=round_off)
    for effort in apart(record, last):
        np.testing.assert_array_equal(matrix[effort], np.arange(len(matrix)) == effort)


def apart(record, first):
    """Rows of the efforts of patches whose surfaces do not touch; `first` is that of the first effort."""
    columns, coordinates = record.friction.columns, record.coordinates
    for number, k in enumerate(record.residual.stiction):
        if columns[k, MODEL] == PATCH and coordinates.value[columns[columns[k, FIRST], COORDINATE]] == 0.0:
            yield first + number


def coupled(record):
    """(N, N) whether the plan has an entry there."""
    newton, size = record.newton, len(record.newton.b)
    out = np.zeros((size, size), dtype=bool)
    out[np.repeat(np.arange(size), np.diff(newton.row_start.astype(np.int64))), newton.column] = True
    return out


def not_a_number_in_one_body_stays_within_what_is_coupled_to_it(here, rng):
    """NaN in the position, rotation or velocities of one body reaches only rows that the plan has for its unknowns."""
    record = residual_of(here)
    known, n, states, rows = coupled(record), here.n, here.states, len(here.lam)
    for body in range(here.motion.system.body_count):
        for first, count in ((7 * body, 3), (7 * body + 3, 4), (here.positions + 6 * body, 6)):
            residual_of(here)
            record.residual.y[first : first + count] = np.nan
            evaluate_residual(here.motion, TIME)
            value = record.residual.value
            reached = np.append(
                np.isnan(value[: n + states]), np.isnan(value[n + states :].reshape(3, rows)).any(axis=0)
            )
            assert not np.any(reached & ~known[:, 6 * body : 6 * body + 6].any(axis=1))
    for k in range(rows):
        residual_of(here)
        record.residual.lam[k] = np.nan
        evaluate_residual(here.motion, TIME)
        assert not np.any(np.isnan(record.residual.value[: n + states]) & ~known[: n + states, n + states + k])
    residual_of(here)
    evaluate_residual(here.motion, TIME)
    assert np.isfinite(record.residual.value).all()


def claims_of(name, coordinates):
    """What holds of a state, by name: of rotation coordinates beside those of bodies residual and derivative."""
    found = {"the residual vanishes for what explicit methods find": residual_vanishes}
    if FULL or not tangent_rests(name, coordinates):
        found["the matrix is the derivative of the residual"] = matrix_is_the_derivative
    if coordinates not in ROTATIONS:
        found["Newton's iteration moves the state as the matrix has it"] = newton_moves_the_state
        found["columns found together are those found one by one"] = columns_found_together_are_those_found_one_by_one
        found["the mass matrix is symmetric and positive, constraints transposed"] = (
            mass_matrix_is_symmetric_and_positive
        )
    if coordinates == "absolute":
        found["NaN in a body stays within what is coupled to it"] = (
            not_a_number_in_one_body_stays_within_what_is_coupled_to_it
        )
    return found


@FORMULATED
def test_residual_and_tangent(name, coordinates, rng):
    claims.check(claims_of(name, coordinates), state_of(name, coordinates, rng), rng)


def test_states_are_where_the_surfaces_of_contacts_and_stops_are_meant_to_be(rng):
    """What is verified above is a contact that touches, or one that does not."""
    for name, case in CASES.items():
        if case.touches is None:
            continue
        here = state_of(name, "absolute", rng)
        surfaces = here.motion.system.record.watched.surface
        if not len(surfaces):  # a blade in soil
            continue
        depths = [float(here.motion.system.record.elements.depth[tuple(each)]) for each in surfaces]
        assert (max(depths) > 0.01) == case.touches, (name, depths)
        assert case.touches or max(depths) < -0.01, (name, depths)
