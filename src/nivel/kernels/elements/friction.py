"""Friction in joints, whose normal load is the joint's own reaction, and of patches where surfaces touch, whose load is given. Clutches,
freewheels and losses of transmissions are frictions too: their loads are functions, efforts of couplings, or none that limits.

The efforts F on the joint coordinates change the reactions, and these the efforts. Both are linear in F: with the extra rows C_f of
the coordinates, λ = λ₀ + R F, accelerations c̈ = c̈₀ + S F, S = C_f P M⁻¹ C_fᵀ (P projects onto the constraints). R and S come from one
solution with the factor that is there already per element; then F is iterated, from where the last evaluation ended, without any
solve. Coulomb's regularised law and LuGre give |F| from the load; with stiction F is what stops the coordinate within the time TAU,
as long as it is no larger than static friction: the joint really stands still. Where more is wanted, the coordinate slides, and F is
kinetic friction. So which of the two it is follows from the load, and not from a speed that is never exactly zero. What slid in the
accepted state slides on, until kinetic friction stops it, or its effort changes its direction: then static friction may hold it again.
With several frictions all others are asked to hold first; those that cannot slide, and the others are asked again, until all that are
left hold.
The two or three efforts of a patch are one friction, and resistance to rolling is one of two moments: see `nivel.kernels.elements.patch`.
A motion that drivers prescribe no effort stops: while it goes on, F is all that the load gives, against it; while they hold it, F is
left to them.
"""

import numpy as np

from nivel.kernels.algebra.analytic import absolute, maximum, real, tanh
from nivel.kernels.algebra.rows import add_times, clear
from nivel.kernels.algebra.spatial import cross
from nivel.kernels.algebra.vectors import minus, plus, seen, times
from nivel.kernels.bodies.patch_coordinate import KEPT, PROPOSED, RESTING, RESTS
from nivel.kernels.core.lanes import is_whole
from nivel.kernels.core.status import BRISTLE_TOO_FAST, FRICTION_DIVERGES, OK
from nivel.kernels.elements.patch import OVER, limited, size_of
from nivel.kernels.elements.touch import DRAG, GIVEN, HELD, LOST, MAGNITUDE, POWER, RUB, SLIP
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.solve.saddle import solve_rows
from nivel.native.function import leaf, stage

# columns of `columns`; JOINT: whose reaction is the load, or NONE; FRAME: marker whose z axis is that of the motion;
# BEARING: marker about whose point moments are taken
# STATE: the bristle, of a patch the work of its friction, or NONE
# outputs: effort, power, normal load, the bristle; of a patch those of its contact. FIRST: friction with which a patch begins, COUNT: how
# many it has: two along tangents, then maybe the spin; CAPACITY: function that is the load, or NONE; ROW: of the constraint whose effort on
# the coordinate is the load, or NONE; WAY: ONE_WAY where no effort is negative, else NONE
COORDINATE, MODEL, JOINT, ROTATES, STATE, OUTPUT, FRAME, BEARING, FIRST, COUNT = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9
CAPACITY, ROW, WAY = 10, 11, 12
ONE_WAY = 1
COULOMB, STICTION, LUGRE, PATCH = 0, 1, 2, 3
# output: the load, or of one way the rate; behind that, where the load is a function, the rate
THIRD, FOURTH = 2, 3
# An effort that nothing limits has this limit.
UNLIMITED = 1e100
# columns of `number`; ARM: a speed of the coordinate times it is the speed of the surfaces; REST: a rate below it is none where drivers
# prescribe it, known when a run starts
KINETIC, STATIC, STRIBECK, TRANSITION, VISCOUS, STIFFNESS, DAMPING = 0, 1, 2, 3, 4, 5, 6
ARM, COLLAR, MOMENT_ARM, SPIN_ARM, LOAD, REST = 7, 8, 9, 10, 11, 12
# of one that is loaded by a row: the coefficient where power comes back to the coordinate, the row's factor of the coordinate
BACKWARD, LEVER = 13, 14

# rows of `work`, besides those of `nivel.kernels.elements.patch`; SLIDES: whether a friction with stiction is asked to hold, as it slid in
# the accepted state is not, or cannot; WANTED: efforts of patches. ACTIVE: numbers of all frictions but those of patches where nothing
# touches, of which the first COUNTED is how many there are. DEFECT, AHEAD and CHANGE are in their order.
DEFECT, AHEAD, CHANGE, SLIDES, WANTED = 0, 1, 2, 3, 4
ACTIVE, COUNTED = 9, 10
HOLDS, SLID, CANNOT = 0.0, 1.0, 2.0

