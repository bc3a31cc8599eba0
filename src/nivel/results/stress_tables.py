"""Displacement and stress of a flexible body as tables of text for other programs, and as data."""

import csv
import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel.files.target import written
from nivel.flexible.body.recovery import displacement, signed_principal, stress, stress_modes, von_mises
from nivel.machine.core.vectors import Array
from nivel.results.stress import RecoveredBody

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


def stress_facts(body: RecoveredBody, *, count: int, nodes: list[int], times: list[float]) -> dict[str, Any]:
    """Hot spots over the run, the histories at `nodes`, the states at `times` [s]."""
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
        "nodes": [_at_node(body, node) for node in nodes],
        "states": [_at_time(body, time) for time in times],
        "trust": {"verdict": trust.light, "verified": trust.verified, "headline": trust.headline},
    }


def _at_node(body: RecoveredBody, node: int) -> dict[str, Any]:
    """Greatest von Mises stress and when; range and cycles of the signed principal stress at the station where it is widest."""
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
