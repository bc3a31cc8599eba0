"""Euler's linearly implicit method, extrapolated once: order 2 at a fixed step and a fixed cost, for stiff circuits in real time.

    (1 - h J) k = f(t + h, y)            Y₁ = y + h k                 one step
    (1 - h/2 J) k = f(t + h/2, y), …     Y₂                           two steps of half the length, with the same J
    y := 2 Y₂ - Y₁

(Deuflhard, Hairer, Zugck 1987). The order is 2 for any J, and every stage forgets what decays within a step, so J may have the secants of
restrictions in place of their tangents: with these, a linearly implicit step over a small volume behind an orifice rings for ever, since
it is one step of Newton's method on a root.

Guard: where pressures of Y₁ and Y₂ differ by more than LARGEST, or a mass would vanish, the step is made in parts
(`nivel.integrate.rosenbrock.parts`). Of the smallest parts that cannot be trusted either Y₂ is taken, or where that is no state, Y₁; they
are counted, and the largest difference is kept, in `Circuit.guard`.

Where surfaces of a contact or stop that were apart at the begin touch in the middle, J of the second half is that of the middle, and Y₂ is
taken as it is: J of the begin knows nothing of the contact, whose force over half a step would throw the bodies back, and so would an
extrapolation from Y₁, which has passed through the surface.
"""

from __future__ import annotations

import numpy as np

from nivel.elements.circuits.ledger import balance_mass, mass_apart
from nivel.elements.contacts.impact import meet, part
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import EVALUATIONS, FACTORISATIONS, REACHED, STEP, STEP_SIGNATURE, TIME, run_at
from nivel.integrate.rosenbrock.parts import LARGEST, step_in_parts
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_evaluate
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.residual.shifted_matrix import factorise_shifted, find_parts, keep_multipliers, solve_shifted_parts
from nivel.native.entry import entry
from nivel.native.function import leaf, stage

# rows of run.stages: rates inside the step, Y₁, Y₂, the rate at the begin
RATE, WHOLE, HALVES, BEGIN = 0, 1, 2, 3
# What becomes of a step: Y₂ is no state; Y₂ is taken as it is; 2 Y₂ - Y₁ is taken.
NO_STATE, PLAIN, EXTRAPOLATED = 0, 1, 2


@leaf
def advance_linearly(machine, run, y, share, into):
    """into := y + share (1 - share J)⁻¹ f with f in RATE; `into` may be y."""
    factors = record_at(machine).newton.shifted.real
    for i in range(y.shape[0]):
        factors.r[i] = run.stages[RATE, i]
    apart = mass_apart(machine, factors.r)
    solve_shifted_parts(machine, factors, share)
    balance_mass(machine, factors.r, apart)
    for i in range(y.shape[0]):
        into[i] = y[i] + share * factors.r[i]


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
    for k in range(pressure.shape[0]):
        kept[k] = pressure[k]
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
        part(record.elements, record.watched.surface[j, 0], record.watched.surface[j, 1])
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
)
