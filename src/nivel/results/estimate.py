"""Estimate of the error of every result variable from a second, finer run."""

import json
import re
from collections.abc import Mapping

import numpy as np

from nivel.lazy import Struct, field
from nivel.machine.core.vectors import Array
from nivel.results.frames.contents import shape_of
from nivel.results.motion import common_frames
from nivel.results.scales import Readable

ATTRIBUTE = "estimated_errors"
# Estimates are kept at so many times, at fewer of machines with more numbers than this.
TIMES, NUMBERS = 50, 200_000
# Errors are not smaller than this share of a value.
ROUND_OFF = 2.220446049250313e-16
NO_NUMBER = re.compile(r"-?inf|nan")


class Estimate(Struct):
    """Estimated errors of all numbers of a result up to some times.

    time : (k,) [s], rising; values : of each variable (k, …), the largest error up to that time. mean : of each variable (…), the mean
    of its errors; factor : what distances to the finer run are multiplied by; both are not kept in a file.
    """

    time: Array
    values: Mapping[str, Array]
    mean: Mapping[str, Array] = field(default_factory=dict)
    factor: float = 1.0

    def at(self, name: str, time: Array) -> Array:
        """Errors (n, …) of the variable `name` at times (n,) [s]; not a number after the last estimate."""
        place = np.searchsorted(self.time, time * (1.0 - 1e-12))
        known = np.minimum(place, len(self.time) - 1)
        out = self.values[name][known]
        out[place >= len(self.time)] = np.nan
        return out

    def to_json(self) -> str:
        """JSON text, three digits."""
        values = ",".join(f"{json.dumps(name)}:{_rounded(each)}" for name, each in self.values.items())
        return f'{{"time":{json.dumps(self.time.tolist())},"values":{{{values}}}}}'

    @classmethod
    def from_json(cls, text: str) -> "Estimate":
        """Read what `to_json` wrote."""
        data = json.loads(text)
        return cls(np.array(data["time"]), {name: np.array(each, dtype=float) for name, each in data["values"].items()})


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is no warning
def estimate_errors(result: Readable, finer: Readable, factor: float) -> Estimate | None:
    """Errors of `result` from its distance to a run with less of them; None where both have no frame at the same time.

    factor : what the distance is multiplied by. Euler parameters are taken with the sign of the others: θ and -θ are one orientation.
    """
    first, second = common_frames(result.time, finer.time)
    if not len(first):
        return None
    width = sum(int(np.prod(shape_of(each, result.coordinates))) for each in result.variables.values())
    count = int(np.clip(NUMBERS // max(width, 1), 1, min(TIMES, len(first))))
    ends = np.unique(np.linspace(0, len(first) - 1, count).round().astype(int))
    values, mean = {}, {}
    for name in result.variables:
        if name not in finer.variables:
            continue
        a, b = result.array(name)[first], finer.array(name)[second]
        if name == "orientation":
            b = np.where(np.sum(a * b, axis=-1, keepdims=True) < 0.0, -b, b)
        off = distances(a, b, factor)
        mean[name] = np.mean(off, axis=0)
        values[name] = np.maximum.accumulate(off, axis=0)[ends]
    return Estimate(result.time[first][ends], values, mean, factor)


def distances(a: Array, b: Array, factor: float) -> Array:
    """Errors of numbers a beside those of a finer run, b; never less than round-off."""
    return np.maximum(factor * np.abs(a - b), ROUND_OFF * np.abs(a))


def _rounded(values: Array) -> str:
    """JSON of nested lists of numbers with three digits; what is no number is null."""
    one = "%.3g"
    for length in reversed(values.shape):
        one = f"[{','.join([one] * length)}]"
    text = one % tuple(values.ravel().tolist())
    return text if np.isfinite(values).all() else NO_NUMBER.sub("null", text)
