"""`nivel.integrate.extrapolated_euler` for machines whose only stiffness is that of their circuits, in relative coordinates.

    (1 - h J) k = f(t, y)            Y₁ = y + h k                 one step
    (1 - h/2 J) k = f(t, y), …       Y₂                           two steps of half the length, with the same J
    y := 2 Y₂ - Y₁

J is that of `nivel.motion.circuit_shift`, and f is taken at the begin of each part: with the evaluation at y, which a step begins with in
any case, it takes two evaluations. Both are first-order changes, which the extrapolation removes.

The guard is the same. How far the pressures of Y₁ and Y₂ differ follows from masses and strokes by their slopes before and behind the step;
where that is more than a part of LARGEST, both are evaluated.
"""

from __future__ import annotations

import numpy as np

from nivel.integrate.extrapolated_euler import HALVES, LARGEST, RATE, WHOLE, is_state, pressure_difference
from nivel.integrate.run import EVALUATIONS, FACTORISATIONS, KNOWN, REACHED, STEP, STEP_SIGNATURE, TIME, run_at
from nivel.kernels.hook import call_evaluate
from nivel.kernels.hydraulics.tangent import find_slopes, slope_by_mass
from nivel.kernels.record import NONE, record_at
from nivel.kernels.status import OK
from nivel.motion.circuit_shift import advance_circuit, factorise_circuit, soften
from nivel.motion.unit_efforts import answer_unit_efforts
from nivel.native.entry import entry
from nivel.native.function import leaf

# Factors of the whole step and of its halves.
OF_WHOLE, OF_HALVES = 0, 1
# Share of LARGEST up to which slopes judge a difference of pressures.
JUDGED = 0.25


@leaf
def prepare_step(machine, t, h):
    """J at the state last evaluated, and the factors for h and h/2. Returns a status."""
    tangent = record_at(machine).circuit.tangent
    find_slopes(machine, t)
    status = answer_unit_efforts(machine)
    if status != OK:
        return status
    soften(tangent)
    status = factorise_circuit(machine, OF_WHOLE, h)
    if status == OK:
        status = factorise_circuit(machine, OF_HALVES, 0.5 * h)
    return status


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
def both(evaluate, machine, run, t, h):
    """Fill WHOLE and HALVES from the state y, last evaluated. Returns a status, and whether HALVES is filled."""
    y, middle, travel = run.y, run.trial, record_at(machine).circuit.tangent.travel
    status = prepare_step(machine, t, h)
    if status != OK:
        return status, False
    travel[:, :] = 0.0
    advance_circuit(machine, OF_WHOLE, h, run.rate, y, 0, run.stages[WHOLE])
    advance_circuit(machine, OF_HALVES, 0.5 * h, run.rate, y, 1, middle)
    run.counter[EVALUATIONS] += 1
    run.counter[FACTORISATIONS] += 2
    if not is_state(machine, middle) or call_evaluate(evaluate, machine, t + 0.5 * h, middle, run.stages[RATE]) != OK:
        return OK, False
    advance_circuit(machine, OF_HALVES, 0.5 * h, run.stages[RATE], middle, 1, run.stages[HALVES])
    return OK, True


@leaf
def may_extrapolate(evaluate, machine, run):
    """Whether 2 Y₂ - Y₁, in `trial`, is a state whose pressures can be trusted; then it is the state last evaluated, with its rate in
    `scratch`, or KNOWN is 0."""
    run.counter[KNOWN] = 0
    if not is_state(machine, run.trial) or not is_state(machine, run.stages[WHOLE]):
        return False
    run.counter[EVALUATIONS] += 1
    if call_evaluate(evaluate, machine, run.clock[REACHED], run.trial, run.scratch) != OK:
        return False
    difference = judged_difference(machine, run)
    # a correction of the state would be behind this evaluation
    run.counter[KNOWN] = 1 if record_at(machine).saddle.row.shape[0] == 0 else 0
    if not difference <= JUDGED * LARGEST:
        run.counter[KNOWN] = 0
        difference = pressure_difference(evaluate, machine, run)
    guard = record_at(machine).circuit.guard
    guard[1] = max(guard[1], difference)
    return difference <= LARGEST


@entry(STEP_SIGNATURE)
def circuit_euler(evaluate, machine, history):
    """One step."""
    run, circuit = run_at(history), record_at(machine).circuit
    t, h, y = run.clock[TIME], run.clock[STEP], run.y
    status, filled = both(evaluate, machine, run, t, h)
    if status != OK:
        return status
    whole, halves = run.stages[WHOLE], run.stages[HALVES]
    filled = filled and is_state(machine, halves)
    if filled:
        for i in range(y.shape[0]):
            run.trial[i] = 2.0 * halves[i] - whole[i]
        if may_extrapolate(evaluate, machine, run):
            for i in range(y.shape[0]):
                y[i] = run.trial[i]
            return OK
    circuit.guard[0] += 1.0
    for i in range(y.shape[0]):
        y[i] = halves[i] if filled else whole[i]
    return OK
