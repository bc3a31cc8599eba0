"""A beam with elements of other lengths: twice as many, or half as many, with the same stations, and nodes that keep their names."""

from collections.abc import Collection
from functools import cached_property

import numpy as np

from nivel.elements.beams.beam import Beam
from nivel.machine.core.vectors import Array
from nivel.machine.given import Field, ManyNames, ManyNumbers

LEAST_TO_HALVE = 4  # elements between what holds a beam: with fewer, half as many may lock where these do
SAME = 1e-12  # of the length: shares of one node


class OtherElements(Beam):
    """The beam `name` whose elements end at the shares `ends` of its length, 0 and 1 among them.

    known : names of the nodes of the beam that it is made of, and known_at : their shares.
    """

    ends: ManyNumbers[float] = Field(default=())
    known: ManyNames[str] = Field(default=())
    known_at: ManyNumbers[float] = Field(default=())

    @property
    def shares(self) -> Array:
        return _with_inner_nodes(np.array(self.ends), self.order)

    @cached_property
    def node_names(self) -> tuple[str, ...]:
        """A node where the other beam has one has its name; others are numbered behind a slash, which no other name has."""
        at = np.array(self.known_at)
        out = []
        for k, share in enumerate(self.shares.tolist()):
            nearest = int(np.argmin(np.abs(at - share)))
            out.append(self.known[nearest] if abs(at[nearest] - share) < SAME else f"{self.name}./{k}")
        return tuple(out)


def doubled(beam: Beam) -> OtherElements:
    """With two elements in place of each."""
    ends = beam.shares[:: beam.order]
    return _other(beam, np.sort(np.concatenate([ends, 0.5 * (ends[1:] + ends[:-1])])))


def changed(beam: Beam, held: Collection[str]) -> tuple[OtherElements, bool, bool]:
    """With half as many elements where that leaves enough of them between the stations `held`, with twice as many elsewhere; and whether
    any are longer, and any shorter."""
    kept, halves, doubles = [0.0], False, False
    for span in _spans(beam, held):
        enough = sum(len(part) - 1 for part in span) >= LEAST_TO_HALVE
        for part in span:
            count = len(part) - 1
            if enough and count > 1:
                kept += [*part[2:count:2].tolist(), float(part[-1])]
                halves = True
            else:
                kept += np.stack([0.5 * (part[1:] + part[:-1]), part[1:]], axis=1).ravel().tolist()
                doubles = True
    found = _other(beam, np.array(kept))
    if any(problem.place == ("elements",) for problem in found.turning_problems()):
        return doubled(beam), False, True
    return found, halves, doubles


def _spans(beam: Beam, held: Collection[str]) -> list[list[Array]]:
    """Between each two stations that are held, and the ends: of each part between two stations the shares at the ends of its elements."""
    ends = beam.shares[:: beam.order]
    stations = {0.0: "", **{share: name for name, share in beam.stations.items()}, 1.0: ""}
    at = sorted(stations)
    places = np.searchsorted(ends, np.array(at) - SAME).tolist()
    spans: list[list[Array]] = [[]]
    for share, first, last in zip(at[1:], places[:-1], places[1:], strict=True):
        spans[-1].append(ends[first : last + 1])
        if stations[share] in held and share < 1.0:
            spans.append([])
    return spans


def _other(beam: Beam, ends: Array) -> OtherElements:
    given = {name: getattr(beam, name) for name in Beam.model_fields}
    given |= {
        "elements": len(ends) - 1,
        "ends": tuple(ends.tolist()),
        "known": beam.node_names,
        "known_at": tuple(beam.shares.tolist()),
    }
    return OtherElements.model_construct(beam.model_fields_set | {"elements"}, **given)


def _with_inner_nodes(ends: Array, order: int) -> Array:
    """(N,) shares of all nodes of elements with these ends."""
    inner = np.linspace(0.0, 1.0, order, endpoint=False)
    return np.append((ends[:-1, None] + np.diff(ends)[:, None] * inner).ravel(), ends[-1])
