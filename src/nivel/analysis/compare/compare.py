"""Run a machine with many methods and measure each: time, constraints, energy, distance from a reference."""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, pairwise
from math import ceil
from typing import Any, Final

import numpy as np

import nivel
from nivel.analysis.compare.compare_grid import REFERENCES, Cell, Grid, reasons
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.progress.journal import Journal, packed, unpacked
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.dynamics import RunOutcome
from nivel.analysis.run.simulate import run_in_memory
from nivel.errors import ModelError
from nivel.judge.after.report import assess, blindness
from nivel.judge.after.subject import Methods, Run
from nivel.lazy import Struct, asdict, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import changed
from nivel.results.comparison import Comparison, Method, Reference, Row, Spread
from nivel.results.comparison_table import CONVERGED, number, seconds
from nivel.results.motion import Motion, common_frames, constraint_measures, distance, energy_measures
from nivel.results.result import Result
from nivel.results.scales import largest_kinetic_energy, machine_size

# Solutions that the runs of a comparison are held against, each with an estimate of its own error.
#
# Two of different methods where they exist: dop853 at tight tolerance, and rk4 extrapolated. Each is the check of the other.

TIGHT, EXTRAPOLATED = REFERENCES
TOLERANCE: Final = 1e-12
LOOSER: Final = 10.0  # times the tolerance: the run that estimates the error
GOAL: Final = 1e-12  # extrapolation ends where the estimate is below this,
NO_GAIN: Final = 0.5  # or no longer falls to this share while below
ROUND_OFF: Final = 1e-11
LEVELS: Final = (3, 16)  # least and most halvings of the step
LONGEST: Final = 10.0  # [s] a further level is not begun where its loop would take longer
DISAGREE: Final = 10.0  # times the sum of both estimates: then neither is believed


class Solution(Struct):
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
    for place, method in ((-1, _tight), (-2, _extrapolated)):
        row = None if journal is None else journal.rows.get(place)
        solution = method(machine, grid, listener) if row is None else _solution_of(row)
        if journal is not None and row is None:
            journal.add(_row_of(solution), place)
        found.append(solution)
    solutions = [each for each in found if each is not None]
    if len(solutions) == 2:
        solutions = _checked(*solutions)
    return sorted(solutions, key=lambda each: each.facts.error)


def _row_of(solution: Solution | None) -> dict[str, Any]:
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


def compare(
    machine: MachineRecord,
    grid: Grid,
    *,
    repeat: int = 3,
    journal: Journal | None = None,
    listener: Listener | None = None,
) -> Comparison:
    """Run every cell of `grid`, `repeat` times for its time, and hold it against a reference.

    journal : keeps references and cells, and has those of an interrupted comparison, which are not run again. Cells that fail or are
    refused are told and do not end the comparison; Ctrl-C does, and what was computed is returned.
    Raises ModelError where no cell could start: the machine itself is at fault.
    """
    listener = listener or Listener()
    bench = _Bench(repeat, listener)
    outcome, note = "done", ""
    try:
        bench.refer(solve(machine, grid, listener, journal))
        note = "" if bench.references else "no reference: none of its runs came to the end"
        for k, cell in enumerate(grid.cells):
            if journal is not None and k in journal.rows:
                bench.take(journal.rows[k])
                continue
            bench.add(cell, f"{k + 1} of {len(grid.cells)}")
            if journal is not None:
                journal.add(bench.last(), k)
    except KeyboardInterrupt:
        outcome = "interrupted"
    comparison = Comparison(
        machine=machine.name,
        duration=machine.simulation.duration,
        output_interval=grid.interval,
        repeat=repeat,
        rows=tuple(bench.rows),
        references=tuple(each.facts for each in bench.references),
        spread=None,
        size=bench.size,
        kinetic_energy=bench.kinetic_energy,
        outcome=outcome,
        note=note,
        nivel_version=nivel.__version__,
    )
    done = _spread(_orders(comparison), bench.finest)
    return replace(done, trust=assess(Methods(outcome=done.outcome, references=done.references, rows=done.rows)))


