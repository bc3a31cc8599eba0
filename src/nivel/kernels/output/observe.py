"""Observation of an evaluated state: joint coordinates, reactions, energies, one frame of output.

A variable is known by its number here; `Outputs.column` has the first column of each, from `nivel.system.layout.first_columns`.
"""

import numpy as np

from nivel.kernels.algebra.rows import copy
from nivel.kernels.bodies.floating_dynamics import flexible_kinetic_energy
from nivel.kernels.bodies.rigid import kinetic_energy, potential_energy
from nivel.kernels.bodies.shared_mass import shared_kinetic_energy
from nivel.kernels.record.hook import ACCEPTED, SHOWN, call_hook
from nivel.kernels.record.record import COMPLETE, MEASURE, NONE, OBSERVE, SENSE, record_at
from nivel.kernels.residual.point_inertia import point_kinetic_energy
from nivel.kernels.solve.least_multipliers import spread_multipliers
from nivel.native.entry import entry
from nivel.native.function import leaf, stage

# what elements report and their states, single numbers; then the variables of `nivel.system.layout`, in the same order
(
    OUTPUTS,
    STATES,
    POSITION,
    ORIENTATION,
    VELOCITY,
    ANGULAR_VELOCITY,
    ACCELERATION,
    ANGULAR_ACCELERATION,
    JOINT_FORCE,
    JOINT_TORQUE,
    JOINT_FORCE_LOCAL,
    JOINT_TORQUE_LOCAL,
    JOINT_COORDINATE,
    JOINT_RATE,
    CONSTRAINT_VIOLATION,
    CONSTRAINT_RATE_VIOLATION,
    CONSTRAINT_FORCE,
    KINETIC_ENERGY,
    POTENTIAL_ENERGY,
    EXTERNAL_WORK,
    DISSIPATED_ENERGY,
    ENERGY_ERROR,
    MODAL_COORDINATE,
    MODAL_RATE,
    MODAL_ACCELERATION,
) = range(25)


@stage
def accept(machine, t):
    """Once an accepted step: follow the angles of joints, keep what forces remember."""
    record = record_at(machine)
    elements = record.elements
    call_hook(machine, MEASURE, ACCEPTED, t)
    for k in range(elements.memory.shape[0]):
        copy(elements.proposal[k], elements.memory[k])


@leaf
def first_column(record, variable):
    """The first column of a variable in a frame."""
    return np.int64(record.outputs.column[variable])


@stage
def _write_bodies(machine, frame):
    """Places, velocities and accelerations of the bodies' frames."""
    record = record_at(machine)
    bodies, frames = record.bodies, record.frames
    position, orientation = first_column(record, POSITION), first_column(record, ORIENTATION)
    velocity, angular_velocity = first_column(record, VELOCITY), first_column(record, ANGULAR_VELOCITY)
    acceleration = first_column(record, ACCELERATION)
    angular_acceleration = first_column(record, ANGULAR_ACCELERATION)
    for b in range(bodies.mass.shape[0]):
        for i in range(3):
            frame[position + 3 * b + i] = frames.R[b, i]
            frame[velocity + 3 * b + i] = frames.Rdot[b, i]
            frame[angular_velocity + 3 * b + i] = bodies.omega[b, i]
            frame[acceleration + 3 * b + i] = frames.Rddot[b, i]
            alpha = 0.0
            for j in range(3):
                alpha += bodies.A[b, i, j] * bodies.alpha_b[b, j]
            frame[angular_acceleration + 3 * b + i] = alpha
        length = 0.0
        for i in range(4):
            length += frames.theta[b, i] * frames.theta[b, i]
        for i in range(4):
            frame[orientation + 4 * b + i] = frames.theta[b, i] / np.sqrt(length)


@stage
def write_reactions(machine, frame):
    """Force and torque of each joint on its first body at its first marker: -Σ λ (f_i, n_i), global axes, then marker axes."""
    record = record_at(machine)
    joints, constraints, markers = record.joints, record.constraints, record.markers
    force, torque = first_column(record, JOINT_FORCE), first_column(record, JOINT_TORQUE)
    local_force = first_column(record, JOINT_FORCE_LOCAL)
    local_torque = first_column(record, JOINT_TORQUE_LOCAL)
    for k in range(joints.first_marker.shape[0]):
        for i in range(3):
            f, n = 0.0, 0.0
            for row in range(joints.rows[k, 0], joints.rows[k, 1]):
                f -= constraints.lam[row] * constraints.J[joints.part[row], i]
                n -= constraints.lam[row] * constraints.J[joints.part[row], 3 + i]
            frame[force + 3 * k + i], frame[torque + 3 * k + i] = f, n
        A = markers.A[joints.first_marker[k]]
        for i in range(3):
            f, n = 0.0, 0.0
            for j in range(3):
                f += A[j, i] * frame[force + 3 * k + j]
                n += A[j, i] * frame[torque + 3 * k + j]
            frame[local_force + 3 * k + i], frame[local_torque + 3 * k + i] = f, n


