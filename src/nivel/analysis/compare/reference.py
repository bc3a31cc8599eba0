"""Solutions that the runs of a comparison are held against, each with an estimate of its own error.

Two of different methods where they exist: dop853 at tight tolerance, and rk4 extrapolated. Each is the check of the other.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import ceil
from typing import Any, Final

import numpy as np

from nivel.analysis.compare.compare_grid import REFERENCES, Grid
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.progress.journal import Journal, packed, unpacked
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.simulate import run_in_memory
from nivel.judge.after.report import assess, blindness
from nivel.judge.after.subject import Run
from nivel.lazy import asdict, dataclass, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import changed
from nivel.results.comparison import Reference
from nivel.results.comparison_table import seconds
from nivel.results.motion import Motion, common_frames, distance
from nivel.results.scales import largest_kinetic_energy, machine_size

TIGHT, EXTRAPOLATED = REFERENCES
TOLERANCE: Final = 1e-12
LOOSER: Final = 10.0  # times the tolerance: the run that estimates the error
GOAL: Final = 1e-12  # extrapolation ends where the estimate is below this,
NO_GAIN: Final = 0.5  # or no longer falls to this share while below
ROUND_OFF: Final = 1e-11
LEVELS: Final = (3, 16)  # least and most halvings of the step
LONGEST: Final = 10.0  # [s] a further level is not begun where its loop would take longer
DISAGREE: Final = 10.0  # times the sum of both estimates: then neither is believed


@dataclass(frozen=True)
class Solution:
    """A reference and its motion; size [m] and largest kinetic energy [J] of the machine in it."""

    facts: Reference
    motion: Motion
    size: float
    kinetic_energy: float


def solve(machine: MachineRecord, grid: Grid, listener: Listener, journal: Journal | None = None) -> list[Solution]:
    """Reference solutions of `machine`, the one with the least error first; empty where no method came to the end.

    All are in absolute coordinates with the newton-euler formulation, frames at the interval of the grid. The tight one has direct
    correction. The extrapolated one has no stabilisation: its error is then a power series in the step, which corrections that act
    only where a joint is open by more than round-off are not.
    journal : keeps them. Raises ModelError where the machine cannot be assembled or started.
    """
    found = []
    for number, method in ((-1, _tight), (-2, _extrapolated)):
        row = None if journal is None else journal.rows.get(number)
        solution = method(machine, grid, listener) if row is None else _solution_of(row)
        if journal is not None and row is None:
            journal.add(_row_of(solution), number)
        found.append(solution)
    solutions = [each for each in found if each is not None]
    if len(solutions) == 2:
        solutions = _checked(*solutions)
    return sorted(solutions, key=lambda each: each.facts.error)


def _row_of(solution: Solution | None) -> dict[str, Any]:
    """A solution as the row of a journal."""
    if solution is None:
        return {"reference": None}
    scales = [solution.size, solution.kinetic_energy]
    return {"reference": asdict(solution.facts), "motion": packed_motion(solution.motion), "scales": scales}


def _solution_of(row: Mapping[str, Any]) -> Solution | None:
    if row["reference"] is None:
        return None
    return Solution(Reference(**row["reference"]), unpacked_motion(row["motion"]), *row["scales"])


def packed_motion(motion: Motion) -> list[Any]:
    """A motion as a row of a journal has it, to the last bit."""
    return [*map(packed, (motion.time, motion.position, motion.orientation)), list(motion.bodies)]


def unpacked_motion(row: Sequence[Any]) -> Motion:
    """The motion of `packed_motion`."""
    time, position, orientation, bodies = row
    return Motion(unpacked(time), unpacked(position), unpacked(orientation), tuple(bodies))


def _tight(machine: MachineRecord, grid: Grid, listener: Listener) -> Solution | None:
    """A run at TOLERANCE; its error is at most about its distance from one at a looser tolerance."""
    runs = []
    for tolerance in (LOOSER * TOLERANCE, TOLERANCE):
        run = _run(machine, grid, listener, integrator=TIGHT, stabilisation="direct", tolerance=tolerance)
        if run.outcome != "done":
            return None
        runs.append(run)
    last = runs[-1].result
    size = machine_size(last)[0]
    motions = [Motion.of(run.result) for run in runs]
    error = distance(motions[0], motions[1], size).value
    how = f"its distance from a run at tolerance {LOOSER * TOLERANCE:.0e}"
    facts = Reference(f"{TIGHT} at tolerance {TOLERANCE:.0e}", TIGHT, error, how, _blind(runs[-1]))
    return Solution(facts, motions[1], size, largest_kinetic_energy(last, size))


def _extrapolated(machine: MachineRecord, grid: Grid, listener: Listener) -> Solution | None:
    """rk4 with halved steps until Richardson's extrapolations no longer change; None where too few runs came to the end."""
    best: Solution | None = None
    finest: Run | None = None
    plain: Motion | None = None
    former: Motion | None = None
    for step, run in _halvings(machine, grid, listener):
        result = None if run is None else run.result
        motion = None if result is None else Motion.of(result)
        finer = None if plain is None or motion is None else _richardson(plain, motion)
        if result is not None and former is not None and finer is not None:
            size = machine_size(result)[0]
            error = distance(former, finer, size).value
            ends = error < GOAL or (
                best is not None and best.facts.error < ROUND_OFF and error > NO_GAIN * best.facts.error
            )
            if best is None or error < best.facts.error:
                name = f"{EXTRAPOLATED} extrapolated from steps of {seconds(2.0 * step)} and {seconds(step)}"
                facts = Reference(name, EXTRAPOLATED, error, "its distance from the extrapolation of twice these steps")
                best, finest = Solution(facts, finer, size, largest_kinetic_energy(result, size)), run
            if ends:
                break
        plain, former = motion, finer
    if best is None or finest is None:
        return None
    return replace(best, facts=replace(best.facts, blind=_blind(finest)))