class _Bench:
    """What the cells of one comparison share: references, scales, and the two finest motions of every method."""

    def __init__(self, repeat: int, listener: Listener) -> None:
        self.repeat, self.listener = repeat, listener
        self.references: list[Solution] = []
        self.rows: list[Row] = []
        self.finest: dict[Method, list[tuple[Row, Motion]]] = {}
        self.size, self.kinetic_energy = 0.0, 0.0

    def refer(self, references: list[Solution]) -> None:
        """Take the solutions that all cells are held against, and the scales from the best of them."""
        self.references = references
        if references:
            self.size, self.kinetic_energy = references[0].size, references[0].kinetic_energy

    def last(self) -> dict[str, Any]:
        """The last row, its motion, and the scales, for a journal."""
        row = self.rows[-1]
        motion = next(
            (motion for other, motion in self.finest.get(row.method, []) if other.fineness == row.fineness), None
        )
        scales = [self.size, self.kinetic_energy]
        return {"row": asdict(row), "motion": None if motion is None else packed_motion(motion), "scales": scales}

    def take(self, kept: Mapping[str, Any]) -> None:
        """A row of a journal."""
        row = Row(**kept["row"])
        self.size, self.kinetic_energy = kept["scales"]
        self.rows.append(row)
        if kept["motion"] is not None:
            self._compare_later(row, unpacked_motion(kept["motion"]))

    def _compare_later(self, row: Row, motion: Motion) -> None:
        """Keep the two finest motions of a method."""
        kept = [*self.finest.get(row.method, []), (row, motion)]
        self.finest[row.method] = sorted(kept, key=lambda each: each[0].fineness)[:2]

    def add(self, cell: Cell, place: str) -> None:
        """Run a cell and add its row; `place` among the others is shown."""
        row = Row(*cell.method, step=cell.step, tolerance=cell.tolerance)
        if cell.plan is None:
            self.rows.append(replace(row, outcome="refused", reason=cell.reason))
            return
        what = f"step {seconds(row.step)}" if row.step else f"tolerance {number(row.tolerance)}"
        self.listener.say(f"{place}: {', '.join(dict.fromkeys(cell.method))}, {what}", cell.plan.settings.duration)
        try:
            run = run_in_memory(cell.plan, self.listener.progress)
        except ModelError as error:
            self.rows.append(replace(row, outcome="refused", reason=reasons(error)))
            return
        result, finished = run.result, run.finished
        times = [finished.timing["loop_seconds"]]
        try:
            for _ in range(self.repeat - 1 if finished.failure is None else 0):
                again = run_in_memory(cell.plan, self.listener.progress).finished
                times.append(again.timing["loop_seconds"])
        finally:  # also where the repeats were interrupted
            self.rows.append(self._measured(_timed(row, result, finished, min(times)), result))

    def _measured(self, row: Row, result: Result) -> Row:
        """`row` with the errors of its run, if it came to the end."""
        if row.outcome != "done":
            return row
        if not self.references and self.size == 0.0:
            self.size = machine_size(result)[0]
            self.kinetic_energy = largest_kinetic_energy(result, self.size)
        motion = Motion.of(result)
        self._compare_later(row, motion)
        open_, open_mean = constraint_measures(result, "constraint_violation", self.size)
        rate, rate_mean = constraint_measures(result, "constraint_rate_violation", self.size)
        energy, relative = energy_measures(result, self.kinetic_energy)
        row = replace(
            row,
            constraint_error=open_,
            constraint_error_mean=open_mean,
            constraint_rate_error=rate,
            constraint_rate_error_mean=rate_mean,
            energy_error=energy,
            energy_error_relative=relative,
        )
        return self._held_against_reference(row, motion)

    def _held_against_reference(self, row: Row, motion: Motion) -> Row:
        """`row` with its motion error: against the best reference of another integrator, else against the best."""
        if not self.references:
            return row
        others = [each for each in self.references if each.facts.integrator != row.integrator]
        reference = (others or self.references)[0]
        error = distance(motion, reference.motion, self.size)
        return replace(
            row,
            motion_error=error.value,
            motion_error_body=error.row,
            motion_error_time=error.time,
            reference=reference.facts.name,
        )


def _timed(row: Row, result: Result, finished: RunOutcome, loop_seconds: float) -> Row:
    """`row` with what its run took, and when and why it stopped."""
    timing = finished.timing
    steps = int(timing["steps"])
    return replace(
        row,
        outcome="failed" if finished.failure else "done",
        reason=finished.failure[0] if finished.failure else "",
        end_time=float(result.time[-1]) if len(result.time) else None,
        stopped_by=finished.stopped_by,
        loop_seconds=loop_seconds,
        seconds_per_step=loop_seconds / steps if steps else None,
        steps=steps,
        rejected=int(timing["rejected"]),
        evaluations=int(timing["evaluations"]),
        iterations=int(timing["iterations"]),
    )


def _orders(comparison: Comparison) -> Comparison:
    """`comparison` with the slopes between neighbouring steps of each method whose errors both stand above their reference's."""
    orders: dict[Row, float] = {}
    for rows in comparison.curves().values():
        resolved = [row if comparison.is_resolved(row) else None for row in rows if row.step is not None]
        for coarse, fine in pairwise(resolved):
            if coarse is not None and fine is not None:
                ratio = (coarse.motion_error or 0.0) / (fine.motion_error or 1.0)
                orders[fine] = math.log(ratio) / math.log(coarse.fineness / fine.fineness)
    return replace(comparison, rows=tuple(replace(row, order=orders.get(row)) for row in comparison.rows))


def _spread(comparison: Comparison, finest: dict[Method, list[tuple[Row, Motion]]]) -> Comparison:
    """`comparison` with the distance of the two methods that are furthest apart, each at its finest.

    A method whose two finest runs (of `finest`, the finest first) are more than CONVERGED apart does not claim to have converged.
    """

    def apart(a: tuple[Row, Motion], b: tuple[Row, Motion]) -> float:
        return distance(a[1], b[1], comparison.size).value

    claiming = [runs[0] for runs in finest.values() if len(runs) == 1 or apart(runs[0], runs[1]) <= CONVERGED]
    pairs = [(apart(a, b), comparison.label(a[0]), comparison.label(b[0])) for a, b in combinations(claiming, 2)]
    if not pairs:
        return comparison
    widest = max(pairs, key=lambda pair: math.inf if math.isnan(pair[0]) else pair[0])
    return replace(comparison, spread=Spread(*widest, len(claiming), len(finest) - len(claiming)))
