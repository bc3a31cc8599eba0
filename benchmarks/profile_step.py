"""Where the time of one step goes: each part of the evaluation in a loop of its own, nanoseconds of process time.

python benchmarks/profile_step.py [MACHINE.yaml]
"""

import sys
import time
from pathlib import Path

import numpy as np
from numba import njit, types

import nivel
from nivel.analysis.dynamics import prepare
from nivel.kernels.constraint import constraint_rows
from nivel.kernels.handle import address_type
from nivel.kernels.load import apply_loads
from nivel.kernels.observe import count_turns, observe
from nivel.kernels.record import record_at, state_type
from nivel.kernels.rigid import load_weight
from nivel.kernels.saddle import factorise_rows, multipliers
from nivel.motion import newton_euler as ne
from nivel.motion.newton_euler_correction import correct

REPEATS, ROUNDS = 20_000, 7
signature = types.void(address_type, state_type, state_type, types.int64)
part = njit(signature, error_model="numpy", _nrt=False)


@part
def positions(machine, y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        ne.read_positions(record, y)


@part
def velocities(machine, y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        ne.read_velocities(record, y)


@part
def constraints(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        constraint_rows(record.bodies, record.markers, record.constraints)


@part
def loads(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        load_weight(record.bodies)
        apply_loads(record, 0.0)
        ne.whiten_forces(record)


@part
def whitening(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        ne.whiten_rows(record)


@part
def factorisation(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        factorise_rows(record, ne.WIDTH)


@part
def solution(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        ne.whiten_forces(record)
        multipliers(record, ne.WIDTH)


@part
def rates(machine, _y, out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        ne.write_rates(record, out)


@part
def turns(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        count_turns(record)


@part
def evaluation(machine, y, out, repeats):
    for _ in range(repeats):
        ne.evaluate(machine, 0.0, y, out)


@part
def correction(machine, y, _out, repeats):
    """A position pass and a velocity pass: the state is disturbed as one step of 1 ms disturbs it."""
    for _ in range(repeats):
        y[0] += 1e-10
        y[y.shape[0] // 2 + 2] += 1e-9
        correct(machine, 0.0, y)


def measure(function, *arguments):
    function(*arguments, 10)
    best = np.inf
    for _ in range(ROUNDS):
        begin = time.process_time()
        function(*arguments, REPEATS)
        best = min(best, time.process_time() - begin)
    return 1e9 * best / REPEATS


def main():
    path = sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent / "examples" / "slider-crank.yaml"
    prepared = prepare(nivel.load(path).record, "newton-euler")
    system, address = prepared.motion.system, prepared.motion.handle.address
    system.record.control.stabilise[2:] = 1e-13
    y, out = prepared.assembly.y.copy(), np.zeros_like(prepared.assembly.y)
    ne.evaluate(address, 0.0, y, out)
    solve = measure(solution, address, y, out)
    load = measure(loads, address, y, out)
    frame = np.zeros(system.layout.width)
    times = {
        "positions of bodies and markers, C": measure(positions, address, y, out),
        "their velocities": measure(velocities, address, y, out) - measure(positions, address, y, out),
        "constraint rows, rates, accelerations": measure(constraints, address, y, out),
        "forces": load,
        "whitening of C_q": measure(whitening, address, y, out),
        "S and its factor": measure(factorisation, address, y, out),
        "multipliers and accelerations": solve - load + measure(rates, address, y, out),
        "one evaluation": measure(evaluation, address, y, out),
        "joint angles followed, per step": measure(turns, address, y, out),
        "direct correction, per step": measure(correction, address, y.copy(), out),
        "output of one frame": 0.0,
    }
    begin = time.process_time()
    for _ in range(REPEATS):
        observe(address, y, frame)
    times["output of one frame"] = 1e9 * (time.process_time() - begin) / REPEATS
    rows = len(system.rows)
    print(f"{Path(path).stem}: {system.body_count} bodies, {rows} rows, {len(system.record.saddle.L)} entries of L")
    for name, nanoseconds in times.items():
        print(f"{name:40} {nanoseconds:8.0f} ns")


if __name__ == "__main__":
    main()
