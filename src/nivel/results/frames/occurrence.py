"""Events that came in a run, as a result keeps them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import NamedTuple


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
