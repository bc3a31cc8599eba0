"""Variants whose numbers are patched: a machine is prepared once, and what follows from its parameters is put into its memory.

How numbers follow from the parameters is found by preparing a few variants, and checked with others: a constant and powers of one
parameter each (masses, stiffnesses, loads, coefficients). What moves the start of a machine, changes its structure, or depends on two
parameters together is left to those who prepare every variant.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from time import thread_time
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.plan import Plan, plan_run
from nivel.analysis.preparation.one_piece import in_one_piece
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.preparation.shared_loads import SharedLoads, are_open
from nivel.analysis.run.attempt import header_of
from nivel.analysis.run.bound_entry import BoundEntry
from nivel.analysis.run.dynamics import Loop, start_loop, taken_events
from nivel.analysis.run.preparation import prepare
from nivel.analysis.sweep.facts import other_fact
from nivel.analysis.sweep.formulas import WORKSPACE, Array, fit_all, named_arrays
from nivel.errors import NivelError
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.run import BUDGET, DONE_STEPS, FRAMES, STOPPED, Run
from nivel.kernels.core.block import Handle
from nivel.kernels.core.status import BUDGET_SPENT, DONE
from nivel.machine.units.quantity import ANY, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.model import Model
from nivel.results.frames.contents import MemoryContents
from nivel.results.result import Result
from nivel.words.wording import seconds

# places between the least and the greatest value of a parameter at which machines are prepared
SHARES: Final = (0.0, 1.0, 0.35, 0.7)
# numbers that are patched agree with those of variants that were prepared to this share of the largest of their kind
AGREES: Final = 1e-11
# constants of this share of the nominal number are those of finding the factors
ROUND_OFF: Final = 1e-13
# variants that are prepared to check all formulas together
CHECKED: Final = 3
SEED: Final = 4
# bytes of frames of one run, at most
MOST_BYTES: Final = 256_000_000
BUDGET_OF_ALL: Final = 2**60
WATCHED: Final = 2000  # steps between two looks at the time


class UnsuitedError(Exception):
    """Why variants cannot be patched, in words."""


class TooLongError(Exception):
    """A run takes longer than its limit [s]."""

    def __init__(self, limit: float) -> None:
        super().__init__(f"it took longer than the time limit of {seconds(limit)}")


@dataclass(frozen=True)
class Blank:
    """A machine ready to run from its start again and again: memory of its records and of its run, each in one piece.

    judged : its runs have trust reports, which also look at the equations in absolute coordinates.
    """

    plan: Plan
    prepared: Prepared
    loop: Loop
    pieces: tuple[NDArray[np.uint8], NDArray[np.uint8]]
    judged: bool = False

    @property
    def run(self) -> Run:
        return self.loop.history.record

    def records(self) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Records of each piece, as far as runs look at them."""
        absolute = (self.prepared.absolute.system.record,) if self.judged else ()
        return (self.prepared.motion.system.record, *absolute), (self.run,)

    def addresses(self) -> list[Any]:
        """What is no number: machine code that it calls."""
        return [
            array.tolist() for _, array in named_arrays(self.prepared.motion.system.record) if array.dtype == np.uint64
        ]


def blank(machine: Model, *, judged: bool = False) -> Blank:
    """Raises UnsuitedError where the run of the machine cannot be begun again in place, ModelError as preparing does."""
    plan = plan_run(machine.record, machine.origin.settings_outside)
    return blank_of(plan, prepare(plan.methods), judged=judged)


def blank_of(plan: Plan, prepared: Prepared, *, judged: bool = False) -> Blank:
    """The same of a machine that is prepared."""
    system = prepared.motion.system
    prepared, piece = prepared.in_one_piece()
    if piece is None or system.units:
        raise UnsuitedError("its integrator or a block of its control keeps memory of its own")
    rows = int(plan.settings.frames) + 2
    if rows * system.layout.width * 8 > MOST_BYTES:
        raise UnsuitedError("it has too many frames")
    loop = start_loop(prepared, plan.settings)
    if len(loop.history.record.ends):
        raise UnsuitedError("its steps are looked at one by one")
    own, run_piece = in_one_piece(loop.history.record._replace(frames=np.zeros((0, 0))))
    frames = np.zeros((rows, system.layout.width))
    loop = loop._replace(history=Handle(own._replace(frames=frames)))
    return Blank(plan, prepared, loop, (piece, run_piece), judged)


