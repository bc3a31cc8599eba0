"""Events and summary of a run."""

import json
from collections.abc import Sequence
from html import escape
from typing import Any, NamedTuple

import numpy as np

from nivel.known import Result
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.words.wording import counted

COLOURS = {"green": "#1a7f4b", "amber": "#b26a00", "red": "#c0362c"}


def summary(result: Result) -> dict[str, Any]:
    """Name, outcome, extent, timing, and the trust report in full; everything JSON can hold."""
    time = result.time
    return {
        "machine": result.name,
        "outcome": result.outcome,
        "failure": result.failure,
        "advice": result.advice,
        "file": str(result.path) if result.path else None,
        "frames": len(time),
        "time": [float(time[0]), float(time[-1])] if len(time) else [],
        "events": [each._asdict() for each in result.events],
        "stopped_by": result.stopped_by,
        "settings": result.settings,
        "timing": result.timing,
        "headline": result.trust.headline,
        "trust": json.loads(result.trust.to_json()),
    }


def summary_text(result: Result) -> str:
    """Name, outcome, extent and trust; then what can be asked for."""
    lines = [f"<Result of {result.name}: {_outcome(result)}>", f"  {_extent(result)}"]
    lines.append(f"  {result.trust.headline}")
    lines += [f"  {item.verdict:>5}  {item.text}" for item in result.trust.items]
    lines += [f"  event  {line}" for line in in_words(result.events, result.stopped_by)]
    lines.append(f"  for instance: {', '.join(_examples(result))}")
    return "\n".join(lines)


def summary_html(result: Result) -> str:
    """The same as a card; colours follow the notebook's theme."""
    rows = "".join(
        f'<tr><td style="vertical-align:top;padding:.15em .8em .15em 0;color:{COLOURS[item.verdict]};font-weight:600">'
        f'● {item.verdict}</td><td style="text-align:left;padding:.15em 0">{escape(item.text)}</td></tr>'
        for item in result.trust.items
    )
    headline = f" · {escape(result.trust.headline)}"
    events = "".join(f"<div>event {escape(line)}</div>" for line in in_words(result.events, result.stopped_by))
    names = " ".join(f"<code>{escape(name)}</code>" for name in _examples(result))
    return (
        '<div style="border:1px solid rgba(128,128,128,.35);border-radius:8px;padding:.8em 1.1em;max-width:56em">'
        f'<div style="font-size:1.15em;font-weight:600">{escape(result.name)}</div>'
        f'<div style="opacity:.75;margin-bottom:.5em">{escape(_outcome(result))} · {escape(_extent(result))}{headline}</div>'
        f'<table style="border-collapse:collapse;background:none">{rows}</table>'
        f"{events}"
        f'<div style="opacity:.75;margin-top:.5em">for instance {names}</div></div>'
    )


def _outcome(result: Result) -> str:
    words = {
        "running": "never closed: still running, or killed; complete up to its last frame",
        "interrupted": "interrupted",
        "failed": "failed",
    }
    said = words.get(result.outcome, result.outcome)
    return f"{said}: {result.failure}" if result.failure else said


def _extent(result: Result) -> str:
    time = result.time
    span = f"{time[0]:.6g} to {time[-1]:.6g} s in {counted(len(time), 'frame')}" if len(time) else "no frame"
    bodies, joints = (len(result.coordinates.get(dim, ())) for dim in ("body", "joint"))
    return ", ".join([span, counted(bodies, "body", "bodies"), counted(joints, "joint")])


def _examples(result: Result) -> list[str]:
    """A few names, one of each variable."""
    firsts: dict[str, str] = {}
    for name in result.names:
        found = result.selection(name)
        dims = result.variables[found.variable].dims[1:]
        if not dims or len(found.where) == 2:
            firsts.setdefault(found.variable, name)
    return list(firsts.values())[:8]


class Occurrence(NamedTuple):
    """An event that came: its name, its time [s], and whether its value was rising or falling."""

    name: str
    time: float
    direction: str


def to_json(occurrences: Sequence[Occurrence]) -> str:
    """JSON list of {name, time, direction}."""
    return json.dumps([each._asdict() for each in occurrences])


def from_json(text: str) -> tuple[Occurrence, ...]:
    """What `to_json` wrote."""
    return tuple(Occurrence(**each) for each in json.loads(text))


def in_words(occurrences: Sequence[Occurrence], stopped_by: str) -> list[str]:
    """A line for each event in the order of their first times: how often it came, when, and whether it ended the run."""
    times: dict[str, list[float]] = {}
    for name, time, _ in occurrences:
        times.setdefault(name, []).append(time)
    return [
        f"{name} {_when(its)}{', which ended the run' if name == stopped_by else ''}" for name, its in times.items()
    ]


def _when(times: Sequence[float]) -> str:
    if len(times) == 1:
        return f"at t = {times[0]:.9g} s"
    if len(times) == 2:
        return f"at t = {times[0]:.9g} s and {times[1]:.9g} s"
    return f"{len(times)} times, first at t = {times[0]:.9g} s, last at {times[-1]:.9g} s"


ATTRIBUTE = "iterations"  # of results


class Iterations(Struct):
    """Of each of the parts of the duration (at most 1024, all of one length) in which steps ended.

    time : (n,) [s] at its end. begin : (n,) [s] at its begin. steps : (n,) that ended in it. total : (n,) iterations of these.
    most : (n,) of one of them.
    """

    begin: Array
    time: Array
    steps: Array
    total: Array
    most: Array

    @property
    def mean(self) -> Array:
        """(n,) iterations a step."""
        return self.total / self.steps

    @classmethod
    def from_json(cls, text: str) -> "Iterations | None":
        """That of an attribute of a result; None where nothing was iterated."""
        stored = json.loads(text or "null")
        if stored is None:
            return None
        part, length = np.array(stored["part"], dtype=float), float(stored["length"])
        steps, total, most = (np.array(stored[name], dtype=float) for name in ("steps", "total", "most"))
        return cls(part * length, (part + 1.0) * length, steps, total, most)

    def at(self, time: Array) -> tuple[Array, Array]:
        """(mean, most) a step since the time before, for ascending times (m,) [s]; where no step ended since then, of the last ones."""
        last = np.searchsorted(self.begin, time, side="right")
        mean, most = np.full(len(time), np.nan), np.full(len(time), np.nan)
        first = 0
        for k, end in enumerate(last.tolist()):
            if end > first:
                mean[k] = self.total[first:end].sum() / self.steps[first:end].sum()
                most[k] = self.most[first:end].max()
                first = end
            elif k > 0:
                mean[k], most[k] = mean[k - 1], most[k - 1]
        return mean, most


def iterations_in_json(steps: Array, total: Array, most: Array, duration: float) -> str:
    """What `Iterations.from_json` reads, of all parts of a duration [s]; empty where nothing was iterated."""
    if not total.any():
        return ""
    found = np.flatnonzero(steps > 0.0)
    numbers = {"steps": steps, "total": total, "most": most}
    stored = {name: values[found].astype(int).tolist() for name, values in numbers.items()}
    return json.dumps({"length": duration / len(steps), "part": found.tolist(), **stored})
