"""Outputs of a machine in relative coordinates beyond what its equations need: accelerations, Euler parameters, all markers,
and the rows of the joints that carry bodies."""

from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.bodies.constraint import combine, constraint_rows
from nivel.kernels.bodies.coordinate import ALONG
from nivel.kernels.bodies.marker import move_markers, place_markers
from nivel.kernels.bodies.rigid import turn_to_body_axes
from nivel.kernels.record.hook import call_hook
from nivel.kernels.record.record import RAIL, record_at
from nivel.kernels.tree.tree import swing
from nivel.kernels.tree.tree_orientation import orient, quaternion_product
from nivel.native.function import stage


@stage
def show_frames(machine):
    """Positions, Euler parameters, velocities and accelerations of the bodies' own frames; ω̄ and ᾱ of these coordinates' frames."""
    record = record_at(machine)
    bodies, tree, frames = record.bodies, record.tree, record.frames
    for b in range(bodies.mass.shape[0]):
        d, A, w, own, e = tree.delta[b], bodies.A[b], bodies.omega[b], tree.own[b], bodies.theta[b]
        f = tree.own_theta[b]
        alpha = (tree.alpha0[b, 0] + d[0], tree.alpha0[b, 1] + d[1], tree.alpha0[b, 2] + d[2])
        u = (dot(A[0], own), dot(A[1], own), dot(A[2], own))
        speed, acceleration = cross(w, u), swing(alpha, w, u)
        for i in range(3):
            bodies.Rddot[b, i] = tree.Rddot0[b, i] + d[3 + i]
            bodies.alpha_b[b, i] = A[0, i] * alpha[0] + A[1, i] * alpha[1] + A[2, i] * alpha[2]
            frames.R[b, i] = bodies.R[b, i] + u[i]
            frames.Rdot[b, i] = bodies.Rdot[b, i] + speed[i]
            frames.Rddot[b, i] = bodies.Rddot[b, i] + acceleration[i]
        turn_to_body_axes(bodies, b)
        turned = quaternion_product((e[0], e[1], e[2], e[3]), (f[0], f[1], f[2], f[3]))
        for i in range(4):
            frames.theta[b, i] = turned[i]


@stage
def show_interfaces(bodies, tree):
    """Accelerations and body-axis angular velocities of the frames at interfaces, for sensors."""
    for v in range(bodies.mass.shape[0] + 1, bodies.R.shape[0]):
        d, A = tree.delta[v], bodies.A[v]
        x, y, z = tree.alpha0[v, 0] + d[0], tree.alpha0[v, 1] + d[1], tree.alpha0[v, 2] + d[2]
        for i in range(3):
            bodies.Rddot[v, i] = tree.Rddot0[v, i] + d[3 + i]
            bodies.alpha_b[v, i] = A[0, i] * x + A[1, i] * y + A[2, i] * z
        turn_to_body_axes(bodies, v)


@stage
def count_turns(coordinates, tree):
    """References of the angles whose turns the state counts."""
    for n in range(tree.counted.shape[0]):
        coordinates.reference[tree.counted[n, 0]] = tree.turn[n, 0] * tree.state[tree.counted[n, 1]] + tree.turn[n, 1]


@stage
def measure_rows(machine, t):
    """The coordinates that rows of sliders are made of, which no evaluation needs."""
    record = record_at(machine)
    coordinates, tree = record.coordinates, record.tree
    for q in range(coordinates.reference.shape[0]):
        if coordinates.what[q, 0] > ALONG:
            for k in range(tree.slider.shape[0]):
                if coordinates.what[q, 3] == tree.slider[k, 1]:
                    call_hook(machine, RAIL, q, t)


@stage
def show_tree(machine, t):
    """All that a frame shows but reactions, for `tree.delta` of the state last evaluated."""
    record = record_at(machine)
    bodies, tree = record.bodies, record.tree
    orient(machine)
    show_frames(machine)
    show_interfaces(bodies, tree)
    count_turns(record.coordinates, tree)
    place_markers(bodies, record.markers)
    move_markers(bodies, record.markers)
    constraint_rows(bodies, record.markers, tree.rows)
    measure_rows(machine, t)
    combine(machine, tree.rows, record.coordinates, record.friction, t)