# Gauss–Seidel sweeps, then Newton steps, then anchored ones, then, where there are patches, sweeps that are anchored more; efforts agree to
# TOLERANCE, and must to ENOUGH.
SWEEPS, STEPS, ANCHORED_STEPS, LAST_SWEEPS = 12, 12, 40, 400
# After so many Newton steps that do not help, efforts that hold one motion contradict each other: nothing but an anchor does.
TRIES = 3
# Newton steps for the slopes: each leaves a millionth of what they are wrong by.
SETTLING = 2
TOLERANCE, ENOUGH = 1e-12, 1e-7
# What would hold a coordinate and is more than static friction by this share of it is not round-off.
MORE = 1e-6
# What rested breaks away for good if its speed, so small as it is, would have to stop within this share of τ: else forces that fall as it
# begins to move (dampers of a contact) would have it hold and break away by turns, in ever shorter steps. It rests where stopping so soon
# takes less than RESTED of static friction.
SHARP, RESTED = 1e-1, 1e-3
# Two frictions that hold one motion may have no common solution by a hair, or many: they then stay near their last efforts, and the
# acceleration that is left is this share of what the change of effort would do.
ANCHOR, LAST_ANCHOR = 1e-3, 1e-2
# What an effort moves counts for no more than this times what it would move of the two bodies without their other joints.
BOUND = 1e3
# An effort that differs from kinetic friction by this share holds.
DIFFERENT = 1e-9
# Where patches that hold are more than one motion needs, what is left of a pivot of S below this share of the largest is round-off.
DEPENDENT = 1e-9
# S_kk as this share of 1/m is round-off: the motion is prescribed.
PRESCRIBED = 1e-7
# So much of the larger S_kk of both tangents of a patch is added to theirs, and of that of the spin to this, where its motion may be
# prescribed; elsewhere it is taken out.
LEAST = 1e-4
# A driver takes up less than this share of an effort that it does not prescribe the motion of [m/m, rad/m, …]: round-off.
DRIVEN = 1e-12
# Rate of relaxation of the bristles times two steps: beyond it RK4 is unstable (2.78 a step).
FASTEST = 5.5


@stage
def along(machine, k, change):
    """Acceleration of coordinate k for whitened accelerations `change` of the bodies."""
    record = record_at(machine)
    friction, saddle = record.friction, record.saddle
    total = 0.0
    for n in range(friction.block[k, 0], friction.block[k, 1]):
        for i in range(saddle.z.shape[1]):
            total += saddle.W[n, i] * change[saddle.block[n, 3], i]
    return total


@stage
def is_apart(record, k):
    """Whether friction k is of a patch where nothing touches."""
    friction = record.friction
    if friction.columns[k, MODEL] != PATCH:
        return False
    return not real(record.coordinates.value[friction.columns[friction.columns[k, FIRST], COORDINATE]]) > 0.0


@stage
def note_active(record):
    """Note the frictions that act, and that those of patches where nothing touches have no effort. Returns how many act."""
    friction, count = record.friction, 0
    for k in range(friction.columns.shape[0]):
        if is_apart(record, k):
            friction.force[k], friction.anchor[k] = 0.0, 0.0
            friction.work[PROPOSED, k], friction.work[RESTING, k] = 0.0, 0.0
        else:
            friction.work[ACTIVE, count] = k
            count += 1
    friction.work[COUNTED, 0] = count
    return count


@stage
def active_count(friction):
    """How many frictions act."""
    return np.int64(friction.work[COUNTED, 0])


@stage
def acting(friction, a):
    """Number of the a-th friction that acts."""
    return np.int64(friction.work[ACTIVE, a])


@stage
def respond(machine):
    """Multipliers and whitened accelerations for a unit effort on each coordinate, S, and the masses that efforts move."""
    record = record_at(machine)
    friction, saddle = record.friction, record.saddle
    width, rows = saddle.z.shape[1], saddle.b.shape[0]
    for a in range(active_count(friction)):
        k = acting(friction, a)
        change, response = friction.change[k], friction.response[k]
        for body in range(change.shape[0]):
            clear(change[body])
        for n in range(friction.block[k, 0], friction.block[k, 1]):
            for i in range(width):
                change[saddle.block[n, 3], i] += saddle.W[n, i]
        friction.mass[k] = along(machine, k, change)
        for row in range(rows):
            saddle.b[row] = 0.0
        for n in range(saddle.blocks[0]):
            row, body = saddle.block[n, 0], saddle.block[n, 3]
            for i in range(width):
                saddle.b[row] += saddle.W[n, i] * change[body, i]
        solve_rows(machine, 0.0)
        for row in range(rows):
            response[saddle.row[row]] = saddle.b[row]
        for n in range(saddle.blocks[0]):
            row, body = saddle.block[n, 0], saddle.block[n, 3]
            for i in range(width):
                change[body, i] -= saddle.W[n, i] * saddle.b[row]
    for a in range(active_count(friction)):
        k = acting(friction, a)
        for b in range(active_count(friction)):
            other = acting(friction, b)
            friction.S[k, other] = along(machine, k, friction.change[other])
        friction.mass[k] = 1.0 / max(friction.S[k, k], friction.mass[k] / BOUND, 1e-300)


@stage
def start(machine):
    """Accelerations of the coordinates and multipliers without friction."""
    record = record_at(machine)
    friction, saddle, constraints = record.friction, record.saddle, record.constraints
    rows = constraints.C.shape[0]
    for row in range(rows):
        friction.lam[row] = constraints.lam[row]
    for a in range(active_count(friction)):
        k = acting(friction, a)
        total = -constraints.gamma[rows + k]
        for n in range(friction.block[k, 0], friction.block[k, 1]):
            for i in range(saddle.z.shape[1]):
                total += saddle.W[n, i] * saddle.z[saddle.block[n, 3], i]
        friction.free[k] = total


@stage
def superpose(machine):
    """λ = λ₀ + Σ R F."""
    record = record_at(machine)
    friction, lam = record.friction, record.constraints.lam
    for row in range(lam.shape[0]):
        lam[row] = friction.lam[row]
    for a in range(active_count(friction)):
        response, force = friction.response[acting(friction, a)], friction.force[acting(friction, a)]
        for row in range(lam.shape[0]):
            lam[row] += response[row] * force


