"""Strains, forces and moments in the sections of a beam, from the places and axes of its nodes in a result."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from nivel.errors import ModelError
from nivel.machine.machine_record import MachineRecord
from nivel.machine.record import unknown_word

if TYPE_CHECKING:
    import xarray as xr

    from nivel.results.result import Result

COMPONENTS = ("x", "y", "z")


def beam_sections(result: Result, name: str) -> xr.Dataset:
    """What the sections of the beam `name` feel at all times, at the Gauss points of its elements.

    Dimensions `time`, `point`, `component` (x along the beam, y and z across it: axes of the section). Variables: `share` (point) of the
    length; `strain` (stretch and two shears) [1] and `curvature` (twist and two curvatures) [1/m], beyond those of the unstressed beam;
    `force` and `moment` of the part behind the section on the part before it [N, N m], elastic and viscous damping apart, which is left
    out; `energy` (time) [J] stored in the beam.

    Raises ModelError where the machine has no such beam.
    """
    import xarray as xr
    from scipy.spatial.transform import Rotation

    machine = MachineRecord.model_validate_json(result.dataset.attrs["machine_record"])
    found = {beam.name: beam for beam in machine.beams}
    if name not in found:
        raise ModelError(unknown_word(name, tuple(found), "beam") if found else f"{machine.name} has no beams")
    from nivel.system.beam_elements import elements_of, strains

    beam = found[name]
    elements, stiffness = elements_of(beam), beam.properties.stiffness
    data = result.dataset.sel(body=list(beam.node_names))
    place, theta = data["position"].values, data["orientation"].values
    turned = Rotation.from_quat(theta[:, :, [1, 2, 3, 0]].reshape(-1, 4))
    axes = turned.as_matrix().reshape(*theta.shape[:2], 3, 3)
    now = np.array(
        [
            strains(x[elements.nodes], A[elements.nodes], elements.reference, elements.N, elements.slope)
            for x, A in zip(place, axes, strict=True)
        ]
    )
    change = now - elements.strain
    stress = change @ stiffness
    energy = 0.5 * np.einsum("tngi,tngi,ng->t", change, stress, elements.weight)
    times, points = len(place), change.shape[1] * change.shape[2]
    flat, felt = change.reshape(times, points, 6), stress.reshape(times, points, 6)
    share = np.einsum("nga,na->ng", elements.N, beam.shares[elements.nodes]).ravel()
    dims = ("time", "point", "component")
    out = xr.Dataset(
        {
            "strain": (dims, flat[:, :, :3], {"units": "1", "long_name": "stretch and shears"}),
            "curvature": (dims, flat[:, :, 3:], {"units": "1/m", "long_name": "twist and curvatures"}),
            "force": (dims, felt[:, :, :3], {"units": "N", "long_name": "force in the section, axes of the section"}),
            "moment": (
                dims,
                felt[:, :, 3:],
                {"units": "N m", "long_name": "moment in the section, axes of the section"},
            ),
            "energy": (("time",), energy, {"units": "J", "long_name": "energy stored in the beam"}),
        },
        {"time": data["time"].values, "point": np.arange(points), "component": list(COMPONENTS)},
    )
    return out.assign_coords(share=("point", share))
