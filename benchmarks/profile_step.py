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
from nivel.kernels.hook import apply_forces
from nivel.kernels.observe import accept, observe
from nivel.kernels.record import record_at, state_type
from nivel.kernels.rigid import load_weight
from nivel.kernels.saddle import factorise_rows, multipliers
from nivel.motion import newton_euler as ne
from nivel.motion.newton_euler_correction import correct

REPEATS, ROUNDS = 20_000, 7
signature = types.void(address_type, state_type, state_type, types.int64)
part = njit(signature, error_model="numpy", _nrt=False)


@part
def state(machine, y, _out, repeats):
    for _ in range(repeats):
        ne.read_state(machine, 0.0, y)


@part
def constraints(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        constraint_rows(record.bodies, record.markers, record.constraints)


@part
def forces(machine, y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        load_weight(record.bodies)
        apply_forces(machine, 0.0, y)
        ne.whiten_forces(machine)


@part
def whitening(machine, _y, _out, repeats):
    for _ in range(repeats):
        ne.whiten_rows(machine)


@part
def factorisation(machine, _y, _out, repeats):
    for _ in range(repeats):
        factorise_rows(machine, ne.WIDTH)


@part
def solution(machine, _y, _out, repeats):
    for _ in range(repeats):
        ne.whiten_forces(machine)
        multipliers(machine, ne.WIDTH)


@part
def rates(machine, _y, out, repeats):
    for _ in range(repeats):
        ne.write_rates(machine, out)


@part
def acceptance(machine, _y, _out, repeats):
    for _ in range(repeats):
        accept(machine, 0.0)


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
    force = measure(forces, address, y, out)
    row = measure(constraints, address, y, out)
    frame = np.zeros(system.layout.width)
    times = {
        "positions and velocities": measure(state, address, y, out) - row,
        "constraint rows, rates, accelerations": row,
        "forces": force,
        "whitening of C_q": measure(whitening, address, y, out),
        "S and its factor": measure(factorisation, address, y, out),
        "multipliers and accelerations": solve - force + measure(rates, address, y, out),
        "one evaluation": measure(evaluation, address, y, out),
        "an accepted state, per step": measure(acceptance, address, y, out),
        "direct correction, per step": measure(correction, address, y.copy(), out),
    }
    begin = time.process_time()
    for _ in range(REPEATS):
        observe(address, 0.0, y, frame)
    times["output of one frame"] = 1e9 * (time.process_time() - begin) / REPEATS
    rows = len(system.rows)
    print(f"{Path(path).stem}: {system.body_count} bodies, {rows} rows, {len(system.record.saddle.L)} entries of L")
    for name, nanoseconds in times.items():
        print(f"{name:40} {nanoseconds:8.0f} ns")


if __name__ == "__main__":
    main()