@stage
def transmitted(machine, k):
    """Effort that the coordinate of friction k gives to what it is coupled with by a row of constraints, with its sign."""
    record = record_at(machine)
    return record.friction.number[k, LEVER] * record.constraints.lam[record.friction.columns[k, ROW]]


@stage
def normal_load(machine, k):
    """What presses the surfaces of friction k together [N], from the multipliers and the constant load.

    With the reaction (F, M) about the bearing, across (⊥) and along the axis of the motion, z: for a turning joint
    |F_⊥| + 2 |M_⊥|/length + |F_z| collar/radius, for a sliding one |F_⊥| + 2 |M_⊥|/length + |M_z|/radius.
    """
    record = record_at(machine)
    friction, joints, constraints, markers = record.friction, record.joints, record.constraints, record.markers
    n, joint = friction.number[k], friction.columns[k, JOINT]
    if friction.columns[k, CAPACITY] != NONE:
        return record.outputs.value[friction.columns[k, OUTPUT] + THIRD]
    if friction.columns[k, ROW] != NONE:
        return absolute(transmitted(machine, k))
    load = n[LOAD]
    if joint == NONE:
        return load
    zero = 0.0 * markers.r[joints.first_marker[joint], 0]
    F, M = (zero, zero, zero), (zero, zero, zero)
    for row in range(joints.rows[joint, 0], joints.rows[joint, 1]):
        J, lam = constraints.J[joints.part[row]], constraints.lam[row]
        F, M = plus(F, times(lam, J)), plus(M, times(lam, J[3:]))
    # the moment about the bearing: M + (r_first - r_bearing) × F
    arm = minus(markers.r[joints.first_marker[joint]], markers.r[friction.columns[k, BEARING]])
    A = markers.A[friction.columns[k, FRAME]]
    f, m = seen(A, F), seen(A, plus(M, cross(arm, F)))
    load += np.sqrt(f[0] * f[0] + f[1] * f[1]) + n[MOMENT_ARM] * np.sqrt(m[0] * m[0] + m[1] * m[1])
    if friction.columns[k, ROTATES] == 1:
        return load + n[COLLAR] * absolute(f[2])
    return load + n[SPIN_ARM] * absolute(m[2])


@stage
def find_capacities(machine, t):
    """Loads that are functions, none of them negative."""
    record = record_at(machine)
    friction, out = record.friction, record.outputs.value
    for k in range(friction.columns.shape[0]):
        if friction.columns[k, CAPACITY] != NONE:
            capacity = evaluate_function(machine, friction.columns[k, CAPACITY], t)
            out[friction.columns[k, OUTPUT] + THIRD] = maximum(capacity, 0.0)


@stage
def limits(machine, k, share):
    """(least, greatest) effort of friction k, `share` its coefficient, without its viscous part.

    Both ways alike ±L, one way (0, L). With the loss of a transmission, whose coordinate gives the effort s to the rest, it is -μ |s| where
    it moves up and μ' |s| where it moves down, μ the coefficient where it then gives power and μ' where it takes it.
    """
    record = record_at(machine)
    columns, n = record.friction.columns[k], record.friction.number[k]
    largest = share * normal_load(machine, k) * n[ARM]
    if columns[WAY] == ONE_WAY:
        return 0.0 * largest, largest
    if columns[ROW] != NONE:
        back = n[BACKWARD] * normal_load(machine, k)
        if real(transmitted(machine, k)) > 0.0:
            return -largest, back
        return -back, largest
    return -largest, largest


@stage
def coefficient(n, speed):
    """μ(v) = μ_d + (μ_s - μ_d) exp(-(v/v_s)²) of surfaces that slide; with v_s = 0 it is μ_d."""
    if n[STATIC] == n[KINETIC] or n[STRIBECK] == 0.0:
        return n[KINETIC]
    ratio = speed / n[STRIBECK]
    return n[KINETIC] + (n[STATIC] - n[KINETIC]) * np.exp(-ratio * ratio)


@stage
def relaxation(machine, k):
    """Rate σ0 |v|/μ(v) at which the bristles of friction k forget [1/s]."""
    record = record_at(machine)
    n = record.friction.number[k]
    speed = record.coordinates.rate[record.friction.columns[k, COORDINATE]] * n[ARM]
    return n[STIFFNESS] * absolute(speed) / coefficient(n, speed)


@stage
def sliding_effort(machine, k):
    """Effort of friction k, without stiction, for the present multipliers; the rate of its bristle is left with the states of forces.

    Viscous friction comes on top of it. LuGre (Canudas de Wit, Olsson, Åström, Lischinsky 1995) with the bristle z per unit load:
    ż = v - σ0 |v| z/μ(v), effort -(σ0 z + σ1 ż) times the load.
    """
    record = record_at(machine)
    friction = record.friction
    n, rate = friction.number[k], record.coordinates.rate[friction.columns[k, COORDINATE]]
    speed = rate * n[ARM]
    load = normal_load(machine, k) * n[ARM]
    viscous = n[VISCOUS] * rate
    if friction.columns[k, MODEL] == COULOMB:
        return -coefficient(n, speed) * tanh(speed / n[TRANSITION]) * load - viscous
    z = record.elements.state[friction.columns[k, STATE]]
    zdot = speed - relaxation(machine, k) * z
    record.elements.state_rate[friction.columns[k, STATE]] = zdot
    return -(n[STIFFNESS] * z + n[DAMPING] * zdot) * load - viscous


