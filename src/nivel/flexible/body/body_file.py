"""Body files: a reduced body as NetCDF-4, written once and read in a moment."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import fields
from io import BytesIO
from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel import __version__
from nivel.errors import ModelError
from nivel.files.target import write_file
from nivel.flexible.body.body import Array, Interface, LeftOut, MeshError, ReducedBody, StressModes
from nivel.flexible.body.invariants import Invariants
from nivel.lazy import h5py

KIND: Final = "flexible body"
FORMAT: Final = 1
AXES: Final = ("x", "y", "z", "rx", "ry", "rz")
STRESS: Final = ("xx", "yy", "zz", "xy", "yz", "zx")
PAIRS: Final = ("xx", "yy", "zz", "xy", "yz", "zx")

# Units and dimensions of the variables; `mode_` is a second dimension of the length of `mode`, for NetCDF wants each only once.
INVARIANTS: Final = {
    "I1": ("kg",),
    "I2": ("kg m", "xyz"),
    "I3": ("kg^0.5", "xyz", "mode"),
    "I4": ("kg^0.5 m", "xyz", "mode"),
    "I5": ("1", "mode", "xyz", "mode_"),
    "I6": ("1", "mode", "mode_"),
    "I7": ("kg m^2", "xyz", "xyz_"),
    "I8": ("kg^0.5 m", "mode", "xyz", "xyz_"),
    "I9": ("1", "mode", "mode_", "xyz", "xyz_"),
}
STIFFENING_DIMS: Final = {"acceleration": "xyz", "angular_acceleration": "xyz", "centrifugal": "pair"}
LEFT_OUT: Final = {
    "eigenvalues": (("left_mode",), "1/s^2", "stiffness, unit modal mass"),
    "phi": (("interface", "axis", "left_mode"), "kg^-0.5", "displacement and turn [kg^-0.5 m^-1] of the interfaces"),
    "mass": (("left_mode", "mode"), "1", "mass in common with the modes"),
    "stiffness": (("left_mode", "mode"), "1/s^2", "stiffness in common with the modes"),
    "I3": (("xyz", "left_mode"), "kg^0.5", "inertia invariant I3"),
    "I4": (("xyz", "left_mode"), "kg^0.5 m", "inertia invariant I4"),
    "I8": (("left_mode", "xyz", "xyz_"), "kg^0.5 m", "inertia invariant I8"),
}
DYNAMIC: Final = ", where it accelerates"
STIFFENING_UNITS: Final = {"acceleration": "1/m", "angular_acceleration": "1", "centrifugal": "1"}


def write_body(
    body: ReducedBody, path: str | Path, *, findings: Mapping[str, Any] | None = None, model: str = ""
) -> None:
    """Write `body` to `path`, replacing what is there. `findings` and the text of the `model` file are kept beside it.

    Raises ModelError where the file cannot be written.
    """
    content = BytesIO()  # HDF5 ends the process where a disk is full
    with h5py.File(content, "w", libver=("v108", "v108"), track_order=True) as file:
        _write(_Writer(file), body)
        file.attrs.update(
            {
                "kind": KIND,
                "format": FORMAT,
                "nivel_version": __version__,
                "Conventions": "CF-1.11",
                "name": body.name,
                "reference": body.reference,
                "held": json.dumps(body.held),
                "mass_kind": body.mass_kind,
                "source": body.source,
                "findings": json.dumps(findings or {}),
                "model": model,
            }
        )
    write_file(path, "body file", content.getbuffer())


class _Writer:
    """Variables with dimensions, units and a long name, as NetCDF-4 has them."""

    def __init__(self, file: h5py.File) -> None:
        self.file = file
        self.scales: dict[str, Any] = {}

    def names(self, dimension: str, names: tuple[str, ...]) -> None:
        """A dimension whose places have names."""
        data = np.array(names, dtype=object)
        self._scale(dimension, self.file.create_dataset(dimension, data=data, dtype=h5py.string_dtype()))

    def length(self, dimension: str, length: int) -> None:
        """A dimension whose places are numbers from 1."""
        self._scale(dimension, self.file.create_dataset(dimension, data=np.arange(1, length + 1)))

    def _scale(self, dimension: str, dataset: Any) -> None:
        dataset.make_scale(dimension)
        self.scales[dimension] = dataset

    def put(self, name: str, data: Any, dims: Sequence[str], units: str, long_name: str) -> None:
        """A variable."""
        dataset = self.file.create_dataset(name, data=data)
        dataset.attrs.update({"units": units, "long_name": long_name})
        for axis, dim in enumerate(dims):
            dataset.dims[axis].attach_scale(self.scales[dim])


def _write(out: _Writer, body: ReducedBody) -> None:
    count = len(body.eigenvalues)
    names = body.mode_names or tuple(f"mode {k + 1}" for k in range(count))
    for dimension, words in (
        ("mode", names),
        ("mode_", names),
        ("xyz", AXES[:3]),
        ("xyz_", AXES[:3]),
        ("axis", AXES),
        ("stress_component", STRESS),
        ("pair", PAIRS),
    ):
        out.names(dimension, tuple(words))
    for dimension, length in (("node", len(body.node_ids)), ("corner", 3), ("end", 2)):
        out.length(dimension, length)
    out.put("eigenvalue", body.eigenvalues, ("mode",), "1/s^2", "stiffness of the modes of unit modal mass")
    out.put("frequency", body.frequencies, ("mode",), "Hz", "frequency of the modes for the reference conditions")
    for name, (units, *dims) in INVARIANTS.items():
        out.put(name, getattr(body.invariants, name), dims, units, f"inertia invariant {name}")
    out.put("node_id", body.node_ids, ("node",), "1", "number of the node in the model")
    out.put("node_position", body.position, ("node", "xyz"), "m", "undeformed place in the body frame")
    text = "displacement [kg^-0.5] and turn [kg^-0.5 m^-1] of nodes by the modes"
    out.put("node_mode", body.modes, ("node", "axis", "mode"), "kg^-0.5", text)
    if body.loads is not None:
        text = "forces [N] and moments [N m] at nodes for a modal coordinate of one"
        out.put("node_load", body.loads, ("node", "axis", "mode"), "N kg^-0.5 m^-1", text)
    out.names("interface", tuple(each.name for each in body.interfaces))
    nodes = np.array([each.node for each in body.interfaces], dtype=np.int64)
    out.put("interface_node", nodes, ("interface",), "1", "place of the node of the interface, from 0")
    turns = np.array([each.turns for each in body.interfaces], dtype=np.int8)
    out.put("interface_turns", turns, ("interface",), "1", "1 where the turn of the node is known")
    _write_meshes(out, body)
    if body.stress is not None:
        _write_stress(out, body.stress)
    for name, matrices in body.stiffening.items():
        _write_stiffening(out, name, matrices)
    if body.left_out is not None:
        _write_left_out(out, body.left_out)
    if body.mesh_error is not None:
        name = "mesh_error.dynamic" if body.mesh_error.dynamic else "mesh_error"
        text = "share by which the energy of the mode is wrong, estimated" + DYNAMIC * body.mesh_error.dynamic
        out.put(name, body.mesh_error.share, ("mode",), "1", text)


def _write_meshes(out: _Writer, body: ReducedBody) -> None:
    for name, mesh in (("triangle", body.triangles), ("line", body.lines), ("solid", body.solids)):
        out.length(name, len(mesh))
        out.length(f"{name}_corner", mesh.shape[1])
        out.put(f"{name}_node", mesh, (name, f"{name}_corner"), "1", "places of nodes, from 0")


def _write_stress(out: _Writer, stress: StressModes) -> None:
    out.length("station", len(stress.station_node))
    out.put("station_node", stress.station_node, ("station",), "1", "place of the node of the stress station, from 0")
    dims = ("station", "stress_component", "mode")
    out.put("stress_mode", stress.modes, dims, "Pa kg^-0.5 m^-1", "stress for a modal coordinate of one")
    if stress.strain is not None:
        out.put(
            "strain_mode", stress.strain, dims, "kg^-0.5 m^-1", "strain for a modal coordinate of one, shear as gamma"
        )
    if stress.labels:
        out.names("station_label", stress.labels)


def _write_stiffening(out: _Writer, name: str, matrices: Array) -> None:
    first = STIFFENING_DIMS.get(name, "axis")
    if first == "axis" and len(matrices) == 3:
        first = "xyz"
    units = STIFFENING_UNITS.get(name, "kg^-1 m^-1")
    out.put(f"stiffening.{name}", matrices, (first, "mode", "mode_"), units, f"geometric stiffness for unit {name}")


def _write_left_out(out: _Writer, left: LeftOut) -> None:
    out.length("left_mode", len(left.eigenvalues))
    for field in fields(left):
        name, (dims, units, text) = field.name, LEFT_OUT[field.name]
        out.put(f"left_out.{name}", getattr(left, name), dims, units, f"modes that are left out: {text}")


def read_body(path: str | Path) -> ReducedBody:
    """The body in the file at `path`.

    Raises ModelError where there is none.
    """
    try:
        with h5py.File(path, "r") as file:
            _check_kind(file, path)
            return _read(file)
    except FileNotFoundError:
        raise ModelError(f"there is no body file {path}; `nivel reduce MODEL -o {path}` makes one") from None
    except IsADirectoryError:
        raise ModelError(f"{path} is a folder; a body file was expected") from None
    except (OSError, RuntimeError, MemoryError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise ModelError(f"{path} is not a body file of nivel: {error}") from None


def _check_kind(file: h5py.File, path: str | Path) -> None:
    if file.attrs.get("kind") != KIND:
        raise ModelError(f"{path} is no body file of nivel; `nivel reduce MODEL -o body.nc` makes one")
    if file.attrs.get("format") != FORMAT:
        raise ModelError(
            f"{path} has format {file.attrs.get('format')}, this nivel reads {FORMAT}: reduce the model again"
        )


def _read(file: Any) -> ReducedBody:
    def array(name: str) -> Any:
        return file[name][()]

    invariants = Invariants(**{name: array(name) for name in INVARIANTS})
    modes, position = array("node_mode"), array("node_position")
    names = [str(name) for name in file["interface"].asstr()[()]]
    interfaces = tuple(
        Interface(name, int(node), position[node], modes[node, :3], np.nan_to_num(modes[node, 3:]), bool(turns))
        for name, node, turns in zip(names, array("interface_node"), array("interface_turns"), strict=True)
    )
    stress = None
    if "stress_mode" in file:
        labels = tuple(file["station_label"].asstr()[()]) if "station_label" in file else ()
        strain = array("strain_mode") if "strain_mode" in file else None
        stress = StressModes(array("station_node"), labels, array("stress_mode"), strain)
    prefix = "stiffening."
    return ReducedBody(
        name=str(file.attrs["name"]),
        eigenvalues=array("eigenvalue"),
        invariants=invariants,
        interfaces=interfaces,
        node_ids=array("node_id"),
        position=position,
        modes=modes,
        reference=str(file.attrs["reference"]),
        held=tuple(json.loads(str(file.attrs["held"]))),
        mass_kind=str(file.attrs["mass_kind"]),
        mode_names=tuple(file["mode"].asstr()[()]),
        stress=stress,
        stiffening={name.removeprefix(prefix): array(name) for name in file if name.startswith(prefix)},
        triangles=array("triangle_node"),
        lines=array("line_node"),
        solids=array("solid_node"),
        source=str(file.attrs["source"]),
        mesh_error=_mesh_error(file),
        loads=array("node_load") if "node_load" in file else None,
        left_out=LeftOut(**{name: array(f"left_out.{name}") for name in LEFT_OUT}) if "left_mode" in file else None,
    )


def _mesh_error(file: Any) -> MeshError | None:
    for name, dynamic in (("mesh_error", False), ("mesh_error.dynamic", True)):
        if name in file:
            return MeshError(file[name][()], dynamic)
    return None


def fingerprint(body: ReducedBody) -> str:
    """Of the nodes, their modes and the frequencies: what gives modal coordinates a meaning. Stresses may be added to a body later."""
    digest = hashlib.sha256()
    for values in (body.eigenvalues, body.node_ids, body.position, body.modes):
        digest.update(repr(values.shape).encode())
        digest.update(np.ascontiguousarray(values).tobytes())
    return digest.hexdigest()
