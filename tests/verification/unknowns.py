"""The unknowns of implicit methods: machines and states in motion, their residual as a function of accelerations, rates and multipliers,
and its derivatives by extrapolated differences."""

import math
from importlib import import_module
from types import SimpleNamespace

import numpy as np
from scipy.spatial.transform import Rotation

from assembled import TIME, random_states
from lanes import FULL
from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.implicit import ResidualOptions, evaluate_residual, find_tangent, with_residual
from nivel.kernels.core.status import OK
from nivel.kernels.record.record import EULER_ANGLES, NONE, ROTATION_VECTOR
from nivel.motion.catalogue import path_of
from nivel.system.states import absolute
from nivel.system.states.absolute import arranged
from nivel.system.states.relative import arrange
from preparing import prepare

# [s², s, s] by how much an acceleration moves positions and velocities, and a rate its state: as in a step of about 0.3 s
SHARES = (0.04, 0.2, 0.2)
# weights of f(+k h) - f(-k h) in central differences of order eight
CENTRAL = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
HALVINGS = 12
# rotation coordinates of the Lagrange equations, which name the coordinates here
ROTATIONS = ("euler-parameters", "euler-angles", "rotation-vector")


def moving(machine, coordinates, rng, count=1, *, place=None):
    """Assembled states in motion: each with the equations, and its state, accelerations, rates and multipliers by `evaluate`.

    coordinates : absolute, relative, or the rotations of the Lagrange equations in absolute ones.
    place : a free body that is put at an offset [m] from another one, or (no name) from the origin.
    """
    of_bodies = "absolute" if coordinates in ROTATIONS else coordinates
    settings = {"integrator": "generalised-alpha", "stabilisation": "direct", "coordinates": of_bodies}
    record = machine.replace(simulation=machine.simulation.replace(**settings))
    prepared = prepare(record, "newton-euler", of_bodies)
    for y in random_states(prepared, rng, count):
        if place is not None:
            body, other, offset = place
            first, origin = (7 * prepared.absolute.system.bodies.index(name) if name else -1 for name in (body, other))
            y[first : first + 3] = np.array(offset) + (y[origin : origin + 3] if other else 0.0)
        yield at_state(record, prepared, coordinates, y, rng)


def at_state(record, prepared, coordinates, y, rng):
    """The equations equipped for state y of absolute coordinates, and all unknowns there."""
    system, own, kernels, path = prepared.absolute.system, y.copy(), prepared.motion.kernels, None
    rank = int(system.record.control.rank[0])
    if coordinates == "relative":
        system, own = arrange(record, system, y, rank, record.simulation)
    elif coordinates in ROTATIONS:
        path = path_of("absolute", "lagrange", coordinates)
        assert path is not None
        kernels = import_module(path.module)
        if coordinates == "euler-parameters":
            system, own = absolute.arrange_parameters(record, system, y, rank, record.simulation)
        else:
            system, own = arranged(system.known_rank(rank), y, *anywhere(coordinates, system.body_count, y, rng))
        system.record.coordinates.reference[:] = prepared.absolute.system.record.coordinates.reference
    states = len(system.record.elements.state)
    own[len(own) - 2 - states : -2] = 1e-4 * rng.uniform(-1, 1, states)
    # bodies that beams carry have no accelerations but by the residual
    wanted = ResidualOptions(balance=len(system.record.tree.slider) > 0)
    of_bodies = "relative" if coordinates == "relative" else "absolute"
    motion = with_residual(MotionEquations(system, kernels), own, of_bodies, wanted, path)
    return SimpleNamespace(
        record=record,
        prepared=prepared,
        motion=motion,
        y=own,
        size=system.size,
        positions=system.positions,
        n=len(own) - system.positions - states - 2,
        states=states,
        rows=len(motion.system.record.residual.row),
        **explicit(motion, own, system.positions, states),
    )


def anywhere(rotations, count, y, rng):
    """Kind, A(φ) and A(body) as Euler parameters, φ and φ̇ of so many bodies in a state of absolute coordinates, φ anywhere regular."""
    body = Rotation.from_quat(rng.standard_normal((count, 4)))
    omega = np.einsum(
        "bij,bj->bi", body.as_matrix().reshape(count, 3, 3), y[7 * count : 13 * count].reshape(count, 6)[:, 3:]
    )
    phi = rng.uniform(-2.0, 2.0, (count, 3))
    if rotations == "euler-angles":
        phi[:, 1] = rng.uniform(0.5, 2.5, count)
    start = Rotation.from_euler("ZXZ", phi) if rotations == "euler-angles" else Rotation.from_rotvec(phi)
    rates = [np.linalg.solve(transformation(rotations, each), w) for each, w in zip(phi, omega, strict=True)]
    kind = EULER_ANGLES if rotations == "euler-angles" else ROTATION_VECTOR
    first, second = (each.as_quat(scalar_first=True).reshape(count, 4) for each in (start, body))
    return kind, first, second, phi, np.array(rates).reshape(count, 3)


