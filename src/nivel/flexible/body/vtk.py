"""Flexible bodies for ParaView: a .pvd file that lists one .vtu file for each mode or moment."""

import base64
import struct
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Final
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.files.target import write_file
from nivel.flexible.body.body import ReducedBody
from nivel.flexible.body.recovery import displacement, signed_principal, stress, von_mises
from nivel.machine.core.vectors import Array

State = tuple[float, Array, dict[str, Array]]  # time, places of nodes, fields at them

LINE, TRIANGLE, TETRAHEDRON, TETRAHEDRON_10 = 3, 5, 10, 24  # VTK's numbers of cells
AMPLITUDE: Final = 0.1  # of the size of the body: displacement of a mode


def write_modes(body: ReducedBody, path: str | Path) -> list[Path]:
    """Write the modes, one after the other as if in time, with their modal stress. Returns the files, the .pvd first.

    `displacement` is scaled to a tenth of the size of the body; warp by it with a factor of one.
    """
    size = float(np.linalg.norm(np.ptp(body.position, axis=0)))
    largest = np.linalg.norm(np.nan_to_num(body.modes[:, :3]), axis=1).max(axis=0)
    states = []
    for k in range(len(body.eigenvalues)):
        q = np.zeros(len(body.eigenvalues))
        q[k] = AMPLITUDE * size / largest[k] if largest[k] > 0.0 else 1.0
        states.append((float(k + 1), body.position, _fields(body, q)))
    return _collection(body, Path(path), states)


def write_motion(
    body: ReducedBody,
    path: str | Path,
    times: Iterable[float],
    q: Array,
    position: Array | None = None,
    rotation: Array | None = None,
) -> list[Path]:
    """Write a motion: nodes where they are in space, with displacement and stress. Returns the files, the .pvd first.

    times : (t,) [s]; q : (t, n); position : (t, 3) [m] of the body frame and rotation : (t, 3, 3), default at rest.
    """

    def states() -> Iterator[State]:
        for k, time in enumerate(times):
            place = body.position + displacement(body, q[k])[0]
            if rotation is not None:
                place = place @ rotation[k].T
            if position is not None:
                place = place + position[k]
            yield float(time), place, _fields(body, q[k])

    return _collection(body, Path(path), states())


def _fields(body: ReducedBody, q: Array) -> dict[str, Array]:
    out = {"displacement": displacement(body, q)[0]}
    if body.stress is not None:
        now, nodes = stress(body, q)[0], body.stress.station_node
        largest, highest, lowest = np.zeros((3, len(body.position)))
        np.maximum.at(largest, nodes, von_mises(now))
        signed = signed_principal(now)
        np.maximum.at(highest, nodes, signed)
        np.minimum.at(lowest, nodes, signed)
        out["von_mises_stress"] = largest
        out["signed_principal_stress"] = np.where(-lowest > highest, lowest, highest)
    return out


def _collection(body: ReducedBody, path: Path, states: Iterable[State]) -> list[Path]:
    if path.suffix != ".pvd":
        raise ModelError(f"{path}: the name of a VTK collection ends with .pvd")
    files, lines = [], []
    for k, (time, place, fields) in enumerate(states):
        piece = path.with_name(f"{path.stem}-{k + 1:04d}.vtu")
        write_file(piece, "VTK file", _grid(body, place, fields))
        files.append(piece)
        lines.append(f'<DataSet timestep="{time!r}" part="0" file={quoteattr(piece.name)}/>')
    text = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">\n<Collection>\n'
    write_file(path, "VTK file", text + "\n".join(lines) + "\n</Collection>\n</VTKFile>\n")
    return [path, *files]


def _grid(body: ReducedBody, place: Array, fields: Mapping[str, Array]) -> str:
    cells = _cells(body)
    kinds = np.repeat(np.array([kind for _, kind in cells], dtype=np.uint8), [len(nodes) for nodes, _ in cells])
    corners = np.concatenate([np.zeros(0), *(nodes.ravel() for nodes, _ in cells)])
    offsets = np.cumsum([len(row) for nodes, _ in cells for row in nodes])
    data = "".join(_array(name, values) for name, values in fields.items())
    return (
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        f'<UnstructuredGrid><Piece NumberOfPoints="{len(place)}" NumberOfCells="{len(kinds)}">\n'
        f"<Points>{_array('Points', place)}</Points>\n"
        f"<Cells>{_array('connectivity', corners.astype(np.int64))}{_array('offsets', offsets.astype(np.int64))}"
        f"{_array('types', kinds)}</Cells>\n<PointData>{data}</PointData>\n</Piece></UnstructuredGrid></VTKFile>\n"
    )


def _cells(body: ReducedBody) -> list[tuple[NDArray[np.int64], int]]:
    """Nodes of cells of one kind, and VTK's number of this."""
    if len(body.solids):
        return [(body.solids, TETRAHEDRON_10 if body.solids.shape[1] == 10 else TETRAHEDRON)]
    return [(body.triangles, TRIANGLE), (body.lines, LINE)]


def _array(name: str, values: NDArray) -> str:
    """An array in base64, after its length in bytes."""
    kind = {"f": "Float64", "i": "Int64", "u": "UInt8"}[values.dtype.kind]
    content = np.ascontiguousarray(values).tobytes()
    text = base64.b64encode(struct.pack("<Q", len(content)) + content).decode()
    parts = values.shape[1] if values.ndim > 1 else 1
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{parts}" format="binary">{text}</DataArray>'
