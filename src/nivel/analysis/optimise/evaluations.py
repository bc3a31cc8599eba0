"""Evaluations of a machine's outputs over its parameters: with all that was computed kept, and slopes by differences."""

import json
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import field
from queue import SimpleQueue
from typing import Any, Final

import numpy as np
import xarray

from nivel.analysis.progress.journal import Journal, packed, unpacked
from nivel.analysis.sweep.outputs import Found
from nivel.analysis.sweep.variant_runs import AnalysedVariants, VariantRuns, formulas_for
from nivel.errors import Fault, ModelError, NivelError, SolveError, refuse
from nivel.lazy import Struct, nivel, scipy
from nivel.machine.core.vectors import Array
from nivel.machine.study.study_record import ANALYSES
from nivel.model import Model
from nivel.words.wording import shown, unknown_word

Reader = Callable[[Found], Array]
# parameters by path to outputs (m,) and exact slopes (m, d), from one run
Exact = Callable[[Mapping[str, float]], tuple[Array, Array]]

# differences are taken over this share of the range of a parameter
SHARE: Final = 1e-5
SAMPLED: Final = 6  # variants in the box for which formulas are looked for


class Box(Struct):
    """Parameters by path between bounds (d,) in SI units; start (d,) : where a search begins first."""

    paths: tuple[str, ...]
    low: Array
    high: Array
    start: Array

    def values(self, z: Array) -> dict[str, float]:
        """Parameters for z (d,) of the unit cube."""
        x = self.low + np.clip(z, 0.0, 1.0) * (self.high - self.low)
        return dict(zip(self.paths, map(float, x), strict=True))

    def scaled(self, x: Array) -> Array:
        """Places in the unit cube."""
        return np.asarray((x - self.low) / (self.high - self.low), dtype=np.float64)

    def starts(self, count: int, seed: int) -> Array:
        """(count, d) places in the unit cube: the start, then those of a Latin hypercube."""
        if count < 1:
            raise ModelError(Fault.at("starts", f"a number of starts of at least 1 was expected, got {count}"))
        first = self.scaled(self.start)[None]
        if count == 1:
            return first
        more = scipy.stats.qmc.LatinHypercube(len(self.paths), rng=np.random.default_rng(seed)).random(count - 1)
        return np.vstack([first, more])


def box_of(machine: Model, parameters: Mapping[str, Any]) -> Box:
    """parameters : (low, high) or (low, start, high) by path, numbers or texts with units. Raises ModelError with all that is wrong."""
    if not parameters:
        raise ModelError(Fault.at("parameters", "nothing varies: give bounds by path, {'bodies.rod.mass': (1, 3)}"))
    rows, faults = [], []
    for path, given in parameters.items():
        try:
            numbers = [_number(machine, path, each) for each in given]
        except ModelError as error:
            faults += error.faults
            continue
        except (TypeError, ValueError):
            numbers = []
        if len(numbers) not in (2, 3) or isinstance(given, str) or not numbers[0] < numbers[-1]:
            message = f"bounds were expected, (1, 3), or (1, 2, 3) with a start between them, the least first, got {shown(given)}"
            faults.append(Fault.at(path, message))
            continue
        low, high = numbers[0], numbers[-1]
        start = numbers[1] if len(numbers) == 3 else _present(machine, path, low, high)
        if not low <= start <= high:
            faults.append(Fault.at(path, f"a start between {low:g} and {high:g} was expected, got {start:g}"))
        rows.append((low, high, start))
    refuse(faults)
    low, high, start = np.array(rows).T
    return Box(tuple(parameters), low, high, start)


def _number(machine: Model, path: str, given: Any) -> float:
    """A bound in SI units; a text is read as what stands at the path, so that its unit has to fit."""
    return float(machine.with_values({path: given})[path] if isinstance(given, str) else given)


def _present(machine: Model, path: str, low: float, high: float) -> float:
    """The value that the machine has, where it is between the bounds; else halfway between them."""
    try:
        value = float(machine[path])
    except (ModelError, TypeError, ValueError):
        return 0.5 * (low + high)
    return value if low <= value <= high else 0.5 * (low + high)


