"""Parameters of an FMU: how the numbers of a machine's image follow from them, found by preparing the machine with other values.

A parameter is offered where every number that it changes is a sum of a constant and one or two powers of it: masses, inertias, stiffnesses,
limits and the like. What moves the start of the machine would need an assembly, which is done in Python; it is refused with its name.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.sweep.formulas import WORKSPACE, fit
from nivel.analysis.sweep.formulas import named_arrays as arrays_of
from nivel.c_library.exported import Exported, refusal
from nivel.c_library.image import WORD
from nivel.errors import Fault, ModelError
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.run import BUDGET, EVENTS, FRAMES
from nivel.kernels.core.arrays import lanes_of
from nivel.kernels.core.status import BUDGET_SPENT

Vary = Callable[[Mapping[str, float]], Exported]

# values that a parameter takes, as shares of its default, until the machine accepts all of a row
SHARES = ((1.25, 0.8, 1.1), (0.8, 0.9, 0.95), (1.02, 0.98, 1.01))
ABOUT_ZERO = (1.0, -1.0, 0.5)
# share of the scale of a state by which a machine with formulas may differ from one that was prepared, after some steps
AGREES, STEPS = 1e-8, 10
LEAST_POSITIVE = 1e-300


class Formula(NamedTuple):
    """Number `word` of the image: a constant and Σ factor x^power of a parameter x."""

    word: int
    parameter: int
    terms: tuple[tuple[float, float], ...]  # (factor, power)

    def __call__(self, x: float) -> float:
        return sum(factor * x**power for factor, power in self.terms)


class Parameter(NamedTuple):
    """A parameter of an FMU. value : its default. least : smallest value that it may take."""

    name: str
    value: float
    least: float


class Formulas(NamedTuple):
    """Parameters and what follows from them."""

    parameters: tuple[Parameter, ...] = ()
    formulas: tuple[Formula, ...] = ()


class _UnfitError(Exception):
    """A number that follows no formula."""


def find_formulas(values: Mapping[str, float], nominal: Exported, vary: Vary) -> Formulas:
    """values : defaults by path. vary : prepares the machine with other values. Raises ModelError with every parameter that is refused."""
    parameters, formulas, faults = [], [], []
    for path, value in values.items():
        try:
            found = [*_formulas_of(path, value, len(parameters), nominal, vary)]
        except _UnfitError as problem:
            faults.append(Fault("", 0, 0, path, f"cannot be a parameter of an FMU: {problem}"))
            continue
        except ModelError as error:
            faults += [Fault("", 0, 0, path, f"cannot be varied: {fault.message}") for fault in error.faults]
            continue
        positive = any(power < 0.0 or power % 1.0 for each in found for _, power in each.terms)
        parameters.append(Parameter(path, value, LEAST_POSITIVE if positive else _least(path, value, vary)))
        formulas += found
    if faults:
        raise ModelError(faults)
    out = Formulas(tuple(parameters), tuple(formulas))
    if parameters:
        _check(out, nominal, vary)
    return out


def _formulas_of(path: str, value: float, number: int, nominal: Exported, vary: Vary) -> Iterator[Formula]:
    xs, varied = _varied(path, value, vary)
    arrays = [[*named_arrays(each)] for each in varied]
    for k, (name, array) in enumerate(named_arrays(nominal)):
        others = [each[k][1] for each in arrays]
        if any(other.shape != array.shape for other in others):
            raise _UnfitError(f"it changes how many numbers `{name}` has")
        if array.dtype == np.uint64 or not array.size:
            continue
        rows = np.array([array.ravel(), *(other.ravel() for other in others)])
        changed = np.flatnonzero(((rows != rows[0]) & ~np.isnan(rows)).any(axis=0)) if array.dtype == np.float64 else ()
        if array.dtype != np.float64 and (rows != rows[0]).any():
            raise _UnfitError(f"it changes the whole numbers `{name}`")
        first = nominal.image.byte_of(array.ctypes.data) // WORD
        for place in changed:
            terms = fit(xs, rows[:, place])
            if terms is not None:
                yield Formula(first + int(place), number, terms)
            elif not _is_workspace(name, int(place), nominal):
                raise _UnfitError(
                    f"`{name}` follows no formula of it; where it changes the start of the machine, that has to be assembled again"
                )


def _varied(path: str, value: float, vary: Vary) -> tuple[NDArray[np.float64], list[Exported]]:
    """Values of a parameter, and the machine with all but the first, its default."""
    rows = [tuple(value * share for share in shares) for shares in SHARES] if value else [ABOUT_ZERO]
    for row in rows[:-1]:
        try:
            return np.array([value, *row]), [vary({path: x}) for x in row]
        except ModelError:
            continue
    return np.array([value, *rows[-1]]), [vary({path: x}) for x in rows[-1]]


def _is_workspace(name: str, place: int, nominal: Exported) -> bool:
    """Whether an evaluation computes this number again."""
    part = name.partition(".")[2]
    if part == "functions.arguments":
        return place in nominal.loop.machine.record.functions.argument[:, 3]
    return part.startswith(WORKSPACE)


def named_arrays(machine: Exported) -> Iterator[tuple[str, NDArray[Any]]]:
    """The arrays of the records that an image is made of, with their names: `machine.bodies.mass`, `history.y`; dual numbers as lanes."""
    twin = machine.prepared.motion.twin
    records = {
        "machine": machine.loop.machine.record,
        **({} if twin is None else {"twin": lanes_of(twin.record)}),
        "history": machine.loop.history.record,
    }
    for name, record in records.items():
        yield from arrays_of(record, name)


def _least(path: str, value: float, vary: Vary) -> float:
    """0 where the machine takes no negative value."""
    if value < 0.0:
        return -np.inf
    try:
        vary({path: -(value or 1.0)})
    except ModelError:
        return 0.0
    return -np.inf


def _check(found: Formulas, nominal: Exported, vary: Vary) -> None:
    """Compare the machine with other values of all parameters at once with one in which they follow from the formulas.

    Raises ModelError where they differ, as where two parameters change one number together.
    """
    values = {each.name: (1.0 + 0.01 * (k + 3)) * each.value or 0.1 for k, each in enumerate(found.parameters)}
    wanted = vary(values)
    words = nominal.image.words.copy()
    numbers = words.view(np.float64)
    for each in found.formulas:
        parameter = found.parameters[each.parameter]
        numbers[each.word] += each(values[parameter.name]) - each(parameter.value)
    y, scale = _state_after(words, nominal), wanted.loop.history.record.scale
    other = _state_after(wanted.image.words.copy(), wanted)
    if not (np.abs(y - other) <= AGREES * np.maximum(scale, np.abs(other))).all():
        names = " and ".join(f"`{each.name}`" for each in found.parameters)
        raise refusal(
            f"{names} cannot be parameters of an FMU together: the machine does not move as one with these values"
        )


def _state_after(words: NDArray[np.uint64], machine: Exported) -> NDArray[np.float64]:
    """The state of the machine of an image after some steps."""
    memory = np.zeros(len(words) + WORD, dtype=np.uint64)
    block = memory[-(memory.ctypes.data // WORD) % WORD :][: len(words)]
    block[:] = words
    begin, codes = block.ctypes.data, {entry.symbol: entry.address for entry in machine.entries}
    for word, byte in machine.image.inner.items():
        block[word] = begin + byte
    for word, symbol in machine.image.outer.items():
        block[word] = codes[symbol]
    numbers, loop = machine.numbers, machine.loop
    counter = block[numbers["counter"] // WORD :].view(np.int64)
    address = begin + numbers["machine"], begin + numbers["history"]
    for _ in range(STEPS):
        counter[[BUDGET, FRAMES, EVENTS]] = 1, 0, 0
        status = advance(loop.evaluate.address, loop.correct.address, loop.step.address, *address)
        if status != BUDGET_SPENT:
            return np.full(numbers["y_size"], np.nan)
    return block[numbers["y"] // WORD :][: numbers["y_size"]].view(np.float64).copy()
