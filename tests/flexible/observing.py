"""What an evaluation in any coordinates leaves, and the state in absolute coordinates that it is."""

from importlib import import_module
from types import SimpleNamespace

import numpy as np
from scipy.spatial.transform import Rotation


def observed(motion, t, y):
    """Status, frame, and copies of what the record has of bodies and modes."""
    status, _ = motion.evaluate(t, y)
    frame = np.zeros(motion.system.layout.width)
    import_module("nivel.kernels.output.observe").observe(motion.handle.address, t, y, frame)
    record = motion.system.record
    frames, own, count = record.frames, record.flexible, len(record.bodies.mass)
    parts = {name: getattr(frames, name)[:count].copy() for name in ("R", "theta", "Rdot", "Rddot")}
    parts |= {name: getattr(record.bodies, name)[:count].copy() for name in ("omega", "omega_b", "alpha_b", "A")}
    parts |= {name: getattr(own, name).copy() for name in ("p", "pdot", "pddot")}
    return SimpleNamespace(status=status, frame=frame, **parts)


def of_absolute(seen, states):
    """The state in absolute coordinates of what was observed."""
    modes = [seen.p, np.column_stack([seen.Rdot, body_rates(seen)]).ravel(), seen.pdot]
    return np.concatenate([np.column_stack([seen.R, seen.theta]).ravel(), *modes, np.zeros(states + 2)])


def body_rates(seen):
    """Angular velocities in axes of the bodies' own frames."""
    A = Rotation.from_quat(seen.theta, scalar_first=True).as_matrix()
    return np.einsum("bij,bi->bj", A, seen.omega)


def assert_same_frame(layout, found, expected, tolerance=1e-9, other=None):
    """All variables but those of violations agree, to this share of their largest entry; signs of Euler parameters and turns apart.

    other : layout of `expected`, where it has more rows.
    """
    columns = {variable.name: variable.columns for variable in (other or layout).variables}
    for variable in layout.variables:
        if variable.name in ("constraint_violation", "constraint_rate_violation", "energy_error"):
            continue
        wanted, value = expected[columns[variable.name]], found[variable.columns]
        if variable.name == "constraint_force":
            shorter = min(len(wanted), len(value))
            wanted, value = wanted[:shorter], value[:shorter]
        if variable.name == "orientation":
            value, wanted = np.abs(value), np.abs(wanted)
        if variable.name == "joint_coordinate":
            value, wanted = np.exp(1j * value), np.exp(1j * wanted)
        largest = np.abs(wanted).max(initial=1e-3)
        np.testing.assert_allclose(value, wanted, rtol=0, atol=tolerance * largest, err_msg=variable.name)