class Computation(Struct):
    """What is computed of each variant. analysis : `run`, or one with its settings. threads : at once, of runs whose numbers are patched;
    None: as many as there are processors.
    time_limit [s] : of each run. exact : outputs with their slopes from one run; None: differences. journal : keeps every variant, and has
    those of an interrupted search, which are not computed again."""

    analysis: str = "run"
    settings: Mapping[str, Any] = field(default_factory=dict)
    threads: int | None = 1
    time_limit: float | None = None
    exact: Exact | None = None
    journal: Journal | None = None

    def __post_init__(self) -> None:
        """Refuse what goes with runs alone, or not with exact slopes. Raises ModelError."""
        if self.analysis not in ANALYSES:
            raise ModelError(Fault.at("analysis", unknown_word(self.analysis, ANALYSES, "analysis")))
        if self.exact is not None and self.time_limit is not None:
            raise ModelError(Fault.at("time_limit", "runs with exact slopes have no time limit: leave one out"))
        if self.analysis == "run" and self.settings:
            raise ModelError(Fault.at("analysis_settings", "settings of runs are given by their names, as duration=2"))
        if self.analysis != "run" and self.time_limit is not None:
            raise ModelError(Fault.at("time_limit", f"belongs to runs; `{self.analysis}` has none"))


class Evaluated(Struct):
    """One variant: place z (d,) in the unit cube, outputs (m,), not numbers where there are none, and how it ended."""

    z: Array
    outputs: Array
    outcome: str
    reason: str
    start: int


class UnreadError(Exception):
    """Some outputs of a run cannot be read, and why; outputs (m,) : the others, and not numbers."""

    def __init__(self, outputs: Array, reason: str) -> None:
        super().__init__(reason)
        self.outputs = outputs


class Evaluations:
    """Outputs (m,) of variants of a machine. made : all of them, in the order in which they were asked for."""

    def __init__(self, machine: Model, box: Box, read: Reader, count: int, of: Computation) -> None:
        """read : the outputs (count,) of a result; a variant of which it raises UnreadError has failed."""
        self.box, self._read, self._count, self._exact, self._journal = box, read, count, of.exact, of.journal
        finished = () if of.journal is None else of.journal.rows.values()
        self._finished = {unpacked(row["z"]).tobytes(): row for row in finished}
        self._slopes: dict[bytes, Array] = {}
        self.made: list[Evaluated] = []
        self._known: dict[bytes, Array] = {}
        self._runs: SimpleQueue[VariantRuns | AnalysedVariants] = SimpleQueue()
        self.start, self._threads = 0, 1
        if of.exact is not None:
            self.prepared_because = "slopes are exact"
            return
        if of.analysis != "run":
            self.prepared_because = f"`{of.analysis}` has no steps"
            self._runs.put(AnalysedVariants(machine, of.analysis, of.settings))
            return
        rng = np.random.default_rng(0)
        rows = [
            box.values(z) for z in (np.zeros(len(box.low)), np.ones(len(box.low)), *rng.random((SAMPLED, len(box.low))))
        ]
        patches, self.prepared_because = formulas_for(machine, rows)
        self._threads = (of.threads or nivel.native.workers.processors()) if patches is not None else 1
        for _ in range(self._threads):
            self._runs.put(VariantRuns(machine, patches, of.time_limit))

    def at(self, z: Array) -> Array:
        """(m,) at a place in the unit cube."""
        return self.each([z])[0]

    def each(self, places: Sequence[Array]) -> list[Array]:
        """Outputs at several places, computed beside each other."""
        new = [z for z in places if z.tobytes() not in self._known]
        if self._threads == 1 or len(new) == 1:
            made = [self._one(z) for z in new]
        else:
            with ThreadPoolExecutor(self._threads) as pool:
                made = list(pool.map(self._one, new))
        for each in made:
            self._known[each.z.tobytes()] = each.outputs
        self.made += made
        return [self._known[z.tobytes()] for z in places]

    def _one(self, z: Array) -> Evaluated:
        key = z.tobytes()
        if (row := self._finished.get(key)) is not None:
            if row["slopes"] is not None:
                self._slopes[key] = unpacked(row["slopes"])
            return Evaluated(z.copy(), unpacked(row["outputs"]), row["outcome"], row["reason"], self.start)
        made = self._run(z) if self._exact is None else self._with_slopes(z, self._exact)
        if self._journal is not None:
            slopes = self._slopes.get(key)
            numbers = {"z": packed(z), "outputs": packed(made.outputs), "outcome": made.outcome, "reason": made.reason}
            self._journal.add({**numbers, "slopes": None if slopes is None else packed(slopes)})
        return made

    def _with_slopes(self, z: Array, exact: Exact) -> Evaluated:
        """A run on dual numbers."""
        try:
            outputs, slopes = exact(self.box.values(z))
        except ModelError as error:
            return self._without(z, "refused", error)
        except NivelError as error:
            return self._without(z, "failed", error)
        self._slopes[z.tobytes()] = slopes * (self.box.high - self.box.low)
        return Evaluated(z.copy(), outputs, "done", "", self.start)

    def _without(self, z: Array, outcome: str, error: NivelError) -> Evaluated:
        self._slopes[z.tobytes()] = np.full((self._count, len(z)), np.nan)
        return Evaluated(z.copy(), np.full(self._count, np.nan), outcome, str(error), self.start)

    def _run(self, z: Array) -> Evaluated:
        runs = self._runs.get()
        try:
            ran = runs.run(self.box.values(z))
            if ran.outcome == "not run":
                raise KeyboardInterrupt
            outputs, outcome, reason = np.full(self._count, np.nan), ran.outcome, ran.reason
            if ran.result is not None and ran.outcome in ("done", "stopped"):
                outputs = self._read(ran.result)
        except UnreadError as error:
            outputs, outcome, reason = error.outputs, "failed", str(error)
        finally:
            self._runs.put(runs)
        return Evaluated(z.copy(), outputs, outcome, reason, self.start)

    def slopes(self, z: Array) -> Array:
        """(m, d) derivatives with respect to places in the unit cube: exact ones, or differences to the side where there is room."""
        if self._exact is not None:
            self.at(z)
            return self._slopes[z.tobytes()]
        d = len(z)
        steps = np.full(d, SHARE)
        places = []
        for k in range(d):
            for side in _sides(z[k], SHARE):
                place = z.copy()
                place[k] += side * steps[k]
                places.append(place)
        found = self.each([z, *places])
        middle, ends = found[0], found[1:]
        columns = []
        for k in range(d):
            a, b = _sides(z[k], SHARE)
            columns.append(_difference(middle, ends[2 * k], ends[2 * k + 1], a, b, steps[k]))
        return np.array(columns).T


