"""The same machine with other elements of its beams, twice or half as many, and how far the two results are apart.

The difference is what tells: curvatures of elements that lock hardly differ from each other, and all of them are wrong. Where the error of
a beam goes with the power p of the length of its elements, the distance D to twice as many is (1 - 2⁻ᵖ) of the error, and that to half
as many 2ᵖ - 1 times it.
"""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from nivel.elements.joints import JOINTS
from nivel.known import Beam, Result
from nivel.lazy import Struct, nivel, scipy
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.results.estimate import Estimate
from nivel.results.motion import common_frames
from nivel.results.scales import Readable, machine_size
from nivel.system.states.relative import bodies_of

IN_A_STEP: Final = 30  # places between two states of a path at which the nearest one is looked for
MARGIN: Final = 1.25  # by which estimates are larger than what follows from the distance


class Pair(Struct):
    """The machine with other elements, `words` says which. factor : by which the distance of the two is multiplied to be the error. order :
    of the elements with the lowest."""

    machine: MachineRecord
    words: str
    factor: float
    order: int

    @property
    def beams(self) -> tuple[str, ...]:
        """Names of the beams."""
        return tuple(beam.name for beam in self.machine.beams)


def other_elements(machine: MachineRecord, *, doubles: bool = False) -> Pair | None:
    """The machine with half as many elements, and twice as many where a beam has too few, or everywhere if it `doubles`; None where it has
    no beams."""
    if not machine.beams:
        return None
    held = {name for joint in machine.joints if not JOINTS[joint.type].rail for name in bodies_of(machine, joint)}
    found: list[Beam] = []
    longer = shorter = False
    for beam in machine.beams:
        if doubles:
            found.append(nivel.elements.beams.other_elements.doubled(beam))
            shorter = True
        else:
            stations = {name.partition(".")[2] for name in held if name.startswith(f"{beam.name}.")}
            other, halves, divides = nivel.elements.beams.other_elements.changed(beam, stations)
            found.append(other)
            longer, shorter = longer or halves, shorter or divides
    given: dict[str, Any] = {name: getattr(machine, name) for name in type(machine).model_fields}
    given["beams"] = tuple(found)
    # of what are both, the distance is that of the longer ones, and the error of the shorter ones no more than a few times the estimate
    power = 2 if longer and shorter else min(_power(beam) for beam in machine.beams)
    left = 2.0**-power
    factor = MARGIN * left / (1.0 - left) if longer else MARGIN / (1.0 - left)
    words = "longer and shorter" if longer and shorter else "half as many" if longer else "twice as many"
    other = type(machine).model_construct(machine.model_fields_set, **given)
    return Pair(other, words, factor, min(beam.order for beam in machine.beams))


def _power(beam: Beam) -> int:
    """Of the length, with which the error of a beam goes at least; loads that jump lower that of quadratic elements."""
    if beam.model == "ancf-cable":
        return 3
    return 2 if beam.model != "geometrically-exact" or beam.order == 1 else 3


class ElementErrors(Struct):
    """time (n,) [s]; values : of each variable (n, …) its estimated error then, zero where the other machine has no such number."""

    time: Array
    values: Mapping[str, Array]


@np.errstate(over="ignore", invalid="ignore")
def element_errors(result: Readable, other: Readable, factor: float) -> ElementErrors | None:
    """Errors of all numbers of `result` at the times that both have."""
    first, second = common_frames(result.time, other.time)
    if not len(first):
        return None
    values = {}
    for name, variable in result.variables.items():
        if name not in other.variables or name.startswith("mode_"):  # shapes have no sign
            continue
        a, b = result.array(name)[first], other.array(name)[second]
        b = _matched(b, variable.dims, result, other)
        if name == "orientation":
            b = np.where(np.sum(a * b, axis=-1, keepdims=True) < 0.0, -b, b)
        if b.shape != a.shape:
            continue
        off = factor * np.abs(a - b)
        if "body" in variable.dims:
            off = _filled(off, variable.dims.index("body"))
        values[name] = np.nan_to_num(off, nan=0.0, posinf=np.inf)
    return ElementErrors(result.time[first], values)


def _matched(b: Array, dims: tuple[str, ...], result: Readable, other: Readable) -> Array:
    """The numbers of `other` in the places that their names have in `result`; not a number where it has none."""
    for axis, dim in enumerate(dims[1:], 1):
        names, others = result.coordinates[dim], other.coordinates.get(dim, ())
        if names == others:
            continue
        place = {name: k for k, name in enumerate(others)}
        known = np.array([place.get(name, -1) for name in names], dtype=int)
        if len(others) == 0:
            return np.full((*b.shape[:axis], len(names)), np.nan)
        b = np.take(b, np.maximum(known, 0), axis=axis)
        gone = [slice(None)] * b.ndim
        gone[axis] = np.flatnonzero(known < 0)  # type: ignore[call-overload]
        b[tuple(gone)] = np.nan
    return b


