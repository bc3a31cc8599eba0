"""A flexible body of a run: where its nodes are and how it is stressed, at every frame; tables of this for other programs, and as
data."""

import csv
import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel.errors import ModelError
from nivel.files.target import written
from nivel.flexible.body import recovery
from nivel.flexible.body.body import ReducedBody
from nivel.flexible.body.body_file import fingerprint, read_body
from nivel.flexible.body.recovery import (
    Cycle,
    Envelope,
    HotSpot,
    displacement,
    signed_principal,
    stations_at,
    stress,
    stress_modes,
    von_mises,
)
from nivel.known import Result
from nivel.lazy import Struct, asdict, nivel
from nivel.machine.core.vectors import Array, Whole
from nivel.results.motion import rotation_matrices
from nivel.results.trust import Trust
from nivel.words.arguments import checked_methods

Told = Callable[[str, float], None]  # what is done, and which share of all is, 0 to 1

CLOSE: Final = 1e-9  # of the last time: a time this near to a frame is that of the frame


def _silent(_what: str, _share: float) -> None:
    """Tells nobody."""


@checked_methods
class RecoveredBody:
    """A flexible body of a result: `body` as it is in its `file`, its modal coordinates `q` (t, n) [kg^½ m], and the times of the frames
    `time` (t,) [s].

    Nodes are those of the finite-element model, by their number or by the name of an interface. Displacements are in the body frame;
    stress of solids is in body axes, of beams in the axes of the element, at fibres of both its ends.
    """

    def __init__(self, result: Result, name: str | None = None, file: str | os.PathLike[str] | None = None) -> None:
        source = source_of(result.attributes, name)
        folder = None if result.path is None else result.path.parent
        self.file = source.path(folder) if file is None else Path(file)
        self.body: ReducedBody = source.read(self.file)
        self.name = source.name
        self.time = result.time
        columns = [k for k, mode in enumerate(result.coordinates["mode"]) if mode.rpartition(".")[0] == source.name]
        self.q: Array = result.array("modal_coordinate")[:, columns]
        self._result = result
        if not len(self.time):
            raise ModelError(f"the result has no frame yet, so {self.name} has no stress")

    @property
    def trust(self) -> Trust:
        """The trust report of the run, of which the stress itself is not verified: nothing estimates what the modes and the elements of the
        body make wrong of it."""
        return self._result.trust.of_derived(f"the stress that modes and elements of {self.name} give")

    # --- where and when ---

    def node(self, node: int | str) -> int:
        """The number of a node given by it, or by the name of its interface. Raises ModelError where there is none."""
        if isinstance(node, str) and not node.lstrip("-").isdigit():
            names = [each.name for each in self.body.interfaces]
            if node not in names:
                raise ModelError(f"{self.name} has no interface `{node}`; there are {', '.join(names) or 'none'}")
            return int(self.body.node_ids[self.body.interface(node).node])
        number = int(node)
        if number not in self.body.node_ids:
            ids = self.body.node_ids
            known = f"its {len(ids)} nodes have numbers from {ids.min()} to {ids.max()}"
            raise ModelError(f"{self.name} has no node {number}; {known}")
        return number

    def frame(self, time: float) -> int:
        """The frame nearest to `time` [s]. Raises ModelError outside of the run."""
        reach = CLOSE * max(abs(self.time[-1]), abs(self.time[0]))
        if not self.time[0] - reach <= time <= self.time[-1] + reach:
            raise ModelError(f"{time:.6g} s is outside of the run, {self.time[0]:.6g} to {self.time[-1]:.6g} s")
        return int(np.argmin(np.abs(self.time - time)))

    def labels(self, node: int | str) -> list[str]:
        """What the stations at a node are called: fibres of beams; one name, empty, of nodes of solids."""
        names = stress_modes(self.body).labels
        return [names[k] if names else "" for k in stations_at(self.body, self.node(node))]

    # --- histories ---

    def displacement(self, node: int | str | None = None) -> Array:
        """(t, 3) [m] of a node, or (t, nodes, 3) of all, in the body frame."""
        if node is None:
            return recovery.displacement(self.body, self.q)
        place = int(np.flatnonzero(self.body.node_ids == self.node(node))[0])
        return self.q @ self.body.modes[place, :3].T

    def stress(self, node: int | str | None = None) -> Array:
        """(t, stations, 6) [Pa] xx, yy, zz, xy, yz, zx at the stations of a node, default all."""
        return recovery.stress(self.body, self.q, self._stations(node))

    def strain(self, node: int | str | None = None) -> Array:
        """(t, stations, 6), shear as γ. Raises ModelError where the body was reduced without strains."""
        return recovery.strain(self.body, self.q, self._stations(node))

    def von_mises(self, node: int | str | None = None) -> Array:
        """(t, stations) [Pa]"""
        return recovery.von_mises(self.stress(node))

    def signed_principal(self, node: int | str | None = None) -> Array:
        """(t, stations) [Pa] the principal stress of largest magnitude, with its sign."""
        return recovery.signed_principal(self.stress(node))

    def _stations(self, node: int | str | None) -> Whole | None:
        return None if node is None else stations_at(self.body, self.node(node))

    # --- the worst ---

    @cached_property
    def envelope(self) -> Envelope:
        """The largest von Mises stress of each station over the run, and the frame at which it was."""
        return recovery.envelope(self.body, self.q)

    @property
    def worst_time(self) -> float:
        """[s] when the largest von Mises stress of all was."""
        return float(self.time[self.envelope.worst])

    def hot_spots(self, count: int = 5, *, apart: float = 0.05) -> list[HotSpot]:
        """The places of largest von Mises stress over the run, greatest first; `index` is the frame.

        apart : places nearer to a greater one than this share of the size of the body are left out.
        """
        return recovery.hot_spots(self.body, self.q, count=count, apart=apart)

    def rainflow(self, node: int | str, station: int | None = None) -> list[Cycle]:
        """Cycles of the signed principal stress [Pa] at a node, ASTM E1049.

        station : which fibre, a place in `labels(node)`; default that of the largest range.
        """
        return recovery.rainflow(self.signed_principal(node)[:, self.widest(node) if station is None else station])

    def damage(self, node: int | str, fatigue: Mapping[str, Any]) -> float:
        """Of the cycles of `rainflow` at a node, by an S–N curve: `strength`, `knee`, `slope`, `slope_below`, `ultimate`; failure at 1."""
        return float(nivel.results.frames.loads.FatigueCurve.of(fatigue, "Pa").damages(self.rainflow(node)).sum())

    def widest(self, node: int | str) -> int:
        """The station of a node, a place in `labels(node)`, whose signed principal stress has the largest range."""
        return int(np.argmax(np.ptp(self.signed_principal(node), axis=0)))

    def classes(self, node: int | str, count: int = 8) -> list[tuple[float, float, float]]:
        """The cycles of `rainflow` in `count` classes of equal width: (least range, greatest range [Pa], cycles), greatest first."""
        cycles = self.rainflow(node)
        top = max((each.range for each in cycles), default=0.0)
        if top <= 0.0:
            return []
        edges = np.linspace(0.0, top, count + 1)
        place = np.minimum((np.array([each.range for each in cycles]) / top * count).astype(int), count - 1)
        sums = np.bincount(place, weights=[each.count for each in cycles], minlength=count)
        return [(float(edges[k]), float(edges[k + 1]), float(sums[k])) for k in reversed(range(count)) if sums[k]]

    # --- for other programs ---

    def load_case(self, time: float) -> Array:
        """(n, 6) [N, N m] forces and moments at the nodes, in the axes of the finite-element model, that bend it as it is at the frame
        nearest to `time` [s]: the loads of interfaces and of inertia that the modes carry. They balance each other to round-off.

        Raises ModelError where the body was reduced without them.
        """
        if self.body.loads is None:
            message = "knows no forces of its nodes: reduce it with `recovery: {loads: true}`"
            raise ModelError(f"the body {self.name} {message}")
        loads = self.body.loads @ self.q[self.frame(time)]
        loaded = np.flatnonzero(loads.any(axis=1))
        rows = np.arange(6 * len(loaded))
        lever = nivel.flexible.model.model.rigid_modes(self.body.position[loaded], rows.reshape(-1, 6), len(rows))
        lever[~(loads[loaded] != 0.0).ravel()] = 0.0
        for _ in range(2):  # the second time what round-off of the first one leaves
            own = loads[loaded].ravel()
            loads[loaded] = (own - lever @ np.linalg.lstsq(lever, own, rcond=None)[0]).reshape(-1, 6)
        return loads

    def write_load_cases(self, path: str | os.PathLike[str], times: Sequence[float] | None = None) -> Path:
        """Write `load_case` at these times [s], default that of the largest stress, for CalculiX and Abaqus (.inp) or Nastran (.bdf)."""
        moments = [self.worst_time] if times is None else list(times)
        return nivel.results.load_cases.write_load_cases(path, self, moments)

    # --- pictures ---

    def write_vtk(
        self, path: str | os.PathLike[str], times: Sequence[float] | None = None, *, told: Told = _silent
    ) -> list[Path]:
        """Write the motion for ParaView: nodes in space with displacement and stress. Returns the files, the .pvd first.

        times : [s] the frames nearest to these, default all. told : hears how far it is.
        """
        frames = np.arange(len(self.time)) if times is None else np.unique([self.frame(time) for time in times])
        place = self._result.selection(f"{self.name}.position").where[1]
        R = self._result.array("position")[frames, place]
        A = rotation_matrices(self._result.array("orientation")[frames, place])

        def followed() -> Iterator[float]:
            for k, frame in enumerate(frames):
                told(f"writing frame {k + 1} of {len(frames)}", k / len(frames))
                yield float(self.time[frame])

        return nivel.flexible.body.vtk.write_motion(self.body, Path(path), followed(), self.q[frames], R, A)


