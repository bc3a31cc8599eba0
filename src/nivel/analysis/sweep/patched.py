"""Variants whose numbers are patched: a machine is prepared once, and what follows from its parameters is put into its memory.

How numbers follow from the parameters is found by preparing a few variants, and checked with others. What moves the start of a machine,
changes its structure, or depends on two parameters together is left to those who prepare every variant.
"""

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from time import thread_time
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.plan import Plan, plan_run
from nivel.analysis.preparation.memory import Array, MachineMemory, UnlikeError, in_one_piece
from nivel.analysis.preparation.parameters import EQUAL, Numbers, Unfit, UnfitError, numbers_of
from nivel.analysis.preparation.preparation import Prepared, SharedLoads, are_open
from nivel.analysis.run.attempt import header_of
from nivel.analysis.run.dynamics import Loop, march, start_loop
from nivel.analysis.run.history import refer_energies
from nivel.analysis.run.prepared_state import BoundEntry, prepare
from nivel.errors import NivelError
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.run import BUDGET, FRAMES, STOPPED, Run
from nivel.kernels.core.block import Handle
from nivel.kernels.core.status import BUDGET_SPENT, DONE
from nivel.lazy import Struct, fields, is_dataclass, replace
from nivel.machine.units.quantity import ANY, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.model import Model
from nivel.results.frames.contents import MemoryContents
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.words.wording import seconds

# values at which machines are prepared, as shares from the least to the greatest value of a parameter: beside its bounds, where what is
# multiplied by nothing may be missing, and away from round numbers, which others may be equal to
SHARES: Final = np.array([0.0031, 0.9967, 0.3523, 0.7109])
NOMINAL: Final = 0.4873
# so many variants are worth the ones that are prepared to find formulas
WORTH_FORMULAS: Final = 24
# variants that are prepared to check all functions together
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


def watch(limit: float | None) -> Callable[[float], None]:
    """What raises TooLongError where this thread has computed for longer than `limit` [s] since now; None: never."""
    begin = thread_time()

    def look(_: float) -> None:
        if limit is not None and thread_time() - begin > limit:
            raise TooLongError(limit)

    return look


class Blank(Struct):
    """A machine ready to run from its start again and again: memory of its records and of its run, each in one piece.

    judged : its runs have trust reports, which also look at the equations in absolute coordinates, as loads do that joints share.
    """

    plan: Plan
    prepared: Prepared
    loop: Loop
    pieces: tuple[NDArray[np.uint8], NDArray[np.uint8]]
    judged: bool = False

    @property
    def run(self) -> Run:
        return self.loop.history.record

    @property
    def memory(self) -> MachineMemory:
        """Its numbers, as far as runs look at them."""
        needs_absolute = self.judged or are_open(self.prepared)
        absolute = (self.prepared.absolute.system.record,) if needs_absolute else ()
        return MachineMemory(self.prepared.motion.system.record, *absolute, self.run)


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
    own, run_piece = in_one_piece(loop.history.record._replace(frames=np.zeros((0, 0))))
    frames = np.zeros((rows, system.layout.width))
    loop = loop._replace(history=Handle(own._replace(frames=frames)))
    return Blank(plan, prepared, loop, (piece, run_piece), judged)


class Patch(NamedTuple):
    """Numbers of one piece that follow from the parameters, and their words in it."""

    words: NDArray[np.intp]
    numbers: Numbers


