"""A step of fixed length, whole or in parts: where the whole one cannot be trusted, as where a valve opens onto a small volume, it is made
in parts, halved until each can be, down to 1/PARTS of it. After a good part the next one is twice as long where it fits.

Steps that were divided are counted in counter[REJECTED], parts that could not be trusted at the least length in `Circuit.guard`.
"""

import numpy as np

from nivel.integrate.loop.run import KNOWN, REACHED, REJECTED, STEP, TIME, run_at
from nivel.integrate.loop.step_control import evaluate_accepted
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import record_at
from nivel.native.function import shared

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