@stage
def _write_joint_coordinates(machine, t, frame):
    """Joint coordinates (angles with all their turns) and their rates."""
    record = record_at(machine)
    chosen, coordinates = record.joints.coordinate, record.coordinates
    call_hook(machine, MEASURE, SHOWN, t)
    value, rate = first_column(record, JOINT_COORDINATE), first_column(record, JOINT_RATE)
    for k in range(chosen.shape[0]):
        frame[value + k], frame[rate + k] = coordinates.value[chosen[k]], coordinates.rate[chosen[k]]


@stage
def _write_constraints(machine, frame):
    """Violations and multipliers of all rows."""
    record = record_at(machine)
    constraints = record.constraints
    violation = first_column(record, CONSTRAINT_VIOLATION)
    rate_violation = first_column(record, CONSTRAINT_RATE_VIOLATION)
    multiplier = first_column(record, CONSTRAINT_FORCE)
    for row in range(constraints.C.shape[0]):
        frame[violation + row] = constraints.C[row]
        frame[rate_violation + row] = constraints.Cdot[row]
        frame[multiplier + row] = constraints.lam[row]


@stage
def energies(machine):
    """(kinetic, potential) [J]; ω̄ of the bodies has to be known."""
    record = record_at(machine)
    bodies, flexible = record.bodies, record.flexible
    kinetic, potential = 0.0, record.control.stored[0]
    for b in range(bodies.mass.shape[0]):
        kinetic += kinetic_energy(bodies, b)
        potential += potential_energy(bodies, b)
    for f in range(flexible.body.shape[0]):
        # in place of what it would be if it were rigid
        kinetic += flexible_kinetic_energy(bodies, flexible, f) - kinetic_energy(bodies, flexible.body[f])
    for k in range(record.shared.pair.shape[0]):
        kinetic += shared_kinetic_energy(bodies, record.markers, record.shared, k)
    for e in range(record.points.marker.shape[0]):
        kinetic += point_kinetic_energy(record.markers, record.points, e)
    return kinetic, potential


@stage
def _write_energies(machine, y, frame):
    """The energies, which the record keeps too, and what is wrong with their balance."""
    record = record_at(machine)
    control = record.control
    kinetic, potential = energies(machine)
    control.energy[0], control.energy[1] = kinetic, potential
    external, dissipated = y[y.shape[0] - 2], y[y.shape[0] - 1]
    frame[first_column(record, KINETIC_ENERGY)] = kinetic
    frame[first_column(record, POTENTIAL_ENERGY)] = potential
    frame[first_column(record, EXTERNAL_WORK)] = external
    frame[first_column(record, DISSIPATED_ENERGY)] = dissipated
    frame[first_column(record, ENERGY_ERROR)] = kinetic + potential - control.energy[2] - external + dissipated


@stage
def _write_outputs(machine, t, frame):
    """What forces, couplings, drivers and sensors report, and the states of elements."""
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
    reported = first_column(record, OUTPUTS)
    for k in range(outputs.value.shape[0]):
        frame[reported + k] = outputs.value[k]
    elements, states = record.elements, first_column(record, STATES)
    for k in range(elements.state.shape[0]):
        frame[states + k] = elements.state[k]


@stage
def _write_modes(machine, frame):
    """Modal coordinates of flexible bodies and their derivatives."""
    record = record_at(machine)
    flexible = record.flexible
    coordinate, rate = first_column(record, MODAL_COORDINATE), first_column(record, MODAL_RATE)
    acceleration = first_column(record, MODAL_ACCELERATION)
    for j in range(flexible.p.shape[0]):
        frame[coordinate + j], frame[rate + j] = flexible.p[j], flexible.pdot[j]
        frame[acceleration + j] = flexible.pddot[j]


@entry(OBSERVE)
def observe(machine, t, y, frame):
    """Fill `frame[1:]` from the state last evaluated; the columns are those of `nivel.system.layout`."""
    spread_multipliers(machine)
    call_hook(machine, COMPLETE, 0, t)
    _write_bodies(machine, frame)
    write_reactions(machine, frame)
    _write_joint_coordinates(machine, t, frame)
    _write_constraints(machine, frame)
    _write_energies(machine, y, frame)
    _write_outputs(machine, t, frame)
    _write_modes(machine, frame)