ATTRIBUTE = "flexible_bodies"


class BodySource(Struct):
    """A flexible body of a run: its `file`, the places of the `modes` that were used among all of it, `fingerprint` of it with these."""

    name: str
    file: str
    modes: tuple[int, ...]
    fingerprint: str

    def read(self, path: Path) -> ReducedBody:
        """The body with the modes of the run from the file where it is now. Raises ModelError where its modes are not those of the run."""
        whole = read_body(path)
        if max(self.modes, default=-1) < len(whole.eigenvalues):
            body = whole.keeping(np.array(self.modes, dtype=np.int64))
            if fingerprint(body) == self.fingerprint:
                return body
        raise ModelError(
            f"{path} was changed since the run, or is another body: its modes are not those that `{self.name}` had, so the "
            f"modal coordinates of this result mean nothing to it; run the machine again, or give the file of the run with --body-file "
            f"(in Python: file=…)"
        )

    def path(self, beside: Path | None = None) -> Path:
        """Where the file was in the run, or else a file of that name in the folder `beside`. Raises ModelError where both are gone."""
        places = [Path(self.file), *([beside / Path(self.file).name] if beside is not None else [])]
        for place in places:
            if place.is_file():
                return place
        raise ModelError(
            f"the file of the flexible body `{self.name}` is gone: {self.file}; say where it is with --body-file (in Python: "
            f"file=…), or reduce its model again and run the machine again"
        )


