"""Basic constraints (report 44, §§2.2–2.7): value, Jacobian with respect to the markers' velocities, acceleration term.

A row consists of parts (f, n), one for each marker it touches: Ċ = Σ fᵀ ṙ + nᵀ ω, all in global axes; γ is the right-hand side of
C_q v̇ = γ, that is minus everything in C̈ that does not contain accelerations of the bodies. s, d1 and d2 hold joints together at
zero; a combination Σ factor coordinate - offset - f(t) - g(coordinates) = 0 of measured coordinates is everything else: distances,
screws, gears, drivers, cams.
"""

from nivel.kernels.bodies.coordinate import cosine, translation
from nivel.kernels.record.function import evaluate_function, evaluate_motion
from nivel.kernels.record.record import NONE
from nivel.native.function import stage


@stage
def constraint_rows(bodies, markers, constraints):
    """C, J, Ċ and γ of s, d1 and d2, from the markers' positions and velocities."""
    for k in range(constraints.s.shape[0]):
        coincident(markers, constraints, constraints.s[k])
    J = constraints.J
    for k in range(constraints.d1.shape[0]):
        i, p, j, o = constraints.d1[k, 0], constraints.d1[k, 1], constraints.d1[k, 2], constraints.d1[k, 3]
        row, part = constraints.d1[k, 4], constraints.d1[k, 5]
        # perpendicular axes, C = aᵀb = 0 (eqs. 6, 31)
        C, rate, bias = cosine(bodies, markers, i, p, j, o, J[part], J[part + 1])
        constraints.C[row], constraints.Cdot[row], constraints.gamma[row] = C, rate, -bias
    for k in range(constraints.d2.shape[0]):
        i, p, j, row = constraints.d2[k, 0], constraints.d2[k, 1], constraints.d2[k, 2], constraints.d2[k, 3]
        part = constraints.d2[k, 4]
        # axis perpendicular to the distance, C = aᵀd = 0 (eqs. 8, 32), valid at d = 0, too
        C, rate, bias = translation(bodies, markers, i, p, j, J[part], J[part + 1])
        constraints.C[row], constraints.Cdot[row], constraints.gamma[row] = C, rate, -bias


@stage
def coincident(markers, constraints, table):
    """s: two points coincide, C = r_j - r_i = 0 in global axes (eqs. 11, 33). J is constant and set when the machine is built."""
    i, j, row = table[0], table[1], table[2]
    for x in range(3):
        constraints.C[row + x] = markers.r[j, x] - markers.r[i, x]
        constraints.Cdot[row + x] = markers.rdot[j, x] - markers.rdot[i, x]
        constraints.gamma[row + x] = markers.bias[i, x] - markers.bias[j, x]


@stage
def combine(machine, constraints, coordinates, friction, t):
    """C, J, Ċ and γ of all combinations of the coordinates just measured, and of the extra rows of friction."""
    J = constraints.J
    for k in range(constraints.combination.shape[0]):
        what = constraints.combination[k]
        row = what[0]
        for part in range(what[4], what[5]):
            for i in range(6):
                J[part, i] = 0.0
        value, rate, second = constraints.offset[k], 0.0, 0.0
        if what[3] != NONE:
            motion, rate, second = evaluate_motion(machine, what[3], t)
            value += motion
        constraints.motion[k] = rate
        C, Cdot, gamma = -value, -rate, second
        if what[6] != NONE:
            C -= evaluate_function(machine, what[6], t)
            for b in range(what[7], what[8]):
                i, j = constraints.bend[b, 0], constraints.bend[b, 1]
                curvature = evaluate_function(machine, constraints.bend[b, 2], t)
                gamma += curvature * coordinates.rate[i] * coordinates.rate[j]
        for n in range(what[1], what[2]):
            q, place = constraints.term[n, 0], constraints.term[n, 1]
            factor = constraints.factor[n]
            C += factor * coordinates.value[q]
            if constraints.term[n, 2] != NONE:
                factor -= evaluate_function(machine, constraints.term[n, 2], t)
            Cdot += factor * coordinates.rate[q]
            gamma -= factor * coordinates.bias[q]
            for part in range(coordinates.start[q], coordinates.start[q + 1]):
                own = J[constraints.term_part[place]]
                for i in range(6):
                    own[i] += factor * coordinates.J[part, i]
                place += 1
        constraints.C[row], constraints.Cdot[row], constraints.gamma[row] = C, Cdot, gamma
    rows = constraints.C.shape[0]
    for k in range(friction.columns.shape[0]):
        q = friction.columns[k, 0]
        constraints.gamma[rows + k] = -coordinates.bias[q]
        to = friction.part[k]
        for part in range(coordinates.start[q], coordinates.start[q + 1]):
            for i in range(6):
                J[to, i] = coordinates.J[part, i]
            to += 1
