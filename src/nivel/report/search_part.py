"""Part of the page of a study that a search has: the values that it found, how certain they are, and how it came to them."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any, Final, NamedTuple

import numpy as np

from nivel.lazy import xarray
from nivel.machine.core.vectors import Array
from nivel.results.study_statistics import Table

SEARCHES: Final = ("optimise", "identify")
WIDTH, HEIGHT, LEFT, BELOW, ABOVE = 560, 240, 70, 36, 14  # px
LOGARITHMIC: Final = 100.0  # ratio of the best value at first and in the end from which on their axis is logarithmic


class Row(NamedTuple):
    """A parameter, in words."""

    path: str
    value: str
    deviation: str
    low: str
    high: str


class Search(NamedTuple):
    """said : how the search ended. course : an SVG of the best value so far over the runs."""

    said: str
    rows: tuple[Row, ...]
    uncertain: bool
    course: str
    course_note: str


def search_of(dataset: xarray.Dataset, table: Table) -> Search | None:
    """That of the table of a search; None of other studies."""
    if dataset.attrs.get("analysis") not in SEARCHES:
        return None
    best = best_so_far(dataset, table)
    name = "sum of squares" if dataset.attrs["analysis"] == "identify" else "objective"
    kept = " of runs within all limits" if table.limited else ""
    return Search(
        _said(dataset),
        tuple(_rows(dataset)),
        "standard_deviation" in dataset,
        _drawing(best, name),
        f"Best {name}{kept} after so many runs; runs for slopes are counted.",
    )


def best_so_far(dataset: xarray.Dataset, table: Table) -> Array:
    """(n,) the best objective within limits after each run; not a number before the first."""
    name = "sum_of_squares" if dataset.attrs["analysis"] == "identify" else "objective"
    values = dataset[name].values.astype(float)
    sign = -1.0 if dataset.attrs.get("maximise") else 1.0
    counted = np.where(table.accepted & np.isfinite(values), sign * values, np.inf)
    best = np.minimum.accumulate(counted)
    return np.where(np.isfinite(best), sign * best, np.nan)


def _said(dataset: xarray.Dataset) -> str:
    facts = dataset.attrs
    if "best" not in facts:
        return "No values were found: no start has a result."
    said = [f"{str(facts['message']).rstrip('.')}." if facts.get("message") else ""]
    if facts.get("kept") == 0:
        said.append("Not all limits are kept.")
    if facts.get("undetermined"):
        said.append(f"The measurements do not tell apart: {facts['undetermined']}.")
    if facts.get("on_bounds"):
        said.append(f"On a bound, without a deviation: {facts['on_bounds']}.")
    told = " ".join(filter(None, said)) or "The least squares were found."
    return f"{told} The trust report is that of the machine that was found." if "trust" in facts else told


def _rows(dataset: xarray.Dataset) -> Iterator[Row]:
    bounds: dict[str, Any] = json.loads(dataset.attrs["bounds"])
    best: dict[str, float] = json.loads(dataset.attrs.get("best", "{}"))
    deviations: dict[str, float] = {}
    if "standard_deviation" in dataset:
        deviations = dict(zip(bounds, dataset["standard_deviation"].values.tolist(), strict=True))
    for path, (low, high) in bounds.items():
        spread = deviations.get(path, np.nan)
        deviation = "on its bound" if np.isnan(spread) else "undetermined" if np.isinf(spread) else f"{spread:.2g}"
        yield Row(path, f"{best[path]:.6g}" if path in best else "–", deviation, f"{low:.5g}", f"{high:.5g}")


def _drawing(best: Array, name: str) -> str:
    known = np.flatnonzero(np.isfinite(best))
    if not len(known):
        return ""
    values = best[known]
    low, high = float(values.min()), float(values.max())
    logarithmic = low > 0.0 and high > LOGARITHMIC * low
    heights = np.log10(values) if logarithmic else values
    least, most = float(heights.min()), float(heights.max())
    if most - least < 1e-12 * max(abs(least), abs(most), 1e-300):
        least, most = least - 0.5 * max(abs(least), 1.0), most + 0.5 * max(abs(most), 1.0)
    right, bottom = WIDTH - 14, HEIGHT - BELOW
    x = LEFT + (known + 1) / max(len(best), 1) * (right - LEFT)
    y = bottom - (heights - least) / (most - least) * (bottom - ABOVE)
    path = f"M{x[0]:.1f} {y[0]:.1f}" + "".join(
        f"H{x[k]:.1f}V{y[k]:.1f}" for k in range(1, len(x)) if y[k] != y[k - 1] or k == len(x) - 1
    )
    marks = [(bottom, least), (ABOVE, most)]
    labels = "".join(
        f'<text x="{LEFT - 6}" y="{at + 4:.1f}" text-anchor="end">{10.0**value if logarithmic else value:.4g}</text>'
        for at, value in marks
    )
    frame = f'<path class="axis" d="M{LEFT} {ABOVE}V{bottom}H{right}"/>'
    runs = f'<text x="{right}" y="{bottom + 16}" text-anchor="end">{len(best)} runs</text><text x="{LEFT}" y="{bottom + 16}">1</text>'
    line = f'<path d="{path}" fill="none" stroke="var(--accent)" stroke-width="2"/>'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="best {name} after each run">{frame}{labels}{runs}{line}</svg>'
    )