def as_attribute(sources: list[BodySource]) -> str:
    """The attribute of a result, JSON."""
    return json.dumps([asdict(each) for each in sources])


def source_of(attributes: Mapping[str, str | float | int], name: str | None) -> BodySource:
    """The flexible body called `name`, default the only one. Raises ModelError where there is none, or more than one to choose from."""
    known = {
        each["name"]: BodySource(each["name"], each["file"], tuple(each["modes"]), each["fingerprint"])
        for each in json.loads(str(attributes.get(ATTRIBUTE, "[]")))
    }
    if not known:
        raise ModelError("no body of this machine is flexible: stress is known of bodies made by `nivel reduce` only")
    if name is None:
        if len(known) > 1:
            raise ModelError(f"the machine has several flexible bodies, {', '.join(known)}: say which one")
        return next(iter(known.values()))
    if name not in known:
        near = get_close_matches(name, known, n=1)
        hint = f"did you mean `{near[0]}`?" if near else f"the flexible bodies are {', '.join(known)}"
        bodies = [each["name"] for each in json.loads(str(attributes.get("scene", "{}"))).get("bodies", [])]
        what = f"the body `{name}` is not flexible" if name in bodies else f"there is no body `{name}`"
        raise ModelError(f"{what}; {hint}")
    return known[name]