@stage
def yielding(friction, k):
    """S_kk, or of a motion that is prescribed, which no effort changes, so much more that friction acts against its rate."""
    own = friction.S[k, k]
    return own if own * friction.mass[k] > PRESCRIBED else 1.0 / friction.mass[k]


@stage
def driven(machine, k):
    """The way, ±1, in which drivers move coordinate k, or 0 while they hold it, where they and the joints leave it no freedom; else not a
    number.

    An effort of one on such a coordinate is taken up by the multipliers R of `respond` alone: C_f = Rᵀ C_q. So ċ = Σ R f'(t) over the
    drivers, however far velocities are from closed. With penalties S_kk is Σ R²/α then, unless they are iterated.
    """
    record = record_at(machine)
    friction, constraints, saddle = record.friction, record.constraints, record.saddle
    own = friction.S[k, k]
    if record.control.iterations[0] <= 1:
        for row in range(saddle.row.shape[0]):
            own -= saddle.shift[row] * friction.response[k, saddle.row[row]] ** 2
    if own * friction.mass[k] > PRESCRIBED:
        return np.nan
    rate, share = 0.0, 0.0
    for i in range(constraints.combination.shape[0]):
        if constraints.combination[i, 3] != NONE:
            part = friction.response[k, constraints.combination[i, 0]]
            rate += part * real(constraints.motion[i])
            share = max(share, np.abs(part))
    if not share > DRIVEN:
        return np.nan
    return np.sign(rate) if np.abs(rate) > friction.number[k, REST] else 0.0


@leaf
def within(limit):
    """An effort that is at its limit; not a number where there is none, as what drivers move against it cannot move."""
    return np.nan * limit if real(limit) >= UNLIMITED else limit


@stage
def holding(machine, k, tau, anchor):
    """Effort, its viscous part left out, that makes c̈ = -ċ/τ of coordinate k for the present efforts of the others."""
    record = record_at(machine)
    friction, rate = record.friction, record.coordinates.rate[record.friction.columns[k, COORDINATE]]
    acceleration = friction.free[k] + rate / tau
    for b in range(active_count(friction)):
        other = acting(friction, b)
        if other != k:
            acceleration += friction.S[k, other] * friction.force[other]
    wanted = (anchor * friction.anchor[k] - acceleration / yielding(friction, k)) / (1.0 + anchor)
    return wanted + friction.number[k, VISCOUS] * rate


@stage
def lack_of_patch(machine, k, a, tau, anchor):
    """What effort a of the patch from friction k on makes of c̈ + ċ/τ without the patch's own efforts, negative."""
    record = record_at(machine)
    friction, rate = record.friction, record.coordinates.rate[record.friction.columns[k + a, COORDINATE]]
    last = k + np.int64(friction.columns[k, COUNT])
    total = -friction.free[k + a] - rate / tau
    for b in range(active_count(friction)):
        other = acting(friction, b)
        if other < k or other >= last:
            total -= friction.S[k + a, other] * friction.force[other]
        else:
            total += anchor * friction.S[k + a, other] * friction.anchor[other]
    return total


@stage
def want_patch(machine, k, tau, anchor, is_limited):
    """Leave the efforts of the patch from friction k on in `work`, for the present efforts of the others: what makes c̈ = -ċ/τ, within the
    limit. Returns (|(F, M/r)| wanted, limit)."""
    record = record_at(machine)
    friction, coordinates, n = record.friction, record.coordinates, record.friction.number[k]
    q, count, S, wanted = friction.columns[k, COORDINATE], friction.columns[k, COUNT], friction.S, friction.work[WANTED]
    load, reach = coordinates.value[q], coordinates.value[q + 1]
    limit = (n[STATIC] if friction.work[SLIDES, k] == HOLDS else n[KINETIC]) * load
    for a in range(count):
        wanted[k + a] = 0.0
    if not load > 0.0:
        return 0.0, 0.0
    b0, b1, b2 = lack_of_patch(machine, k, 0, tau, anchor), lack_of_patch(machine, k, 1, tau, anchor), 0.0
    more = 1.0 + anchor
    s0, s1, s3 = more * S[k, k], more * S[k, k + 1], more * S[k + 1, k + 1]
    least = LEAST * max(1.0 / friction.mass[k], 1.0 / friction.mass[k + 1])
    s2, s4, s5, turn = 0.0, 0.0, 1.0, least
    if count == 3 and reach > 0.0:
        b2 = reach * lack_of_patch(machine, k, 2, tau, anchor)
        s2, s4 = more * reach * S[k, k + 2], more * reach * S[k + 1, k + 2]
        s5, turn = reach * reach * more * S[k + 2, k + 2], LEAST * reach * reach / friction.mass[k + 2]
    x = limited((s0, s1, s2, s3, s4, s5), (least, turn), (b0, b1, b2), limit if is_limited else np.inf)
    wanted[k], wanted[k + 1] = x[0], x[1]
    if count == 3:
        wanted[k + 2] = reach * x[2]
    return size_of(x), limit