@dataclass(frozen=True)
class _Patch:
    """Numbers of one piece that follow from the parameters: words of the piece, and constants (n,) and factors (n, m) of the powers."""

    words: NDArray[np.intp]
    constants: Array
    factors: Array


@dataclass(frozen=True)
class Patches:
    """How the memory of a machine follows from its parameters.

    paths : of the parameters; terms : (parameter, power) of each column of the factors; start : both pieces at the start of the nominal
    machine.
    """

    paths: tuple[str, ...]
    base: Model
    blank: Blank
    terms: tuple[tuple[int, float], ...]
    patches: tuple[_Patch, _Patch]
    start: tuple[NDArray[np.uint8], NDArray[np.uint8]]

    def prepared(self, x: Array) -> Blank:
        """The variant with parameters x, prepared."""
        return _prepared(self.base, self.paths, x, judged=self.blank.judged)

    def put(self, pieces: tuple[NDArray[np.uint8], ...], x: Array) -> None:
        """The memory of the variant with parameters x at its start, into `pieces`."""
        powers = np.array([x[k] ** power for k, power in self.terms])
        for piece, start, patch in zip(pieces, self.start, self.patches, strict=True):
            piece[:] = start
            piece.view(np.float64)[patch.words] = patch.constants + patch.factors @ powers


def _prepared(base: Model, paths: tuple[str, ...], x: Array, *, judged: bool) -> Blank:
    return blank(base.with_values(dict(zip(paths, map(float, x), strict=True))), judged=judged)


def read_values(values: Mapping[str, Any]) -> Array:
    """Parameters of a variant in SI units. Raises UnsuitedError where one is no plain quantity."""
    try:
        return np.array([read_quantity(value, ANY, {}) for value in values.values()])
    except (ExpressionError, TypeError, ValueError):
        raise UnsuitedError("a value is no quantity") from None


def sampled(rows: Sequence[Mapping[str, Any]]) -> tuple[Mapping[str, Any], ...]:
    """Those of the variants from which `learn` finds the same bounds, and some more; none where a value is no quantity."""
    try:
        xs = np.array([read_values(row) for row in rows])
    except UnsuitedError:
        return ()
    some = np.random.default_rng(SEED).choice(len(xs), min(CHECKED, len(xs)), replace=False)
    return tuple(rows[k] for k in sorted({*xs.argmin(axis=0).tolist(), *xs.argmax(axis=0).tolist(), *some.tolist()}))


def learn(base: Model, rows: Sequence[Mapping[str, Any]], *, judged: bool = False) -> Patches:
    """Formulas for these variants and all between them. judged : for runs with trust reports, see `JudgedRuns`.

    Raises UnsuitedError where the numbers follow none.
    """
    paths = tuple(rows[0])
    if any(path.partition(".")[0].strip() in ("simulation", "assembly", "include", "assemblies") for path in paths):
        raise UnsuitedError("a setting varies")
    xs = np.array([read_values(row) for row in rows])
    low, high = xs.min(axis=0), xs.max(axis=0)
    nominal = 0.5 * (low + high)
    try:
        return _learned(base, paths, xs, (low, nominal, high), judged=judged)
    except NivelError as error:
        raise UnsuitedError(f"a variant cannot be prepared: {error}") from None