class Patches(Struct):
    """How the memory of a machine follows from its parameters.

    paths : of the parameters; varied : those of them that are not the same in all variants. start : both pieces at the start of the nominal
    machine. apart : parameters by number with values for which the machine is refused, or has another structure.
    """

    paths: tuple[str, ...]
    varied: NDArray[np.intp]
    base: Model
    blank: Blank
    patches: tuple[Patch, Patch]
    start: tuple[NDArray[np.uint8], NDArray[np.uint8]]
    apart: frozenset[tuple[int, float]] = frozenset()

    def has(self, x: Array) -> bool:
        """Whether the variant with parameters x has the structure of the machine."""
        return self.apart.isdisjoint(enumerate(x.tolist()))

    def put(self, pieces: tuple[NDArray[np.uint8], ...], x: Array) -> None:
        """The memory of the variant with parameters x at its start, into `pieces`."""
        for piece, start, patch in zip(pieces, self.start, self.patches, strict=True):
            piece[:] = start
            piece.view(np.float64)[patch.words] = patch.numbers.at(x[self.varied])


def _prepared(base: Model, values: Mapping[str, float], *, judged: bool) -> Blank:
    return blank(base.with_values(values), judged=judged)


def read_values(values: Mapping[str, Any]) -> Array:
    """Parameters of a variant in SI units. Raises UnsuitedError where one is no plain quantity."""
    try:
        return np.array([read_quantity(value, ANY, {}) for value in values.values()])
    except (ExpressionError, TypeError, ValueError):
        raise UnsuitedError("a value is no quantity") from None


def sample_of(rows: Sequence[Mapping[str, Any]]) -> tuple[Mapping[str, Any], ...]:
    """Those of the variants from which `learn` finds the same bounds, and some more; none where they are few, or a value is no quantity."""
    if len(rows) < WORTH_FORMULAS:
        return ()
    try:
        xs = np.array([read_values(row) for row in rows])
    except UnsuitedError:
        return ()
    some = np.random.default_rng(SEED).choice(len(xs), min(CHECKED, len(xs)), replace=False)
    return tuple(rows[k] for k in sorted({*xs.argmin(axis=0).tolist(), *xs.argmax(axis=0).tolist(), *some.tolist()}))


def learn(base: Model, rows: Sequence[Mapping[str, Any]], *, judged: bool = False) -> Patches:
    """Numbers of these variants and all between them. judged : for runs with trust reports, see `JudgedRuns`.

    Raises UnsuitedError where they follow from the parameters by no laws.
    """
    paths = tuple(rows[0])
    if any(path.partition(".")[0].strip() in ("simulation", "assembly", "include", "assemblies") for path in paths):
        raise UnsuitedError("a setting varies")
    if deciding := [path for path in paths if base.decides(path)]:
        raise UnsuitedError(f"`{deciding[0]}` decides between pieces of an expression")
    xs = np.array([read_values(row) for row in rows])
    try:
        return _learned(base, paths, xs, judged=judged)
    except UnfitError as error:
        raise UnsuitedError(_why(error.args[0], [paths[k] for k in _varied(xs)])) from None
    except UnlikeError as error:
        raise UnsuitedError(f"`{error.name}` has whole numbers that vary") from None
    except NivelError as error:
        raise UnsuitedError(f"a variant cannot be prepared: {error}") from None


def _varied(xs: Array) -> NDArray[np.intp]:
    return np.flatnonzero(np.ptp(xs, axis=0) > 0.0)


def _why(unfit: Unfit, paths: Sequence[str]) -> str:
    match unfit.reason:
        case UnlikeError(kind="count"):
            return "its structure or its method varies"
        case UnlikeError():
            return "whole numbers vary"
        case str(name):
            return f"`{name}` follows no formula of `{paths[unfit.parameter]}`"
    return f"a variant cannot be prepared: {unfit.reason}"


