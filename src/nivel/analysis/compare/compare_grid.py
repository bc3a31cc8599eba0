"""The cells of a comparison: all combinations of some words, steps and tolerances, with frames at common times."""

from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import product
from math import ceil, lcm
from typing import Final

from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import Plan, plan_run
from nivel.analysis.plan.settings import FRAMES
from nivel.analysis.progress.log import Listener
from nivel.errors import Fault, ModelError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.lazy import Struct
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings, changed
from nivel.machine.settings.sweep import Axes
from nivel.methods import chooses
from nivel.results.comparison import Method

REFERENCES: Final = ("dop853", "rk4")  # integrators of the solutions that cells are held against
FEWEST_FRAMES: Final = 10  # a common output interval gives at least so many
FINEST: Final = 10**12  # largest denominator of a step in seconds that is looked for


class Cell(Struct):
    """One run of the grid: step or tolerance, whichever its integrator has. Where it is refused, `plan` is None and `reason` says why."""

    method: Method
    step: float | None
    tolerance: float | None
    plan: Plan | None = None
    reason: str = ""


class Grid(Struct):
    """All cells; interval [s] between their frames; coarsest [s] of their fixed steps, or the machine's own."""

    cells: tuple[Cell, ...]
    interval: float
    coarsest: float


def lay_out(machine: MachineRecord, axes: Axes, given: Collection[str] = ()) -> Grid:
    """The grid of `axes` for a machine.

    given : settings of the machine that were asked for. With an output interval among them, cells whose step does not divide it are
    refused; without, it is a common multiple of all steps.
    Raises ModelError where what was asked for has no effect on any cell, or the steps have no common multiple.
    """
    own = machine.simulation.replace(output_interval=None)
    integrators = dict.fromkeys(axes.integrators or (own.integrator,))
    fixed = any(not chooses(word, own.step_control) for word in integrators)
    steps = [step for step in dict.fromkeys(axes.steps or (own.step,)) if step <= own.duration] if fixed else []
    asked = machine.simulation.output_interval if "output_interval" in given else None
    interval = asked or _common_interval(steps, machine.simulation)
    bare = machine.replace(simulation=own)
    found = [
        _cell(bare, method, step, tolerance, interval)
        for method in _methods(axes, own)
        for step, tolerance in _sizes(axes, own, method.integrator)
    ]
    # `auto` and the coordinates that it stands for are one cell
    cells = tuple({(cell.method, cell.step, cell.tolerance): cell for cell in found}.values())
    _refuse_idle(axes, own, list(integrators), given, cells)
    return Grid(cells, interval, max(steps, default=min(own.step, interval)))


def compile_grid(machine: MachineRecord, grid: Grid, listener: Listener | None) -> None:
    """Compile, where needed, what all cells and the references need, so that no time has compiling in it."""
    entries = [entry for cell in grid.cells if cell.plan is not None for entry in run_entries(cell.plan)]
    for integrator in REFERENCES:
        words = {"integrator": integrator, "formulation": "newton-euler", "coordinates": "absolute"}
        with suppress(ModelError):  # where there is no reference, cells are compared without one
            entries += run_entries(plan_run(machine.replace(simulation=changed(machine.simulation, words))))
    build(entries, listener)


def _methods(axes: Axes, own: SimulationSettings) -> Iterator[Method]:
    """All combinations of words, each once; rotation coordinates only where they are chosen."""
    combinations = product(
        axes.integrators or (own.integrator,),
        axes.formulations or (own.formulation,),
        axes.coordinates or (own.coordinates,),
        axes.rotations or (own.rotations,),
        axes.stabilisations or (own.stabilisation,),
    )
    methods = (Method(*words) for words in combinations)
    chosen = (m if m.formulation == "lagrange" else m._replace(rotations="euler-parameters") for m in methods)
    return iter(dict.fromkeys(chosen))


