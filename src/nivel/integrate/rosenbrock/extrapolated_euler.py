"""Euler's linearly implicit method, extrapolated once: order 2 at a fixed step and a fixed cost, for stiff circuits in real time.

    (1 - h J) k = f(t + h, y)            Y₁ = y + h k                 one step
    (1 - h/2 J) k = f(t + h/2, y), …     Y₂                           two steps of half the length, with the same J
    y := 2 Y₂ - Y₁

(Deuflhard, Hairer, Zugck 1987). The order is 2 for any J, and every stage forgets what decays within a step, so J may have the secants of
restrictions in place of their tangents: with these, a linearly implicit step over a small volume behind an orifice rings for ever, since
it is one step of Newton's method on a root.

Guard: where pressures of Y₁ and Y₂ differ by more than LARGEST, or a mass would vanish, the step is made in parts
(`step_in_parts`). Of the smallest parts that cannot be trusted either Y₂ is taken, or where that is no state, Y₁; they
are counted, and the largest difference is kept, in `Circuit.guard`.

Where surfaces of a contact or stop that were apart at the begin touch in the middle, J of the second half is that of the middle, and Y₂ is
taken as it is: J of the begin knows nothing of the contact, whose force over half a step would throw the bodies back, and so would an
extrapolation from Y₁, which has passed through the surface.
"""

import numpy as np

from nivel.elements.circuits.ledger import balance_mass, mass_apart
from nivel.elements.circuits.pistons import a_stop_is_met, pushing_stops
from nivel.elements.circuits.tangent import find_slopes, slope_by_mass
from nivel.elements.contacts.impact import meet
from nivel.elements.contacts.impact import part as separate
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import (
    EVALUATIONS,
    FACTORISATIONS,
    KNOWN,
    REACHED,
    REJECTED,
    STEP,
    STEP_SIGNATURE,
    TIME,
    evaluate_at,
    run_at,
)
from nivel.integrate.loop.step_control import evaluate_accepted
from nivel.kernels.algebra.rows import advance, copy
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_evaluate
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.residual.shifted_matrix import factorise_shifted, find_parts, keep_multipliers, solve_shifted_parts
from nivel.motion import circuit_shift
from nivel.motion.modal_shift import factorise_shifted_modes, solve_shifted_modes
from nivel.native.entry import entry
from nivel.native.function import leaf, part, shared, stage

# A step of fixed length, whole or in parts: where the whole one cannot be trusted, as where a valve opens onto a small volume, it is made
# in parts, halved until each can be, down to 1/PARTS of it. After a good part the next one is twice as long where it fits.
#
# Steps that were divided are counted in counter[REJECTED], parts that could not be trusted at the least length in `Circuit.guard`.

# A step has at most this many parts.
PARTS = 16
# Pressures [Pa] of a step and of two half ones may differ by this much.
LARGEST = 2e5


@shared
def step_in_parts(evaluate, machine, history, attempt, first):
    """One step. Returns a status.

    attempt : compiled into this one; (evaluate, machine, history) makes a step of clock[STEP] from y, last evaluated, into `trial`, and
    returns a status and by how much pressures [Pa] of one step and of two half ones differ, infinite where it cannot be trusted at all.
    first : row of run.stages that keeps the rate at the begin of the step.
    """
    run = run_at(history)
    clock, y = run.clock, run.y
    begin, end, h = clock[TIME], clock[REACHED], clock[STEP]
    kept, guard = run.stages[first], record_at(machine).circuit.guard
    done, size, status = 0, PARTS, OK
    while status == OK and done < PARTS:
        status, difference = attempt(evaluate, machine, history)
        if difference <= LARGEST or size == 1:
            if status == OK:
                copy(run.trial, y)
            if not difference <= LARGEST:
                guard[0] += 1.0
            if difference < np.inf:
                guard[1] = max(guard[1], difference)
            done += size
            if done % (2 * size) == 0 and done + 2 * size <= PARTS:
                size *= 2
        else:
            if size == PARTS:
                run.counter[REJECTED] += 1
                copy(run.rate, kept)
            size //= 2
            status = OK
            run.counter[KNOWN] = 0
        if status == OK and done < PARTS:
            clock[TIME] = begin + done * (h / PARTS)
            clock[STEP] = size * (h / PARTS)
            clock[REACHED] = end if done + size == PARTS else clock[TIME] + clock[STEP]
            status = evaluate_accepted(evaluate, machine, history)
    if clock[STEP] != h:
        clock[TIME], clock[REACHED], clock[STEP] = begin, end, h
        copy(kept, run.rate)
    return status


