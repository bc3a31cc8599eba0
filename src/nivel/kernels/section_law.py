"""The law of a section of a beam: stress resultants are C (strain + damping × its rate)."""

from __future__ import annotations

from nivel.kernels.compile import shared


@shared
def resist(C, damping, weight, e, r, control):
    """Resultants (6,) of a section for strains e (6,) and their rates r (6,), times the length `weight` [m] that it stands for.

    C : (36,) stiffness, row by row. damping : time of damping [s]. What the length stores and loses is added to stored energy and power.
    """
    e0, e1, e2, e3, e4, e5 = e
    r0, r1, r2, r3, r4, r5 = r
    s0, s1, s2, s3, s4, s5 = 0.0 * e0, 0.0 * e0, 0.0 * e0, 0.0 * e0, 0.0 * e0, 0.0 * e0
    stored, lost = 0.0 * e0, 0.0 * e0
    for i in range(6):
        row = C[6 * i : 6 * i + 6]
        elastic = row[0] * e0 + row[1] * e1 + row[2] * e2 + row[3] * e3 + row[4] * e4 + row[5] * e5
        viscous = damping * (row[0] * r0 + row[1] * r1 + row[2] * r2 + row[3] * r3 + row[4] * r4 + row[5] * r5)
        strain = e0 if i == 0 else e1 if i == 1 else e2 if i == 2 else e3 if i == 3 else e4 if i == 4 else e5
        rate = r0 if i == 0 else r1 if i == 1 else r2 if i == 2 else r3 if i == 3 else r4 if i == 4 else r5
        stored += 0.5 * elastic * strain
        lost += viscous * rate
        total = weight * (elastic + viscous)
        if i == 0:
            s0 = total
        elif i == 1:
            s1 = total
        elif i == 2:
            s2 = total
        elif i == 3:
            s3 = total
        elif i == 4:
            s4 = total
        else:
            s5 = total
    control.stored[0] += weight * stored
    control.power[1] += weight * lost
    return s0, s1, s2, s3, s4, s5
