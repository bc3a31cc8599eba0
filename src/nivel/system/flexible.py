"""Flexible bodies in numbers: the tables of the kernels from reduced bodies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.flexible.body import Interface, ReducedBody
from nivel.flexible.body_file import read_body
from nivel.kernels.flexible_record import Flexible
from nivel.machine.body import Body
from nivel.machine.inertia import MassProperties
from nivel.machine.machine_record import MachineRecord
from nivel.system.located import located
from nivel.system.tables import Array, index_array


@dataclass(frozen=True)
class Bending:
    """A body of the machine that bends: its number, its modes, their damping (n,) [1/s], their places among all of its file."""

    body: int
    reduced: ReducedBody
    damping: Array
    modes: tuple[int, ...]


@dataclass(frozen=True)
class Frame:
    """A frame at an interface: number of the flexible body, number of the interface."""

    flexible: int
    interface: int


def flexible_mass(body: Body) -> MassProperties:
    """Mass, centre and inertia of a flexible body, undeformed. Raises ModelError where its file is none."""
    reduced = reduced_body(body)
    return MassProperties(reduced.mass, reduced.centre_of_mass, reduced.inertia)


def reduced_body(body: Body) -> ReducedBody:
    """The reduced body of a flexible one, with all its modes. Raises ModelError where its file is none."""
    assert body.flexible is not None
    with located(f"bodies.{body.name}.flexible"):
        path = Path(body.flexible.file)
        return _read(str(path.resolve()), path.stat().st_mtime_ns if path.exists() else 0)


@lru_cache(maxsize=64)
def _read(path: str, changed: int) -> ReducedBody:
    del changed  # a file that was written anew is read anew
    return read_body(path)


def bending_bodies(machine: MachineRecord) -> tuple[Bending, ...]:
    """The bodies of the machine that bend, with the modes asked for and their damping 2 ζ ω.

    Raises ModelError naming every body that has fewer modes than are asked for, or a file that is none.
    """
    bending, faults = [], []
    for k, body in enumerate(machine.bodies):
        if body.flexible is None:
            continue
        whole = reduced_body(body)
        count = len(whole.eigenvalues) if body.flexible.modes is None else body.flexible.modes
        if count > len(whole.eigenvalues):
            message = f"{count} modes are asked for, {body.flexible.file} has {len(whole.eigenvalues)}"
            faults.append(Fault("", 0, 0, f"bodies.{body.name}.flexible.modes", message))
            continue
        taken = np.sort(np.argsort(whole.eigenvalues, kind="stable")[:count])
        reduced = whole.keeping(taken)
        damping = 2.0 * body.flexible.damping_ratio * np.sqrt(reduced.eigenvalues)
        bending.append(Bending(k, reduced, damping, tuple(taken.tolist())))
    if faults:
        raise ModelError(faults)
    return tuple(bending)


def no_flexible() -> Flexible:
    """For machines of rigid bodies: all arrays empty."""
    return flexible_tables(0, (), (), ())


def flexible_tables(
    bodies: int, bending: Sequence[Bending], frames: Sequence[Frame], block: Sequence[tuple[int, int, int, int]]
) -> Flexible:
    """For so many bodies, those that bend, the frames at their interfaces and `Flexible.block`."""
    counts = [len(each.reduced.eigenvalues) for each in bending]
    ends = np.cumsum([0, *counts])
    F, n, N, m = len(bending), max(counts, default=0), len(frames), int(ends[-1])
    table = _Padded(bending, n)
    rigid = np.ones(bodies, dtype=np.uint32)
    rigid[[each.body for each in bending]] = 0
    return Flexible(
        body=index_array([each.body for each in bending], 1),
        rigid=rigid,
        mode=index_array(np.column_stack([ends[:-1], ends[1:]]), 2),
        frame=index_array([(frame.flexible, bodies + 1 + k) for k, frame in enumerate(frames)], 2),
        place_b=np.array([_interface(bending, frame).position for frame in frames]).reshape(N, 3),
        shape=_shapes(bending, frames, n),
        I2=np.array([each.reduced.invariants.I2 for each in bending]).reshape(F, 3),
        I3=table.of("I3", (3, n)),
        I4=table.of("I4", (3, n)),
        I5=table.of("I5", (n, 3, n)).reshape(F * n, 3, n),
        I7=table.of("I7", (3, 3)),
        I8=table.of("I8", (n, 3, 3)).reshape(F * n, 3, 3),
        I9=table.of("I9", (n, n, 3, 3)).reshape(F * n * n, 3, 3),
        stiffness=_diagonals([each.reduced.eigenvalues for each in bending], n),
        damping=_diagonals([each.damping for each in bending], n),
        **_stiffening(bending, frames, n),
        block=index_array(block, 4),
        p=np.zeros(m),
        pdot=np.zeros(m),
        pddot=np.zeros(m),
        Q=np.zeros(m),
        first=np.zeros((F, 3)),
        inertia=np.zeros((F, 3, 3)),
        coupling=np.zeros((F, 6, n)),
        static=np.zeros((F, n, 3)),
        drift=np.zeros((F, 3)),
        spin=np.zeros((F, 3)),
        velocity_force=np.zeros((F, 6)),
        now=np.zeros((N, 6, n)),
        displacement=np.zeros((N, 3, n)),
        turn=np.zeros((N, 3, n)),
        bias=np.zeros((N, 6)),
        root=np.zeros((F, 6, 6)),
    )


@dataclass(frozen=True)
class _Padded:
    """Invariants of all flexible bodies, padded with zeros to n modes."""

    bending: Sequence[Bending]
    n: int

    def of(self, name: str, shape: tuple[int, ...]) -> Array:
        out = np.zeros((len(self.bending), *shape))
        for f, each in enumerate(self.bending):
            value = getattr(each.reduced.invariants, name)
            out[(f, *(slice(length) for length in value.shape))] = value
        return out


def _diagonals(values: Sequence[Array], n: int) -> Array:
    out = np.zeros((len(values), n, n))
    for f, each in enumerate(values):
        out[f, range(len(each)), range(len(each))] = each
    return out


def _interface(bending: Sequence[Bending], frame: Frame) -> Interface:
    return bending[frame.flexible].reduced.interfaces[frame.interface]


def _shapes(bending: Sequence[Bending], frames: Sequence[Frame], n: int) -> Array:
    out = np.zeros((len(frames), 6, n))
    for k, frame in enumerate(frames):
        interface = _interface(bending, frame)
        out[k, :3, : interface.phi.shape[1]] = interface.phi
        if interface.turns:
            out[k, 3:, : interface.psi.shape[1]] = interface.psi
    return out


def _stiffening(bending: Sequence[Bending], frames: Sequence[Frame], n: int) -> dict[str, Array]:
    """The tables of geometric stiffening, without numbers where no body has any."""
    F, N = len(bending), len(frames)
    if not any(each.reduced.stiffening for each in bending):
        F = N = 0
    out = {
        "of_acceleration": np.zeros((F, 3, n, n)),
        "of_turning": np.zeros((F, 3, n, n)),
        "of_spin": np.zeros((F, 6, n, n)),
        "of_load": np.zeros((N, 6, n, n)),
    }
    causes = {"of_acceleration": "acceleration", "of_turning": "angular_acceleration", "of_spin": "centrifugal"}
    for f, each in enumerate(bending[:F]):
        for table, cause in causes.items():
            if cause in each.reduced.stiffening:
                value = each.reduced.stiffening[cause]
                out[table][f, :, : value.shape[1], : value.shape[2]] = value
    for k, frame in enumerate(frames[:N]):
        value = bending[frame.flexible].reduced.stiffening.get(f"interface.{_interface(bending, frame).name}")
        if value is not None:
            out["of_load"][k, : len(value), : value.shape[1], : value.shape[2]] = value
    return {table: value.reshape(value.shape[0] * value.shape[1], n, n) for table, value in out.items()}


def modal_blocks(count: int) -> int:
    """Blocks of six that so many modes take in the saddle."""
    return -(-count // 6)


def first_modal_rows(bodies: int, bending: Sequence[Bending]) -> NDArray[np.int64]:
    """Row of z where the modes of each flexible body begin, then one past the last."""
    return bodies + np.cumsum([0, *(modal_blocks(len(each.reduced.eigenvalues)) for each in bending)])
