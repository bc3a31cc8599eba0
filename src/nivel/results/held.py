"""When a friction and what prescribes the motion that it rubs against rest together: no law says how they share the load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.results.row_units import own_units
from nivel.results.scales import Readable, machine_size, span

# A rate below this share of the largest one of the run, and of the machine's size or a radian once in the run, is none.
STILL = 1e-9
SHOWN = 3  # spans in a sentence


@dataclass(frozen=True)
class Held:
    """A friction with stiction on a joint coordinate (`pin.angle`) whose motion is prescribed by these drivers, or without any of them by
    these joints and couplings."""

    friction: str
    coordinate: str
    drivers: tuple[str, ...]
    others: tuple[str, ...] = ()


@dataclass(frozen=True)
class Shared:
    """The times [s] of the first and the last frame of each span in which what `held` names is at rest."""

    held: Held
    spans: tuple[tuple[float, float], ...]


def shared_loads(result: Readable, held: Sequence[Held]) -> tuple[Shared, ...]:
    """Those of the frictions `held` that rest over two frames or more, and when: a motion that turns back rests for no time."""
    found = []
    for each in held:
        spans = _spans(result.time, _still(result, each.coordinate))
        if spans:
            found.append(Shared(each, spans))
    return tuple(found)


def efforts(held: Held) -> tuple[str, ...]:
    """Names of the results that are not unique while it rests."""
    return f"force.{held.friction}.magnitude", *(f"driver.{name}.effort" for name in held.drivers)


def in_words(shared: Shared) -> str:
    """Who holds which coordinate, and when."""
    its = shared.held
    other = f"driver{'s' * (len(its.drivers) > 1)} {', '.join(its.drivers)}" if its.drivers else ", ".join(its.others)
    when = ", ".join(f"{first:.6g} to {last:.6g} s" for first, last in shared.spans[:SHOWN])
    more = f" and {len(shared.spans) - SHOWN} times more" if len(shared.spans) > SHOWN else ""
    return f"{its.friction} and {other} hold {its.coordinate} at rest together (t = {when}{more})"


def _still(result: Readable, coordinate: str) -> NDArray[np.bool_]:
    """(frames,) whether the joint coordinate is at rest."""
    place = result.coordinates[result.variables["joint_rate"].dims[1]].index(coordinate)
    rate = np.abs(result.array("joint_rate")[:, place])
    known = np.isfinite(rate)
    size = machine_size(result)[0] if own_units(result.attributes, "joint_coordinate", coordinate) == "m" else 1.0
    once = size / span(result)
    return known & (rate <= STILL * max(once, float(np.max(rate, initial=0.0, where=known))))


def _spans(time: NDArray[np.float64], still: NDArray[np.bool_]) -> tuple[tuple[float, float], ...]:
    """First and last times of the frames that follow each other in `still`, two at least."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], still, [False]]).astype(int)))
    pairs = zip(edges[::2], edges[1::2] - 1, strict=True)
    return tuple((float(time[first]), float(time[last])) for first, last in pairs if last > first)