def _halvings(machine: MachineRecord, grid: Grid, listener: Listener) -> Iterator[tuple[float, Run | None]]:
    """(step [s], run with rk4) for halved steps, None where it failed; ends where the next would take too long."""
    parts = ceil(grid.interval / grid.coarsest * (1.0 - 1e-9))
    for level in range(LEVELS[1]):
        step = grid.interval / (parts * 2**level)
        run = _run(machine, grid, listener, integrator=EXTRAPOLATED, stabilisation="none", step=step)
        yield step, run if run.outcome == "done" else None
        if level + 1 >= LEVELS[0] and 2.0 * run.finished.timing["loop_seconds"] > LONGEST:
            return


def _richardson(coarse: Motion, fine: Motion) -> Motion:
    """y_h/2 + (y_h/2 - y_h)/15: the error of rk4 of order h⁴ cancels (Richardson 1911; Hairer, Nørsett, Wanner 1993, II.4)."""
    first, second = common_frames(coarse.time, fine.time)
    y, z = coarse.orientation[first], fine.orientation[second]
    y = np.where(np.sum(y * z, axis=-1, keepdims=True) < 0.0, -y, y)  # θ and -θ are one orientation
    theta = z + (z - y) / 15.0
    theta /= np.linalg.norm(theta, axis=-1, keepdims=True)
    r = fine.position[second] + (fine.position[second] - coarse.position[first]) / 15.0
    return Motion(fine.time[second], r, theta, fine.bodies)


def _checked(first: Solution, second: Solution) -> list[Solution]:
    """Both with the error that they have at least: where they are further apart than both estimates allow, neither is believed."""
    apart = distance(first.motion, second.motion, first.size).value
    if not apart > DISAGREE * (first.facts.error + second.facts.error):
        return [first, second]
    return [
        replace(each, facts=replace(each.facts, error=apart, how=f"its distance from {other.facts.name}"))
        for each, other in ((first, second), (second, first))
    ]


def _blind(run: Run) -> str:
    """What both this run and one with finer steps may have wrong alike."""
    return blindness(assess(run).items)


def _run(machine: MachineRecord, grid: Grid, listener: Listener, **settings: object) -> Run:
    fixed = {"formulation": "newton-euler", "coordinates": "absolute"}
    step = {"step": min(machine.simulation.step, grid.interval), "output_interval": grid.interval}
    own = changed(machine.simulation, {**fixed, **step, **settings})
    what = (
        f"step {seconds(float(str(settings['step'])))}"
        if "step" in settings
        else f"tolerance {settings['tolerance']:.0e}"
    )
    listener.say(f"reference: {settings['integrator']}, {what}", own.duration)
    return run_in_memory(plan_run(machine.replace(simulation=own)), listener.progress)