AXES: Final = ("x", "y", "z")
STRESS: Final = ("xx", "yy", "zz", "xy", "yz", "zx")


def write_rows(path: str | os.PathLike[str], header: Sequence[str], rows: Iterable[Sequence[object]]) -> Path:
    """Write a table; an existing file is replaced. Raises ModelError where it cannot be written."""
    with written(path, "table") as draft, draft.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])
    return Path(path)


def write_history(
    path: str | os.PathLike[str], body: RecoveredBody, nodes: Sequence[int | str], *, strains: bool = False
) -> Path:
    """A row per frame: the time, and for every node its displacement and the stress at its stations."""
    columns: dict[str, Array] = {"time [s]": body.time}
    for node in nodes:
        columns |= _history(body, node, strains)
    return write_rows(path, list(columns), np.column_stack(list(columns.values())).tolist())


def _history(body: RecoveredBody, node: int | str, strains: bool) -> dict[str, Array]:
    number = body.node(node)
    moved, sigma = body.displacement(number), body.stress(number)
    epsilon = body.strain(number) if strains else None
    out = {f"node {number} displacement {axis} [m]": moved[:, k] for k, axis in enumerate(AXES)}
    for s, label in enumerate(body.labels(number)):
        place = f"node {number} {label}".strip()
        out[f"{place} von Mises [Pa]"] = von_mises(sigma[:, s])
        out[f"{place} signed principal [Pa]"] = signed_principal(sigma[:, s])
        out |= {f"{place} stress {name} [Pa]": sigma[:, s, k] for k, name in enumerate(STRESS)}
        if epsilon is not None:
            out |= {f"{place} strain {name} [1]": epsilon[:, s, k] for k, name in enumerate(STRESS)}
    return out


def write_states(path: str | os.PathLike[str], body: RecoveredBody, times: Sequence[float]) -> Path:
    """A row for each of the times and stations: its node, its place, its displacement and stress."""
    header = ["time [s]", "node", "station", *(f"{axis} [m]" for axis in AXES)]
    header += [f"displacement {axis} [m]" for axis in AXES]
    header += ["von Mises [Pa]", "signed principal [Pa]", *(f"stress {name} [Pa]" for name in STRESS)]
    return write_rows(path, header, _states(body, times))


def _states(body: RecoveredBody, times: Sequence[float]) -> Iterator[list[object]]:
    for frame in [body.frame(time) for time in times]:
        moved, sigma = displacement(body.body, body.q[frame])[0], stress(body.body, body.q[frame])[0]
        size, signed = von_mises(sigma), signed_principal(sigma)
        for s, (node, place) in enumerate(_stations(body)):
            numbers = [float(size[s]), float(signed[s]), *sigma[s].tolist()]
            yield [float(body.time[frame]), *place, *moved[node].tolist(), *numbers]