def _sizes(axes: Axes, own: SimulationSettings, integrator: str) -> Iterator[tuple[float | None, float | None]]:
    """(step, tolerance) of the cells of an integrator: it has one of them."""
    if chooses(integrator, own.step_control):
        yield from ((None, tolerance) for tolerance in dict.fromkeys(axes.tolerances or (own.tolerance,)))
    else:
        yield from ((step, None) for step in dict.fromkeys(axes.steps or (own.step,)))


def _cell(machine: MachineRecord, method: Method, step: float | None, tolerance: float | None, interval: float) -> Cell:
    own = machine.simulation
    changes = {**method._asdict(), "output_interval": interval, "step": step or min(own.step, interval)}
    if tolerance is not None:
        changes["tolerance"] = tolerance
    try:
        planned = plan_run(machine.replace(simulation=changed(own, changes)))
    except ModelError as error:
        return Cell(method, step, tolerance, reason=reasons(error))
    return Cell(method._replace(coordinates=planned.settings.coordinates), step, tolerance, planned)


def reasons(error: ModelError) -> str:
    """The faults of a cell in one sentence."""
    return "; ".join(fault.message for fault in error.faults)


def _common_interval(steps: list[float], own: SimulationSettings) -> float:
    """[s] The machine's own output interval where all steps divide it, else their least common multiple, as often as gives FRAMES."""
    if not steps:
        return own.output_interval or own.duration / FRAMES
    if own.output_interval is not None and all(_divides(step, own.output_interval) for step in steps):
        return own.output_interval
    fractions = [Fraction(step).limit_denominator(FINEST) for step in steps]
    denominator = lcm(*(each.denominator for each in fractions))
    multiple = Fraction(lcm(*(int(each * denominator) for each in fractions)), denominator)
    if len(steps) > 1 and not 0 < multiple <= Fraction(own.duration) / FEWEST_FRAMES:
        shown = ", ".join(f"{text} s" for text in _told_apart(steps))
        message = (
            f"the steps {shown} have no common multiple below a tenth of the duration {own.duration:g} s, so their runs cannot be "
            f"compared at common times; take steps like {', '.join(f'{steps[0] / k:g} s' for k in (1, 2, 4))}, or give an "
            f"output interval: cells whose step does not divide it are refused"
        )
        raise ModelError(Fault.at("steps", message))
    base = float(multiple) if len(steps) > 1 else steps[0]
    return base * max(1, ceil(own.duration / FRAMES / base * (1.0 - 1e-12)))


def _told_apart(steps: list[float]) -> list[str]:
    """Different steps in the fewest digits, six at least, in which no two are alike."""
    texts = ([f"{step:.{digits}g}" for step in steps] for digits in range(6, 18))
    return next(each for each in texts if len(set(each)) == len(steps))


def _divides(step: float, interval: float) -> bool:
    times = round(interval / step)
    return times >= 1 and abs(times * step - interval) <= 1e-9 * interval


def _refuse_idle(
    axes: Axes, own: SimulationSettings, integrators: list[str], given: Collection[str], cells: Sequence[Cell]
) -> None:
    """What was asked for and would change no cell is refused."""
    faults = []
    known = [word for word in integrators if word in INTEGRATORS]
    fixed = bool(known) and not any(chooses(word, own.step_control) for word in known)
    if axes.tolerances and fixed:
        faults.append(("tolerances", f"the steps of {', '.join(known)} are fixed: give steps"))
    if axes.steps and known and all(chooses(word, own.step_control) for word in known):
        faults.append(("steps", f"{', '.join(known)} choose their steps: give tolerances"))
    if axes.rotations and "lagrange" not in (axes.formulations or (own.formulation,)):
        faults.append(("rotations", "they are of `lagrange`, which is not among the formulations"))
    if "largest_step" in given and fixed:
        faults.append(("largest_step", f"the steps of {', '.join(known)} are fixed"))
    if "cut" in given and own.cut and all(cell.method.coordinates != "relative" for cell in cells):
        faults.append(("cut", "no cell is in relative coordinates"))
    if faults:
        raise ModelError(Fault.at(name, f"`{name}` would have no effect: {reason}") for name, reason in faults)
