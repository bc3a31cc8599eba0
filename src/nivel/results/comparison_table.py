"""A comparison as a table for people: in a terminal and in a notebook."""

from collections.abc import Callable
from html import escape
from typing import Final, NamedTuple

from nivel import known
from nivel.words import wording

CONVERGED: Final = 1e-3  # a method whose two finest runs are further apart does not claim to have converged
MEANING: Final = (
    "constraints and their rates: the largest, lengths as shares of the machine's size; energy: the largest error as a share of the "
    "largest kinetic energy; motion: the largest position error as a share of the size, or rotation error in radians"
)


class Column(NamedTuple):
    """A heading and what stands under it."""

    title: str
    cell: Callable[[known.Row], str]


def columns(comparison: known.Comparison) -> list[Column]:
    """The columns that say something: words that vary, then numbers that not all rows have in common at zero."""
    rows = comparison.rows
    out = [Column(name, _word(name)) for name in comparison.varying or ("integrator",)]
    if any(row.step is not None for row in rows):
        out.append(Column("step", lambda row: seconds(row.step)))
    if any(row.tolerance is not None for row in rows):
        out.append(Column("tolerance", lambda row: number(row.tolerance, 2)))
    if comparison.stopped:
        out.append(Column("ended at", lambda row: f"{row.end_time:.6g} s" if row.stopped_by else ""))
    out.append(Column("loop time", lambda row: seconds(row.loop_seconds) or row.outcome))
    out.append(Column("per step", lambda row: seconds(row.seconds_per_step)))
    counts = ("steps", "rejected", "evaluations", "iterations")
    out += [Column(name, _count(name)) for name in counts if any(getattr(row, name) for row in rows)]
    out += [
        Column("constraints", lambda row: "failed" if row.outcome == "failed" else number(row.constraint_error, 2)),
        Column("rates [1/s]", lambda row: number(row.constraint_rate_error, 2)),
        Column("energy", lambda row: number(row.energy_error_relative, 2)),
    ]
    if comparison.references:
        out.append(Column("motion", lambda row: motion(comparison, row)))
    if any(row.order is not None for row in rows):
        out.append(Column("order", order))
    return out


def lines(comparison: known.Comparison) -> list[str]:
    """What stands below the table: rows without numbers, what is the same for all, references, agreement."""
    out = _failures(comparison)
    if comparison.rows:
        words = ", ".join([*comparison.common, simulated(comparison)])
        out.append(f"all: {words}; times are the least of {wording.counted(comparison.repeat, 'run')}")
    out += stops(comparison)
    out += [
        f"reference: {each.name}, its own error {number(each.error, 2)} ({each.how})" for each in comparison.references
    ]
    out.append(MEANING)
    if comparison.note:
        out.append(comparison.note)
    if comparison.spread is not None:
        out.append(spread_line(comparison))
    if comparison.outcome != "done":
        out.append("interrupted: cells are missing")
    out += [item.text for item in comparison.trust.items if item.verdict != "green" and item.name != "outcome"]
    out.append(f"trust: {comparison.trust.told}")
    return out


def simulated(comparison: known.Comparison) -> str:
    """How long the runs are."""
    return f"{'up to ' if comparison.stopped else ''}{seconds(comparison.duration)} simulated"


def stops(comparison: known.Comparison) -> list[str]:
    """A line for every event that ended runs: how many, and when."""
    times: dict[str, list[float]] = {}
    for row in comparison.stopped:
        times.setdefault(row.stopped_by, []).append(row.end_time or 0.0)
    ran, out = sum(row.outcome != "refused" for row in comparison.rows), []
    for event, its in times.items():
        many = "the run was" if ran == 1 else f"{len(its)} of {ran} runs {'was' if len(its) == 1 else 'were'}"
        first, last = (f"{time:.6g}" for time in (min(its), max(its)))
        between = f"{first} s" if first == last else f"{first} to {last} s"
        out.append(f"{many} ended by the event {event}, at {between}")
    return out


