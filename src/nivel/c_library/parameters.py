"""Parameters of an exported machine: how the numbers of its image follow from them.

A parameter is offered where every number that it changes follows a law (`nivel.analysis.preparation.parameters`): masses, inertias,
stiffnesses, gains, limits and the like. What moves the start of the machine would need an assembly, which is done in Python; it is refused
with its name. Where the machine lacks what a default of zero would multiply, it is that of other values, with the default put in.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.gradients.outputs import Parameter
from nivel.analysis.preparation.memory import Array, MachineMemory, UnlikeError
from nivel.analysis.preparation.parameters import Numbers, Unfit, UnfitError, numbers_of
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.run.dynamics import Loop
from nivel.c_library.exported import Exported, refusal
from nivel.c_library.image import WORD
from nivel.errors import Fault, ModelError
from nivel.integrate.loop.run import BUDGET, EVENTS, FRAMES
from nivel.kernels.core.arrays import lanes_of
from nivel.kernels.core.status import BUDGET_SPENT

Vary = Callable[[Mapping[str, float]], Exported]

# values of a parameter as shares of its default, or themselves where that is zero, until the machine accepts all of a row; and one beside
SHARES: Final = ((1.25, 0.8, 1.1, 0.9), (0.8, 0.95, 0.9, 0.85), (1.02, 0.98, 1.01, 0.99))
ABOUT_ZERO: Final = ((1.0, -1.0, 0.5, -0.5), (1.0, 0.25, 0.5, 0.75), (-1.0, -0.25, -0.5, -0.75))
BESIDE, BESIDE_ZERO = 1.05, 0.6
# share of an output by which the machine of a default may differ from the one that lacks what is zero, after some steps
AGREES, STEPS = 1e-8, 10
LEAST_POSITIVE = 1e-300


class Followed(NamedTuple):
    """The machine, its parameters, the smallest value that each may take, and what follows from them: numbers, and their words in
    the image."""

    machine: Exported
    parameters: tuple[Parameter, ...] = ()
    least: tuple[float, ...] = ()
    numbers: Numbers | None = None
    words: NDArray[np.intp] = np.zeros(0, dtype=np.intp)

    @property
    def terms(self) -> list[tuple[int, int]]:
        """Numbers, and the parameters that each follows."""
        if self.numbers is None:
            return []
        return [(int(n), int(k)) for n, k in np.argwhere(self.numbers.factors.any(axis=-1))]


def follow(parameters: Sequence[Parameter], nominal: Exported, vary: Vary) -> Followed:
    """vary : prepares the machine with other values. Raises ModelError with every parameter that is refused."""
    paths, defaults = [each.path for each in parameters], np.array([each.value for each in parameters])
    base, values, asides = nominal, defaults.copy(), set[int]()

    def varied(x: Array) -> Exported:
        return vary(dict(zip(paths, x.tolist(), strict=True)))

    while True:
        at = values.copy()

        def one(k: int, value: float, at: Array = at) -> MachineMemory:
            other = varied(np.where(np.arange(len(at)) == k, value, at))
            return memory_of(other.prepared, other.loop)

        rows = [
            [[[share * (value or 1.0) for share in row]] for row in (SHARES if value else ABOUT_ZERO)]
            for value in defaults
        ]
        try:
            numbers = numbers_of(memory_of(base.prepared, base.loop), values, rows, one)
            break
        except UnfitError as error:
            lacking = {each.parameter for each in error.args if isinstance(each.reason, UnlikeError)} - asides
            if not lacking:
                raise ModelError([fault for each in error.args for fault in _faults(each, paths, base.what)]) from None
            asides |= lacking
            values = np.array([(BESIDE * x or BESIDE_ZERO) if k in asides else x for k, x in enumerate(defaults)])
            base = varied(values)
    _check_together(paths, defaults, base, numbers, varied)
    if asides and (name := _unlike_output(base, numbers, defaults, nominal)):
        listed = " and ".join(f"`{paths[k]}`" for k in sorted(asides))
        raise refusal(
            f"{listed} cannot be parameters of {base.what}: with their defaults the machine is another one (`{name}`)"
        )
    addresses = memory_of(base.prepared, base.loop).addresses[numbers.places]
    words = np.array([base.image.byte_of(int(each)) // WORD for each in addresses], dtype=np.intp)
    if asides:
        base.image.words.view(np.float64)[words] = numbers.at(defaults)
    least = tuple(_least(k, defaults, base, numbers, varied) for k in range(len(paths)))
    return Followed(base, tuple(parameters), least, numbers, words)


def _faults(unfit: Unfit, paths: Sequence[str], of: str) -> list[Fault]:
    path = paths[unfit.parameter]
    match unfit.reason:
        case UnlikeError(name=name, kind="count"):
            what = f"it changes how many numbers `{name}` has"
        case UnlikeError(name=name):
            what = f"it changes the whole numbers `{name}`"
        case str(name):
            what = f"`{name}` follows no formula of it; where it changes the start of the machine, that has to be assembled again"
        case ModelError() as error:
            return [Fault.at(path, f"cannot be varied: {fault.message}") for fault in error.faults]
    return [Fault.at(path, f"cannot be a parameter of {of}: {what}")]


def memory_of(prepared: Prepared, loop: Loop) -> MachineMemory:
    """The numbers that an image is made of; dual numbers as lanes."""
    twin = prepared.motion.twin
    twins = {} if twin is None else {"twin": lanes_of(twin.record)}
    return MachineMemory(machine=loop.machine.record, **twins, history=loop.history.record)


def _check_together(
    paths: Sequence[str], defaults: Array, base: Exported, numbers: Numbers, varied: Callable[[Array], Exported]
) -> None:
    """Compare the machine with other values of all parameters at once with one that is prepared. Raises ModelError where they differ, as
    where two parameters change one number together."""
    x = np.array([(1.0 + 0.01 * (k + 3)) * value or 0.1 for k, value in enumerate(defaults)])
    memory = memory_of(base.prepared, base.loop)
    found = memory.numbers
    found[numbers.places] = numbers.at(x)
    try:
        # errors are measured by scales where steps are chosen, which a unit has none of
        other = varied(x)
        names = [n for n in memory.differences(found, memory_of(other.prepared, other.loop)) if n != "history.scale"]
    except UnlikeError as error:
        names = [error.name]
    if names:
        listed = " and ".join(f"`{path}`" for path in paths)
        raise refusal(
            f"{listed} cannot be parameters of {base.what} together: `{names[0]}` is not that of a machine with these values"
        )


def _unlike_output(base: Exported, numbers: Numbers, x: Array, other: Exported) -> str:
    """The first output that the machine with numbers of parameters x has otherwise than `other` after some steps, or none: it may lack what
    is multiplied by nothing."""
    memory = memory_of(base.prepared, base.loop)
    kept = [leaf.array.copy() for leaf in memory.leaves]
    memory.put(numbers.places, numbers.at(x))
    mine, wanted = _outputs_after(base), _outputs_after(other)
    for leaf, before in zip(memory.leaves, kept, strict=True):
        leaf.array[...] = before
    near = {name: abs(mine.get(name, np.nan) - value) <= AGREES * (1.0 + abs(value)) for name, value in wanted.items()}
    return next((name for name in near if not near[name]), "")


def _outputs_after(machine: Exported) -> dict[str, float]:
    run = machine.loop.history.record
    for _ in range(STEPS):
        run.counter[[BUDGET, FRAMES, EVENTS]] = 1, 0, 0
        if machine.loop.advance() != BUDGET_SPENT:
            break
    return {each.name: float(run.frames[0, each.place]) for each in machine.outputs}


def _least(k: int, defaults: Array, base: Exported, numbers: Numbers, varied: Callable[[Array], Exported]) -> float:
    """0 where the machine takes no negative value, and more where it does not take that."""
    if defaults[k] < 0.0:
        return -np.inf

    def accepts(value: float) -> bool:
        x = np.where(np.arange(len(defaults)) == k, value, defaults)
        try:
            other = varied(x)
        except ModelError:
            return False
        try:
            memory_of(base.prepared, base.loop).refuse_unlike(memory_of(other.prepared, other.loop))
        except UnlikeError:
            with np.errstate(all="ignore"):
                return not _unlike_output(base, numbers, x, other)
        return True

    if not accepts(0.0):
        return LEAST_POSITIVE
    return -np.inf if accepts(-(float(defaults[k]) or 1.0)) else 0.0