def _stations(body: RecoveredBody) -> Iterator[tuple[int, list[object]]]:
    """The place of its node among all, and its number, name and position (3) [m], of each station."""
    modes, own = stress_modes(body.body), body.body
    for s, node in enumerate(modes.station_node):
        yield node, [int(own.node_ids[node]), modes.labels[s] if modes.labels else "", *own.position[node].tolist()]


def write_envelope(path: str | os.PathLike[str], body: RecoveredBody) -> Path:
    """A row per station: its node, its place, its largest von Mises stress over the run and when."""
    worst = body.envelope
    header = ["node", "station", *(f"{axis} [m]" for axis in AXES), "largest von Mises [Pa]", "time [s]"]
    most = zip(worst.value.tolist(), body.time[worst.index].tolist(), strict=True)
    rows = ([*place, *numbers] for (_, place), numbers in zip(_stations(body), most, strict=True))
    return write_rows(path, header, rows)


def write_cycles(path: str | os.PathLike[str], body: RecoveredBody, nodes: Sequence[int | str]) -> Path:
    """A row per cycle that rainflow counting finds at the nodes, each at its station of the largest range; greatest ranges first."""
    header = ["node", "station", "range [Pa]", "mean [Pa]", "count"]
    rows = [
        [body.node(node), body.labels(node)[body.widest(node)], each.range, each.mean, each.count]
        for node in nodes
        for each in sorted(body.rainflow(node), reverse=True)
    ]
    return write_rows(path, header, rows)


def stress_facts(
    body: RecoveredBody, *, count: int, nodes: list[int], times: list[float], fatigue: Mapping[str, Any] | None = None
) -> dict[str, Any]:
    """Hot spots over the run, the histories at `nodes`, the states at `times` [s]. fatigue : S–N curve by which nodes have a damage."""
    trust = body.trust
    spots = [
        {
            "node": spot.node_id,
            "station": spot.label,
            "position": spot.position.tolist(),
            "von_mises": spot.value,
            "signed_principal": spot.signed,
            "time": float(body.time[spot.index]),
        }
        for spot in body.hot_spots(count)
    ]
    return {
        "body": body.name,
        "worst_time": body.worst_time,
        "hot_spots": spots,
        "nodes": [_at_node(body, node, fatigue) for node in nodes],
        "states": [_at_time(body, time) for time in times],
        "trust": {"verdict": trust.light, "verified": trust.verified, "headline": trust.headline},
    }


def _at_node(body: RecoveredBody, node: int, fatigue: Mapping[str, Any] | None) -> dict[str, Any]:
    """Greatest von Mises stress and when; range, cycles and damage of the signed principal stress at the station where it is widest."""
    size, widest = body.von_mises(node), body.widest(node)
    signed = body.signed_principal(node)[:, widest]
    frame = int(np.argmax(size.max(axis=1)))
    return {
        "node": node,
        "von_mises": float(size.max()),
        "time": float(body.time[frame]),
        "station": body.labels(node)[widest],
        "least": float(signed.min()),
        "greatest": float(signed.max()),
        "cycles": [list(each) for each in body.classes(node)],
        **({"damage": body.damage(node, fatigue)} if fatigue else {}),
    }


def _at_time(body: RecoveredBody, time: float) -> dict[str, Any]:
    """The greatest von Mises stress and displacement at the frame nearest to `time`."""
    frame = body.frame(time)
    size, modes = von_mises(stress(body.body, body.q[frame])[0]), stress_modes(body.body)
    station = int(np.argmax(size))
    return {
        "time": float(body.time[frame]),
        "node": int(body.body.node_ids[modes.station_node[station]]),
        "station": modes.labels[station] if modes.labels else "",
        "von_mises": float(size[station]),
        "displacement": float(np.linalg.norm(displacement(body.body, body.q[frame])[0], axis=1).max()),
    }
