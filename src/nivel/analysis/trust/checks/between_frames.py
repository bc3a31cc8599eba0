"""Numbers between frames: how much farther they go than any stored number shows, and what no frame shows of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.trust.check import FRAMES, Check
from nivel.analysis.trust.subject import Actuated, Positions, Run
from nivel.results.curve import ROUNDED, Curve, curve
from nivel.results.frames.contents import shape_of
from nivel.results.frames.loads import with_probes
from nivel.results.reductions import extreme
from nivel.results.result import Result
from nivel.results.trust import Item, amount, number

# a peak that may be larger by this share is told; below it plots and tables show it
HIDDEN = 0.05
# of its range in the frames: a motion that goes otherwise between them is another one than they show
OTHERWISE = 1e-2
# of the largest range of a variable: less is no motion
STILL = 1e-9
# frames that are looked at, at most
MOST = 20_000
LOADS = ("force.", "driver.", "sensor.", "hydraulics.")
# of modes only the sum is a place: fast ones of small amplitude swing between all frames
MOTIONS = ("position", "joint_coordinate")
NOT_SHOWN = (".sticks", ".count", "_local")


@dataclass(frozen=True)
class Hidden:
    """The number whose peak frames may hide most of, as a share of its largest stored value."""

    name: str
    share: float


@dataclass(frozen=True)
class Otherwise:
    """The number that goes otherwise between frames, or positions, by `off` [units], the largest as a share of its range. motion : it is a
    place, or an analysis of positions was made, of which each number is one of the motion that was asked for."""

    name: str
    off: float
    units: str
    share: float
    motion: bool
    positions: bool


def look(run: Run) -> Hidden | None:
    """The worst of all loads and sensors."""
    result, worst = run.result, Hidden("", HIDDEN)
    if len(result.time) > MOST:
        return None
    for name, of in _curves(result):
        found = extreme(of)
        share = float(found.doubt[0]) / max(float(np.abs(found.value[0])), 1e-300)
        if np.isfinite(share) and share > worst.share:
            worst = Hidden(name, share)
    return worst if worst.name else None


def _curves(result: Result) -> Iterator[tuple[str, Curve]]:
    """Names and curves of one column."""
    for name in ("joint_force", "joint_torque"):
        if name in result.variables:
            size = np.linalg.norm(result.array(name), axis=2)
            of = with_probes(result, name, curve(result.time, size))
            floor = 1e-9 * float(np.max(size, initial=0.0))
            for k in np.flatnonzero(size.max(axis=0, initial=0.0) > floor):
                yield f"{result.coordinates['joint'][k]}.{name.removeprefix('joint_')}", _column(of, int(k))
    names = [
        # numbers without units are shares, directions and marks of what sticks
        name
        for name, variable in result.variables.items()
        if name.startswith(LOADS) and variable.dims == ("time",) and result.units(name) not in ("", "1")
    ]
    if names:
        every = curve(result.time, np.column_stack([result.array(name) for name in names]))
        size = np.max(np.abs(every.value), axis=0, initial=0.0)
        for k in np.flatnonzero(np.ptp(every.value, axis=0) > 1e-9 * size):
            yield names[k], _column(every, int(k))


def _column(of: Curve, k: int) -> Curve:
    part = slice(k, k + 1)
    return Curve(of.time, of.value[:, part], of.rate[:, part], of.doubt[:, part], of.hidden[:, part])


def say(found: Hidden) -> Item:
    """The line is green: the stored numbers are right."""
    why = f"that of {found.name} may be {number(100.0 * found.share)} % larger than any stored number"
    said = f"Not examined: peaks, work and cycles between frames: {why}; a shorter output_interval shows them"
    return Item("unexamined", "green", said, row=found.name)


def look_otherwise(subject: Run | Positions | Actuated) -> Otherwise | None:
    """The worst number at a probe: of places, if one of these goes otherwise, else of all; of efforts what their own times leave open."""
    positions = not isinstance(subject, Run)
    found = [
        each
        for variable, off in subject.between_frames.items()
        if not variable.endswith(NOT_SHOWN)
        for each in _of_variable(subject.result, variable, np.asarray(off, dtype=float), positions)
    ]
    if not found and isinstance(subject, Actuated):
        name, off, units, share = subject.efforts.open_between
        if off > ROUNDED * _energy(subject) / (subject.scales.size if units == "N" else 1.0):
            return Otherwise(f"the effort of {name}", off, units, share, motion=True, positions=True)
        return None
    return max(found, key=lambda each: (each.motion, each.share), default=None)


def _energy(subject: Actuated) -> float:
    """[J] the largest kinetic energy: efforts that are nothing beside it are round-off."""
    known = "kinetic_energy" in subject.result.variables
    return float(np.max(subject.result.array("kinetic_energy"), initial=0.0)) if known else 0.0


def _of_variable(result: Any, variable: str, off: NDArray[np.float64], positions: bool) -> Iterator[Otherwise]:
    """The worst number of a variable."""
    values = result.array(variable).reshape(len(result.time), -1)
    ranges = np.ptp(values, axis=0)
    # a column that hardly moves beside the others of its variable moves by their round-off
    share = off / np.maximum(ranges, max(STILL * float(ranges.max(initial=0.0)), 1e-300))
    k = int(np.argmax(share))
    dims = result.variables[variable].dims[1:]
    place = np.unravel_index(k, shape_of(result.variables[variable], result.coordinates)) if dims else ()
    names = [result.coordinates[dim][at] for dim, at in zip(dims, place, strict=True)]
    name = ".".join([*names[:1], variable.removeprefix("joint_") if names else variable, *names[1:]])
    is_motion = positions or (variable in MOTIONS and float(share[k]) > OTHERWISE)
    units = result.units(name) if name in result else result.variables[variable].units
    yield Otherwise(name, float(off[k]), units, float(share[k]), is_motion, positions)


def say_otherwise(found: Otherwise) -> Item:
    """Amber where the motion itself is another one between frames."""
    frames, what = (
        ("positions", "more positions show") if found.positions else ("frames", "a shorter output_interval shows")
    )
    off = f"{found.name} may go {amount(found.off, found.units)} beyond what {frames} show"
    if found.motion:
        said = f"Between {frames}: {off}; {what} it (green if it goes along a smooth curve)"
        return Item("between_frames", "amber", said, row=found.name)
    return Item(
        "unexamined", "green", f"Not examined: peaks, work and cycles between frames: {off}; {what} it", row=found.name
    )


CHECKS = (
    Check("between_frames", Run, look, say, 914, (FRAMES,), "Peaks between frames", line="unexamined"),
    Check(
        "otherwise",
        (Run, Positions, Actuated),
        look_otherwise,
        say_otherwise,
        27,
        (FRAMES,),
        "Between frames",
        line="between_frames",
    ),
)