def _learned(
    base: Model, paths: tuple[str, ...], xs: Array, box: tuple[Array, Array, Array], *, judged: bool
) -> Patches:
    low, nominal, high = box

    def prepared(x: Array) -> Blank:
        return _prepared(base, paths, x, judged=judged)

    first = prepared(nominal)
    start = tuple(piece.copy() for piece in first.pieces)
    kinds = tuple(_Kinds.of(records, piece) for records, piece in zip(first.records(), first.pieces, strict=True))
    found: list[tuple[int, int, int, tuple[tuple[float, float], ...]]] = []  # piece, word, parameter, terms
    for k in np.flatnonzero(high > low):
        points = [low[k] + share * (high[k] - low[k]) for share in SHARES]
        others = [prepared(np.where(np.arange(len(paths)) == k, point, nominal)) for point in points]
        values = np.array([nominal[k], *points])
        for p in (0, 1):
            pieces = [_alike(first, other, p, kinds[p]) for other in others]
            words = np.array([start[p].view(np.float64), *(piece.view(np.float64) for piece in pieces)])
            changed = np.flatnonzero(((words != words[0]) & ~np.isnan(words)).any(axis=0) & kinds[p].is_number)
            fits, terms = fit_all(values, words[:, changed])
            if (left := changed[~fits & ~kinds[p].is_work[changed]]).size:
                raise UnsuitedError(f"`{kinds[p].name_of(int(left[0]))}` follows no formula of `{paths[k]}`")
            found += [(p, int(word), int(k), each) for word, ok, each in zip(changed, fits, terms, strict=True) if ok]
    out = _collected(base, paths, first, start, nominal, found)
    _check(out, xs)
    return out


def _collected(
    base: Model,
    paths: tuple[str, ...],
    first: Blank,
    start: tuple[NDArray[np.uint8], ...],
    nominal: Array,
    found: Sequence[tuple[int, int, int, tuple[tuple[float, float], ...]]],
) -> Patches:
    terms = tuple(dict.fromkeys((k, power) for _, _, k, each in found for _, power in each))
    column, patches = {term: n for n, term in enumerate(terms)}, []
    powers = np.array([nominal[k] ** power for k, power in terms])
    for p in (0, 1):
        words = sorted({word for piece, word, _, _ in found if piece == p})
        row, factors = {word: n for n, word in enumerate(words)}, np.zeros((len(words), len(terms)))
        for piece, word, k, each in found:
            for factor, power in each if piece == p else ():
                factors[row[word], column[k, power]] += factor
        places = np.array(words, dtype=np.intp)
        values = start[p].view(np.float64)[places]
        constants = values - factors @ powers
        # numbers that follow powers alone are exact to their own size at both ends of wide ranges
        constants[np.abs(constants) <= ROUND_OFF * np.abs(values)] = 0.0
        patches.append(_Patch(places, constants, factors))
    return Patches(paths, base, first, terms, (patches[0], patches[1]), (start[0], start[1]))