def spread_line(comparison: known.Comparison) -> str:
    """How far the completed methods agree."""
    spread = comparison.spread
    if spread is None:
        return ""
    return (
        f"spread: the {spread.methods} methods, each at its finest, agree to {number(spread.distance, 2)}; "
        f"furthest apart are {spread.first} and {spread.second}{not_converged(spread, '; ')}"
    )


def not_converged(spread: known.Spread, before: str) -> str:
    """How many methods the spread leaves out, after `before`; nothing where there are none."""
    if spread.left_out == 0:
        return ""
    methods = "1 method is" if spread.left_out == 1 else f"{spread.left_out} methods are"
    return f"{before}{methods} left out: their two finest runs are more than {CONVERGED:g} apart"


def as_text(comparison: known.Comparison) -> str:
    """The table and its lines in plain text."""
    shown = columns(comparison)
    cells = [[column.title for column in shown], *([column.cell(row) for column in shown] for row in comparison.rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    words = len(comparison.varying or ("integrator",))
    table = [
        "  ".join(
            cell.ljust(width) if k < words else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in cells
    ]
    head = f"<Comparison of {comparison.machine}: {wording.counted(len(comparison.rows), 'cell')}>"
    return "\n".join([head, *table, *lines(comparison)])


def as_html(comparison: known.Comparison) -> str:
    """The same for a notebook; colours follow its theme."""
    shown = columns(comparison)
    head = "".join(f"<th>{escape(column.title)}</th>" for column in shown)
    body = "".join(
        f"<tr>{''.join(f'<td>{escape(column.cell(row))}</td>' for column in shown)}</tr>" for row in comparison.rows
    )
    below = "".join(f"<div>{escape(line)}</div>" for line in lines(comparison))
    return (
        f'<table><caption style="text-align:left;font-weight:600">{escape(comparison.machine)}</caption>'
        f'<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table><div style="opacity:.75">{below}</div>'
    )


def motion(comparison: known.Comparison, row: known.Row) -> str:
    """The motion error of a row, or what it is below where its reference is no better."""
    reference = comparison.reference_of(row)
    if row.motion_error is None or reference is None:
        return ""
    below = f"≲ {number(max(row.motion_error, reference.error), 2)}"
    return number(row.motion_error, 2) if comparison.is_resolved(row) else below


def order(row: known.Row) -> str:
    """The observed order of a row."""
    return "" if row.order is None else f"{round(row.order, 1) + 0.0:.1f}"


def number(value: float | None, digits: int = 3) -> str:
    """A number in few digits, nothing for None."""
    if value is None:
        return ""
    if value == 0.0 or 1e-2 <= abs(value) < 1e4:
        return f"{value:.{digits}g}" if abs(value) < 10.0**digits - 0.5 else f"{value:.0f}"
    mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


def seconds(value: float | None) -> str:
    """A time in the unit that suits it, nothing for None."""
    return "" if value is None else wording.seconds(value)


def _word(name: str) -> Callable[[known.Row], str]:
    return lambda row: "" if name == "rotations" and row.formulation != "lagrange" else str(getattr(row, name))


def _count(name: str) -> Callable[[known.Row], str]:
    return lambda row: "" if getattr(row, name) is None else str(getattr(row, name))


def _failures(comparison: known.Comparison) -> list[str]:
    """A line for every method and reason why it has no numbers, with its steps or tolerances."""
    cells: dict[tuple[str, str, str], list[str]] = {}
    for row in comparison.rows:
        if row.outcome != "done":
            cells.setdefault((comparison.label(row), row.outcome, row.reason), []).append(fineness(row))
    return [f"{label}, {', '.join(sizes)}: {outcome}: {reason}" for (label, outcome, reason), sizes in cells.items()]


def fineness(row: known.Row) -> str:
    """The step or the tolerance of a row."""
    return seconds(row.step) if row.step is not None else number(row.tolerance, 2)
