"""Facts from a second, finer run beside its distance: parts that are wrong against their own motion, vibrations that the method
damped away, and motions that part from their neighbours."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.results.scales import Readable, largest_energy, machine_size
from nivel.results.trust.accuracy import factor, round_off
from nivel.results.trust.estimate import Estimate
from nivel.results.trust.motion import Motion, common_frames, distances

Array = NDArray[np.float64]
# Of the size of the machine, or of a radian: motions below it are at rest and have no error of their own.
AT_REST = 1e-6
# A loss of energy counts above this share of the largest energy; it does not get less where this share of it is left.
LOSS, STAYS = 1e-8, 0.7
# Distances grow with the exponential of time where they do so over so many powers of e, better than with a power of time.
POWERS_OF_E, LEAST_POINTS = 5.0, 8
# Distances between these are looked at: times the round-off, of the size; motions that far apart have parted.
ABOVE, PARTED = 100.0, 0.1


@dataclass(frozen=True)
class OwnError:
    """The part that is wrong most against its own motion. error and extent of its motion [units]."""

    name: str
    error: float
    extent: float
    units: str

    @property
    def share(self) -> float:
        return self.error / self.extent


@dataclass(frozen=True)
class Damped:
    """Energy [J] that the run lost, and what a finer one did."""

    lost: float
    lost_finer: float


@dataclass(frozen=True)
class Growth:
    """Neighbouring motions part by e in `time_constant` [s], and have parted at `parted` [s]."""

    time_constant: float
    parted: float


@np.errstate(over="ignore", invalid="ignore")
def own_error(result: Readable, estimate: Estimate) -> OwnError | None:
    """Errors of bodies against the extent of their paths, of joint coordinates against their ranges; the largest share."""
    size = machine_size(result)[0]
    time = np.array([estimate.time[-1]])
    found: list[OwnError] = []
    if "position" in estimate.values:
        path = result.array("position")
        extent = np.linalg.norm(np.ptp(path, axis=0), axis=-1)
        error = np.linalg.norm(estimate.at("position", time)[0], axis=-1)
        names = result.coordinates["body"]
        moving = np.flatnonzero(extent > AT_REST * size)
        found += [OwnError(names[k], float(error[k]), float(extent[k]), "m") for k in moving]
    if "joint_coordinate" in estimate.values:
        extent = np.ptp(result.array("joint_coordinate"), axis=0)
        error = estimate.at("joint_coordinate", time)[0]
        names = result.coordinates[result.variables["joint_coordinate"].dims[1]]
        for k in np.flatnonzero(extent > AT_REST * max(size, 1.0)):
            angle = names[k].rpartition(".")[2].startswith("angle")
            found.append(OwnError(names[k], float(error[k]), float(extent[k]), "rad" if angle else "m"))
    finite = [each for each in found if np.isfinite(each.share)]
    return max(finite, key=lambda each: each.share, default=None)


@np.errstate(over="ignore", invalid="ignore")
def damped(result: Readable, finer: Readable) -> Damped | None:
    """Energy that the method takes from the motion whatever the step: None where it takes none that counts, or less with finer steps."""
    if "energy_error" not in result.variables:
        return None
    first, second = common_frames(result.time, finer.time)
    if not len(first):
        return None
    coarse, fine = result.array("energy_error")[first], finer.array("energy_error")[second]
    k = int(np.argmin(coarse))
    lost, lost_finer = -float(coarse[k]), -float(fine[k])
    scale = largest_energy(result, machine_size(result)[0])[0]
    return Damped(lost, lost_finer) if lost > LOSS * scale and lost_finer > STAYS * lost else None


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def growth(result: Readable, finer: Readable, left: float) -> Growth | None:
    """How neighbouring motions part: None where they do not, or no faster than with a power of time, or stay near to the end."""
    size, motion = machine_size(result)[0], Motion.of(result)
    time, apart = distances(motion, Motion.of(finer), size)
    if not apart.size:
        return None
    running = np.maximum.accumulate(factor(left) * np.nan_to_num(apart.max(axis=1), nan=np.inf))
    floor = ABOVE * max(round_off(motion) / size, 1e-15)
    inside = (running > floor) & (running < PARTED) & (time > 0.0)
    if inside.sum() < LEAST_POINTS or not running[-1] >= PARTED:
        return None
    log, t = np.log(running[inside]), time[inside]
    (rate, _), straight = np.polyfit(t, log, 1), _misfit(t, log)
    if log[-1] - log[0] < POWERS_OF_E or straight > _misfit(np.log(t), log) or rate <= 0.0:
        return None
    return Growth(1.0 / float(rate), float(time[np.argmax(running >= PARTED)]))


def _misfit(x: Array, y: Array) -> float:
    """Mean square distance of y from a straight line over x."""
    return float(np.mean((np.polyval(np.polyfit(x, y, 1), x) - y) ** 2))
