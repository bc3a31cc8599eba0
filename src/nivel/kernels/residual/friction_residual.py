"""The hook of friction in the residual of implicit methods: the multipliers are given, so nothing has to be iterated here.

Efforts with stiction are unknowns as well, each with a row of its own. Where the coordinate sticks, F is what stops it within τ; where it
slides, the friction that its load makes:

    F + b ċ - clip(w, -L, L) = 0        w = F + b ċ - m (c̈ + ċ/τ) - ε (F - F₀),   L = μ_s N(λ) where |w| ≤ μ_s N, else μ(ċ) N

the law of `nivel.kernels.elements.friction` for any mass m, as a projection (Alart, Curnier 1991), in which Newton's iteration decides by
F and c̈ together which of the two it is: with one friction it decides right at once. With the fall from μ_s to μ(ċ) there may be neither:
what has begun to slide RELEASES times in one iteration holds no more than μ(ċ) N until its end. m is the mass that F moves; ε has F stay
near that of the accepted state, F₀, where several frictions hold one motion. b is viscous friction. Where the multipliers of constraints
close velocities at the ends of steps, c̈ and ċ of what sticks are means of a step (ċ that at its end in steps longer than τ):
accelerations at the ends are a little open, and two frictions of a loop would contradict each other.
"""

from __future__ import annotations

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.elements.friction import (
    ARM,
    COORDINATE,
    KINETIC,
    MODEL,
    STATIC,
    STICTION,
    STRIBECK,
    VISCOUS,
    coefficient,
    driven,
    normal_load,
    report,
    sliding_effort,
)
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import stage

# ε: the acceleration that is left of a joint that sticks is this share of what the change of the effort since F₀ would make.
NEAR = 1e-4
# Where Stribeck's curve falls so steeply that within τ it would change the speed by this share of itself, the matrix does not know of it:
# with it pivots would vanish, and the iteration go to the wrong side of the fall.
STEEP = 0.5
# Times that a friction begins to slide in one iteration, after which static friction holds it no longer.
RELEASES = 2.0
# entries of `residual.tally`: turns; then of each friction how often it has begun to slide
TURNS, RELEASED = 0, 3


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
    if n[STATIC] == n[KINETIC] or n[STRIBECK] == 0.0:
        return False
    ratio = speed / n[STRIBECK]
    fall = 2.0 * (n[STATIC] - n[KINETIC]) * np.abs(ratio) / n[STRIBECK] * np.exp(-ratio * ratio)
    return fall * load * n[ARM] * tau > STEEP * mass


@stage
def greatest(machine, k, number, rate):
    """(L, whether Stribeck's curve is too steep for the matrix there): the greatest effort of friction k without its viscous part."""
    record = record_at(machine)
    n, own = record.friction.number[k], record.residual
    load, speed, frozen = normal_load(machine, k) * n[ARM], rate * n[ARM], own.frozen[number]
    if not np.isnan(frozen):
        return coefficient(n, frozen * n[ARM]) * load, False
    if is_steep(n, real(speed), real(load), record.friction.mass[k], record.control.stick[0]):
        return coefficient(n, real(speed)) * load, True
    return coefficient(n, speed) * load, False


@stage
def find_branch(machine, k, number, wanted, limit):
    """1 or -1 where friction k slides, whose greatest effort is then `limit`, 0 where it holds."""
    record = record_at(machine)
    n, own = record.friction.number[k], record.residual
    if own.tally[TURNS] == 0.0:
        own.tally[RELEASED + number] = 0.0
    if own.tally[RELEASED + number] < RELEASES:
        limit = n[STATIC] * real(normal_load(machine, k)) * n[ARM]
    branch = 1.0 if wanted > limit else (-1.0 if wanted < -limit else 0.0)
    if branch != 0.0 and own.branch[number] == 0.0:
        own.tally[RELEASED + number] += 1.0
    return branch


@stage
def hold(machine, k, place):
    """Fill the row of friction k, whose effort is multiplier `place` of the residual. Returns the effort."""
    record = record_at(machine)
    friction, own, tau = record.friction, record.residual, record.control.stick[0]
    q, number, span = friction.columns[k, COORDINATE], place - own.row.shape[0], own.span[0]
    force, rate = own.lam[place], record.coordinates.rate[q]
    dry, change = force + friction.number[k, VISCOUS] * rate, force - friction.anchor[k]
    limit, steep = greatest(machine, k, number, rate)
    if span > 0.0:
        second, slowing = (rate - own.begun[number]) / span, 0.5 * (rate + own.begun[number]) if span <= tau else rate
    else:
        second, slowing = second_derivative(machine, q), rate
    missed = friction.mass[k] * (second + slowing / tau) + NEAR * change
    way = driven(machine, k)
    branch = own.bidden[number] if np.isnan(way) else -way
    if np.isnan(branch):
        branch = find_branch(machine, k, number, real(dry - missed), real(limit))
    row = missed if branch == 0.0 and np.isnan(way) else dry - branch * limit
    if tau == np.inf:
        # forces do not jump where speeds do, see `nivel.integrate.loop.corners`
        row = change
    own.value[own.vdot.shape[0] + record.elements.state_rate.shape[0] + 2 * own.lam.shape[0] + place] = row
    own.branch[number] = 2.0 * branch if steep else branch
    own.limit[number], own.rate[number], friction.force[k] = real(limit), real(rate), real(force)
    return force


@family
def apply(machine, number, t):
    """Add the efforts of all frictions for the multipliers of the constraints to the wrenches of the bodies, and report them."""
    record = record_at(machine)
    place = record.residual.row.shape[0]
    for k in range(record.friction.columns.shape[0]):
        if record.friction.columns[k, MODEL] == STICTION:
            force = hold(machine, k, place)
            place += 1
        else:
            force = sliding_effort(machine, k)
        add_coordinate_force(machine, record.friction.columns[k, COORDINATE], force)
        report(machine, k, force)
    return OK