@stage
def effort(machine, k, tau, anchor):
    """Effort of friction k for the present multipliers and efforts of the others."""
    record = record_at(machine)
    friction, coordinates = record.friction, record.coordinates
    n, q, model = friction.number[k], friction.columns[k, COORDINATE], friction.columns[k, MODEL]
    if model == PATCH:
        if friction.columns[k, FIRST] == k:
            want_patch(machine, k, tau, anchor, True)
        return friction.work[WANTED, k]
    if model != STICTION:
        return sliding_effort(machine, k)
    rate = coordinates.rate[q]
    viscous = n[VISCOUS] * rate
    way = driven(machine, k)
    share = n[STATIC] if np.isnan(way) and friction.work[SLIDES, k] == HOLDS else coefficient(n, rate * n[ARM])
    least, greatest = limits(machine, k, share)
    if not np.isnan(way):
        return (0.0 if way == 0.0 else least if way > 0.0 else within(greatest)) - viscous
    return min(max(holding(machine, k, tau, anchor), least), greatest) - viscous


@stage
def residual(machine, anchor, r):
    """r = effort(F) - F of all frictions for the present F, multipliers included; returns (largest |r|, its friction, largest |F|)."""
    record = record_at(machine)
    friction = record.friction
    superpose(machine)
    largest, worst, scale = 0.0, 0, 0.0
    for a in range(active_count(friction)):
        k = acting(friction, a)
        wanted = effort(machine, k, record.control.stick[0], anchor)
        r[a] = wanted - friction.force[k]
        size = np.abs(r[a])
        if not size <= largest:
            largest, worst = size, k
        scale = max(scale, np.abs(wanted), np.abs(friction.force[k]))
    return largest, worst, scale


@stage
def sweep(machine, anchor):
    """One Gauss–Seidel sweep: each friction takes the effort that the others' leave it."""
    record = record_at(machine)
    friction = record.friction
    for a in range(active_count(friction)):
        k = acting(friction, a)
        if friction.columns[k, MODEL] == PATCH:
            if friction.columns[k, FIRST] == k:
                want_patch(machine, k, record.control.stick[0], anchor, True)
            friction.force[k] = friction.work[WANTED, k]
        else:
            superpose(machine)
            friction.force[k] = effort(machine, k, record.control.stick[0], anchor)


@leaf
def eliminate(J, r, d):
    """d with J d = -r; unknowns without a pivot stay zero (two frictions that hold the same motion). J is overwritten."""
    n = r.shape[0]
    for k in range(n):
        d[k] = -r[k]
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if np.abs(J[i, k]) > np.abs(J[best, k]):
                best = i
        if np.abs(J[best, k]) < 1e-9:
            J[k, k] = np.inf
            continue
        if best != k:
            d[k], d[best] = d[best], d[k]
            for j in range(n):
                J[k, j], J[best, j] = J[best, j], J[k, j]
        for i in range(k + 1, n):
            factor = J[i, k] / J[k, k]
            d[i] -= factor * d[k]
            for j in range(k + 1, n):
                J[i, j] -= factor * J[k, j]
    for m in range(n):
        k = n - 1 - m
        for j in range(k + 1, n):
            d[k] -= J[k, j] * d[j]
        d[k] /= J[k, k]


@stage
def find_change(machine, anchor, scale):
    """The change of all efforts by a Newton step for effort(F) = F, with differences (λ is linear in F, loads are norms), into `work`;
    returns the largest defect before it."""
    record = record_at(machine)
    friction = record.friction
    n = active_count(friction)
    r, ahead, d, J = friction.work[DEFECT, :n], friction.work[AHEAD], friction.work[CHANGE], friction.jacobian
    before, _, _ = residual(machine, anchor, r)
    for b in range(n):
        j = acting(friction, b)
        kept = friction.force[j]
        delta = 1e-7 * (np.abs(kept) + scale) + 1e-30
        friction.force[j] = kept + delta
        residual(machine, anchor, ahead)
        friction.force[j] = kept
        for a in range(n):
            J[a, b] = (ahead[a] - r[a]) / delta
    eliminate(J, r, d)
    return before


@stage
def settle_slopes(machine, scale):
    """Slopes of efforts whose values agree with what they cause: Newton steps, whatever they do to the values' round-off."""
    friction = record_at(machine).friction
    for _ in range(SETTLING):
        find_change(machine, 0.0, scale)
        for a in range(active_count(friction)):
            friction.force[acting(friction, a)] += friction.work[CHANGE, a]
    superpose(machine)


@stage
def newton(machine, anchor, scale):
    """One Newton step for effort(F) = F, halved while it does not help. Returns whether it does; else it leaves a sweep."""
    record = record_at(machine)
    friction = record.friction
    n = active_count(friction)
    ahead, d = friction.work[AHEAD], friction.work[CHANGE]
    before = find_change(machine, anchor, scale)
    share = 1.0
    for _ in range(6):
        for a in range(n):
            friction.force[acting(friction, a)] += share * d[a]
        largest, _, _ = residual(machine, anchor, ahead)
        if largest < before or anchor > 0.0:  # at a limit the step is right only on its other side
            return True
        for a in range(n):
            friction.force[acting(friction, a)] -= share * d[a]
        share *= 0.5
    sweep(machine, anchor)
    return False


@stage
def has_patches(record):
    """Whether a friction is of a patch."""
    friction = record.friction
    for a in range(active_count(friction)):
        if friction.columns[acting(friction, a), MODEL] == PATCH:
            return True
    return False


