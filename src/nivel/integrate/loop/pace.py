"""The pace of a run: how long its steps are at which time, how far and how fast bodies move in them, how often their equations are
iterated, and how long they may be."""

from __future__ import annotations

import numpy as np

from nivel.integrate.loop.run import (
    ALLOWED,
    COUNTED,
    DONE_STEPS,
    END,
    FROM,
    ITERATED,
    ITERATIONS,
    LARGEST,
    LEAST,
    MOST_ITERATED,
    MOVING,
    PARTS,
    REACHED,
    SHORT,
    START,
    STEPPED,
    TAKEN,
    TIME,
    TURNED,
    UNTIL,
)
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
    share = (t - run.clock[START]) / (run.clock[END] - run.clock[START])
    return np.int64(max(0.0, min(PARTS - 1.0, np.floor(share * PARTS))))


@leaf
def allow(run):
    """clock[LARGEST] := what a step that begins now may be long: where it reaches into the next part, no longer there than one that begins
    there may be; and a window no further than by a short step."""
    clock, t = run.clock, run.clock[TIME]
    k = part_at(run, t)
    clock[LARGEST] = run.pace[ALLOWED, k]
    if k + 1 < PARTS:
        left = clock[START] + (k + 1) * (clock[END] - clock[START]) / PARTS - t
        clock[LARGEST] = min(clock[LARGEST], left + run.pace[ALLOWED, k + 1])
    for w in range(run.windows.shape[0]):
        window = run.windows[w]
        if t < window[UNTIL]:
            clock[LARGEST] = min(clock[LARGEST], max(window[FROM] - t, 0.0) + window[SHORT])


@leaf
def note_step(machine, run, speed):
    """Note the step from clock[TIME] to clock[REACHED]. speed : the largest angular speed at its begin [rad/s]; the record is that of a
    state near its end."""
    h = run.clock[REACHED] - run.clock[TIME]
    turn = h * max(speed, fastest_turn(machine))
    first = part_at(run, run.clock[TIME])
    for k in range(first, part_at(run, run.clock[REACHED]) + 1):
        run.pace[TAKEN, k] = max(run.pace[TAKEN, k], h)
        run.pace[LEAST, k] = min(run.pace[LEAST, k], h)
        run.pace[TURNED, k] = max(run.pace[TURNED, k], turn)
    done = run.counter[ITERATIONS] + np.int64(record_at(machine).control.iterations[1])
    k, iterations = part_at(run, run.clock[REACHED]), float(done - run.counter[COUNTED])
    run.counter[COUNTED] = done
    run.pace[STEPPED, k] += 1.0
    run.pace[ITERATED, k] += iterations
    run.pace[MOST_ITERATED, k] = max(run.pace[MOST_ITERATED, k], iterations)


@leaf
def note_energy(machine, run):
    """Note the kinetic energy of the accepted state, just evaluated, at a quarter of the steps."""
    place = IRRATIONAL * run.counter[DONE_STEPS]
    if place - np.floor(place) >= LOOKED_AT:
        return
    bodies = record_at(machine).bodies
    for b in range(bodies.mass.shape[0]):
        turn_to_body_axes(bodies, b)
    kinetic = energies(machine)[0]
    k = part_at(run, run.clock[TIME])
    run.pace[MOVING, k] = max(run.pace[MOVING, k], kinetic)
