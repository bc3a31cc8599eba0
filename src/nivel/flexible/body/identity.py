"""Identity of a flexible body, against the one that a run was made with: histories of modal coordinates belong to one set of modes only."""

from __future__ import annotations

import hashlib

import numpy as np

from nivel.flexible.body.body import ReducedBody


def fingerprint(body: ReducedBody) -> str:
    """Of the nodes, their modes and the frequencies: what gives modal coordinates a meaning. Stresses may be added to a body later."""
    digest = hashlib.sha256()
    for values in (body.eigenvalues, body.node_ids, body.position, body.modes):
        digest.update(repr(values.shape).encode())
        digest.update(np.ascontiguousarray(values).tobytes())
    return digest.hexdigest()
