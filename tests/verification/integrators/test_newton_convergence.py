"""Newton's method with the exact tangents converges quadratically: the number of right digits doubles."""

from itertools import pairwise

import numpy as np

import machines
from nivel.analysis.assembly.implicit import evaluate_residual, find_tangent, with_residual
from preparing import prepare


def defect(motion, start, unknowns, cq, cv):
    """Residual of a step from `start` as index 3, in units of accelerations, with q = q0 + cq v̇ and v = v0 + cv v̇."""
    residual = motion.system.record.residual
    n, positions = len(residual.vdot), motion.system.positions
    residual.y[:] = start
    residual.y[:positions] += cq * unknowns[:n]
    residual.y[positions : positions + n] += cv * unknowns[:n]
    residual.vdot[:], residual.lam[:] = unknowns[:n], unknowns[n:]
    assert evaluate_residual(motion, 0.0) == 0
    rows = len(residual.lam)
    return np.concatenate([residual.value[:n], residual.value[n : n + rows] / cq])


def test_digits_double():
    """The slider-crank with its pin cut (joint coordinates are plain numbers), a step of 10 ms from a state in motion."""
    machine = machines.slider_crank(integrator="generalised-alpha", cut=("pin",))
    prepared = prepare(machine, coordinates="relative")
    motion = with_residual(prepared.motion, prepared.start, "relative")
    residual = motion.system.record.residual
    n, positions = len(residual.vdot), motion.system.positions
    start = prepared.start.copy()
    _, rate = motion.evaluate(0.0, start)
    for _ in range(200):
        start += 5e-3 * rate
        _, rate = motion.evaluate(0.0, start)
    cq, cv = 0.25e-4, 0.5e-2
    unknowns = np.concatenate([rate[positions : positions + n], motion.system.record.constraints.lam[residual.row]])
    sizes = []
    for _ in range(8):
        r = defect(motion, start, unknowns, cq, cv)
        status, tangent = find_tangent(motion, 0.0, cq, cv, cv)
        assert status == 0
        change = np.linalg.solve(tangent, -r)
        unknowns += change
        sizes.append(np.abs(cq * change[:n]).max())
    useful = [size for size in sizes if size > 1e-13]
    assert len(useful) >= 3
    assert sizes[-1] < 1e-13
    # each change is of the order of the square of the one before
    for before, after in pairwise(useful):
        assert after < 30.0 * before**2 + 1e-13
