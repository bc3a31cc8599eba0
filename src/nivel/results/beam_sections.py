"""Strains, forces and moments in the sections of a beam, from the places and axes of its nodes in a result."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.machine.beam import Beam
from nivel.machine.machine_record import MachineRecord
from nivel.machine.record import unknown_word

if TYPE_CHECKING:
    import xarray as xr

    from nivel.results.result import Result

Array = NDArray[np.float64]
COMPONENTS = ("x", "y", "z")
AT_ONCE: Final = 20_000  # elements, counted anew at every time


@dataclass(frozen=True)
class Felt:
    """What a beam feels at times t and points p: the Gauss points of its elements, or where its segments meet.

    share : (p,) of the length. weight : (p,) [m]. strain : (t, p, 6) Γ [1] and Κ [1/m], axes of the section, beyond those of the unstressed
    beam. stress : (t, p, 6) force [N] and moment [N m] that go with it.
    """

    share: Array
    weight: Array
    strain: Array
    stress: Array


def felt(beam: Beam, place: Array, theta: Array) -> Felt:
    """From places (t, N, 3) and Euler parameters (t, N, 4) of the nodes of `beam`."""
    from scipy.spatial.transform import Rotation

    from nivel.system.beam_elements import elements_of, strains

    if beam.model == "segments":
        return _felt_by_springs(beam, place, theta)
    elements = elements_of(beam)
    count, points = elements.N.shape[:2]
    times, rows = len(place), max(AT_ONCE // count, 1)
    parts = [np.zeros((0, count * points, 6))]
    for start in range(0, times, rows):
        x, turned = place[start : start + rows], theta[start : start + rows]
        axes = (
            Rotation.from_quat(turned[:, :, [1, 2, 3, 0]].reshape(-1, 4)).as_matrix().reshape(*turned.shape[:2], 3, 3)
        )
        many = len(x)
        now = strains(
            x[:, elements.nodes].reshape(many * count, -1, 3),
            axes[:, elements.nodes].reshape(many * count, -1, 3, 3),
            elements.reference,
            np.tile(elements.N, (many, 1, 1)),
            np.tile(elements.slope, (many, 1, 1)),
        )
        parts.append((now.reshape(many, count, points, 6) - elements.strain).reshape(many, -1, 6))
    strain = np.concatenate(parts)
    share = np.einsum("nga,na->ng", elements.N, beam.shares[elements.nodes]).ravel()
    return Felt(share, elements.weight.ravel(), strain, strain @ beam.properties.stiffness)


def _felt_by_springs(beam: Beam, place: Array, theta: Array) -> Felt:
    """The same where segments meet: the deflection of the spring over the length of its piece of beam."""
    from scipy.spatial.transform import Rotation

    from nivel.system.beam_segments import boundaries, deflections

    axes = Rotation.from_quat(theta.reshape(-1, 4), scalar_first=True).as_matrix().reshape(*theta.shape[:2], 3, 3)
    weight = beam.line.length * np.diff(beam.shares)
    strain = deflections(beam, place, axes) / weight[:, None]
    return Felt(boundaries(beam), weight, strain, strain @ beam.properties.stiffness)


def beam_sections(result: Result, name: str) -> xr.Dataset:
    """What the sections of the beam `name` feel at all times, at the Gauss points of its elements or where its segments meet.

    Dimensions `time`, `point`, `component` (x along the beam, y and z across it: axes of the section). Variables: `share` (point) of the
    length; `strain` (stretch and two shears) [1] and `curvature` (twist and two curvatures) [1/m], beyond those of the unstressed beam;
    `force` and `moment` of the part behind the section on the part before it [N, N m], elastic and viscous damping apart, which is left
    out; `energy` (time) [J] stored in the beam.

    Raises ModelError where the machine has no such beam.
    """
    import xarray as xr

    machine = MachineRecord.model_validate_json(result.dataset.attrs["machine_record"])
    found = {beam.name: beam for beam in machine.beams}
    if name not in found:
        raise ModelError(unknown_word(name, tuple(found), "beam") if found else f"{machine.name} has no beams")
    beam = found[name]
    data = result.dataset.sel(body=list(beam.node_names))
    of = felt(beam, data["position"].values, data["orientation"].values)
    energy = 0.5 * np.einsum("tpi,tpi,p->t", of.strain, of.stress, of.weight)
    dims = ("time", "point", "component")
    out = xr.Dataset(
        {
            "strain": (dims, of.strain[:, :, :3], {"units": "1", "long_name": "stretch and shears"}),
            "curvature": (dims, of.strain[:, :, 3:], {"units": "1/m", "long_name": "twist and curvatures"}),
            "force": (
                dims,
                of.stress[:, :, :3],
                {"units": "N", "long_name": "force in the section, axes of the section"},
            ),
            "moment": (
                dims,
                of.stress[:, :, 3:],
                {"units": "N m", "long_name": "moment in the section, axes of the section"},
            ),
            "energy": (("time",), energy, {"units": "J", "long_name": "energy stored in the beam"}),
        },
        {"time": data["time"].values, "point": np.arange(len(of.share)), "component": list(COMPONENTS)},
    )
    return out.assign_coords(share=("point", of.share))