# rows of run.stages: rates inside the step, Y₁, Y₂, the rate at the begin
RATE, WHOLE, HALVES, BEGIN = 0, 1, 2, 3
# What becomes of a step: Y₂ is no state; Y₂ is taken as it is; 2 Y₂ - Y₁ is taken.
NO_STATE, PLAIN, EXTRAPOLATED = 0, 1, 2


@leaf
def advance_linearly(machine, run, y, share, into):
    """into := y + share (1 - share J)⁻¹ f with f in RATE; `into` may be y."""
    factors = record_at(machine).newton.shifted.real
    copy(run.stages[RATE], factors.r)
    apart = mass_apart(machine, factors.r)
    solve_shifted_parts(machine, factors, share)
    balance_mass(machine, factors.r, apart)
    advance(y, share, factors.r, into)


@leaf
def is_state(machine, y):
    """Whether all is a number, and no volume is empty."""
    record = record_at(machine)
    circuit, first = record.circuit, y.shape[0] - 2 - record.elements.state.shape[0]
    for i in range(y.shape[0]):
        if not np.abs(y[i]) < np.inf:
            return False
    smallest = 1.0
    for k in range(circuit.node.shape[0]):
        if circuit.node[k, 1] != NONE:
            smallest = min(smallest, y[first + np.int64(circuit.node[k, 1])])
    return smallest > 0.0


@leaf
def pressure_difference(evaluate, machine, run):
    """The largest difference of a pressure [Pa] at Y₁ and Y₂; infinite where one cannot be evaluated."""
    record = record_at(machine)
    pressure, kept = record.circuit.pressure, record.circuit.kept
    run.counter[EVALUATIONS] += 2
    if call_evaluate(evaluate, machine, run.clock[REACHED], run.stages[WHOLE], run.scratch) != OK:
        return np.inf
    copy(pressure, kept)
    if call_evaluate(evaluate, machine, run.clock[REACHED], run.stages[HALVES], run.scratch) != OK:
        return np.inf
    largest = 0.0
    for k in range(pressure.shape[0]):
        difference = np.abs(pressure[k] - kept[k])
        if not difference <= largest:
            largest = difference
    return largest


@leaf
def surfaces_meet(machine):
    """Whether surfaces touch in the state last evaluated that did not touch before; the speeds at which they met are kept while they do."""
    record = record_at(machine)
    met = False
    for j in range(record.watched.surface.shape[0]):
        separate(record.elements, record.watched.surface[j, 0], record.watched.surface[j, 1])
        if meet(record.elements, record.watched.surface[j, 0], record.watched.surface[j, 1]):
            met = True
    return met


@leaf
def renew_parts(machine, t, y, rate, s):
    """Factors for s with the derivatives at the state y, last evaluated, with its rate. Returns a status."""
    keep_multipliers(machine)
    status = find_parts(machine, t, y, rate)
    if status == OK:
        status = factorise_shifted(machine, record_at(machine).newton.shifted.real, s)
    return status


