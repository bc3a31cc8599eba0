"""The page of a comparison: which method is worth what, in one HTML file, with the work–precision diagram."""

import math
from html import escape
from typing import Final, NamedTuple

from nivel.lazy import Struct
from nivel.report.page import page, text_of
from nivel.report.plots import LogAxis, power_of_ten
from nivel.report.story import trusted
from nivel.results import comparison_table as told
from nivel.results.comparison import Comparison, Method, Row, method_label
from nivel.results.comparison_table import fineness, number, seconds
from nivel.results.motion import DEFINITION

TONES: Final = 8  # colours of the page
LEAST: Final = 1e-16  # an error of zero is drawn here
LARGEST: Final = 1e2  # what is further off is drawn here
DASHES: Final = ("", "7 4", "2 3", "9 3 2 3")
# around the origin, of about one area: circle, square, triangle, diamond, triangle on its point
MARKERS: Final = (
    "M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z",
    "M-4 -4h8v8h-8z",
    "M0 -5.4l4.9 8.6h-9.8z",
    "M0 -5.8l5 5.8l-5 5.8l-5 -5.8z",
    "M0 5.4l4.9 -8.6h-9.8z",
)


class Size(NamedTuple):
    """Pixels of a drawing, and of the margins of its plot."""

    width: float
    height: float
    left: float
    right: float
    top: float
    bottom: float


WIDE: Final = Size(1100, 470, 62, 18, 14, 46)
NARROW: Final = Size(400, 430, 50, 10, 12, 44)


