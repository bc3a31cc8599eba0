"""Indeterminate friction: frictions at rest together, or with what prescribes the motion they rub against. No law says how they share the
load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nivel.results.frames.row_units import own_units
from nivel.results.trust.scales import Readable, machine_size, span

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
    """Who holds which joint coordinates at rest together, which results are not unique then, and the times [s] of the first and the last
    frame of each span in which they do.

    holders : in words, `driver turn`.
    """

    holders: tuple[str, ...]
    coordinates: tuple[str, ...]
    efforts: tuple[str, ...]
    spans: tuple[tuple[float, float], ...]


def shared_loads(result: Readable, held: Sequence[Held]) -> tuple[Shared, ...]:
    """Those of the frictions `held` that rest over two frames or more, and when: a motion that turns back rests for no time."""
    found = []
    for each in held:
        spans = spans_of(result.time, still(result, each.coordinate, STILL))
        if spans:
            efforts = f"force.{each.friction}.magnitude", *(f"driver.{name}.effort" for name in each.drivers)
            found.append(Shared((each.friction, _prescriber(each)), (each.coordinate,), efforts, spans))
    return tuple(found)


def in_words(shared: Shared) -> str:
    """Who holds which coordinates, and when."""
    when = ", ".join(f"{first:.6g} to {last:.6g} s" for first, last in shared.spans[:SHOWN])
    more = f" and {len(shared.spans) - SHOWN} times more" if len(shared.spans) > SHOWN else ""
    return f"{_listed(shared.holders)} hold {_listed(shared.coordinates)} at rest together (t = {when}{more})"


def still(result: Readable, coordinate: str, share: float) -> NDArray[np.bool_]:
    """(frames,) whether the joint coordinate is at rest: slower than a share of its largest rate, or of the machine's size or a radian once
    in the run."""
    place = result.coordinates[result.variables["joint_rate"].dims[1]].index(coordinate)
    rate = np.abs(result.array("joint_rate")[:, place])
    known = np.isfinite(rate)
    size = machine_size(result)[0] if own_units(result.attributes, "joint_coordinate", coordinate) == "m" else 1.0
    once = size / span(result)
    return known & (rate <= share * max(once, float(np.max(rate, initial=0.0, where=known))))


def spans_of(time: NDArray[np.float64], rests: NDArray[np.bool_]) -> tuple[tuple[float, float], ...]:
    """First and last times of the frames that follow each other in `rests`, two at least."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], rests, [False]]).astype(int)))
    pairs = zip(edges[::2], edges[1::2] - 1, strict=True)
    return tuple((float(time[first]), float(time[last])) for first, last in pairs if last > first)


def _prescriber(held: Held) -> str:
    if not held.drivers:
        return ", ".join(held.others)
    return f"driver{'s' * (len(held.drivers) > 1)} {', '.join(held.drivers)}"


def _listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