def _sides(z: float, share: float) -> tuple[float, float]:
    """Multiples of the step to which differences go: both sides, or two to one where a bound is near."""
    if z + share > 1.0:
        return -1.0, -2.0
    return (1.0, 2.0) if z - share < 0.0 else (1.0, -1.0)


def _difference(middle: Array, first: Array, second: Array, a: float, b: float, step: float) -> Array:
    """Slope of the parabola through three places, 0, a and b steps away."""
    return np.asarray(
        (b * b * (first - middle) - a * a * (second - middle)) / (a * b * (b - a) * step), dtype=np.float64
    )


FAILURES = ("failed", "timed out")


class NothingFoundError(ModelError):
    """No start has what is asked for, though runs came to their end; `result` is the table of all variants."""

    def __init__(self, fault: Fault, result: xarray.Dataset) -> None:
        super().__init__(fault)
        self.result = result


def table_of(evaluations: Evaluations, names: Sequence[str], attributes: Mapping[str, Any]) -> xarray.Dataset:
    """All variants that were computed, along the dimension `variant`, as those of a study. names : of the outputs."""
    made, box = evaluations.made, evaluations.box
    x = np.array([[*box.values(each.z).values()] for each in made]).reshape(len(made), len(box.paths))
    coords = {path: ("variant", x[:, k], {"long_name": f"value of {path}"}) for k, path in enumerate(box.paths)}
    data: dict[str, Any] = {
        "outcome": ("variant", np.array([each.outcome for each in made], dtype=str)),
        "reason": ("variant", np.array([each.reason for each in made], dtype=str)),
        "start": ("variant", np.array([each.start for each in made]), {"long_name": "number of the start"}),
    }
    for k, name in enumerate(names):
        data[name] = ("variant", np.array([each.outputs[k] for each in made]))
    counted = Counter(each.outcome for each in made)
    about = {
        "prepared_because": evaluations.prepared_because,
        "outcomes": ", ".join(f"{count} {outcome}" for outcome, count in counted.items()),
        "parameters": json.dumps(list(box.paths)),
        "outputs": json.dumps(list(names)),
        "bounds": json.dumps({path: [low, high] for path, low, high in zip(box.paths, box.low, box.high, strict=True)}),
    }
    return xarray.Dataset(data, coords=coords, attrs={**about, **attributes})


def nothing_found(made: Sequence[Evaluated], fault: Fault, otherwise: str, table: xarray.Dataset) -> NivelError:
    """Why no start has outputs: SolveError where runs fail, else NothingFoundError, with the table of all variants as its `result`.

    otherwise : the reason where variants tell none.
    """
    reasons = sorted({each.reason for each in made if each.reason})
    text = f"{fault.message}: {reasons[0] if reasons else otherwise}"
    if any(each.outcome in FAILURES for each in made):
        return SolveError(f"{fault.path}: {text}", time=0.0, result=table)
    return NothingFoundError(Fault.at(fault.path, text), table)
