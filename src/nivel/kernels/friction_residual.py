"""The hook of friction in the residual of implicit methods: the multipliers are given, so nothing has to be iterated here.

Efforts with stiction are unknowns as well, each with a row of its own. Where the coordinate sticks, F is what stops it within τ; where it
slides, the friction that its load makes:

    F + b ċ - clip(F + b ċ - m (c̈ + ċ/τ) - ε (F - F₀), -L, L) = 0        L = μ(ċ) N(λ)

the law of `nivel.kernels.friction` for any mass m, as a projection (Alart, Curnier 1991), in which Newton's iteration decides by F and c̈
together which of the two it is: with one friction it decides right at once. m is the mass that F moves; ε has F stay near that of the
accepted state, F₀, where several frictions hold one motion. b is viscous friction.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.analytic import real
from nivel.kernels.compile import stage
from nivel.kernels.forces.push import push_coordinate
from nivel.kernels.friction import (
    ARM,
    COORDINATE,
    KINETIC,
    MODEL,
    STATIC,
    STICTION,
    STRIBECK,
    VISCOUS,
    coefficient,
    normal_load,
    report,
    sliding_effort,
)
from nivel.kernels.hook import family
from nivel.kernels.record import record_at
from nivel.kernels.status import OK

# ε: the acceleration that is left of a joint that sticks is this share of what the change of the effort since F₀ would make.
NEAR = 1e-6
# Where Stribeck's curve falls so steeply that within τ it would change the speed by this share of itself, the matrix does not know of it:
# with it pivots would vanish, and the iteration go to the wrong side of the fall.
STEEP = 0.5


@stage
def second_derivative(machine, q):
    """c̈ of coordinate q for the accelerations in `residual.acceleration`."""
    record = record_at(machine)
    coordinates, markers = record.coordinates, record.markers
    total = coordinates.bias[q]
    for part in range(coordinates.start[q], coordinates.start[q + 1]):
        marker = coordinates.part_marker[part]
        J, u, x = coordinates.J[part], markers.u[marker], record.residual.acceleration[markers.body[marker]]
        total += J[0] * (x[3] + x[1] * u[2] - x[2] * u[1])
        total += J[1] * (x[4] + x[2] * u[0] - x[0] * u[2])
        total += J[2] * (x[5] + x[0] * u[1] - x[1] * u[0])
        total += J[3] * x[0] + J[4] * x[1] + J[5] * x[2]
    return total


@stage
def is_steep(n, speed, load, mass, tau):
    """Whether Stribeck's curve is too steep for the matrix at this speed of the surfaces and this load times the arm."""
    ratio = speed / n[STRIBECK]
    fall = 2.0 * (n[STATIC] - n[KINETIC]) * np.abs(ratio) / n[STRIBECK] * np.exp(-ratio * ratio)
    return fall * load * n[ARM] * tau > STEEP * mass


@stage
def hold(machine, k, place):
    """Row of the friction k, whose effort is multiplier `place` of the residual. Returns the effort."""
    record = record_at(machine)
    friction, own, tau = record.friction, record.residual, record.control.stick[0]
    n, q, mass = friction.number[k], friction.columns[k, COORDINATE], friction.mass[k]
    number = place - own.row.shape[0]
    force, rate = own.lam[place], record.coordinates.rate[q]
    dry, change = force + n[VISCOUS] * rate, force - friction.anchor[k]
    load = normal_load(machine, k) * n[ARM]
    speed = rate * n[ARM]
    frozen = not np.isnan(own.frozen[number])
    steep = not frozen and is_steep(n, real(speed), real(load), mass, tau)
    limit = coefficient(n, own.frozen[number] if frozen else real(speed)) * load
    if not steep and not frozen:
        limit = coefficient(n, speed) * load
    missed = mass * (second_derivative(machine, q) + rate / tau) + NEAR * change
    wanted = real(dry - missed)
    branch, row = 0.0, missed
    if tau == np.inf:
        row = change
    elif wanted > real(limit):
        branch, row = 1.0, dry - limit
    elif wanted < -real(limit):
        branch, row = -1.0, dry + limit
    own.branch[number], own.limit[number] = (2.0 if steep else 1.0) * branch, real(limit)
    own.speed[number] = real(speed)
    own.value[own.vdot.shape[0] + record.elements.state_rate.shape[0] + 2 * own.lam.shape[0] + place] = row
    friction.force[k] = real(force)
    return force


@family
def rub(machine, number, t):
    """Add the efforts of all frictions for the multipliers of the constraints to the wrenches of the bodies, and report them."""
    record = record_at(machine)
    place = record.residual.row.shape[0]
    for k in range(record.friction.columns.shape[0]):
        if record.friction.columns[k, MODEL] == STICTION:
            force = hold(machine, k, place)
            place += 1
        else:
            force = sliding_effort(machine, k)
        push_coordinate(machine, record.friction.columns[k, COORDINATE], force)
        report(machine, k, force)
    return OK