@dataclass(frozen=True)
class _Kinds:
    """What the words of a piece are: numbers, and which of them each evaluation computes again. spans : of the arrays, in words."""

    is_number: NDArray[np.bool_]
    is_work: NDArray[np.bool_]
    spans: tuple[tuple[str, int, int], ...]

    @classmethod
    def of(cls, records: Sequence[Any], piece: NDArray[np.uint8]) -> _Kinds:
        count = len(piece) // 8
        is_number, is_work, spans = np.zeros(count, dtype=bool), np.zeros(count, dtype=bool), []
        # what no array of the record is has no part in a run
        is_work[:] = True
        for record, name, array in ((its, *each) for its in records for each in named_arrays(its)):
            first = array.ctypes.data - piece.ctypes.data
            if not array.size or not 0 <= first < len(piece):
                continue
            words = slice(first // 8, (first + array.nbytes + 7) // 8)
            is_number[words] = array.dtype == np.float64
            is_work[words] = name.startswith(WORKSPACE)
            spans.append((name, words.start, words.stop))
            if name == "functions.arguments":
                is_work[words.start + record.functions.argument[:, 3].astype(int)] = True
        return cls(is_number, is_work, tuple(spans))

    def name_of(self, word: int) -> str:
        return next((name for name, first, end in self.spans if first <= word < end), "a number")


def _alike(first: Blank, other: Blank, p: int, kinds: _Kinds) -> NDArray[np.uint8]:
    """A piece of a machine with the same structure. Raises UnsuitedError where it has another one."""
    mine, piece = first.pieces[p], other.pieces[p]
    same = (
        first.plan.settings == other.plan.settings
        and first.prepared.path == other.prepared.path
        and len(mine) == len(piece)
        and first.addresses() == other.addresses()
    )
    if not same:
        raise UnsuitedError("its structure or its method varies")
    if first.judged and (fact := other_fact(first.prepared, other.prepared)):
        raise UnsuitedError(f"`{fact}` varies")
    whole = mine.view(np.int64) != piece.view(np.int64)
    if (whole & ~kinds.is_number & ~kinds.is_work).any():
        raise UnsuitedError("whole numbers vary")
    return piece


def _check(found: Patches, xs: Array) -> None:
    """Compare some of the variants with ones that are prepared. Raises UnsuitedError where they differ."""
    rows = np.random.default_rng(SEED).choice(len(xs), min(CHECKED, len(xs)), replace=False)
    for x in xs[rows]:
        if names := differences(found, x):
            raise UnsuitedError(f"`{names[0]}` depends on several parameters together")


def _close(a: Array, b: Array) -> bool:
    """Whether numbers of an array agree, those that are infinite or none too."""
    finite = np.isfinite(b)
    if not np.array_equal(a[~finite], b[~finite], equal_nan=True):
        return False
    size = AGREES * np.abs(b[finite]).max(initial=0.0)
    return bool((np.abs(a[finite] - b[finite]) <= size).all())


def differences(found: Patches, x: Array) -> list[str]:
    """Arrays in which a patched variant differs from one that is prepared, but those that each evaluation computes again.

    Raises UnsuitedError where the latter has another structure, ModelError where it cannot be prepared.
    """
    other = found.prepared(x)
    mine, out = tuple(np.empty_like(piece) for piece in found.start), []
    found.put(mine, x)
    for p, records in enumerate(found.blank.records()):
        kinds = _Kinds.of(records, found.blank.pieces[p])
        a, b = mine[p].view(np.float64), _alike(found.blank, other, p, kinds).view(np.float64)
        for name, first, end in kinds.spans:
            span = np.arange(first, end)
            span = span[kinds.is_number[span] & ~kinds.is_work[span]]
            if not _close(a[span], b[span]):
                out.append(name)
    return out


class PatchedRuns:
    """Runs of variants in memory of their own, one after the other; several of these go beside each other."""

    def __init__(self, found: Patches) -> None:
        again = found.blank.prepared.again()
        if again is None:
            raise UnsuitedError("its records cannot be copied")
        self._found, self._blank = found, blank_of(found.blank.plan, again)
        if any(len(a) != len(b) for a, b in zip(self._blank.pieces, found.start, strict=True)):
            raise UnsuitedError("its memory is laid out otherwise")
        self._advance = BoundEntry(advance, self._blank.loop.addresses, keep=self._blank.loop)
        plan, prepared = found.blank.plan, self._blank.prepared
        self._header = header_of(plan, prepared, "")
        self.loop_seconds = 0.0
        self._shares = are_open(prepared)

    def run(self, x: Array, limit: float | None = None) -> Array | None:
        """Frames (n, width) of the variant with parameters x, valid until the next run; None where it did not come to its end as it
        should, so that it has to be prepared to find out why. Raises TooLongError where it takes longer than `limit` [s]."""
        self._found.put(self._blank.pieces, x)
        run = self._blank.run
        begin, status = thread_time(), BUDGET_SPENT
        while status == BUDGET_SPENT:
            run.counter[BUDGET] = BUDGET_OF_ALL if limit is None else WATCHED
            status = self._advance()
            self.loop_seconds = thread_time() - begin
            if limit is not None and status == BUDGET_SPENT and self.loop_seconds > limit:
                raise TooLongError(limit)
        if status != DONE:
            return None
        frames = run.frames[: run.counter[FRAMES]]
        loads = SharedLoads.of(self._blank.prepared, keeps_sparse=False) if self._shares else None
        if loads is not None:
            loads.share(frames)
        return frames

    @property
    def stopped_by(self) -> str:
        """The event that ended the last run."""
        number = self._blank.run.counter[STOPPED]
        return self._blank.prepared.motion.system.events[number - 1] if number else ""

    @property
    def steps(self) -> int:
        """Steps of the last run."""
        return int(self._blank.run.counter[DONE_STEPS])

    def events(self) -> list[Any]:
        """The events of the last run."""
        return taken_events(self._blank.run, self._blank.prepared.motion.system.events)

    def result(self, frames: Array) -> Result:
        """Frames with their names. Facts beside the frames are those of the nominal machine."""
        return Result(MemoryContents(self._header, frames, dict(self._header.attributes)))