@leaf
def both(evaluate, machine, run, t, h):
    """Fill WHOLE and HALVES from the state y, last evaluated. Returns a status, and what becomes of the step."""
    y, rate = run.y, run.stages[RATE]
    shifted = record_at(machine).newton.shifted
    surfaces_meet(machine)
    status = find_parts(machine, t, y, run.rate)
    if status == OK:
        status = call_evaluate(evaluate, machine, run.clock[REACHED], y, rate)
    if status == OK:
        status = factorise_shifted(machine, shifted.real, h)
    if status != OK:
        return status, NO_STATE
    advance_linearly(machine, run, y, h, run.stages[WHOLE])
    status = call_evaluate(evaluate, machine, t + 0.5 * h, y, rate)
    if status == OK:
        status = factorise_shifted(machine, shifted.real, 0.5 * h)
    if status != OK:
        return status, NO_STATE
    middle = run.trial
    advance_linearly(machine, run, y, 0.5 * h, middle)
    run.counter[EVALUATIONS] += 3
    run.counter[FACTORISATIONS] += 2
    if not is_state(machine, middle) or call_evaluate(evaluate, machine, run.clock[REACHED], middle, rate) != OK:
        return OK, NO_STATE
    outcome = EXTRAPOLATED
    if surfaces_meet(machine):
        outcome = PLAIN
        run.counter[FACTORISATIONS] += 1
        status = renew_parts(machine, run.clock[REACHED], middle, rate, 0.5 * h)
        if status != OK:
            return status, NO_STATE
    advance_linearly(machine, run, middle, 0.5 * h, run.stages[HALVES])
    return OK, outcome if is_state(machine, run.stages[HALVES]) else NO_STATE


@stage
def attempt(evaluate, machine, history):
    """A step into `trial`, for `step_in_parts`: 2 Y₂ - Y₁, or where that cannot be trusted Y₂, or Y₁."""
    run, circuit = run_at(history), record_at(machine).circuit
    whole, halves, trial = run.stages[WHOLE], run.stages[HALVES], run.trial
    keep_multipliers(machine)
    status, outcome = both(evaluate, machine, run, run.clock[TIME], run.clock[STEP])
    if status != OK:
        return status, np.inf
    difference = np.inf
    if outcome != NO_STATE and is_state(machine, whole):
        difference = 0.0 if circuit.node.shape[0] == 0 else pressure_difference(evaluate, machine, run)
    beyond = 1.0 if outcome == EXTRAPOLATED else 0.0
    for i in range(trial.shape[0]):
        trial[i] = halves[i] + beyond * (halves[i] - whole[i])
    if not is_state(machine, trial):
        difference = np.inf
    if not difference <= LARGEST:
        for i in range(trial.shape[0]):
            trial[i] = halves[i] if outcome != NO_STATE else whole[i]
    return OK, difference


@entry(STEP_SIGNATURE)
def extrapolated_euler(evaluate, machine, history):
    """One step."""
    return step_in_parts(evaluate, machine, history, attempt, BEGIN)


# The same for machines whose only stiffness is that of their circuits, in relative coordinates.
#
#     (1 - h J) k = f(t, y)            Y₁ = y + h k                 one step
#     (1 - h/2 J) k = f(t, y), …       Y₂                           two steps of half the length, with the same J
#     y := 2 Y₂ - Y₁
#
# J is that of `nivel.motion.circuit_shift`, and f is taken at the begin of each part: with the evaluation at y, which a step begins with in
# any case, it takes two evaluations. What changes with the time is late by the part, which the extrapolation removes.
#
# Where an end stop that was free at the begin is met in the middle, J of the second half is that of the middle, with the slopes of the
# stop, and Y₂ is taken as it is: Y₁ has passed through the stop, and an extrapolation from it would throw the piston back.
#
# The guard is the same. How far the pressures of Y₁ and Y₂ differ follows from masses and strokes by their slopes before and behind the
# step; where that is more than a part of LARGEST, both are evaluated.

# Numbers of the factors of the whole step and of its halves; more rows of run.stages: k without circuits, the rate at the begin.
OF_WHOLE, OF_HALVES = 0, 1
OTHER, CIRCUIT_BEGIN = 3, 4
# Share of LARGEST up to which slopes judge a difference of pressures.
JUDGED = 0.25


@leaf
def judged_difference(machine, run):
    """The largest difference of a pressure [Pa] at Y₁ and Y₂ by slopes, the larger of those at the begin and those last evaluated."""
    record = record_at(machine)
    circuit, first = record.circuit, run.y.shape[0] - 2 - record.elements.state.shape[0]
    tangent, largest = circuit.tangent, 0.0
    whole, halves = run.stages[WHOLE], run.stages[HALVES]
    for node in range(circuit.node.shape[0]):
        state = circuit.node[node, 1]
        if state == NONE:
            if tangent.signal[node] == NONE:
                continue
            place = first + np.int64(tangent.state[tangent.signal[node]])
            change = np.abs(halves[place] - whole[place])
        else:
            change = tangent.by_mass[node] * (halves[first + np.int64(state)] - whole[first + np.int64(state)])
            for c in range(tangent.coordinate.shape[0]):
                change += tangent.by_stroke[node, c] * (tangent.travel[1, c] - tangent.travel[0, c])
            change = np.abs(change) * max(1.0, slope_by_mass(circuit, node) / tangent.by_mass[node])
        if not change <= largest:
            largest = change
    return largest


