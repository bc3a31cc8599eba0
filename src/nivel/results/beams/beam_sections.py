"""Strains, forces and moments in the sections of a beam, from the places and axes of its nodes in a result."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from nivel.errors import ModelError
from nivel.machine.beams.beam import Beam
from nivel.machine.core.record import unknown_word
from nivel.machine.machine_record import MachineRecord
from nivel.results.beams.section_resultants import Array, Felt
from nivel.results.frames.stored import understood

if TYPE_CHECKING:
    import xarray as xr

    from nivel.results.result import Result

COMPONENTS = ("x", "y", "z")
AT_ONCE: Final = 20_000  # elements, counted anew at every time


def felt(beam: Beam, place: Array, theta: Array, modal: Array) -> Felt:
    """From places (t, N, 3), Euler parameters (t, N, 4) and modal coordinates (t, N, m) of the nodes of `beam`."""
    from scipy.spatial.transform import Rotation

    from nivel.system.beams.elements import elements_of, strains

    if beam.model == "segments":
        return _felt_by_springs(beam, place, theta)
    if beam.has_gradients:
        from nivel.results.beams.gradient_sections import felt_by_gradients

        turned = Rotation.from_quat(theta[:, :, [1, 2, 3, 0]].reshape(-1, 4)).as_matrix()
        return felt_by_gradients(beam, place, turned.reshape(*theta.shape[:2], 3, 3), modal)
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
    return _felt_elastically(beam, share, elements.weight.ravel(), strain)


def _felt_elastically(beam: Beam, share: Array, weight: Array, strain: Array) -> Felt:
    """With the forces and the energy that go with strains (t, p, 6)."""
    stress = strain @ beam.properties.stiffness
    return Felt(share, weight, strain, stress, 0.5 * np.einsum("tpi,tpi,p->t", strain, stress, weight))


def modes_of_nodes(result: Result, beam: Beam) -> Array:
    """(t, N, m) modal coordinates of the nodes of a beam in a result; m = 0 where they do not deform."""
    numbers: dict[str, list[int]] = {name: [] for name in beam.node_names}
    for k, mode in enumerate(result.coordinates.get("mode", ())):
        numbers.get(mode.rpartition(".")[0], []).append(k)
    places = np.array(list(numbers.values()), dtype=np.int64)
    return result.array("modal_coordinate")[:, places] if places.size else np.zeros((len(result.time), len(places), 0))


def _felt_by_springs(beam: Beam, place: Array, theta: Array) -> Felt:
    """The same where segments meet: the deflection of the spring over the length of its piece of beam."""
    from scipy.spatial.transform import Rotation

    from nivel.system.beams.segments import boundaries, deflections

    axes = Rotation.from_quat(theta.reshape(-1, 4), scalar_first=True).as_matrix().reshape(*theta.shape[:2], 3, 3)
    weight = beam.line.length * np.diff(beam.shares)
    strain = deflections(beam, place, axes) / weight[:, None]
    return _felt_elastically(beam, boundaries(beam), weight, strain)


def beam_sections(result: Result, name: str) -> xr.Dataset:
    """What the sections of the beam `name` feel at all times, at the Gauss points of its elements or where its segments meet.

    Dimensions `time`, `point`, `component` (x along the beam, y and z across it: axes of the section). Variables: `share` (point) of the
    length; `strain` (stretch and two shears) [1] and `curvature` (twist and two curvatures) [1/m], beyond those of the unstressed beam;
    `force` and `moment` of the part behind the section on the part before it [N, N m], elastic and viscous damping apart, which is left
    out; `energy` (time) [J] stored in the beam. An `ancf-cable` has no shear strain: its shear force is what the change of the moment asks
    for.

    Raises ModelError where the machine has no such beam.
    """
    import xarray as xr

    with understood(result, "machine_record"):
        machine = MachineRecord.model_validate_json(result.dataset.attrs["machine_record"])
    found = {beam.name: beam for beam in machine.beams}
    if name not in found:
        raise ModelError(unknown_word(name, tuple(found), "beam") if found else f"{machine.name} has no beams")
    beam = found[name]
    data = result.dataset.sel(body=list(beam.node_names))
    of = felt(beam, data["position"].values, data["orientation"].values, modes_of_nodes(result, beam))
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
            "energy": (("time",), of.energy, {"units": "J", "long_name": "energy stored in the beam"}),
        },
        {"time": data["time"].values, "point": np.arange(len(of.share)), "component": list(COMPONENTS)},
    )
    return out.assign_coords(share=("point", of.share))
