"""Parts of a machine that are wrong against their own motion, as a second run tells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nivel.analysis.trust.check import ESTIMATE, Check
from nivel.analysis.trust.subject import Run
from nivel.results.trust import Item, Threshold, number

# Of the size of the machine, or of a radian: motions below it are at rest and have no error of their own.
AT_REST = 1e-6
THRESHOLD = Threshold(
    1e-2,
    1e-1,
    "Error of a body or of a joint coordinate as a share of its own motion. Below a hundredth it is hardly visible in a curve; "
    "above a tenth the curve is a different one.",
)


@dataclass(frozen=True)
class OwnError:
    """The part that is wrong most against its own motion. error and extent of its motion [units]; of turning up to a radian."""

    name: str
    error: float
    extent: float
    units: str

    @property
    def share(self) -> float:
        return self.error / self.extent


def look(run: Run) -> OwnError | None:
    """Errors of bodies against the extent of their paths and against what they turn by, up to a radian; of joint coordinates against
    their ranges; the largest share."""
    result, estimate = run.result, run.estimate
    if estimate is None:
        return None
    size = run.scales.size
    time = np.array([estimate.time[-1]])
    found: list[OwnError] = []
    if "position" in estimate.values:
        path = result.array("position")
        extent = np.linalg.norm(np.ptp(path, axis=0), axis=-1)
        error = np.linalg.norm(estimate.at("position", time)[0], axis=-1)
        names = result.coordinates["body"]
        moving = np.flatnonzero(extent > AT_REST * size)
        found += [OwnError(names[k], float(error[k]), float(extent[k]), "m") for k in moving]
    if "orientation" in estimate.values:
        theta = result.array("orientation")
        # |θ - θ'| = 2 sin(angle/4), with the sign of θ' that is nearer
        chord = np.sqrt(2.0 * np.maximum(1.0 - np.abs(np.sum(theta * theta[:1], axis=-1)), 0.0))
        turned = np.max(4.0 * np.arcsin(np.clip(0.5 * chord, 0.0, 1.0)), axis=0)
        error = 2.0 * np.linalg.norm(estimate.at("orientation", time)[0], axis=-1)
        names = result.coordinates["body"]
        turning = np.flatnonzero(turned > AT_REST)
        found += [OwnError(names[k], float(error[k]), min(float(turned[k]), 1.0), "rad") for k in turning]
    if "joint_coordinate" in estimate.values:
        extent = np.ptp(result.array("joint_coordinate"), axis=0)
        error = estimate.at("joint_coordinate", time)[0]
        names = result.coordinates[result.variables["joint_coordinate"].dims[1]]
        for k in np.flatnonzero(extent > AT_REST * max(size, 1.0)):
            angle = names[k].rpartition(".")[2].startswith("angle")
            found.append(OwnError(names[k], float(error[k]), float(extent[k]), "rad" if angle else "m"))
    finite = [each for each in found if np.isfinite(each.share)]
    return max(finite, key=lambda each: each.share, default=None)


def say(found: OwnError) -> Item:
    """Its error against its motion."""
    its = f"{number(found.share)} of its own motion over {number(found.extent)} {found.units}"
    said = f"Parts: {found.name} is off by {number(found.error)} {found.units}, {its}"
    return THRESHOLD.item("parts", said, found.share, row=found.name)


CHECKS = (Check("parts", Run, look, say, 320, (ESTIMATE,), "Parts", THRESHOLD, quiet=True),)