@leaf
def difference_in_step(evaluate, machine, run):
    """How far the pressures [Pa] of Y₁ and Y₂ differ; infinite where these, or what is made of them in `trial`, are no states.

    Where the last one can be taken it is the state last evaluated, with its rate in `scratch`, or KNOWN is 0.
    """
    run.counter[KNOWN] = 0
    if not is_state(machine, run.trial) or not is_state(machine, run.stages[WHOLE]):
        return np.inf
    if evaluate_at(evaluate, machine, run, run.clock[REACHED], run.trial, run.scratch) != OK:
        return np.inf
    difference = judged_difference(machine, run)
    # where constraints are corrected, the state to be accepted is another one
    run.counter[KNOWN] = 1 if record_at(machine).saddle.row.shape[0] == 0 else 0
    if not difference <= JUDGED * LARGEST:
        run.counter[KNOWN] = 0
        difference = pressure_difference(evaluate, machine, run)
    return difference


@leaf
def renew_slopes(machine, t, s):
    """Factors of the halves with the slopes of the state last evaluated; the mechanics respond as at the begin. Returns a status."""
    find_slopes(machine, t)
    circuit_shift.soften(record_at(machine).circuit.tangent)
    return circuit_shift.factorise_circuit(machine, OF_HALVES, s)


@shared
def fill_both(evaluate, machine, run, t, h, prepare, renew, leave):
    """Fill WHOLE and HALVES from the state y, last evaluated. Returns a status, and what becomes of the step."""
    y, middle, other = run.y, run.trial, run.stages[OTHER]
    record_at(machine).circuit.tangent.travel[:, :] = 0.0
    pistons = record_at(machine).circuit.tangent.pistons[0]
    pushing = pushing_stops(machine, pistons) if pistons != NONE else 0
    find_slopes(machine, t)
    run.counter[EVALUATIONS] += 1
    run.counter[FACTORISATIONS] += 2
    status = prepare(machine, OF_WHOLE, h)
    if status == OK:
        status = leave(machine, y, run.rate, h, other)
    if status == OK:
        circuit_shift.advance_circuit(machine, OF_WHOLE, h, run.rate, other, y, run.stages[WHOLE])
        status = prepare(machine, OF_HALVES, 0.5 * h)
    if status == OK:
        status = leave(machine, y, run.rate, 0.5 * h, other)
    if status != OK:
        return status, NO_STATE
    circuit_shift.advance_circuit(machine, OF_HALVES, 0.5 * h, run.rate, other, y, middle)
    if not is_state(machine, middle) or call_evaluate(evaluate, machine, t + 0.5 * h, middle, run.stages[RATE]) != OK:
        return OK, NO_STATE
    outcome = EXTRAPOLATED
    if pistons != NONE and a_stop_is_met(machine, pistons, pushing):
        outcome = PLAIN
        run.counter[FACTORISATIONS] += 1
        status = renew_slopes(machine, t + 0.5 * h, 0.5 * h)
    if status == OK:
        status = renew(machine, 0.5 * h)
    if status == OK:
        status = leave(machine, middle, run.stages[RATE], 0.5 * h, other)
    if status != OK:
        return status, NO_STATE
    circuit_shift.advance_circuit(machine, OF_HALVES, 0.5 * h, run.stages[RATE], other, middle, run.stages[HALVES])
    return OK, outcome if is_state(machine, run.stages[HALVES]) else NO_STATE


