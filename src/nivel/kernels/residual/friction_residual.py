"""The hook of friction in the residual of implicit methods: the multipliers are given, so nothing has to be iterated here.

Efforts with stiction are unknowns as well, each with a row of its own. Where the coordinate sticks, F is what stops it within τ; where it
slides, the friction that its load makes:

    F + b ċ - clip(w, -L, L) = 0        w = F + b ċ - m (c̈ + ċ/τ) - ε (F - F₀),   L = μ_s N(λ) where |w| ≤ μ_s N, else μ(ċ) N

the law of `nivel.kernels.elements.friction` for any mass m, as a projection (Alart, Curnier 1991), in which Newton's iteration decides by
F and c̈ together which of the two it is: with one friction it decides right at once. What slid in the accepted state is held by μ(ċ) N
alone while its effort keeps its direction. With the fall from μ_s to μ(ċ) there may be no solution: what has begun to slide RELEASES times
in one iteration holds no more than μ(ċ) N until its end. m is the mass that F moves; ε has F stay near that of the accepted state, F₀,
where several frictions hold one motion. b is viscous friction. Where the multipliers of constraints close velocities at the ends of steps,
c̈ and ċ of what sticks are means of a step (ċ that at its end in steps longer than τ): accelerations at the ends are a little open, and two
frictions of a loop would contradict each other.

The efforts (F, M/r) of a patch are a vector with one row each, and the sphere of radius L is in place of the two ends of the interval.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.bodies.patch_coordinate import KEPT
from nivel.kernels.core.status import OK
from nivel.kernels.elements.friction import (
    ARM,
    COORDINATE,
    COUNT,
    FIRST,
    KINETIC,
    MODEL,
    PATCH,
    STATIC,
    STICTION,
    STRIBECK,
    UNLIMITED,
    VISCOUS,
    coefficient,
    driven,
    find_capacities,
    limits,
    normal_load,
    report,
    sliding_effort,
    within,
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
    """(least, greatest effort of friction k without its viscous part, whether Stribeck's curve is too steep for the matrix there)."""
    record = record_at(machine)
    n, own = record.friction.number[k], record.residual
    load, speed, frozen = normal_load(machine, k) * n[ARM], rate * n[ARM], own.frozen[number]
    steep = False
    share = coefficient(n, speed)
    if not np.isnan(frozen):
        share = coefficient(n, frozen * n[ARM]) + 0.0 * speed
    elif is_steep(n, real(speed), real(load), record.friction.mass[k], record.control.stick[0]):
        steep = True
        share = coefficient(n, real(speed)) + 0.0 * speed
    least, most = limits(machine, k, share)
    return least, most, steep


@stage
def find_branch(machine, k, number, wanted, least, most):
    """1 or -1 where friction k slides, whose effort is then `most` or `least`, 0 where it holds."""
    record = record_at(machine)
    n, own = record.friction.number[k], record.residual
    if own.tally[TURNS] == 0.0:
        own.tally[RELEASED + number] = 0.0
    goes_on = wanted * record.friction.work[KEPT, k] > 0.0
    if own.tally[RELEASED + number] < RELEASES and not goes_on:
        below, above = limits(machine, k, n[STATIC])
        least, most = real(below), real(above)
    branch = 1.0 if wanted > most else (-1.0 if wanted < least else 0.0)
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
    least, most, steep = greatest(machine, k, number, rate)
    if span > 0.0:
        second, slowing = (rate - own.begun[number]) / span, 0.5 * (rate + own.begun[number]) if span <= tau else rate
    else:
        second, slowing = second_derivative(machine, q), rate
    missed = friction.mass[k] * (second + slowing / tau) + NEAR * change
    way = driven(machine, k)
    branch = own.bidden[number] if np.isnan(way) else -way
    if np.isnan(branch):
        branch = find_branch(machine, k, number, real(dry - missed), real(least), real(most))
    row = missed if np.isnan(way) else dry
    if branch != 0.0:
        row = dry - (within(most) if branch > 0.0 else within(least))
    if tau == np.inf:
        # forces do not jump where speeds do, see `nivel.integrate.loop.corners`
        row = change
    own.value[own.vdot.shape[0] + record.elements.state_rate.shape[0] + 2 * own.lam.shape[0] + place] = row
    own.branch[number] = 2.0 * branch if steep else branch
    limit = max(real(most), -real(least))
    own.limit[number] = limit if limit < UNLIMITED else 0.0
    own.rate[number], friction.force[k] = real(rate), real(force)
    return force


@stage
def lack(machine, k, place):
    """Of effort k, multiplier `place`: (c̈ + ċ/τ, or what stands for it over a step; change of the effort since the accepted state)."""
    record = record_at(machine)
    friction, own, tau = record.friction, record.residual, record.control.stick[0]
    q, number, span = friction.columns[k, COORDINATE], place - own.row.shape[0], own.span[0]
    rate, change = record.coordinates.rate[q], own.lam[place] - friction.anchor[k]
    own.rate[number] = real(rate)
    if span > 0.0:
        return (rate - own.begun[number]) / span + (
            0.5 * (rate + own.begun[number]) if span <= tau else rate
        ) / tau, change
    return second_derivative(machine, q) + rate / tau, change


@stage
def hold_patch(machine, k, place):
    """Fill the rows of the patch that begins with friction k, whose efforts are multipliers from `place` on of the residual."""
    record = record_at(machine)
    friction, own, n, value = record.friction, record.residual, record.friction.number[k], record.residual.value
    q, count, number = friction.columns[k, COORDINATE], friction.columns[k, COUNT], place - own.row.shape[0]
    first = own.vdot.shape[0] + record.elements.state_rate.shape[0] + 2 * own.lam.shape[0] + place
    load, reach, mass = record.coordinates.value[q], record.coordinates.value[q + 1], friction.mass[k]
    x, y = lack(machine, k, place), lack(machine, k + 1, place + 1)
    F, G, H = own.lam[place], own.lam[place + 1], 0.0 * load
    miss_x, miss_y, miss_z = mass * x[0] + NEAR * x[1], mass * y[0] + NEAR * y[1], 0.0 * load
    spins = count == 3 and real(reach) > 0.0
    if spins:
        z = lack(machine, k + 2, place + 2)
        H = own.lam[place + 2] / reach
        miss_z = mass * reach * z[0] + NEAR * z[1] / reach
    limit, largest = n[KINETIC] * load, n[STATIC] * real(load)
    if own.tally[TURNS] == 0.0:
        own.tally[RELEASED + number] = 0.0
    a, b, c = F - miss_x, G - miss_y, H - miss_z
    goes_on = real(a) * friction.work[KEPT, k] + real(b) * friction.work[KEPT, k + 1]
    if spins:
        goes_on += real(c) * friction.work[KEPT, k + 2] / real(reach)
    if own.tally[RELEASED + number] >= RELEASES or goes_on > 0.0:
        largest = real(limit)
    size = np.sqrt(a * a + b * b + c * c + 0.0 * load)
    branch = own.bidden[number]
    if np.isnan(branch):
        branch = 1.0 if real(size) > largest else 0.0
        if branch != 0.0 and own.branch[number] == 0.0:
            own.tally[RELEASED + number] += 1.0
    if record.control.stick[0] == np.inf:
        miss_x, miss_y, branch = x[1] + 0.0 * load, y[1] + 0.0 * load, 0.0
        if spins:
            miss_z = (own.lam[place + 2] - friction.anchor[k + 2]) / reach
    if not real(load) > 0.0:
        miss_x, miss_y, branch = F, G, 0.0
    elif branch != 0.0:
        share = limit / size if real(size) > 0.0 else 0.0 * load
        miss_x, miss_y, miss_z = F - share * a, G - share * b, H - share * c
    value[first], value[first + 1] = miss_x, miss_y
    if count == 3:
        value[first + 2] = miss_z if spins and real(load) > 0.0 else own.lam[place + 2]
    for m in range(count):
        own.branch[number + m], friction.force[k + m] = branch, real(own.lam[place + m])
        own.limit[number + m] = real(limit) * (real(reach) if m == 2 else 1.0)


@family
def apply(machine, number, t):
    """Add the efforts of all frictions for the multipliers of the constraints to the wrenches of the bodies, and report them."""
    record = record_at(machine)
    place = record.residual.row.shape[0]
    find_capacities(machine, t)
    for k in range(record.friction.columns.shape[0]):
        model = record.friction.columns[k, MODEL]
        if model == STICTION:
            force = hold(machine, k, place)
            place += 1
        elif model == PATCH:
            if record.friction.columns[k, FIRST] == k:
                hold_patch(machine, k, place)
            force = record.residual.lam[place]
            place += 1
        else:
            force = sliding_effort(machine, k)
        add_coordinate_force(machine, record.friction.columns[k, COORDINATE], force)
        report(machine, k, force)
    return OK
