"""Assembled states near the start of a machine, and what holds of every state."""

import numpy as np

from nivel.analysis.assembly.closing import close_positions
from nivel.analysis.assembly.equations import moved

TIME = 0.02


def random_states(prepared, rng, count=3, *, size=0.1):
    """Assembled states near the start: a random change of all bodies of this size, closed again; random velocities that the rows allow."""
    motion, system = prepared.absolute, prepared.absolute.system
    for _ in range(count):
        y = prepared.assembly.y.copy()
        change = rng.uniform(-size, size, (system.body_count, 6))
        change[:, :3] *= system.size
        y[: system.positions] = moved(y[: system.positions], change.ravel())
        assert close_positions(motion, TIME, y)
        v = slice(system.positions, system.positions + 6 * system.body_count)
        y[v] = rng.uniform(-2, 2, 6 * system.body_count)
        motion.evaluate(TIME, y)
        y[v] -= np.linalg.lstsq(motion.jacobian(), system.record.constraints.Cdot, rcond=1e-10)[0]
        yield y


def mass_matrix(system):
    """M (6 B, 6 B) of (Ṙ, ω̄) as the second derivative of T = Σ ½ m |Ṙ + A ω̄ × c|² + ½ ω̄ᵀ J̄ ω̄."""
    bodies, count = system.record.bodies, system.body_count
    M = np.zeros((6 * count, 6 * count))
    for b in range(count):
        # velocity of the centre of mass = [1, -A c̃] (Ṙ, ω̄)
        V = np.hstack([np.eye(3), -bodies.A[b] @ np.cross(np.eye(3), bodies.centre_b[b])])
        at = slice(6 * b, 6 * b + 6)
        M[at, at] = bodies.mass[b] * V.T @ V
        M[6 * b + 3 : 6 * b + 6, 6 * b + 3 : 6 * b + 6] += bodies.inertia_b[b]
    return M