class Curve(Struct):
    """A method: its label, its look, and its points from coarse to fine. number : of the curve; tone, kind : of colour and marker."""

    label: str
    number: int
    tone: int
    kind: int
    rows: tuple[Row, ...]

    @property
    def style(self) -> str:
        """Colour and dashes, in CSS."""
        dash = DASHES[self.kind // len(MARKERS) % len(DASHES)]
        return f"--tone:var(--tone-{self.tone})" + (f";stroke-dasharray:{dash}" if dash else "")

    @property
    def marker(self) -> str:
        """Path of its marker around the origin."""
        return MARKERS[self.kind % len(MARKERS)]

    @property
    def mark(self) -> str:
        """A small SVG with its line and its marker, for the legend."""
        return (
            f'<svg class="mark" viewBox="0 0 34 14" width="34" height="14" aria-hidden="true"><g class="curve" style="{self.style}">'
            f'<path class="line" d="M1 7H33"/><path class="point" transform="translate(17 7)" d="{self.marker}"/></g></svg>'
        )


def curves(comparison: Comparison) -> list[Curve]:
    """The curves of the diagram, none without a reference.

    Where several axes vary, the colour tells the word on one of them, that with most words among those with enough colours, and the
    marker the others.
    """
    found = {
        method: tuple(row for row in rows if row.motion_error is not None and (row.loop_seconds or 0.0) > 0.0)
        for method, rows in comparison.curves().items()
    }
    methods = [method for method, rows in found.items() if rows]
    words = {name: list(dict.fromkeys(getattr(method, name) for method in methods)) for name in Method._fields}
    fitting = [name for name in Method._fields if len(words[name]) <= TONES]
    axis = max(fitting, key=lambda name: len(words[name]), default="")
    others = list(dict.fromkeys(_without(method, axis) for method in methods))
    out = []
    for k, method in enumerate(methods):
        tone = words[axis].index(getattr(method, axis)) if axis else k % TONES
        kind = others.index(_without(method, axis)) if axis else k // TONES
        if len(others) == 1:
            kind = k  # no other word is left for the marker to tell
        label = method_label(method, comparison.varying)
        out.append(Curve(label, k, tone, kind % (len(MARKERS) * len(DASHES)), found[method]))
    return out


def _without(method: Method, axis: str) -> tuple[str, ...]:
    return tuple(word for name, word in method._asdict().items() if name != axis)


def diagram(comparison: Comparison, size: Size, kind: str) -> str:
    """SVG text of the diagram in the given size; `kind` is its class. Empty where there is nothing to draw."""
    shown = curves(comparison)
    rows = [row for curve in shown for row in curve.rows]
    if not rows:
        return ""
    floor = max((each.error for each in comparison.references), default=0.0)
    times = [row.loop_seconds or 0.0 for row in rows]
    errors = [_error(row) for row in rows] + ([max(floor, LEAST)] if floor > 0.0 else [])
    across = LogAxis.around(times, size.left, size.width - size.right)
    up = LogAxis.around(errors, size.height - size.bottom, size.top, room=0.6)
    parts = [_grid(across, up, size), _floor(floor, across, up)]
    parts += [_curve(comparison, curve, across, up) for curve in shown]
    label = f"Work–precision diagram: error of the motion against loop time of {len(shown)} methods; its numbers are in the table"
    return (
        f'<svg class="precision {kind}" viewBox="0 0 {size.width:g} {size.height:g}" role="img" aria-label="{escape(label)}">'
        f"{''.join(parts)}</svg>"
    )


def _grid(across: LogAxis, up: LogAxis, size: Size) -> str:
    left, right, low, high = across.start, across.end, up.start, up.end
    out = []
    for tick in across.ticks(seconds):
        x = across.at(tick.value)
        out.append(f'<path class="grid" d="M{x:.1f} {low:.1f}V{high:.1f}"/>')
        out.append(f'<text class="tick" x="{x:.1f}" y="{low + 17:.1f}" text-anchor="middle">{tick.label}</text>')
    for tick in up.ticks(power_of_ten):
        y = up.at(tick.value)
        out.append(f'<path class="grid" d="M{left:.1f} {y:.1f}H{right:.1f}"/>')
        out.append(f'<text class="tick" x="{left - 8:.1f}" y="{y + 4:.1f}" text-anchor="end">{tick.label}</text>')
    out.append(f'<path class="frame" d="M{left:.1f} {high:.1f}V{low:.1f}H{right:.1f}"/>')
    place = f'x="{0.5 * (left + right):.1f}" y="{size.height - 8:.1f}"'
    out.append(f'<text class="axis" {place} text-anchor="middle">time in the loop</text>')
    place = f'transform="translate(13 {0.5 * (low + high):.1f}) rotate(-90)"'
    out.append(f'<text class="axis" {place} text-anchor="middle">error of the motion</text>')
    return "".join(out)


def _floor(error: float, across: LogAxis, up: LogAxis) -> str:
    """What lies below the error of the references cannot be told apart."""
    if error <= up.low:
        return ""
    y, word = up.at(error), "below the error of the reference"
    return (
        f'<rect class="floor" x="{across.start:.1f}" y="{y:.1f}" width="{across.end - across.start:.1f}" height="{up.start - y:.1f}"/>'
        f'<text class="tick" x="{across.end - 6:.1f}" y="{min(y + 14, up.start - 4):.1f}" text-anchor="end">{word}</text>'
    )


def _curve(comparison: Comparison, curve: Curve, across: LogAxis, up: LogAxis) -> str:
    places = [(across.at(row.loop_seconds or 0.0), up.at(_error(row))) for row in curve.rows]
    line = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
    points = [
        f'<g class="hit" transform="translate({x:.1f} {y:.1f})"><title>{escape(_told(comparison, curve, row))}</title>'
        f'<circle r="11"/><path class="point{"" if comparison.is_resolved(row) else " hollow"}" d="{curve.marker}"/></g>'
        for row, (x, y) in zip(curve.rows, places, strict=True)
    ]
    return f'<g class="curve" data-curve="{curve.number}" style="{curve.style}"><path class="line" d="{line}"/>{"".join(points)}</g>'


def _told(comparison: Comparison, curve: Curve, row: Row) -> str:
    word = "step" if row.step is not None else "tolerance"
    doubt = "" if comparison.is_resolved(row) else ", not resolved"
    error = f"error {number(row.motion_error, 2)}{doubt}"
    return f"{curve.label}\n{word} {fineness(row)}: {error} in {seconds(row.loop_seconds)}, {row.steps} steps"


def _error(row: Row) -> float:
    error = row.motion_error or 0.0
    return min(max(error, LEAST), LARGEST) if math.isfinite(error) else LARGEST


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


class Stat(Struct):
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
        mark=lambda curve: curve.mark,
        columns=COLUMNS,
        cells=lambda row: _cells(comparison, row),
        label=comparison.label,
        fineness=fineness,
        definition=DEFINITION,
        converged=f"{told.CONVERGED:g}",
        script=text_of("compare.js"),
    )


def _title(comparison: Comparison) -> str:
    rows, completed = len(comparison.rows), len(comparison.completed)
    ended = completed - len(comparison.stopped)
    ran = f"{'All' if ended == rows else ended or 'None'} of them ran to the end."
    cells = "1 run" if rows == 1 else f"{rows} runs"
    stopped = [f"{line[0].upper()}{line[1:]}." for line in told.stops(comparison)]
    missing = ["Interrupted: cells are missing."] if comparison.outcome != "done" else []
    return " ".join([f"Methods compared in {cells}. {ran}", *stopped, *missing])


def _facts(comparison: Comparison) -> list[str]:
    return [
        told.simulated(comparison),
        f"a frame every {seconds(comparison.output_interval)}",
        f"times are the least of {comparison.repeat}",
        *comparison.common,
    ]


def _stats(comparison: Comparison) -> list[Stat]:
    out = []
    spread = comparison.spread
    if spread is not None:
        pair = f"{spread.first} and {spread.second}{told.not_converged(spread, '. ')}."
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
        Shown(rates := row.constraint_rate_error, number(rates, 2), number(row.constraint_rate_error_mean, 2)),
        Shown(row.energy_error_relative, number(row.energy_error_relative, 2), f"{number(row.energy_error, 2)} J"),
        Shown(row.motion_error, told.motion(comparison, row), where),
        Shown(row.order, told.order(row)),
    ]
