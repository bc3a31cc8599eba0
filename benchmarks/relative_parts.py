"""The parts of an evaluation in relative coordinates, each in a loop of its own; see profile_step.py."""

from __future__ import annotations

import numpy as np

from nivel.kernels.bodies.constraint import constraint_rows
from nivel.kernels.bodies.marker import move_marker, place_marker
from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.record.hook import apply_forces, finish_forces, measure_active
from nivel.kernels.record.record import record_at
from nivel.kernels.solve.saddle import factorise_rows, multipliers
from nivel.kernels.tree.articulated import accelerate, factorise_tree, own_inertia, whiten_efforts, whiten_tree_rows
from nivel.kernels.tree.tree import move_tree
from nivel.motion import relative
from nivel.motion.relative import correct
from nivel.motion.tree_motion import write_positions
from part import part


@part
def tree_motion(machine, y, _out, repeats):
    for _ in range(repeats):
        move_tree(machine, y)


@part
def markers(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        for i in range(record.tree.marker.shape[0]):
            k = record.tree.marker[i]
            place_marker(record.bodies, record.markers, k)
            move_marker(record.bodies, record.markers, k)


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
def inertias(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        for b in range(record.bodies.mass.shape[0]):
            own_inertia(record.bodies, record.tree, b)


@part
def factorisation(machine, _y, _out, repeats):
    record = record_at(machine)
    for _ in range(repeats):
        factorise_tree(record.bodies, record.tree)


@part
def whitening(machine, _y, _out, repeats):
    for _ in range(repeats):
        whiten_tree_rows(machine)


@part
def schur_complement(machine, _y, _out, repeats):
    for _ in range(repeats):
        factorise_rows(machine, relative.WIDTH)


@part
def efforts(machine, _y, _out, repeats):
    for _ in range(repeats):
        whiten_efforts(machine, _y)


@part
def solution(machine, _y, _out, repeats):
    for _ in range(repeats):
        multipliers(machine, relative.WIDTH)


@part
def accelerations(machine, y, out, repeats):
    tree = record_at(machine).tree
    for _ in range(repeats):
        accelerate(machine, tree.change)
        for n in range(tree.node.shape[0]):
            write_positions(machine, y, y, out, n, np.int64(tree.place[n, 1]))


@part
def evaluation(machine, y, out, repeats):
    for _ in range(repeats):
        relative.evaluate(machine, 0.0, y, out)


@part
def correction(machine, y, _out, repeats):
    """A position pass and a velocity pass: the state is disturbed as one step of 1 ms disturbs it."""
    first = np.int64(record_at(machine).tree.positions[0])
    for _ in range(repeats):
        y[0] += 1e-10
        y[first] += 1e-9
        correct(machine, 0.0, y)


PARTS = {
    "poses and velocities of the tree": tree_motion,
    "markers": markers,
    "constraint rows, rates, accelerations": rows,
    "forces": forces,
    "factorisation of the tree": factorisation,
    "of it: inertias of the bodies": inertias,
    "whitening of C_q": whitening,
    "S and its factor": schur_complement,
    "efforts": efforts,
    "multipliers": solution,
    "accelerations and rates": accelerations,
}
