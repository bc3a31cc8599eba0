"""Integrators on differential equations that are no machines: what the tests of their orders are made of."""

from types import SimpleNamespace

import numpy as np

from nivel import Body, MachineRecord
from nivel.analysis.assembly.equations import equations
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.loop import run as names
from nivel.kernels.core.block import Handle
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import EVALUATE
from nivel.native.entry import entry


@entry(EVALUATE)
def oscillator(machine, t, y, ydot):
    """Circular motion in (0, 1), x'' = -x; two entries where machines have energies."""
    ydot[0], ydot[1], ydot[2], ydot[3] = y[1], -y[0], 0.0, 0.0
    return OK


@entry(EVALUATE)
def swing(machine, t, y, ydot):
    """A pendulum whose support shakes, x'' = -(1 + cos(t)/2) sin x: not linear, and depends on time."""
    ydot[0], ydot[1], ydot[2], ydot[3] = y[1], -(1.0 + 0.5 * np.cos(t)) * np.sin(y[0]), 0.0, 0.0
    return OK


@entry(EVALUATE)
def stiff(machine, t, y, ydot):
    """y' = -10⁶ (y - cos t) - sin t, whose smooth solution is cos t."""
    ydot[0], ydot[1], ydot[2], ydot[3] = -1e6 * (y[0] - np.cos(t)) - np.sin(t), y[2], -y[1], 0.0
    return OK


def resting():
    """The handle of a machine that does not move: what integrators look up there are turning bodies."""
    record = MachineRecord(name="rest", bodies=(Body(name="b", mass=1, inertia=(1, 1, 1)),))
    motion = equations(record)
    motion.evaluate(0.0, motion.system.start)
    return motion.handle


def march(integrator, evaluate, start, end, *, tolerance=1e-6, step=1e-2, fixed=False, newton=False, largest=np.inf):
    """Steps of an integrator by name from `start` (4,) at 0 to `end`.

    fixed : steps of one size as long as nothing is rejected (step is also the largest).
    Returns time, y (n, 4), the dense output of every step as a function of θ, orders, evaluations, rejected.
    """
    facts = INTEGRATORS[integrator]
    clock, counter = np.zeros(names.CLOCKS), np.zeros(names.COUNTS, dtype=np.int64)
    clock[names.STEP], clock[names.END], clock[names.INTERVAL] = step, end, 1e-9
    clock[names.STEP_TICKS], clock[names.TICK_RATE] = step, 1.0
    clock[names.BOUND] = end
    clock[names.TOLERANCE], clock[names.LARGEST] = tolerance, step if fixed else largest
    counter[names.MOST_ITERATIONS], counter[names.NEWTON] = 50, int(newton)
    y = np.array(start, dtype=float)
    n = len(y)
    run = names.Run(
        clock=clock,
        counter=counter,
        y=y,
        rate=np.zeros(n),
        previous=y.copy(),
        scratch=np.zeros(n),
        trial=np.zeros(n),
        scale=np.ones(n),
        raised=np.ones(n, dtype=np.uint32),
        stages=np.zeros((facts.stages, n)),
        numbers=np.zeros(facts.numbers),
        matrix=np.zeros((n, n)),
        pivot=np.zeros(n, dtype=np.uint32),
        plain=np.zeros((0, 2), dtype=np.uint32),
        turns=np.zeros((0, 2), dtype=np.uint32),
        dense=np.zeros((names.DENSE_ROWS, n)),
        frames=np.zeros((1, 1)),
        event_values=np.zeros((2, 0)),
        samples=np.zeros(0, dtype=np.int64),
        corners=np.zeros(0),
        pace=np.full((5, names.PARTS), np.inf),
        events=np.zeros((0, 3)),
        ends=np.zeros(0),
        windows=np.zeros((0, 3)),
    )
    machine, history = resting(), Handle(run)
    time, states, inside, orders = [0.0], [y.copy()], [], []
    while clock[names.TIME] < end:
        evaluate(machine.address, clock[names.TIME], y, run.rate)
        run.previous[:] = y
        status = facts.step(evaluate.address, machine.address, history.address)
        assert status == OK, (status, clock[names.TIME])
        inside.append((run.previous.copy(), run.dense[: counter[names.DENSE]].copy(), int(counter[names.POWERS])))
        clock[names.TIME] = clock[names.REACHED]
        counter[names.DONE_STEPS] += 1
        time.append(clock[names.TIME])
        states.append(y.copy())
        orders.append(int(counter[names.ORDER]))
    return SimpleNamespace(
        time=np.array(time),
        y=np.array(states),
        inside=inside,
        orders=np.array(orders),
        evaluations=int(counter[names.EVALUATIONS]) + len(orders),
        rejected=int(counter[names.REJECTED]),
        iterations=int(counter[names.ITERATIONS]),
    )


def between(inside, theta):
    """The state at the share θ of a step, from its dense output: `nivel.integrate.loop.dense`."""
    previous, rows, powers = inside
    value = np.zeros_like(previous)
    for k in reversed(range(len(rows))):
        value = (theta if powers or k % 2 == 0 else 1 - theta) * (rows[k] + value)
    return previous + value
