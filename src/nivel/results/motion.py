"""The motion of all bodies at the frames of a run, and how far two of them are apart."""

import json
import math
from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.results.scales import Readable, blocks


class Peak(Struct):
    """The largest number of a history: its value, the name it belongs to, and the time in seconds."""

    value: float
    row: str = ""
    time: float = 0.0


def peak(result: Readable, name: str) -> Peak:
    """The largest magnitude of a history without rows; the first NaN counts as the largest."""
    if name not in result.variables or not len(result.time):
        return Peak(0.0)
    values = np.abs(result.array(name))
    k = int(np.argmax(values))
    return Peak(float(values[k]), "", float(result.time[k]))


def worst_row(result: Readable, name: str, fraction_of: Mapping[str, float]) -> tuple[Peak, str]:
    """The row of `name` (time, row) that is largest as a fraction, and its units: m, rad or 1.

    fraction_of : factor that turns a value into a fraction: of lengths ("m"), of all others ("1").
    """
    if name not in result.variables:
        return Peak(0.0), "m"
    rows = result.coordinates[result.variables[name].dims[1]]
    units = row_units(result, rows)
    factors = np.array([fraction_of["m" if each == "m" else "1"] for each in units])
    best, largest = (0, 0), -1.0
    for frames in blocks(result):
        block = np.abs(result.array(name, frames)) * factors
        if not block.size:
            continue
        k, row = np.unravel_index(int(np.argmax(block)), block.shape)
        if not block[k, row] <= largest:  # also when it is NaN
            best, largest = (frames.start + int(k), int(row)), float(block[k, row])
        if math.isnan(largest):
            break
    if largest < 0.0:
        return Peak(0.0), "m"
    k, row = best
    value = float(abs(result.array(name, slice(k, k + 1))[0, row]))
    return Peak(value, rows[row], float(result.time[k])), units[row]


def row_units(result: Readable, rows: tuple[str, ...]) -> tuple[str, ...]:
    """Units of the constraint rows at position level, m, rad or 1; rows without a stated unit count as lengths.

    They are stated by the attribute `constraint_units` (JSON: row → units).
    """
    stated = json.loads(str(result.attributes.get("constraint_units", "{}")))
    return tuple(stated.get(row, "m") or "1" for row in rows)


NORMALISATION = ".euler_parameters"  # rows of lagrange that are not of the machine


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is far off, not a warning
def constraint_measures(result: Readable, name: str, size: float) -> tuple[float, float]:
    """(largest, mean) magnitude of the variable `name` over frames and rows; rows in metres divided by `size` [m].

    name : `constraint_violation` or `constraint_rate_violation`. Rows that only normalise rotation coordinates are left out: not all
    formulations have them.
    """
    if name not in result.variables or not len(result.time):
        return 0.0, 0.0
    rows = result.coordinates[result.variables[name].dims[1]]
    kept = [k for k, row in enumerate(rows) if not row.endswith(NORMALISATION)]
    if not kept:
        return 0.0, 0.0
    factors = np.array([1.0 / size if units == "m" else 1.0 for units in row_units(result, rows)])
    values = np.abs(result.array(name)[:, kept]) * factors[kept]
    return float(np.max(values)), float(np.mean(values))


@np.errstate(over="ignore", invalid="ignore")
def energy_measures(result: Readable, kinetic_energy: float) -> tuple[float, float | None]:
    """(largest energy error [J], the same divided by `kinetic_energy` [J], None where that is zero)."""
    if "energy_error" not in result.variables or not len(result.time):
        return 0.0, None
    error = float(np.max(np.abs(result.array("energy_error"))))
    return error, error / kinetic_energy if kinetic_energy > 0.0 else None


SAME_TIME: Final = 1e-9  # of the time span: frames this near are of one time

DEFINITION: Final = (
    "the largest, over all frames and bodies, of the distance between the two body origins divided by the size of the machine, and of "
    "the angle between the two orientations in radians"
)


class Motion(Struct):
    """time (n,) [s], position (n, bodies, 3) [m], orientation (n, bodies, 4): Euler parameters of body frames in global axes."""

    time: Array
    position: Array
    orientation: Array
    bodies: tuple[str, ...]

    @classmethod
    def of(cls, result: Readable) -> "Motion":
        """The motion in `result`; it may have no bodies."""
        bodies = result.coordinates.get("body", ())
        if "position" not in result.variables:
            n = len(result.time)
            return cls(result.time, np.zeros((n, 0, 3)), np.zeros((n, 0, 4)), ())
        return cls(result.time, result.array("position"), result.array("orientation"), bodies)


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is far away, not a warning
def distance(a: Motion, b: Motion, size: float) -> Peak:
    """How far two motions are apart: DEFINITION, with body and time. size : of the machine [m].

    Only frames at times that both have count; the first NaN counts as the largest.
    """
    time, worst = distances(a, b, size)
    if not worst.size:
        return Peak(0.0)
    k, body = np.unravel_index(int(np.argmax(worst)), worst.shape)
    return Peak(float(worst[k, body]), a.bodies[body], float(time[k]))


@np.errstate(over="ignore", invalid="ignore")
def distances(a: Motion, b: Motion, size: float, levers: Array | float | None = None) -> tuple[Array, Array]:
    """Times (n,) [s] that both motions have, and how far each body is from itself then (n, bodies), as DEFINITION says.

    levers : (bodies,) [m] that angles are multiplied by, before they are divided by the size too; by default the size itself.
    """
    first, second = common_frames(a.time, b.time)
    off = np.linalg.norm(a.position[first] - b.position[second], axis=-1) / size
    p, q = a.orientation[first], b.orientation[second]
    # θ and -θ are one orientation; |θ_a - θ_b| = 2 sin(angle/4)
    chord = np.minimum(np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1))
    angle = 4.0 * np.arcsin(np.clip(0.5 * chord, 0.0, 1.0))
    return a.time[first], np.maximum(off, angle if levers is None else angle * (np.asarray(levers) / size))


def common_frames(a: Array, b: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Places in the times a (n,) and b (m,) [s], both rising, of the frames that both have."""
    if not len(a) or not len(b):
        return np.zeros(0, dtype=np.intp), np.zeros(0, dtype=np.intp)
    tolerance = SAME_TIME * max(abs(float(a[-1])), abs(float(b[-1])))
    places = np.minimum(np.searchsorted(b, a - tolerance), len(b) - 1)
    found = np.flatnonzero(np.abs(b[places] - a) <= tolerance)
    return found, places[found]


def rotation_matrices(theta: Array) -> Array:
    """(n, 3, 3) of Euler parameters (n, 4), scalar first and of unit length: columns are the axes of the frames."""
    e0, e = theta[:, 0], theta[:, 1:]
    tilde = np.zeros((len(theta), 3, 3))
    tilde[:, [2, 0, 1], [1, 2, 0]], tilde[:, [1, 2, 0], [2, 0, 1]] = e, -e
    return np.eye(3) + 2.0 * (e0[:, None, None] * tilde + tilde @ tilde)