def _learned(base: Model, paths: tuple[str, ...], xs: Array, *, judged: bool) -> Patches:
    varied, low, high = _varied(xs), xs.min(axis=0), xs.max(axis=0)
    nominal = low + NOMINAL * (high - low)
    first = _prepared(base, dict(zip(paths, nominal.tolist(), strict=True)), judged=judged)
    memory, places = first.memory, first.prepared.absolute.system.positions

    def memory_at(x: Array) -> MachineMemory:
        other = _prepared(base, dict(zip(paths, x.tolist(), strict=True)), judged=judged)
        if first.plan.settings != other.plan.settings or first.prepared.path != other.prepared.path:
            raise UnsuitedError("its structure or its method varies")
        if judged:
            if fact := _other(first.prepared, other.prepared, ""):
                raise UnsuitedError(f"`{fact}` varies")
        elif not _same(*(each.prepared.assembly.y[:places] for each in (first, other))):
            raise UnsuitedError("the places where its bodies are assembled vary")
        return other.memory

    def with_one(k: int, value: float) -> MachineMemory:
        return memory_at(np.where(np.arange(len(paths)) == varied[k], value, nominal))

    values = [[[(low[k] + SHARES * (high[k] - low[k])).tolist()]] for k in varied]
    numbers = numbers_of(memory, nominal[varied], values, with_one)
    start = tuple(piece.copy() for piece in first.pieces)
    addresses, patches = memory.addresses[numbers.places], []
    for piece in first.pieces:
        words = (addresses - piece.ctypes.data) // 8
        chosen = (words >= 0) & (words < len(piece) // 8)
        patches.append(Patch(words[chosen], numbers.among(chosen)))
    out = Patches(paths, varied, base, first, (patches[0], patches[1]), (start[0], start[1]))

    def is_apart(k: int, value: float) -> bool:
        """A machine may be refused at a bound, and lack what zero multiplies."""
        x = np.where(np.arange(len(paths)) == k, value, nominal)
        try:
            if value == 0.0:
                return bool(_differences(out, x, memory_at(x)))
            base.with_values(dict(zip(paths, x.tolist(), strict=True)))
        except (UnsuitedError, UnlikeError, NivelError):
            return True
        return False

    asked = {(int(k), float(value)) for k in varied for value in (low[k], high[k], 0.0) if low[k] <= value <= high[k]}
    out = replace(out, apart=frozenset(each for each in asked if is_apart(*each)))
    whole = np.array([x for x in xs if out.has(x)])
    for x in np.random.default_rng(SEED).permutation(whole)[:CHECKED]:
        if names := _differences(out, x, memory_at(x)):
            raise UnsuitedError(f"`{names[0]}` depends on several parameters together")
    return out


def differences(found: Patches, x: Array) -> list[str]:
    """Arrays in which a patched variant differs from one that is prepared, but those that each evaluation computes again.

    Raises UnlikeError where the latter has another structure, ModelError where it cannot be prepared.
    """
    values = dict(zip(found.paths, x.tolist(), strict=True))
    return _differences(found, x, _prepared(found.base, values, judged=found.blank.judged).memory)


def _differences(found: Patches, x: Array, other: MachineMemory) -> list[str]:
    memory, pieces = found.blank.memory, found.blank.pieces
    found.put(pieces, x)
    numbers = memory.numbers
    for piece, start in zip(pieces, found.start, strict=True):
        piece[:] = start
    return memory.differences(numbers, other)


class PatchedRuns:
    """Runs of variants in memory of their own, one after the other; several of these go beside each other."""

    def __init__(self, found: Patches) -> None:
        """Raises UnsuitedError where the memory cannot be copied."""
        again = found.blank.prepared.again()
        if again is None:
            raise UnsuitedError("its records cannot be copied")
        self.found, self.blank = found, blank_of(found.blank.plan, again, judged=found.blank.judged)
        if any(len(a) != len(b) for a, b in zip(self.blank.pieces, found.start, strict=True)):
            raise UnsuitedError("its memory is laid out otherwise")
        self._advance = BoundEntry(advance, self.blank.loop.addresses, keep=self.blank.loop)
        self._header = header_of(found.blank.plan, self.blank.prepared, "")
        # names of columns are made once
        self._contents = MemoryContents(self._header, self.blank.run.frames[:0], dict(self._header.attributes))
        self.loop_seconds = 0.0
        prepared = self.blank.prepared
        self.shares = are_open(prepared) and bool(prepared.redundancy.redundant_rows)

    def run(self, x: Array, limit: float | None = None) -> Array | None:
        """Frames (n, width) of the variant with parameters x, valid until the next run; None where it did not come to its end as it
        should, so that it has to be prepared to find out why. Raises TooLongError where it takes longer than `limit` [s]."""
        if not self.found.has(x):
            return None
        self.begin(x)
        run = self.blank.run
        frames = self._looked_at(x, limit) if len(run.ends) else self._advanced(run, limit)
        if frames is not None:
            self.share(frames)
        return frames

    def share(self, frames: Array) -> None:
        """Let redundant joints share their loads in frames of the variant whose memory this is."""
        loads = SharedLoads.of(self.blank.prepared, keeps_sparse=False) if self.shares else None
        if loads is not None:
            loads.share(frames)

    def begin(self, x: Array) -> None:
        """Put the memory of a variant at its start, as its first evaluation leaves it."""
        self.found.put(self.blank.pieces, x)
        refer_energies(self.blank.prepared, self.blank.run.y)

    def _advanced(self, run: Run, limit: float | None) -> Array | None:
        begin, look, status = thread_time(), watch(limit), BUDGET_SPENT
        while status == BUDGET_SPENT:
            run.counter[BUDGET] = BUDGET_OF_ALL if limit is None else WATCHED
            status = self._advance()
            self.loop_seconds = thread_time() - begin
            if status == BUDGET_SPENT:
                look(self.loop_seconds)
        return run.frames[: run.counter[FRAMES]] if status == DONE else None

    def _looked_at(self, x: Array, limit: float | None) -> Array | None:
        """The same where steps are looked at for narrow features of functions, which are those of the variant."""
        look, plan, prepared = watch(limit), self.blank.plan, self.blank.prepared
        machine = self.found.base.with_values(dict(zip(self.found.paths, x.tolist(), strict=True))).record
        sink = Memory(plan.settings.frames + 1)
        sink.begin(self._header)
        finished = march(
            replace(prepared, machine=machine), plan.settings, [sink], progress=look, loop=self.blank.loop, shared=False
        )
        self.loop_seconds = finished.timing["loop_seconds"]
        return sink.frames if finished.outcome == "done" else None

    @property
    def stopped_by(self) -> str:
        """The event that ended the last run."""
        number = self.blank.run.counter[STOPPED]
        return self.blank.prepared.motion.system.events[number - 1] if number else ""

    def result(self, frames: Array) -> Result:
        """Frames with their names. Facts beside the frames are those of the nominal machine."""
        contents = copy(self._contents)
        contents.frames, contents.frame_count = frames, len(frames)
        return Result(contents)


# what a variant has of its own: the memory, and the machine as it is written
OWN: Final = ("record", "machine", "beams", "kernels", "twin")


def _other(a: Any, b: Any, name: str) -> str:
    """The first fact in which two differ, as `assembly.y`; empty where they do so in their memory alone, and in how they are written."""
    if a is b:
        return ""
    if is_dataclass(a) and type(a) is type(b):
        own = (each.name for each in fields(a) if each.name not in OWN)
        return next(filter(None, (_other(getattr(a, each), getattr(b, each), f"{name}.{each}") for each in own)), "")
    return "" if _same(a, b) else name.removeprefix(".")


def _same(a: Any, b: Any) -> bool:
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        if a.dtype.kind != "f" or a.shape != b.shape:
            return bool(np.array_equal(a, b))
        size = np.abs(a[np.isfinite(a)]).max(initial=0.0)
        return bool(np.isclose(a, b, rtol=0.0, atol=EQUAL * size, equal_nan=True).all())
    if isinstance(a, Mapping):
        return a.keys() == b.keys() and all(_same(value, b[key]) for key, value in a.items())
    if isinstance(a, tuple | list):
        return len(a) == len(b) and all(map(_same, a, b))
    return not _other(a, b, "it") if is_dataclass(a) else bool(a == b)
