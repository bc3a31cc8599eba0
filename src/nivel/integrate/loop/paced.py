"""The loop of live operation: ticks at deadlines, inputs from an operator, frames for watchers. Nothing of it calls Python.

A tick is a fixed number of fixed steps. Within it every input goes straight from the value at its start to that at its end, so the
inputs are functions of time that a table repeats exactly; the values at the ends of ticks are kept on a tape.

A tick begins at its deadline. One that ends after the next deadline is an overrun. Later ticks catch up as long as they are late by
less than a bound; beyond it the deadlines are moved, and the simulated time is stretched by as much.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from nivel.integrate.loop.run import BUDGET, DONE_STEPS, EVENTS, FRAMES, TIME, run_at
from nivel.integrate.loop.samples import time_of
from nivel.kernels.algebra.rows import copy
from nivel.kernels.core.arrays import A1, F1, F2, I1, U1
from nivel.kernels.core.handle import reader
from nivel.kernels.core.status import BUDGET_SPENT
from nivel.kernels.record.record import record_at
from nivel.native.entry import entry
from nivel.native.function import caller, leaf
from nivel.native.signature import Signature

# entries of Live.clock
TICK, SPEED, BOUND, WATCHDOG = 0, 1, 2, 3
CLOCKS = 4
# entries of Live.control, set from outside
COMMAND, TICKS, PACED, FROM_TAPE, SUBSTEPS, HEARD = 0, 1, 2, 3, 4, 5
# and by the loop
DONE, SHOWN, LOST, OVERRUNS, OWN, STRETCHED, LONGEST, LATEST, NEXT, MODE, SAVED = 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16
CONTROLS = 17
# columns of Live.limit
LOW, HIGH, RATE, REST = 0, 1, 2, 3
# entries of Live.address
CLOCK, SLEEP, NOW, DEADLINE = 0, 1, 2, 3
# rows of Live.histogram; bins of 2 % from 100 ns on
COMPUTING, LATENESS = 0, 1
BINS, FIRST_BIN, BIN_WIDTH = 1024, 100.0, 0.02
MONOTONIC, THREAD_TIME, ABSOLUTE = 1, 3, 1  # of Linux
SECOND = 1_000_000_000


class Live(NamedTuple):
    """What the loop shares with its operator and watchers. All times of clocks in ns.

    `tape` and `frames` are rings: row number modulo their length.
    """

    # TICK, simulated time of a tick; SPEED, simulated over real time; BOUND, largest delay that is caught up; WATCHDOG, longest silence
    # of the operator: beyond it all inputs go to rest [s]
    clock: F1
    # COMMAND, not zero: return after the next tick; TICKS to do; PACED, 0: as fast as possible; FROM_TAPE: inputs come from the tape;
    # SUBSTEPS of a tick; HEARD, when the operator was last heard. DONE ticks; SHOWN frames; LOST, whether the operator is; OVERRUNS, those
    # of them of OWN computing; STRETCHED, by which deadlines were moved; LONGEST computing; LATEST start; NEXT deadline, 0: now; MODE
    # and ticks SAVED, of the program
    control: I1
    function: U1  # (inputs,) of the machine
    limit: F2  # (inputs, 4)
    target: F1  # (inputs,) wanted by the operator
    value: F1  # (inputs,) at the end of the last tick
    tape: F2  # (rows, inputs) values at the ends of ticks
    frames: F2  # (rows, width)
    histogram: I1  # (2 BINS,) ticks by computing time and by lateness
    address: A1  # of clock_gettime, clock_nanosleep, and of the two below
    now: I1  # (2,) seconds, ns
    deadline: I1  # (2,)


live_at = reader(Live)
DRIVE = Signature("status", ("entry", "entry", "entry", "entry", "machine", "machine", "machine"))
ADVANCE = Signature("status", ("entry", "entry", "entry", "machine", "machine"))
call_advance = caller(ADVANCE)
call_clock = caller(Signature("nothing", ("count", "machine")))
call_sleep = caller(Signature("nothing", ("count", "count", "machine", "entry")))


@leaf
def read_clock(session, clock):
    """Time of a clock of the system [ns]."""
    live = live_at(session)
    call_clock(live.address[CLOCK], clock, live.address[NOW])
    return live.now[0] * SECOND + live.now[1]


@leaf
def sleep_until(session, deadline):
    """Sleep until the monotonic clock shows the deadline [ns]."""
    live = live_at(session)
    live.deadline[0], live.deadline[1] = deadline // SECOND, deadline % SECOND
    call_sleep(live.address[SLEEP], MONOTONIC, ABSOLUTE, live.address[DEADLINE], np.uint64(0))


@leaf
def count_into(histogram, row, duration):
    """One more tick of this duration [ns] in a row of the histogram."""
    k = np.int64(0)
    if duration > FIRST_BIN:
        k = min(np.int64(np.log(duration / FIRST_BIN) / BIN_WIDTH), np.int64(BINS - 1))
    histogram[row * BINS + k] += 1


@leaf
def wanted(live, i, heard):
    """Value of input i that the operator wants, within its limits; at rest where no operator is heard. Without a rest it stays."""
    limit = live.limit[i]
    rest = live.value[i] if np.isnan(limit[REST]) else limit[REST]
    target = live.target[i] if heard else rest
    if not (limit[LOW] <= target <= limit[HIGH]):
        # beyond its range, or no number
        target = limit[LOW] if target < limit[LOW] else limit[HIGH] if target > limit[HIGH] else rest
    return target


@leaf
def set_inputs(machine, history, session, heard):
    """Let every input go to its value at the end of the tick that begins: a table of two points."""
    run, live, functions = run_at(history), live_at(session), record_at(machine).functions
    clock, control = live.clock, live.control
    row = live.tape[control[DONE] % np.int64(live.tape.shape[0])]
    begin = run.clock[TIME]
    end = time_of(run, run.counter[DONE_STEPS] + control[SUBSTEPS])
    for i in range(live.function.shape[0]):
        first = live.value[i]
        if control[FROM_TAPE] == 1:
            last = row[i]
        else:
            most = live.limit[i, RATE] * clock[TICK]
            last = first + min(max(wanted(live, i, heard) - first, -most), most)
            row[i] = last
        k = functions.table[live.function[i], 0]
        functions.knots[k], functions.knots[k + 1] = begin, end
        piece, held = functions.coefficients[k], functions.coefficients[k + 1]
        piece[0], piece[1], held[0] = first, (last - first) / (end - begin), last
        live.value[i] = last


@leaf
def show_frame(history, session):
    """Put the newest frame, if there is one, into the ring."""
    run, live = run_at(history), live_at(session)
    count = run.counter[FRAMES]
    if count > 0:
        target, source = live.frames[live.control[SHOWN] % np.int64(live.frames.shape[0])], run.frames[count - 1]
        copy(source, target)
        run.counter[FRAMES] = 0
        live.control[SHOWN] += 1
    run.counter[EVENTS] = 0


@leaf
def judge(session, deadline, period, begin, end, computing):
    """Count a tick in the timing; the next deadline [ns]."""
    live = live_at(session)
    control = live.control
    late = max(begin - deadline, 0)
    count_into(live.histogram, COMPUTING, float(computing))
    count_into(live.histogram, LATENESS, float(late))
    control[LONGEST], control[LATEST] = max(control[LONGEST], computing), max(control[LATEST], late)
    following = deadline + period
    if end > following:
        control[OVERRUNS] += 1
        if computing > period:
            control[OWN] += 1
    behind = end - following - np.int64(live.clock[BOUND] * 1e9)
    if behind > 0:
        control[STRETCHED] += behind
        following += behind
    return following


@leaf
def tick(advance, evaluate, correct, step, machine, history, session, heard):
    """One tick; that with which a run ends counts, too. Returns a status, BUDGET_SPENT where all is well."""
    run, live = run_at(history), live_at(session)
    set_inputs(machine, history, session, heard)
    run.counter[BUDGET] = live.control[SUBSTEPS]
    status = call_advance(advance, evaluate, correct, step, machine, history)
    show_frame(history, session)
    live.control[DONE] += 1
    return status


@entry(DRIVE)
def drive(advance, evaluate, correct, step, machine, history, session):
    """Tick until TICKS are done, there is a command after a tick, or the run ends or fails. Returns the status of the last tick."""
    live = live_at(session)
    clock, control = live.clock, live.control
    status, left, paced = BUDGET_SPENT, control[TICKS], control[PACED] == 1
    deadline = control[NEXT]
    if paced and deadline == 0:
        deadline = read_clock(session, MONOTONIC)
    while left > 0 and status == BUDGET_SPENT:
        left = left - 1 if control[COMMAND] == 0 else 0
        if not paced:
            status = tick(advance, evaluate, correct, step, machine, history, session, True)
            continue
        sleep_until(session, deadline)
        begin = read_clock(session, MONOTONIC)
        heard = begin - control[HEARD] < np.int64(clock[WATCHDOG] * 1e9)
        control[LOST] = 0 if heard else 1
        used = read_clock(session, THREAD_TIME)
        status = tick(advance, evaluate, correct, step, machine, history, session, heard)
        computing = read_clock(session, THREAD_TIME) - used
        period = np.int64(clock[TICK] / clock[SPEED] * 1e9)
        deadline = judge(session, deadline, period, begin, read_clock(session, MONOTONIC), computing)
        control[NEXT] = deadline
    return status
