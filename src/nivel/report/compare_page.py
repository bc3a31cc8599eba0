"""The page of a comparison: which method is worth what, in one HTML file with everything in it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

from nivel.files.target import write_text
from nivel.lazy import dataclass
from nivel.report.page import page, text_of
from nivel.report.story import trusted
from nivel.report.work_precision import NARROW, WIDE, curves, diagram, legend_mark
from nivel.results.comparison import Comparison, Row
from nivel.results.comparison_table import (
    CONVERGED,
    fineness,
    motion,
    not_converged,
    number,
    order,
    seconds,
    simulated,
    stops,
)
from nivel.results.motion import DEFINITION

WANTED = (1e-3, 1e-6, 1e-9)  # errors to which the cheapest cell is told


class Heading(NamedTuple):
    """A column of the table, and what stands small below its numbers."""

    title: str
    below: str = ""


class Shown(NamedTuple):
    """A cell: what it is sorted by, its text, and the small one below."""

    value: float | None
    text: str
    below: str = ""


@dataclass(frozen=True)
class Stat:
    """A card on top: a figure, and what it says."""

    title: str
    figure: str = ""
    texts: tuple[str, ...] = ()
    items: tuple[tuple[str, str], ...] = ()


COLUMNS = (
    Heading("method"),
    Heading("fineness"),
    Heading("loop time", "per step"),
    Heading("steps", "rejected"),
    Heading("evaluations", "iterations"),
    Heading("constraints", "mean"),
    Heading("rates [1/s]", "mean"),
    Heading("energy", "absolute"),
    Heading("motion", "where"),
    Heading("order"),
)


def write_comparison(comparison: Comparison, path: str | os.PathLike[str], *, force: bool = False) -> Path:
    """Write the page of `comparison` to `path`; an existing file is replaced with `force` only.

    The file needs no network and nothing beside it.
    """
    write_text(comparison_html(comparison), path, "report", force=force)
    return Path(path)


def comparison_html(comparison: Comparison) -> str:
    """The page as text."""
    return page(
        "compare.html.j2",
        ("compare.css",),
        trusted=trusted(comparison.trust),
        comparison=comparison,
        title=_title(comparison),
        facts=_facts(comparison),
        stats=_stats(comparison),
        curves=curves(comparison),
        wide=diagram(comparison, WIDE, "wide"),
        narrow=diagram(comparison, NARROW, "narrow"),
        mark=legend_mark,
        columns=COLUMNS,
        cells=lambda row: _cells(comparison, row),
        label=comparison.label,
        fineness=fineness,
        definition=DEFINITION,
        converged=f"{CONVERGED:g}",
        script=text_of("compare.js"),
    )


def _title(comparison: Comparison) -> str:
    rows, completed = len(comparison.rows), len(comparison.completed)
    ended = completed - len(comparison.stopped)
    ran = f"{'All' if ended == rows else ended or 'None'} of them ran to the end."
    cells = "1 run" if rows == 1 else f"{rows} runs"
    stopped = [f"{line[0].upper()}{line[1:]}." for line in stops(comparison)]
    missing = ["Interrupted: cells are missing."] if comparison.outcome != "done" else []
    return " ".join([f"Methods compared in {cells}. {ran}", *stopped, *missing])


def _facts(comparison: Comparison) -> list[str]:
    """What all cells share."""
    return [
        simulated(comparison),
        f"a frame every {seconds(comparison.output_interval)}",
        f"times are the least of {comparison.repeat}",
        *comparison.common,
    ]


def _stats(comparison: Comparison) -> list[Stat]:
    out = []
    spread = comparison.spread
    if spread is not None:
        pair = f"{spread.first} and {spread.second}{not_converged(spread, '. ')}."
        text = f"Furthest apart of {spread.methods} methods, each at its finest: {pair}"
        out.append(Stat("How far the methods agree", number(spread.distance, 2), (text,)))
    for reference in comparison.references[:1]:
        others = [f"Checked by {each.name}, error {number(each.error, 2)}." for each in comparison.references[1:]]
        text = f"{reference.name}: {reference.how}."
        out.append(Stat("Error of the reference", number(reference.error, 2), (text, *others)))
    if comparison.note:
        out.append(Stat("Reference", "none", (comparison.note,)))
    cheapest = [(f"error ≤ {number(wanted, 1)}", _cheapest(comparison, wanted)) for wanted in WANTED]
    if comparison.references:
        out.append(Stat("The fastest way to a motion", items=tuple(cheapest)))
    return out


def _cheapest(comparison: Comparison, wanted: float) -> str:
    """The completed row with the least time among those whose error is below `wanted`."""
    fit = [row for row in comparison.completed if row.motion_error is not None and row.motion_error <= wanted]
    if not fit:
        return "none"
    best = min(fit, key=lambda row: row.loop_seconds or 0.0)
    size, time = (text.replace(" ", "\u00a0") for text in (fineness(best), seconds(best.loop_seconds)))
    return f"{comparison.label(best)}, {size}: {time}"


def _cells(comparison: Comparison, row: Row) -> list[Shown]:
    """The numbers of a completed row, below the columns from the third on."""
    where = f"{row.motion_error_body}, {seconds(row.motion_error_time)}" if row.motion_error_body else ""
    return [
        Shown(row.loop_seconds, seconds(row.loop_seconds), seconds(row.seconds_per_step)),
        Shown(row.steps, str(row.steps), str(row.rejected)),
        Shown(row.evaluations, str(row.evaluations), str(row.iterations)),
        Shown(row.constraint_error, number(row.constraint_error, 2), number(row.constraint_error_mean, 2)),
        Shown(
            row.constraint_rate_error, number(row.constraint_rate_error, 2), number(row.constraint_rate_error_mean, 2)
        ),
        Shown(row.energy_error_relative, number(row.energy_error_relative, 2), f"{number(row.energy_error, 2)} J"),
        Shown(row.motion_error, motion(comparison, row), where),
        Shown(row.order, order(row)),
    ]