def _filled(off: Array, axis: int) -> Array:
    """Nodes that the other machine does not have are off as the larger of those beside them."""
    moved = np.moveaxis(off, axis, 0)
    lacking = np.isnan(moved).reshape(len(moved), -1).all(axis=1)
    known = np.flatnonzero(~lacking)
    if not lacking.any() or not len(known):
        return off
    for k in np.flatnonzero(lacking):
        place = int(np.searchsorted(known, k))
        beside = [known[max(place - 1, 0)], known[min(place, len(known) - 1)]]
        moved[k] = np.maximum(moved[beside[0]], moved[beside[1]])
    return np.moveaxis(moved, 0, axis)


def with_elements(estimate: Estimate | None, errors: ElementErrors) -> Estimate:
    """The estimated errors of a run, and those that its elements add; they are known as far as both are."""
    running = {name: np.maximum.accumulate(each, axis=0) for name, each in errors.values.items()}
    mean = {name: np.mean(each, axis=0) for name, each in errors.values.items()}
    if estimate is None:
        ends = np.unique(np.linspace(0, len(errors.time) - 1, min(50, len(errors.time))).round().astype(int))
        return Estimate(errors.time[ends], {name: each[ends] for name, each in running.items()}, mean)
    time = estimate.time[estimate.time <= errors.time[-1] * (1.0 + 1e-9)]
    place = np.minimum(np.searchsorted(errors.time, time * (1.0 - 1e-12)), len(errors.time) - 1)
    values = {name: each[: len(time)] for name, each in estimate.values.items()}
    for name, each in running.items():
        if name in values and values[name].shape[1:] == each.shape[1:]:
            values[name] = values[name] + each[place]
    both = {
        name: each + mean[name] if name in running and mean[name].shape == each.shape else each
        for name, each in estimate.mean.items()
    }
    return Estimate(time, values, both)


def errors_along_path(result: Readable, other: Readable, factor: float) -> ElementErrors | None:
    """Errors of places against the nearest state of a path whose states have other times: states count by places over the size and time
    over the duration."""
    # here, as runs of rigid bodies need no SciPy
    names, others = result.coordinates["body"], other.coordinates["body"]
    both = [k for k, name in enumerate(names) if name in others]
    if len(other.time) < 4 or not both:
        return None
    size, span = machine_size(result)[0], float(np.ptp(result.time)) or 1.0
    place = other.array("position")[:, [others.index(names[k]) for k in both]].reshape(len(other.time), -1) / size
    curve = np.column_stack([place, other.time / span])
    along = other.array("path")
    rising = np.concatenate([[True], np.diff(along) > 0.0])
    spline = scipy.interpolate.CubicSpline(along[rising], curve[rising])
    steps = np.arange(IN_A_STEP * (int(rising.sum()) - 1) + 1) / IN_A_STEP
    dense = spline(np.interp(steps, np.arange(int(rising.sum())), along[rising]))
    own = result.array("position")[:, both].reshape(len(result.time), -1) / size
    off = np.full((len(result.time), len(names), 3), np.nan)
    for k, point in enumerate(np.column_stack([own, result.time / span])):
        nearest = _nearest(dense, point)
        off[k, both] = np.abs(nearest[:-1] - point[:-1]).reshape(-1, 3) * size * factor
    return ElementErrors(result.time, {"position": _filled(off, 1)})


def _nearest(curve: Array, point: Array) -> Array:
    """The point of a polygon (n, d) that is nearest to one (d,)."""
    step = np.diff(curve, axis=0)
    square = np.maximum(np.einsum("ij,ij->i", step, step), 1e-300)
    share = np.clip(np.einsum("ij,ij->i", point - curve[:-1], step) / square, 0.0, 1.0)
    found = curve[:-1] + share[:, None] * step
    return found[int(np.argmin(np.linalg.norm(found - point, axis=1)))]


class Stiffness(Struct):
    """The lowest squares of vibrations [1/s²], as drawn and in the last state."""

    drawn: float
    last: float


class Compared(Struct, kw_only=True):
    """A machine with other elements and its result as far as it came; None where it has no frame. why : it did not come to its end.

    errors : what follows for the numbers of the machine itself. Of equilibria: drawn : places (3,) [m] of bodies before they are loaded;
    unique : joints whose reactions are; own, its : the lowest stiffness of both; by_arc : the states of both have times of their own.
    """

    pair: Pair
    result: Result | None
    errors: ElementErrors | None
    why: str = ""
    drawn: Mapping[str, Array] | None = None
    unique: tuple[str, ...] = ()
    own: Stiffness | None = None
    its: Stiffness | None = None
    by_arc: bool = False
