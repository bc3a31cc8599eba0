"""Strains, forces and moments in the sections of a beam, from the places and axes of its nodes in a result."""

from __future__ import annotations

from typing import Final

import numpy as np

from nivel.elements.beams.ancf_beam import beam_strains, section_stiffness
from nivel.elements.beams.ancf_cable import BENDING_POINTS, STRETCH_POINTS, cable_strains, carried_over, twists
from nivel.elements.beams.beam import Beam
from nivel.elements.beams.exact import gauss
from nivel.elements.beams.gradients import gradients, lengths_of, line_at, unstressed_vectors
from nivel.errors import ModelError
from nivel.known import Result
from nivel.lazy import Struct, nivel, replace, scipy, xarray
from nivel.machine.core.record import unknown_word
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.results.frames.stored import understood
from nivel.system.beam_nodes import gradient_nodes, modes_in_gradients

COMPONENTS = ("x", "y", "z")
AT_ONCE: Final = 20_000  # elements, counted anew at every time


def felt(beam: Beam, place: Array, theta: Array, modal: Array) -> Felt:
    """From places (t, N, 3), Euler parameters (t, N, 4) and modal coordinates (t, N, m) of the nodes of `beam`."""
    if beam.model == "segments":
        return _felt_by_springs(beam, place, theta)
    if beam.has_gradients:
        return felt_by_gradients(beam, place, _axes(theta), modal)
    elements = nivel.elements.beams.exact.elements_of(beam)
    count, points = elements.N.shape[:2]
    times, rows = len(place), max(AT_ONCE // count, 1)
    parts = [np.zeros((0, count * points, 6))]
    for start in range(0, times, rows):
        x, axes = place[start : start + rows], _axes(theta[start : start + rows])
        many = len(x)
        now = nivel.elements.beams.exact.strains(
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


def _axes(theta: Array) -> Array:
    """(t, N, 3, 3) of Euler parameters (t, N, 4)."""
    turned = scipy.spatial.transform.Rotation.from_quat(theta.reshape(-1, 4), scalar_first=True)
    return turned.as_matrix().reshape(*theta.shape[:2], 3, 3)


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
    weight = beam.line.length * np.diff(beam.shares)
    strain = nivel.elements.beams.segments.deflections(beam, place, _axes(theta)) / weight[:, None]
    return _felt_elastically(beam, nivel.elements.beams.segments.boundaries(beam), weight, strain)


def beam_sections(result: Result, name: str) -> xarray.Dataset:
    """What the sections of the beam `name` feel at all times, at the Gauss points of its elements or where its segments meet.

    Dimensions `time`, `point`, `component` (x along the beam, y and z across it: axes of the section). Variables: `share` (point) of the
    length; `strain` (stretch and two shears) [1] and `curvature` (twist and two curvatures) [1/m], beyond those of the unstressed beam;
    `force` and `moment` of the part behind the section on the part before it [N, N m], elastic and viscous damping apart, which is left
    out; `energy` (time) [J] stored in the beam. An `ancf-cable` has no shear strain: its shear force is what the change of the moment asks
    for.

    Raises ModelError where the machine has no such beam.
    """
    with understood(result, "machine_record"):
        machine = MachineRecord.model_validate_json(result.dataset.attrs["machine_record"])
    found = {beam.name: beam for beam in machine.beams}
    if name not in found:
        raise ModelError(unknown_word(name, tuple(found), "beam") if found else f"{machine.name} has no beams")
    beam = found[name]
    data = result.dataset.sel(body=list(beam.node_names))
    of = felt(beam, data["position"].values, data["orientation"].values, modes_of_nodes(result, beam))
    rows = (
        ("strain", of.strain[:, :, :3], "1", "stretch and shears"),
        ("curvature", of.strain[:, :, 3:], "1/m", "twist and curvatures"),
        ("force", of.stress[:, :, :3], "N", "force in the section, axes of the section"),
        ("moment", of.stress[:, :, 3:], "N m", "moment in the section, axes of the section"),
        ("energy", of.energy, "J", "energy stored in the beam"),
    )
    dims = ("time", "point", "component")
    values = {name: (dims[: each.ndim], each, {"units": unit, "long_name": said}) for name, each, unit, said in rows}
    coords = {"time": data["time"].values, "point": np.arange(len(of.share)), "component": list(COMPONENTS)}
    return xarray.Dataset(values, coords).assign_coords(share=("point", of.share))


def felt_by_gradients(beam: Beam, place: Array, axes: Array, modal: Array) -> Felt:
    """From places (t, N, 3), axes (t, N, 3, 3) and modal coordinates (t, N, m) of the nodes of `beam`."""
    change = np.stack([modes_in_gradients(beam, node.reduced) for node in gradient_nodes(beam)])
    own = [np.swapaxes(gradients(axes[:, k], modal[:, k], each), -1, -2) for k, each in enumerate(change)]
    v = np.concatenate([place[:, :, None], np.stack(own, axis=1)], axis=2)
    return _cable(beam, v, axes) if beam.model == "ancf-cable" else _beam(beam, v)


def _share(beam: Beam, xi: Array) -> Array:
    """(p,) of the length of the beam at xi (g,) in every element."""
    shares = beam.shares
    return np.ravel(shares[:-1, None] + np.diff(shares)[:, None] * xi)


def _beam(beam: Beam, v: Array) -> Felt:
    now, unstressed = beam_strains(beam, v), beam_strains(beam, unstressed_vectors(beam))
    strain = (now.value - unstressed.value).reshape(len(v), -1, 6)
    C = beam.properties.stiffness
    of = _felt_elastically(beam, _share(beam, now.share[0]), now.weight.ravel(), strain)
    energy = of.energy
    Y, Z = v[:, :, 2], v[:, :, 3]
    squares = 0.5 * np.sum(Y * Y, axis=-1) - 0.5, 0.5 * np.sum(Z * Z, axis=-1) - 0.5, np.sum(Y * Z, axis=-1)
    for length in np.unique(lengths_of(beam)).tolist():
        of_element = np.where(lengths_of(beam) == length, 0.5 * length, 0.0)
        of_node = np.append(of_element, 0.0) + np.append(0.0, of_element)
        for share, value in zip(section_stiffness(C, length), squares, strict=True):
            energy = energy + 0.5 * share * (value**2 @ of_node)
    return replace(of, energy=energy)


def _cable(beam: Beam, v: Array, axes: Array) -> Felt:
    """At the points of bending. There is no shear strain; the shear force is what the change of the moment asks for."""
    C, lengths = beam.properties.stiffness, lengths_of(beam)
    (xi, weight), (full, heavy) = gauss(BENDING_POINTS), gauss(STRETCH_POINTS)
    stretch, K = cable_strains(beam, v, xi)
    line = line_at(beam, v, xi)
    square = np.sum(line.slope**2, axis=-1)[..., None]
    t = line.slope / np.sqrt(square)
    change = np.cross(line.slope, line.third) / square
    change -= 2.0 * np.sum(line.slope * line.bend, axis=-1)[..., None] / square * K
    shear = C[4, 4] * np.cross(t, change) / np.sqrt(square)
    first, last = axes[:, :-1, None], axes[:, 1:, None]
    across = (1.0 - xi[:, None]) * carried_over(first[..., 1] + 0.0 * t, first[..., 0] + 0.0 * t, t)
    across += xi[:, None] * carried_over(last[..., 1] + 0.0 * t, last[..., 0] + 0.0 * t, t)
    across /= np.linalg.norm(across, axis=-1)[..., None]
    other = np.cross(t, across)
    twist = np.broadcast_to((twists(axes) / lengths)[..., None], stretch.shape)

    def seen(vector: Array) -> tuple[Array, Array]:
        return np.sum(vector * across, axis=-1), np.sum(vector * other, axis=-1)

    strain = np.stack([stretch, 0.0 * stretch, 0.0 * stretch, twist, *seen(K)], axis=-1)
    stress = np.stack(
        [C[0, 0] * stretch, *seen(shear), C[3, 3] * twist, C[4, 4] * strain[..., 4], C[5, 5] * strain[..., 5]], axis=-1
    )
    energy = 0.5 * C[0, 0] * np.einsum("tng,g,n->t", cable_strains(beam, v, full)[0] ** 2, heavy, lengths)
    energy += 0.5 * C[4, 4] * np.einsum("tngi,g,n->t", K**2, weight, lengths)
    energy += 0.5 * C[3, 3] * np.sum(twists(axes) ** 2 / lengths, axis=-1)
    shape = (len(v), -1, 6)
    return Felt(
        _share(beam, xi), np.outer(lengths, weight).ravel(), strain.reshape(shape), stress.reshape(shape), energy
    )


class Felt(Struct):
    """What a beam feels at times t and points p: the Gauss points of its elements, or where its segments meet.

    share : (p,) of the length. weight : (p,) [m]. strain : (t, p, 6) Γ [1] and Κ [1/m], axes of the section, beyond those of the unstressed
    beam. stress : (t, p, 6) force [N] and moment [N m] that go with it. energy : (t,) [J] stored.
    """

    share: Array
    weight: Array
    strain: Array
    stress: Array
    energy: Array
