"""The pace of a run: how long its steps are at which time, how far and how fast bodies move in them, how often their equations are
iterated, and how long they may be."""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.step_control import fastest_turn
from nivel.kernels.bodies.rigid import turn_to_body_axes
from nivel.kernels.output.observe import energies
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf

# Steps at which energies are looked at, as a share: multiples of an irrational number, so that no period of a load hides from them.
IRRATIONAL, LOOKED_AT = 0.6180339887498949, 0.25


@leaf
def part_at(run, t):
    """The part of the duration that holds the time t."""
    share = (t - run.clock[of_run.START]) / (run.clock[of_run.END] - run.clock[of_run.START])
    return np.int64(max(0.0, min(of_run.PARTS - 1.0, np.floor(share * of_run.PARTS))))


@leaf
def allow(run):
    """clock[LARGEST] := what a step that begins now may be long: where it reaches into the next part, no longer there than one that begins
    there may be; and a window no further than by a short step."""
    clock, t = run.clock, run.clock[of_run.TIME]
    k = part_at(run, t)
    clock[of_run.LARGEST] = run.pace[of_run.ALLOWED, k]
    if k + 1 < of_run.PARTS:
        left = clock[of_run.START] + (k + 1) * (clock[of_run.END] - clock[of_run.START]) / of_run.PARTS - t
        clock[of_run.LARGEST] = min(clock[of_run.LARGEST], left + run.pace[of_run.ALLOWED, k + 1])
    for w in range(run.windows.shape[0]):
        window = run.windows[w]
        if t < window[of_run.UNTIL]:
            clock[of_run.LARGEST] = min(clock[of_run.LARGEST], max(window[of_run.FROM] - t, 0.0) + window[of_run.SHORT])


@leaf
def note_step(machine, run, speed):
    """Note the step from clock[TIME] to clock[REACHED]. speed : the largest angular speed at its begin [rad/s]; the record is that of a
    state near its end."""
    h = run.clock[of_run.REACHED] - run.clock[of_run.TIME]
    turn = h * max(speed, fastest_turn(machine))
    first = part_at(run, run.clock[of_run.TIME])
    for k in range(first, part_at(run, run.clock[of_run.REACHED]) + 1):
        run.pace[of_run.TAKEN, k] = max(run.pace[of_run.TAKEN, k], h)
        run.pace[of_run.LEAST, k] = min(run.pace[of_run.LEAST, k], h)
        run.pace[of_run.TURNED, k] = max(run.pace[of_run.TURNED, k], turn)
    done = run.counter[of_run.ITERATIONS] + np.int64(record_at(machine).control.iterations[1])
    k, iterations = part_at(run, run.clock[of_run.REACHED]), float(done - run.counter[of_run.COUNTED])
    run.counter[of_run.COUNTED] = done
    run.pace[of_run.STEPPED, k] += 1.0
    run.pace[of_run.ITERATED, k] += iterations
    run.pace[of_run.MOST_ITERATED, k] = max(run.pace[of_run.MOST_ITERATED, k], iterations)


@leaf
def note_energy(machine, run):
    """Note the kinetic energy of the accepted state, just evaluated, at a quarter of the steps."""
    place = IRRATIONAL * run.counter[of_run.DONE_STEPS]
    if place - np.floor(place) >= LOOKED_AT:
        return
    bodies = record_at(machine).bodies
    for b in range(bodies.mass.shape[0]):
        turn_to_body_axes(bodies, b)
    kinetic = energies(machine)[0]
    k = part_at(run, run.clock[of_run.TIME])
    run.pace[of_run.MOVING, k] = max(run.pace[of_run.MOVING, k], kinetic)
