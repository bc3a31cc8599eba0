"""The parts of an evaluation in absolute coordinates (newton-euler), each in a loop of its own; see profile_step.py."""

from __future__ import annotations

from nivel.kernels.bodies.constraint import constraint_rows
from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.record.hook import apply_forces, finish_forces, measure_active
from nivel.kernels.record.record import record_at
from nivel.kernels.solve.saddle import factorise_rows, multipliers
from nivel.motion import newton_euler as ne
from nivel.motion.newton_euler import correct
from part import part


@part
def state(machine, y, _out, repeats):
    for _ in range(repeats):
        ne.read_state(machine, 0.0, y)


@part
def rows(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        constraint_rows(record.bodies, record.markers, record.constraints)
        measure_active(machine, 0.0)


@part
def forces(machine, y, out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        load_weight(record.bodies)
        apply_forces(machine, 0.0, y)
        finish_forces(machine, 0.0, out)


@part
def whitening(machine, _y, _out, repeats):
    for _ in range(repeats):
        ne.whiten_rows(machine)


@part
def factorisation(machine, _y, _out, repeats):
    for _ in range(repeats):
        factorise_rows(machine, ne.WIDTH)


@part
def efforts(machine, _y, _out, repeats):
    for _ in range(repeats):
        ne.whiten_forces(machine)


@part
def solution(machine, _y, _out, repeats):
    for _ in range(repeats):
        multipliers(machine, ne.WIDTH)


@part
def rates(machine, _y, out, repeats):
    for _ in range(repeats):
        ne.write_rates(machine, out)


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


PARTS = {
    "poses and velocities, with the rows": state,
    "of it: constraint rows": rows,
    "forces": forces,
    "whitening of C_q": whitening,
    "S and its factor": factorisation,
    "efforts": efforts,
    "multipliers": solution,
    "accelerations and rates": rates,
}