@stage
def iterate(machine):
    """Efforts that agree with what they cause, from where they are; returns (largest defect, its friction, largest effort)."""
    record = record_at(machine)
    largest, worst, scale = np.inf, 0, 0.0
    free, anchored = SWEEPS + STEPS, SWEEPS + STEPS + ANCHORED_STEPS
    failed, iteration, last = 0, 0, anchored + (LAST_SWEEPS if has_patches(record) else 0)
    while iteration < last:
        anchor = 0.0 if iteration < free else ANCHOR if iteration < anchored else LAST_ANCHOR
        largest, worst, scale = residual(machine, anchor, record.friction.work[DEFECT])
        if largest <= (TOLERANCE if iteration < anchored else 0.1 * ENOUGH) * scale:
            if is_whole(machine):
                settle_slopes(machine, scale)
            break
        if iteration < SWEEPS or iteration >= anchored:
            sweep(machine, anchor)
        elif not newton(machine, anchor, scale):
            failed += 1
            if failed == TRIES and iteration < free:
                iteration = free - 1
        iteration += 1
    return largest, worst, scale


@stage
def has_fall(friction, k):
    """Whether friction k is the first of one with stiction whose static friction is more than the kinetic one."""
    n, model = friction.number[k], friction.columns[k, MODEL]
    if not n[STATIC] > n[KINETIC]:
        return False
    return model == STICTION or (model == PATCH and friction.columns[k, FIRST] == k)


@stage
def most_to_hold(machine, k):
    """The most that friction k is allowed to hold with."""
    record = record_at(machine)
    friction, n = record.friction, record.friction.number[k]
    holds = friction.work[SLIDES, k] == HOLDS
    if friction.columns[k, MODEL] == PATCH:
        return (n[STATIC] if holds else n[KINETIC]) * real(record.coordinates.value[friction.columns[k, COORDINATE]])
    return (n[STATIC] if holds else coefficient(n, rate_of(record, k) * n[ARM])) * normal_load(machine, k) * n[ARM]


@stage
def needed(machine, k, tau):
    """What friction k would have to hold with to stop within `tau`."""
    if record_at(machine).friction.columns[k, MODEL] == PATCH:
        return want_patch(machine, k, tau, 0.0, False)[0]
    return np.abs(holding(machine, k, tau, 0.0))


@stage
def is_beyond(machine, k):
    """Whether friction k would need more than it is allowed to hold with."""
    record = record_at(machine)
    friction, tau = record.friction, record.control.stick[0]
    if friction.work[SLIDES, k] == HOLDS and friction.work[RESTS, k] != 0.0:
        tau *= SHARP
    return needed(machine, k, tau) > (1.0 + MORE) * most_to_hold(machine, k)


@stage
def rests(machine, k):
    """Whether friction k, which holds, has stopped its motion."""
    record = record_at(machine)
    tau, most = record.control.stick[0], most_to_hold(machine, k)
    return needed(machine, k, SHARP * tau) - needed(machine, k, tau) <= RESTED * most


@stage
def rate_of(record, k):
    """ċ of friction k."""
    return record.coordinates.rate[record.friction.columns[k, COORDINATE]]


@stage
def slid(friction, k):
    """Whether friction k, or the patch that begins with it, slid in the accepted state."""
    kept = friction.work[KEPT]
    if friction.columns[k, MODEL] != PATCH or friction.columns[k, FIRST] != k:
        return kept[k] != 0.0
    return kept[k] != 0.0 or kept[k + 1] != 0.0 or (friction.columns[k, COUNT] == 3 and kept[k + 2] != 0.0)


@stage
def turns_back(record, k):
    """Whether the effort of friction k is against that in the accepted state."""
    friction = record.friction
    if friction.columns[k, MODEL] != PATCH:
        return (friction.force[k] + friction.number[k, VISCOUS] * rate_of(record, k)) * friction.work[KEPT, k] < 0.0
    total, reach = 0.0, record.coordinates.value[friction.columns[k, COORDINATE] + 1]
    for a in range(friction.columns[k, COUNT]):
        share = friction.force[k + a] * friction.work[KEPT, k + a]
        total += share if a < 2 else (share / (reach * reach) if reach > 0.0 else 0.0)
    return total < 0.0


@stage
def choose(machine):
    """Have those frictions slide that would need more than static friction to hold, and ask those to hold that turn back. Returns how many
    these are."""
    record = record_at(machine)
    friction, more = record.friction, 0
    for a in range(active_count(friction)):
        k = acting(friction, a)
        if not has_fall(friction, k):
            continue
        if friction.work[SLIDES, k] == SLID and turns_back(record, k):
            friction.work[SLIDES, k] = HOLDS
            more += 1
        elif friction.work[SLIDES, k] == HOLDS and is_beyond(machine, k):
            friction.work[SLIDES, k] = CANNOT
            more += 1
    return more


@stage
def propose(machine):
    """Leave what an accepted step would keep: the efforts of what slides."""
    record = record_at(machine)
    friction = record.friction
    for a in range(active_count(friction)):
        k = acting(friction, a)
        if has_fall(friction, k):
            count = np.int64(friction.columns[k, COUNT]) if friction.columns[k, MODEL] == PATCH else 1
            slides = friction.work[SLIDES, k] != HOLDS and is_beyond(machine, k)
            resting = not slides and rests(machine, k)
            for i in range(k, k + count):
                friction.work[PROPOSED, i] = friction.force[i] if slides else 0.0
                friction.work[RESTING, i] = 1.0 if resting else 0.0