def transformation(rotations, phi):
    """Ḡ of ω̄ = Ḡ φ̇; of angles z, x, z its columns are their axes as the turned frame sees them."""
    if rotations == "rotation-vector":
        return tangent_of_vector(phi)
    last, middle = Rotation.from_euler("Z", phi[2]).inv(), Rotation.from_euler("X", phi[1]).inv()
    return np.column_stack([(last * middle).apply([0, 0, 1]), last.apply([1, 0, 0]), [0, 0, 1]])


def explicit(motion, y, positions, states):
    """Accelerations, rates and multipliers as explicit methods have them; of redundant machines the multipliers that the rows kept need.

    The state is an accepted one: what holds stays near its efforts.
    """
    status, rate = motion.evaluate(TIME, y)
    assert status == OK
    residual = motion.system.record.residual
    n = len(y) - positions - states - 2
    vdot, xdot = rate[positions : positions + n], rate[positions + n : positions + n + states]
    record = motion.system.record
    record.friction.anchor[:] = record.friction.force
    lam = np.append(record.constraints.lam[residual.row], record.friction.force[residual.stiction])
    kept = len(residual.row)
    if kept < len(record.saddle.row):
        residual.y[:], residual.vdot[:], residual.lam[:kept], residual.lam[kept:] = y, vdot, 0.0, lam[kept:]
        assert evaluate_residual(motion, TIME) == OK
        value = residual.value[:n].copy()
        _, matrix = find_tangent(motion, TIME, *SHARES)
        lam[:kept] = -np.linalg.lstsq(matrix[:n, n + states : n + states + kept], value, rcond=None)[0]
    return {"vdot": vdot, "xdot": xdot, "lam": lam}


def value_at(here, y, vdot, lam):
    """(M v̇ + C_qᵀ λ - Q, rates of states, C, Ċ, C̈); the rows of efforts with stiction are behind those of C̈."""
    residual = here.motion.system.record.residual
    residual.y[:], residual.vdot[:], residual.lam[:] = y, vdot, lam
    assert evaluate_residual(here.motion, TIME) == OK
    n, states, rows = here.n, here.states, len(lam)
    return np.split(residual.value.copy(), np.cumsum([n, states, rows, rows]))


def turn_after(theta, psi):
    """Euler parameters of A(θ) exp(ψ̃)."""
    e0, e1, e2, e3 = theta.tolist()
    angle = math.hypot(*psi)
    f0, f = math.cos(0.5 * angle), math.sin(0.5 * angle) / angle if angle else 0.5
    f1, f2, f3 = (f * each for each in psi.tolist())
    return np.array(
        [
            e0 * f0 - e1 * f1 - e2 * f2 - e3 * f3,
            e0 * f1 + f0 * e1 + e2 * f3 - e3 * f2,
            e0 * f2 + f0 * e2 + e3 * f1 - e1 * f3,
            e0 * f3 + f0 * e3 + e1 * f2 - e2 * f1,
        ]
    )


def tangent_of_vector(psi):
    """T(ψ) = 1 - a ψ̃ + b ψ̃²: exp of ψ + δ is exp ψ exp(T δ); a = (1 - cos|ψ|)/ψ², b = (1 - sin|ψ|/|ψ|)/ψ²."""
    s = psi @ psi
    root = np.sqrt(s)
    a, b = ((1 - np.cos(root)) / s, (1 - np.sin(root) / root) / s) if root > 1e-3 else (0.5 - s / 24, 1 / 6 - s / 120)
    skew = np.cross(np.eye(3), psi)
    return np.eye(3) - a * skew + b * skew @ skew


