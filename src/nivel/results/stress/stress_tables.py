"""Displacement and stress of a flexible body as tables of text, for other programs."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.files.target import written
from nivel.flexible.body.recovery import displacement, signed_principal, stress, stress_modes, von_mises
from nivel.results.stress.recovered import RecoveredBody

Array = NDArray[np.float64]

AXES: Final = ("x", "y", "z")
STRESS: Final = ("xx", "yy", "zz", "xy", "yz", "zx")


def write_rows(path: str | os.PathLike[str], header: Sequence[str], rows: Iterable[Sequence[object]]) -> Path:
    """Write a table; an existing file is replaced. Raises ModelError where it cannot be written."""
    with written(path, "table") as draft, draft.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(header)
        table.writerows(rows)
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
    modes, node_of = stress_modes(body.body), stress_modes(body.body).station_node
    for frame in [body.frame(time) for time in times]:
        moved, sigma = displacement(body.body, body.q[frame])[0], stress(body.body, body.q[frame])[0]
        size, signed = von_mises(sigma), signed_principal(sigma)
        for s, node in enumerate(node_of):
            label = modes.labels[s] if modes.labels else ""
            yield [
                float(body.time[frame]),
                int(body.body.node_ids[node]),
                label,
                *body.body.position[node].tolist(),
                *moved[node].tolist(),
                float(size[s]),
                float(signed[s]),
                *sigma[s].tolist(),
            ]


def write_envelope(path: str | os.PathLike[str], body: RecoveredBody) -> Path:
    """A row per station: its node, its place, its largest von Mises stress over the run and when."""
    modes, worst = stress_modes(body.body), body.envelope
    header = ["node", "station", *(f"{axis} [m]" for axis in AXES), "largest von Mises [Pa]", "time [s]"]
    rows = (
        [
            int(body.body.node_ids[node]),
            modes.labels[s] if modes.labels else "",
            *body.body.position[node].tolist(),
            float(worst.value[s]),
            float(body.time[worst.index[s]]),
        ]
        for s, node in enumerate(modes.station_node)
    )
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