@stage
def held_patches(record):
    """Note in `work` the efforts of all patches that hold, those of spins where there is a reach. Returns how many these are."""
    friction, count = record.friction, 0
    for a in range(active_count(friction)):
        k = acting(friction, a)
        friction.work[WANTED, k] = 0.0
        if friction.columns[k, MODEL] != PATCH:
            continue
        first = np.int64(friction.columns[k, FIRST])
        reach = real(record.coordinates.value[friction.columns[first, COORDINATE] + 1])
        if is_held(record, first) and (k < first + 2 or reach > 0.0):
            arm = friction.number[k, KINETIC] if friction.columns[first, ROTATES] == 1 else 1.0
            friction.work[AHEAD, count] = k
            friction.work[CHANGE, count] = reach if k == first + 2 else arm
            count += 1
    return count


@stage
def decompose(record, count):
    """Turn S of the noted efforts, scaled by their arms, into U of Uᵀ D⁻¹ U by the largest pivots, which are noted in this order.
    Returns the rank."""
    friction = record.friction
    S, order, arm = friction.S, friction.work[AHEAD], friction.work[CHANGE]
    for a in range(count):
        for b in range(count):
            S[np.int64(order[a]), np.int64(order[b])] *= arm[a] * arm[b]
    largest = 0.0
    for a in range(count):
        best = a
        for b in range(a + 1, count):
            if S[np.int64(order[b]), np.int64(order[b])] > S[np.int64(order[best]), np.int64(order[best])]:
                best = b
        order[a], order[best] = order[best], order[a]
        arm[a], arm[best] = arm[best], arm[a]
        i = np.int64(order[a])
        largest = max(largest, S[i, i])
        if not S[i, i] > DEPENDENT * largest:
            return a
        for b in range(a + 1, count):
            j = np.int64(order[b])
            part = S[j, i] / S[i, i]
            for c in range(a + 1, count):
                S[j, np.int64(order[c])] -= part * S[i, np.int64(order[c])]
    return count


@stage
def find_shift(record, rank, count):
    """Leave in `work`, by frictions, what takes the efforts F to those of least norm: with W = S₁₁⁻¹ S₁₂ they change along (-W, 1) alone,
    by -(1 + Wᵀ W)⁻¹ (F₂ - Wᵀ F₁)."""
    friction = record.friction
    S, order, arm = friction.S, friction.work[AHEAD], friction.work[CHANGE]
    y, out = friction.work[DEFECT], friction.work[WANTED]
    for b in range(rank, count):
        j = np.int64(order[b])
        y[b] = friction.force[j] / arm[b]
        for a in range(rank - 1, -1, -1):
            i = np.int64(order[a])
            total = S[i, j]
            for c in range(a + 1, rank):
                total -= S[i, np.int64(order[c])] * S[j, np.int64(order[c])]
            S[j, i] = total / S[i, i]
            y[b] -= S[j, i] * friction.force[i] / arm[a]
    for b in range(rank, count):
        j = np.int64(order[b])
        for c in range(rank, count):
            total, other = 1.0 if b == c else 0.0, np.int64(order[c])
            for a in range(rank):
                total += S[j, np.int64(order[a])] * S[other, np.int64(order[a])]
            S[j, other] = total
    for b in range(rank, count):
        j = np.int64(order[b])
        for c in range(b + 1, count):
            other = np.int64(order[c])
            part = S[other, j] / S[j, j]
            y[c] -= part * y[b]
            for d in range(b + 1, count):
                S[other, np.int64(order[d])] -= part * S[j, np.int64(order[d])]
    for b in range(count - 1, rank - 1, -1):
        j = np.int64(order[b])
        for c in range(b + 1, count):
            y[b] -= S[j, np.int64(order[c])] * y[c]
        y[b] /= S[j, j]
        out[j] = -y[b]
        for a in range(rank):
            out[np.int64(order[a])] += S[j, np.int64(order[a])] * y[b]


@stage
def room(record, k):
    """The share of the change in `work` that the patch from friction k on has room for within static friction, 1 at most."""
    friction, q = record.friction, record.friction.columns[k, COORDINATE]
    own = friction.number[k, STATIC] if friction.columns[k, ROTATES] == 1 else 1.0
    reach = real(record.coordinates.value[q + 1])
    limit = friction.number[k, STATIC] * real(record.coordinates.value[q]) / own
    square, both, change = -limit * limit, 0.0, 0.0
    for a in range(friction.columns[k, COUNT]):
        arm = own if a < 2 else reach
        effort, more = friction.force[k + a] / arm if arm > 0.0 else 0.0, friction.work[WANTED, k + a]
        square, both, change = square + effort * effort, both + effort * more, change + more * more
    if change == 0.0 or square + 2.0 * both + change <= 0.0:
        return 1.0
    return max((-both + np.sqrt(max(both * both - change * square, 0.0))) / change, 0.0) if square < 0.0 else 0.0


@stage
def share(machine):
    """Have patches that hold, and are more than one motion needs, take the efforts of least norm that cause the same accelerations, those
    of spins by their reach; as near to these as static friction allows."""
    record = record_at(machine)
    friction = record.friction
    count = held_patches(record)
    rank = decompose(record, count) if count > 1 else count
    if rank == count:
        return
    find_shift(record, rank, count)
    part = 1.0
    for a in range(count):
        k = np.int64(friction.work[AHEAD, a])
        if friction.columns[k, FIRST] == k:
            part = min(part, room(record, k))
    for a in range(count):
        k = np.int64(friction.work[AHEAD, a])
        friction.force[k] += part * friction.work[CHANGE, a] * friction.work[WANTED, k]
    superpose(machine)


