"""Bodies of a result that are nodes of beams."""

from __future__ import annotations

import json

import numpy as np
from numpy.typing import NDArray

from nivel.results.scales import Readable


def beam_nodes(result: Readable) -> dict[str, NDArray[np.intp]]:
    """Beam → numbers of its nodes among the bodies of the result, from start to end."""
    record = json.loads(str(result.attributes.get("machine_record", "{}")))
    owner = np.array([name.partition(".")[0] for name in result.coordinates.get("body", ())])
    return {beam["name"]: np.flatnonzero(owner == beam["name"]) for beam in record.get("beams") or ()}


def stations(result: Readable, beam: str) -> list[str]:
    """Names of the bodies of a result that are named places on a beam, among them its ends; nodes between them have numbers."""
    inside = f"{beam}."
    bodies = result.coordinates.get("body", ())
    return [name for name in bodies if name.startswith(inside) and not name.removeprefix(inside).isdecimal()]
