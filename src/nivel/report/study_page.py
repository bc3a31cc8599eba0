"""The page of a study: its variants side by side, what the outputs depend on, and how many are within limits, in one HTML file.

Of a search also the values that it found, how certain they are, and how it came to them.
"""

import json
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import xarray
from nivel.machine.core.vectors import Array
from nivel.report.page import page, text_of
from nivel.report.story import trusted
from nivel.results import study_statistics as statistics
from nivel.results.study_statistics import Surface, Table, share_within
from nivel.results.trust import Trust

MOST_LINES: Final = 2000  # variants that are drawn
MOST_REASONS: Final = 30
DESIGNS: Final = {
    "grid": "grid",
    "rows": "rows of lists",
    "random": "drawn at random",
    "latin-hypercube": "Latin hypercube",
    "sobol": "Sobol's sequence",
    "sobol-indices": "for Sobol indices",
}


class Figures(NamedTuple):
    """A row of the table of outputs."""

    name: str
    unit: str
    numbers: tuple[str, ...]
    limits: str
    within: str
    capability: str


def study_html(dataset: xarray.Dataset) -> str:
    """The page as text."""
    table = Table.of(dataset)
    trust = dataset.attrs.get("trust")
    return page(
        "study.html.j2",
        ("plots.css", "study.css"),
        name=dataset.attrs.get("study") or f"{dataset.attrs['machine']}: sweep",
        description=dataset.attrs.get("description", ""),
        facts=_facts(dataset, table),
        trusted=None if trust is None else trusted(Trust.from_json(str(trust))),
        search=search_of(dataset, table),
        accepted=None if dataset.attrs["analysis"] in SEARCHES else _yield(table),
        figures=list(_figures(table)),
        reasons=_reasons(table)[:MOST_REASONS],
        more=max(0, len(_reasons(table)) - MOST_REASONS),
        data=json.dumps(_data(table)).replace("<", "\\u003c"),
        table=table,
        script=text_of("study.js"),
    )


def _facts(dataset: xarray.Dataset, table: Table) -> list[str]:
    count = len(table.outcome)
    facts = [
        str(dataset.attrs["machine"]),
        str(dataset.attrs.get("analysis", "run")),
        f"{count} variants: {dataset.attrs['outcomes']}",
    ]
    if table.design:
        drawn = f", seed {dataset.attrs['seed']}" if table.samples else ""
        facts.append(f"{DESIGNS.get(table.design, table.design)}{drawn}")
    return facts


def _yield(table: Table) -> tuple[str, str] | None:
    """The share of variants within all limits, and what is said of it; None without limits."""
    if not table.limited:
        return None
    share, lost = share_within(table), int(np.sum(~table.ended))
    low, high = share.interval
    between = f"with a confidence of 95 % between {100.0 * low:.3g} and {100.0 * high:.3g} %"
    said = f"{share.count} of {share.of} variants are within all limits; {between}."
    said += f" {lost} that came to no end count as outside." if lost else ""
    return f"{100.0 * share.value:.4g} %", said


def _figures(table: Table) -> Iterator[Figures]:
    for name, values in table.outputs.items():
        known = values[table.ended & np.isfinite(values)]
        numbers = ("",) * 4
        if len(known):
            deviation = float(np.std(known, ddof=1)) if len(known) > 1 else 0.0
            numbers = tuple(f"{each:.5g}" for each in (known.min(), known.mean(), known.max(), deviation))
        least, most = table.limits[name]
        limits = f"{'' if least is None else f'{least:.5g}'} … {'' if most is None else f'{most:.5g}'}"
        limited = name in table.limited
        cpk = statistics.capability(table, name) if limited else np.nan
        yield Figures(
            name,
            table.units[name],
            numbers,
            limits if limited else "",
            f"{100.0 * share_within(table, name).value:.4g} %" if limited else "",
            f"{cpk:.3g}" if np.isfinite(cpk) else "",
        )


def _reasons(table: Table) -> list[tuple[int, str, str]]:
    return [(int(k), table.outcome[k], table.reason[k]) for k in np.flatnonzero(~table.ended)]


def _data(table: Table) -> dict[str, Any]:
    """What the page draws. Variants that came to no end are left out."""
    some = np.flatnonzero(table.ended)
    if len(some) > MOST_LINES:
        some = some[np.linspace(0, len(some) - 1, MOST_LINES).astype(int)]
    outputs = [
        {**_axis(table, name, each, some), **_findings(table, name), "limits": table.limits[name]}
        for name, each in table.outputs.items()
    ]
    return {
        "parameters": [_axis(table, name, each, some) for name, each in table.parameters.items()],
        "outputs": outputs,
        "accepted": table.accepted[some].tolist(),
        "variants": some.tolist(),
        "limited": bool(table.limited),
        "shown": len(some),
        "count": int(table.ended.sum()),
    }


def _axis(table: Table, name: str, values: NDArray[np.float64], some: NDArray[np.int_]) -> dict[str, Any]:
    return {
        "name": name,
        "unit": table.units[name],
        "words": list(table.words.get(name, ())),
        "values": [float(f"{each:.7g}") if np.isfinite(each) else None for each in values[some]],
    }


def _findings(table: Table, name: str) -> dict[str, Any]:
    found, shares = statistics.surface(table, name), statistics.sobol_indices(table, name)
    out: dict[str, Any] = {"surface": None if found is None else _surface(table, found)}
    out["effects"] = [asdict(each) for each in statistics.effects(table, name, found)]
    if shares is not None:
        out["sobol"] = _plain(shares)
    return out


def _plain(facts: Any) -> dict[str, Any]:
    """The fields of a record, arrays as lists."""
    return {name: each.tolist() if isinstance(each, np.ndarray) else each for name, each in asdict(facts).items()}


def _surface(table: Table, found: Surface) -> dict[str, Any]:
    middle = [float(np.median(table.parameters[name][table.ended])) for name in found.parameters]
    predicted = found.predicted if np.isfinite(found.predicted) else None
    return {**_plain(found), "middle": middle, "predicted": predicted}


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
    corners = [k for k in range(1, len(x)) if y[k] != y[k - 1] or k == len(x) - 1]
    path = f"M{x[0]:.1f} {y[0]:.1f}" + "".join(f"H{x[k]:.1f}V{y[k]:.1f}" for k in corners)
    ends = [(at, 10.0**value if logarithmic else value) for at, value in ((bottom, least), (ABOVE, most))]
    anchor = 'text-anchor="end"'
    labels = "".join(f'<text x="{LEFT - 6}" y="{at + 4:.1f}" {anchor}>{value:.4g}</text>' for at, value in ends)
    frame = f'<path class="axis" d="M{LEFT} {ABOVE}V{bottom}H{right}"/>'
    runs = f'<text x="{right}" y="{bottom + 16}" text-anchor="end">{len(best)} runs</text><text x="{LEFT}" y="{bottom + 16}">1</text>'
    line = f'<path d="{path}" fill="none" stroke="var(--accent)" stroke-width="2"/>'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="best {name} after each run">{frame}{labels}{runs}{line}</svg>'
    )