@stage
def report_patch(machine, k):
    """Outputs of the contact whose patch begins with friction k, with its efforts; they take their power from the machine, and pass on that
    of a surface that moves over its body."""
    record = record_at(machine)
    friction, coordinates, out = record.friction, record.coordinates, record.outputs.value
    first, q = friction.columns[k, OUTPUT], friction.columns[k, COORDINATE]
    load, x, y = coordinates.value[q], coordinates.rate[q], coordinates.rate[q + 1]
    squared, power = friction.force[k] * friction.force[k] + friction.force[k + 1] * friction.force[k + 1], 0.0 * load
    given = 0.0 * load
    for a in range(friction.columns[k, COUNT]):
        power += friction.force[k + a] * coordinates.rate[q + a]
        given += friction.force[k + a] * friction.number[k + a, OVER]
    record.control.power[0] += given
    record.control.power[1] -= power
    if friction.columns[k, STATE] != NONE:
        record.elements.state_rate[friction.columns[k, STATE]] -= power
    out[first + POWER] += power + given
    out[first + LOST], out[first + GIVEN] = -power, given
    out[first + MAGNITUDE] = np.sqrt(load * load + squared)
    out[first + RUB] = np.sqrt(0.0 * load + squared)
    out[first + SLIP] = np.sqrt(x * x + y * y)
    out[first + HELD] = 0.0 * load + (1.0 if is_held(record, k) else 0.0)
    t, u = coordinates.J[coordinates.start[q]], coordinates.J[coordinates.start[q + 1]]
    for a in range(3):
        out[first + DRAG + a] = friction.force[k] * t[a] + friction.force[k + 1] * u[a] + 0.0 * load


@stage
def report_rolling(machine, k):
    """Outputs of the contact whose resistance to rolling begins with friction k: what it loses, beside its other friction."""
    record = record_at(machine)
    friction, coordinates, out = record.friction, record.coordinates, record.outputs.value
    first, q = friction.columns[k, OUTPUT], friction.columns[k, COORDINATE]
    power = friction.force[k] * coordinates.rate[q] + friction.force[k + 1] * coordinates.rate[q + 1]
    record.control.power[1] -= power
    if friction.columns[k, STATE] != NONE:
        record.elements.state_rate[friction.columns[k, STATE]] -= power
    out[first + POWER] += power
    out[first + LOST] -= power


@stage
def is_held(record, k):
    """Whether the efforts of the patch that begins with friction k are not those of sliding."""
    friction, q = record.friction, record.friction.columns[k, COORDINATE]
    squared = friction.force[k] * friction.force[k] + friction.force[k + 1] * friction.force[k + 1]
    reach = real(record.coordinates.value[q + 1])
    if friction.columns[k, COUNT] == 3 and reach > 0.0:
        squared += (friction.force[k + 2] / reach) ** 2
    sliding = friction.number[k, KINETIC] * real(record.coordinates.value[q])
    return np.abs(np.sqrt(squared) - sliding) > DIFFERENT * sliding


@stage
def report(machine, k, force):
    """The outputs of friction k with this effort; it takes its power from the machine."""
    record = record_at(machine)
    friction, out = record.friction, record.outputs.value
    if friction.columns[k, MODEL] == PATCH:
        if friction.columns[k, FIRST] == k and not is_apart(record, k):
            if friction.columns[k, ROTATES] == 1:
                report_rolling(machine, k)
            else:
                report_patch(machine, k)
        return
    first = friction.columns[k, OUTPUT]
    power = force * record.coordinates.rate[friction.columns[k, COORDINATE]]
    record.control.power[1] -= power
    out[first], out[first + 1] = force, power
    if friction.columns[k, WAY] == ONE_WAY:
        out[first + THIRD] = rate_of(record, k)
    elif friction.columns[k, CAPACITY] != NONE:
        out[first + FOURTH] = rate_of(record, k)
    else:
        out[first + THIRD] = normal_load(machine, k)
    if friction.columns[k, MODEL] == LUGRE:
        out[first + 3] = record.elements.state[friction.columns[k, STATE]]


@family
def apply(machine, number, t):
    """Efforts of all frictions, consistent with the reactions that they cause; multipliers and accelerations are left with them.

    FRICTION_DIVERGES names the worst (control.failure) where no consistent effort is found: more friction than any load can carry;
    BRISTLE_TOO_FAST where the bristles of LuGre relax faster than a Runge–Kutta step of fixed size can follow.
    """
    record = record_at(machine)
    friction, saddle, control = record.friction, record.saddle, record.control
    count = note_active(record)
    if count == 0:
        return OK
    find_capacities(machine, t)
    respond(machine)
    start(machine)
    for a in range(count):
        k = acting(friction, a)
        friction.anchor[k] = friction.force[k]
        friction.work[SLIDES, k] = SLID if slid(friction, k) else HOLDS
    largest, worst, scale = iterate(machine)
    while choose(machine) > 0:
        largest, worst, scale = iterate(machine)
    propose(machine)
    if not largest <= ENOUGH * scale:
        control.failure[0] = worst
        return FRICTION_DIVERGES
    if has_patches(record):
        share(machine)
    for a in range(count):
        k = acting(friction, a)
        force = friction.force[k]
        report(machine, k, force)
        if friction.columns[k, MODEL] == LUGRE and relaxation(machine, k) * control.stick[1] > FASTEST:
            control.failure[0] = k
            return BRISTLE_TOO_FAST
        for body in range(saddle.z.shape[0]):
            add_times(force, friction.change[k, body], saddle.z[body])
    return OK
