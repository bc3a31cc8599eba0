"""Facts of the stress of a flexible body, as data: pascals, seconds and metres."""

from __future__ import annotations

from typing import Any

import numpy as np

from nivel.flexible.body.recovery import displacement, stress, stress_modes, von_mises
from nivel.results.stress.recovered import RecoveredBody


def facts(body: RecoveredBody, *, count: int, nodes: list[int], times: list[float]) -> dict[str, Any]:
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