@shared
def attempt_over_circuits(evaluate, machine, history, prepare, renew, leave):
    """A step into `trial`, for `step_in_parts`: 2 Y₂ - Y₁, or where that cannot be trusted Y₂, or Y₁.

    prepare, renew, leave : compiled into this one. The first gives factors (machine, number, s) in the state y, the second what of those of
    the halves depends on the state in the middle (machine, s), the third k without circuits (machine, y, f, s, other).
    """
    run = run_at(history)
    whole, halves, trial = run.stages[WHOLE], run.stages[HALVES], run.trial
    status, outcome = fill_both(evaluate, machine, run, run.clock[TIME], run.clock[STEP], prepare, renew, leave)
    if status != OK:
        return status, np.inf
    beyond = 1.0 if outcome == EXTRAPOLATED else 0.0
    for i in range(trial.shape[0]):
        trial[i] = halves[i] + beyond * (halves[i] - whole[i])
    difference = difference_in_step(evaluate, machine, run) if outcome != NO_STATE else np.inf
    if not difference <= LARGEST:
        for i in range(trial.shape[0]):
            trial[i] = halves[i] if outcome != NO_STATE else whole[i]
    return OK, difference


@stage
def prepare_rigid(machine, number, s):
    """Factors `number` for s. Returns a status."""
    if number == OF_WHOLE:
        status = circuit_shift.apply_compliance(machine, circuit_shift.project, circuit_shift.respond)
        if status != OK:
            return status
        circuit_shift.soften(record_at(machine).circuit.tangent)
    return circuit_shift.factorise_circuit(machine, number, s)


@stage
def renew_nothing(machine, s):
    """Nothing depends on the state in the middle."""
    return OK


@stage
def leave_rate(machine, y, f, s, other):
    """Without circuits nothing is stiff: k = f."""
    copy(f, other)
    return OK


@stage
def attempt_rigid(evaluate, machine, history):
    """`attempt_over_circuits` of rigid bodies."""
    return attempt_over_circuits(evaluate, machine, history, prepare_rigid, renew_nothing, leave_rate)


@entry(STEP_SIGNATURE)
def circuit_euler(evaluate, machine, history):
    """One step."""
    return step_in_parts(evaluate, machine, history, attempt_rigid, CIRCUIT_BEGIN)


# The same for machines with flexible bodies, whose modes are stiff too.
#
# J is that of `nivel.motion.circuit_shift` with the modes of `nivel.motion.modal_shift`, whose factors are those of the state at which each
# part begins.


@part
def prepare_flexible(machine, number, s):
    """Factors `number` for s, and those of the tree. Returns a status."""
    status = factorise_shifted_modes(machine, s)
    if status == OK:
        status = circuit_shift.apply_compliance(machine, circuit_shift.project_flexible, circuit_shift.respond_flexible)
    if status != OK:
        return status
    circuit_shift.soften(record_at(machine).circuit.tangent)
    return circuit_shift.factorise_circuit(machine, number, s)


@stage
def leave_modes(machine, y, f, s, other):
    """k of the modes and joints without circuits. Returns a status."""
    copy(f, other)
    return solve_shifted_modes(machine, y, other, s)


@stage
def attempt_flexible(evaluate, machine, history):
    """`attempt_over_circuits` of flexible bodies."""
    return attempt_over_circuits(evaluate, machine, history, prepare_flexible, factorise_shifted_modes, leave_modes)


@entry(STEP_SIGNATURE)
def flexible_circuit_euler(evaluate, machine, history):
    """One step."""
    return step_in_parts(evaluate, machine, history, attempt_flexible, CIRCUIT_BEGIN)


FACTS = (
    IntegratorFacts(
        "extrapolated-euler",
        extrapolated_euler,
        order=2,
        stages=4,
        kind="implicit",
        needs="complex shifts",
        ends="corners",
        guarded=True,
    ),
    IntegratorFacts(
        "extrapolated-euler",
        circuit_euler,
        order=2,
        stages=CIRCUIT_BEGIN + 1,
        kind="implicit",
        needs="circuits",
        machines="circuits",
        guarded=True,
    ),
    IntegratorFacts(
        "extrapolated-euler",
        flexible_circuit_euler,
        order=2,
        stages=CIRCUIT_BEGIN + 1,
        kind="implicit",
        needs="circuits",
        machines="flexible circuits",
        guarded=True,
    ),
)
