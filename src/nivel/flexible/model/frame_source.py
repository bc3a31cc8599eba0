"""Frames as model files say them, divided into elements."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from nivel.errors import ModelError
from nivel.flexible.model.beam import Beam
from nivel.flexible.model.frame import Mesh, assembled, local_axes
from nivel.flexible.model.model import FiniteElementModel
from nivel.flexible.model.model_file import Located
from nivel.machine.beams.section_properties import section_of


def frame_model(located: Located) -> FiniteElementModel:
    """The finite-element model of the `frame` of a model file. Every node of a frame has six freedoms.

    Raises ModelError.
    """
    record, frame = located.record, located.record.frame
    assert frame is not None
    mesh = Mesh()
    names = {name: mesh.node(np.array(position)) for name, position in frame.nodes.items()}
    faults = []
    used: set[str] = set()
    for name, beam in frame.beams.items():
        used.update(beam.nodes)
        first, last = (names[node] for node in beam.nodes)
        start, span = mesh.position[first], mesh.position[last] - mesh.position[first]
        up = None if beam.up is None else np.array(beam.up)
        if up is not None and np.linalg.norm(np.cross(up, span)) < 1e-9 * np.linalg.norm(span) * max(
            np.linalg.norm(up), 1e-300
        ):
            faults.append(located.fault(("frame", "beams", name, "up"), "`up` must not be along the beam, nor zero"))
            continue
        material = record.materials[beam.material]
        section = section_of(record.sections[beam.section], material.poisson_ratio)
        between = [mesh.node(start + k / beam.elements * span) for k in range(1, beam.elements)]
        chain = [first, *between, last]
        length = float(np.linalg.norm(span)) / beam.elements
        for i, j in pairwise(chain):
            mesh.ends.append((i, j))
            mesh.beams.append(Beam(length, section, material, frame.theory == "timoshenko"))
            mesh.axes.append(local_axes(span, up))
            mesh.names.append(name)
    lost = "no beam ends at this node: remove it, or join it"
    faults += [located.fault(("frame", "nodes", name), lost) for name in frame.nodes if name not in used]
    if faults:
        raise ModelError(faults)
    masses: dict[int, float] = {}
    for mass in frame.masses.values():
        masses[names[mass.node]] = masses.get(names[mass.node], 0.0) + mass.mass
    return assembled(record.name, mesh, names, masses, lumped=record.reduction.mass == "lumped")