class Unknowns:
    """The state as a function of z = (v̇, ẋ, λ), as `nivel.integrate.newmark.residual_newton` has it: at z of the state given, positions
    are turned
    from the base by `change` (n,) [m or rad]."""

    def __init__(self, here, change=None):
        self.here, self.change = here, np.zeros(here.n) if change is None else change
        self.z = np.concatenate([here.vdot, here.xdot, here.lam])
        self.place = here.motion.system.record.newton.place
        self.first_turns = [k for k in range(here.n) if self.place[k, 1] == 0]
        self.base = self._moved(here.y[: here.positions], -self.change)

    def _moved(self, q, change):
        q = q.copy()
        for k, (place, axis) in enumerate(self.place.tolist()):
            if axis == NONE:
                q[place] += change[k]
            elif axis == 0:
                q[place : place + 4] = turn_after(q[place : place + 4], change[k : k + 3])
        return q

    def state(self, z):
        """y of the unknowns z."""
        here, (cq, cv, cx), d = self.here, SHARES, z - self.z
        y, n = here.y.copy(), here.n
        y[: here.positions] = self._moved(self.base, self.change + cq * d[:n])
        y[here.positions : here.positions + n] += cv * d[:n]
        y[here.positions + n : len(y) - 2] += cx * d[n : n + here.states]
        return y

    def residual(self, z):
        """(r, ẋ - rates, C/cq, rows of efforts)."""
        here = self.here
        r, rates, C, _, rows = value_at(here, self.state(z), z[: here.n], z[here.n + here.states :])
        return np.concatenate(
            [r, z[here.n : here.n + here.states] - rates, C[: here.rows] / SHARES[0], rows[here.rows :]]
        )

    def widths(self):
        """First steps of the differences, by unknown: 2 % of a radian, of the machine's length or a metre, of the largest multiplier."""
        here, (cq, _, cx) = self.here, SHARES
        units = here.motion.system.map.units
        lengths = np.array(
            [min(here.size, 1.0) if unit == "m/s" else 1.0 for unit in units[here.positions : here.positions + here.n]]
        )
        lam = np.full(len(here.lam), 1.0 + np.abs(here.lam).max(initial=0.0))
        return 0.02 * np.concatenate([lengths / cq, np.full(here.states, 5e-3 / cx), lam])

    def derivative(self, direction):
        """The Jacobian times a direction: of differences with steps halved again and again, by entry the one that halving changes least."""
        before, column, least = None, None, None
        for k in range(HALVINGS):
            found = np.zeros(len(self.z))
            for m, weight in enumerate(CENTRAL, start=1):
                step = m * 0.5**k * direction
                found += weight * 2.0**k * (self.residual(self.z + step) - self.residual(self.z - step))
            if before is not None:
                changed = np.abs(found - before)
                better = changed < (np.inf if least is None else least)
                least = changed if least is None else np.where(better, changed, least)
                column = found if column is None else np.where(better, found, column)
                if not better.any() and least.max() < 1e-12 * np.abs(column).max():
                    break
            before = found
        return column

    def error(self, count=None, columns=None):
        """Largest error of an entry of `matrix` as a share of the largest in its row; unknowns in units of their widths.

        Entries are looked at one by one, or by default tests all at once along `count` random directions, where each that is wrong shows,
        or those of so many `columns` at random.
        """
        widths = self.widths()
        _, own = self.matrix()
        directions = np.diag(widths)
        if columns and not FULL and len(widths) > columns:
            rng = np.random.default_rng([len(widths), self.here.rows])
            directions = directions[:, rng.choice(len(widths), columns, replace=False)]
        if count and not FULL and len(widths) > count:
            rng = np.random.default_rng(len(widths))
            signs = rng.choice([-1.0, 1.0], (len(widths), count))
            directions = 0.25 * widths[:, None] * signs * rng.uniform(0.5, 1.0, signs.shape)
        expected = (
            np.array([self.derivative(direction) for direction in directions.T]).reshape(directions.shape[::-1]).T
        )
        rows = np.abs(own * widths).max(axis=1, keepdims=True, initial=0.0)
        error = np.abs(own @ directions - expected) / np.maximum(rows, 1e-300)
        return float(np.delete(error, self._slips(), axis=0).max(initial=0.0))

    def _slips(self):
        """Rows of velocities alone: their values do not change with positions; that they are those of C_q is tested elsewhere."""
        first, row = self.here.n + self.here.states, self.here.motion.system.record.residual.row
        return [first + k for k, each in enumerate(row) if each in self.here.motion.system.velocity_rows]

    def matrix(self):
        """(matrix of `differentiate` at z, the same for changes of z): its columns are for turns after the change."""
        newton, residual = self.here.motion.system.record.newton, self.here.motion.system.record.residual
        newton.change[:] = self.change
        residual.y[:], residual.vdot[:], residual.lam[:] = self.here.y, self.here.vdot, self.here.lam
        status, matrix = find_tangent(self.here.motion, TIME, *SHARES)
        assert status == OK
        own = matrix.copy()
        for k in self.first_turns:
            own[:, k : k + 3] = matrix[:, k : k + 3] @ tangent_of_vector(self.change[k : k + 3])
        return matrix, own
