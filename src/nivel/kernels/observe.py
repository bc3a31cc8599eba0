"""What a run keeps of an evaluated state: joint coordinates, reactions, energies, one frame of output."""

from __future__ import annotations

import numpy as np

from nivel.kernels.compile import entry, stage
from nivel.kernels.energy import energies
from nivel.kernels.hook import ACCEPTED, SHOWN, call_hook
from nivel.kernels.record import COMPLETE, MEASURE, NONE, SENSE, observe_signature, record_at


@stage
def accept(machine, t):
    """Once an accepted step: follow the angles of joints, keep what forces remember."""
    record = record_at(machine)
    elements = record.elements
    call_hook(machine, MEASURE, ACCEPTED, t)
    for k in range(elements.memory.shape[0]):
        for i in range(elements.memory.shape[1]):
            elements.memory[k, i] = elements.proposal[k, i]


@stage
def _reactions(machine, frame, at):
    """Force and torque of each joint on its first body at its first marker: -Σ λ (f_i, n_i), global axes, then marker axes."""
    record = record_at(machine)
    joints, constraints, markers = record.joints, record.constraints, record.markers
    count = joints.first_marker.shape[0]
    for k in range(count):
        for i in range(3):
            force, torque = 0.0, 0.0
            for row in range(joints.rows[k, 0], joints.rows[k, 1]):
                force -= constraints.lam[row] * constraints.J[joints.part[row], i]
                torque -= constraints.lam[row] * constraints.J[joints.part[row], 3 + i]
            frame[at + 3 * k + i] = force
            frame[at + 3 * count + 3 * k + i] = torque
        A = markers.A[joints.first_marker[k]]
        for i in range(3):
            force, torque = 0.0, 0.0
            for j in range(3):
                force += A[j, i] * frame[at + 3 * k + j]
                torque += A[j, i] * frame[at + 3 * count + 3 * k + j]
            frame[at + 6 * count + 3 * k + i] = force
            frame[at + 9 * count + 3 * k + i] = torque
    return at + 12 * count


@stage
def _joint_coordinates(machine, t, frame, at):
    """Joint coordinates (angles with all their turns), then their rates."""
    record = record_at(machine)
    chosen, coordinates = record.joints.coordinate, record.coordinates
    call_hook(machine, MEASURE, SHOWN, t)
    count = chosen.shape[0]
    for k in range(count):
        frame[at + k], frame[at + count + k] = coordinates.value[chosen[k]], coordinates.rate[chosen[k]]
    return at + 2 * count


@stage
def _outputs(machine, t, frame, at):
    """What forces, couplings, drivers and sensors report."""
    record = record_at(machine)
    constraints, outputs = record.constraints, record.outputs
    for k in range(outputs.combination.shape[0]):
        first = outputs.combination[k, 0]
        if first != NONE:
            effort = -constraints.lam[constraints.combination[k, 0]]
            outputs.value[first] = effort
            if outputs.combination[k, 1] == 1:
                outputs.value[first + 1] = effort * constraints.motion[k]
    call_hook(machine, SENSE, 0, t)
    for k in range(outputs.value.shape[0]):
        frame[at + k] = outputs.value[k]


@entry(observe_signature)
def observe(machine, t, y, frame):
    """Fill `frame[1:]` from the state last evaluated; the columns are those of `nivel.system.layout`."""
    call_hook(machine, COMPLETE, 0, t)
    record = record_at(machine)
    bodies, constraints, control, frames = record.bodies, record.constraints, record.control, record.frames
    nb = bodies.mass.shape[0]
    at = 1
    for b in range(nb):
        for i in range(3):
            frame[at + 3 * b + i] = frames.R[b, i]
            frame[at + 7 * nb + 3 * b + i] = frames.Rdot[b, i]
            frame[at + 10 * nb + 3 * b + i] = bodies.omega[b, i]
            frame[at + 13 * nb + 3 * b + i] = frames.Rddot[b, i]
            alpha = 0.0
            for j in range(3):
                alpha += bodies.A[b, i, j] * bodies.alpha_b[b, j]
            frame[at + 16 * nb + 3 * b + i] = alpha
        length = 0.0
        for i in range(4):
            length += frames.theta[b, i] * frames.theta[b, i]
        for i in range(4):
            frame[at + 3 * nb + 4 * b + i] = frames.theta[b, i] / np.sqrt(length)
    at += 19 * nb
    at = _reactions(machine, frame, at)
    at = _joint_coordinates(machine, t, frame, at)
    rows = constraints.C.shape[0]
    for row in range(rows):
        frame[at + row] = constraints.C[row]
        frame[at + rows + row] = constraints.Cdot[row]
        frame[at + 2 * rows + row] = constraints.lam[row]
    at += 3 * rows
    kinetic, potential = energies(machine)
    control.energy[0], control.energy[1] = kinetic, potential
    external, dissipated = y[y.shape[0] - 2], y[y.shape[0] - 1]
    frame[at], frame[at + 1], frame[at + 2], frame[at + 3] = kinetic, potential, external, dissipated
    frame[at + 4] = kinetic + potential - control.energy[2] - external + dissipated
    _outputs(machine, t, frame, at + 5)
    flexible = record.flexible
    modes = flexible.p.shape[0]
    at = frame.shape[0] - 2 * modes
    for j in range(modes):
        frame[at + j], frame[at + modes + j] = flexible.p[j], flexible.pdot[j]
