"""Run a machine with many methods and measure each: time, constraints, energy, distance from a reference."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, replace
from itertools import combinations, pairwise
from typing import Any

import nivel
from nivel.analysis.compare.compare_grid import Cell, Grid, reasons
from nivel.analysis.compare.reference import Solution, packed_motion, solve, unpacked_motion
from nivel.analysis.progress.journal import Journal
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.dynamics import RunOutcome
from nivel.analysis.run.simulate import run_in_memory
from nivel.errors import ModelError
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Methods
from nivel.machine.machine_record import MachineRecord
from nivel.results.comparison import Comparison, Method, Row, Spread
from nivel.results.comparison_table import CONVERGED, number, seconds
from nivel.results.motion import Motion, constraint_measures, distance, energy_measures
from nivel.results.result import Result
from nivel.results.scales import largest_kinetic_energy, machine_size


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
    return _trusted(_spread(_orders(comparison), bench.finest))


def _trusted(comparison: Comparison) -> Comparison:
    """`comparison` with its trust report."""
    subject = Methods(outcome=comparison.outcome, references=comparison.references, rows=comparison.rows)
    return replace(comparison, trust=assess(subject))


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
