"""Discretisation error of a finite-element model: the error of the energy of each mode, estimated at reduction.

Solids by the strain that is left when strains are smoothed over the nodes (Zienkiewicz, Zhu 1987): the share of its strain energy that
a mode lacks, so by how much its eigenvalue is too high. Of bent bars of one to four quadratic tetrahedra over their height it was half
of that, so it is doubled. Frames by elements of half the length: the deflection between nodes that forces
at nodes make is exact, so there the error is that of inertia between the nodes alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.body.body import MeshError
from nivel.flexible.model.frame import frame_model
from nivel.flexible.model.model import FiniteElementModel
from nivel.flexible.model.model_file import Located
from nivel.flexible.model.solid_elements import SolidElements
from nivel.flexible.model.solid_shapes import TETRAHEDRON_4, TETRAHEDRON_10
from nivel.flexible.reduction.free_body import FreeBody

Array = NDArray[np.float64]
# Freedoms of the finer frame, at most; modes that are compared.
MOST_FREEDOMS, COMPARED = 30_000, 30
SMOOTHED = 2.0
RICHARDSON = 4.0 / 3.0  # for errors that fall with the square of the length, or faster


def mesh_error(located: Located, model: FiniteElementModel, modes: Array, eigenvalues: Array) -> MeshError | None:
    """The estimate for `modes` (N, n) of a body with these `eigenvalues` (n,) [1/s²]; None where elements are not known
    or are no tetrahedra."""
    if isinstance(model.elements, SolidElements):
        if any(block.shape not in (TETRAHEDRON_4, TETRAHEDRON_10) for block in model.elements.blocks):
            return None
        return MeshError(SMOOTHED * model.elements.energy_error(model.expansion @ modes), dynamic=False)
    if located.record.frame is None or 2 * model.count > MOST_FREEDOMS:
        return None
    values = FreeBody.of(frame_model(located)).elastic_modes(COMPARED)[0]
    finer = FreeBody.of(frame_model(_halved(located))).elastic_modes(len(values))[0]
    error = np.maximum.accumulate(np.abs(RICHARDSON * (values / finer[: len(values)] - 1.0)))
    return MeshError(np.interp(eigenvalues, values, error), dynamic=True)


def _halved(located: Located) -> Located:
    """The model with twice as many elements in each of its beams."""
    record, frame = located.record, located.record.frame
    assert frame is not None
    beams = {name: beam.model_copy(update={"elements": 2 * beam.elements}) for name, beam in frame.beams.items()}
    return located.with_record(
        record.model_copy(update={"frame": frame.model_copy(update={"beams": beams}), "interfaces": {}})
    )
