"""Flexible bodies in numbers: the tables of the kernels from reduced bodies."""

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, located, refuse
from nivel.flexible.body.invariants import Invariants
from nivel.kernels.bodies.geometric_stiffening import FIRST_AXIS, SECOND_AXIS
from nivel.kernels.record.flexible_record import Flexible, ModalTree
from nivel.known import Interface, ReducedBody
from nivel.lazy import Struct, nivel, replace
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import MassProperties
from nivel.machine.machine_record import MachineRecord
from nivel.system.beam_nodes import GradientNode
from nivel.system.tables import Array, index_array, zeros

# of what ω_a ω_b does in each component of a symmetric tensor: those off the diagonal count twice
SHARE = np.array([1.0, 1.0, 1.0, 0.5, 0.5, 0.5])


class Bending(Struct):
    """A body of the machine that bends: its number, its modes, their damping (n,) [1/s], their places among all of its file, names of the
    inertia invariants that it moves without. beam : name of the beam whose node it is, empty for all others."""

    body: int
    reduced: ReducedBody
    damping: Array
    modes: tuple[int, ...]
    neglected: tuple[str, ...] = ()
    beam: str = ""

    @property
    def invariants(self) -> Invariants:
        """Those that it moves with."""
        its = self.reduced.invariants
        return replace(its, **{name: np.zeros_like(getattr(its, name)) for name in self.neglected})


class Frame(Struct):
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
    if isinstance(body.flexible, GradientNode):
        return body.flexible.reduced
    with located(f"bodies.{body.name}.flexible"):
        path = Path(body.flexible.file)
        return _read(str(path.resolve()), path.stat().st_mtime_ns if path.exists() else 0)


@lru_cache(maxsize=64)
def _read(path: str, changed: int) -> ReducedBody:
    del changed  # a file that was written anew is read anew
    return nivel.flexible.body.body_file.read_body(path)


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
            faults.append(Fault.at(f"bodies.{body.name}.flexible.modes", message))
            continue
        taken = np.sort(np.argsort(whole.eigenvalues, kind="stable")[:count])
        reduced = whole.keeping(taken)
        damping = 2.0 * body.flexible.damping_ratio * np.sqrt(reduced.eigenvalues)
        beam = body.flexible.beam if isinstance(body.flexible, GradientNode) else ""
        bending.append(Bending(k, reduced, damping, tuple(taken.tolist()), body.flexible.neglect, beam))
    refuse(faults)
    return tuple(bending)


def no_flexible() -> Flexible:
    """For machines of rigid bodies: all arrays empty."""
    return flexible_tables(0, (), (), ())


def no_modal_tree() -> ModalTree:
    """For other than relative coordinates with flexible bodies: all arrays empty."""
    return modal_tree((), (), (), 0, 0, 0)


def modal_tree(
    link: Sequence[int], carrier: Sequence[int], heavy: Sequence[bool], modes: int, most: int, bundle: int
) -> ModalTree:
    """Tables as in `ModalTree` for so many modes, the most of one body and rows in the largest bundle."""
    F = len(carrier)
    return ModalTree(
        link=index_array(link, 1),
        carrier=index_array(carrier, 1),
        heavy=index_array(heavy, 1),
        **zeros("shift effort", modes),
        **zeros("column coupling", F, 6, most),
        factor=np.zeros((F, most, most + 6)),
        push=np.zeros((6, most)),
        load=np.zeros((bundle, modes)),
    )


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
    I8, I9, stiffening = table.of("I8", (n, 3, 3)), table.of("I9", (n, n, 3, 3)), _stiffening(bending, frames, n)
    turning = table.of("I5", (n, 3, n)).transpose(0, 2, 1, 3)
    spin = stiffening.pop("of_spin")
    return Flexible(
        body=index_array([each.body for each in bending], 1),
        rigid=rigid,
        mode=index_array(np.column_stack([ends[:-1], ends[1:]]), 2),
        terms=index_array([_terms(each) for each in bending], 3),
        frame=index_array([(frame.flexible, bodies + 1 + k) for k, frame in enumerate(frames)], 2),
        loaded=index_array(stiffening["of_load"].any(axis=(1, 2, 3)), 1),
        place_b=np.array([_interface(bending, frame).position for frame in frames]).reshape(N, 3),
        shape=_shapes(bending, frames, n),
        I2=np.array([each.reduced.invariants.I2 for each in bending]).reshape(F, 3),
        I3=table.of("I3", (3, n)),
        I4=table.of("I4", (3, n)),
        I5=_beside(turning),
        I7=table.of("I7", (3, 3)),
        I8=np.ascontiguousarray(_components(I8).transpose(0, 2, 1)),
        stiffness=_rows([each.reduced.eigenvalues for each in bending], n),
        damping=_rows([each.damping for each in bending], n),
        of_inertia=_beside(_components(I9).transpose(0, 3, 1, 2) - SHARE[:, None, None] * spin),
        of_coupling=_beside(turning + stiffening["of_turning"]),
        **{name: _beside(value) for name, value in stiffening.items()},
        block=index_array(block, 4),
        **zeros("p pdot pddot Q", m),
        first=np.zeros((F, 3)),
        inertia=np.zeros((F, 3, 3)),
        coupling=np.zeros((F, 6, n)),
        bulge=np.zeros((F, 6 * n)),
        velocity_force=np.zeros((F, 6)),
        scratch=np.zeros((2, 6 * n)),
        now=np.zeros((N, 6, n)),
        node=np.zeros((N, 29)),
        **zeros("displacement turn", N, 3, n),
        bias=np.zeros((N, 6)),
        root=np.zeros((F, 6, 6)),
    )


class _Padded(Struct):
    """Invariants of all flexible bodies, padded with zeros to n modes."""

    bending: Sequence[Bending]
    n: int

    def of(self, name: str, shape: tuple[int, ...]) -> Array:
        out = np.zeros((len(self.bending), *shape))
        for f, each in enumerate(self.bending):
            value = getattr(each.invariants, name)
            out[(f, *(slice(length) for length in value.shape))] = value
        return out


def _terms(bending: Bending) -> tuple[int, int, int]:
    """`Flexible.terms` of one body."""
    its, stiff = bending.invariants, bool(bending.reduced.stiffening)
    return int(np.any(its.I5)), int(stiff or np.any(its.I9)), int(stiff)


def _components(tensors: Array) -> Array:
    """(…, 6) xx, yy, zz, xy, yz, zx of the symmetric part of (…, 3, 3), symmetric too in the two indices before if there are two."""
    both = 0.5 * (tensors + np.swapaxes(tensors, -1, -2))
    if both.ndim == 5:
        both = 0.5 * (both + np.swapaxes(both, 1, 2))
    return both[..., FIRST_AXIS, SECOND_AXIS]


def _beside(tables: Array) -> Array:
    """(F n, c n) from c matrices of each of F bodies (F, c, n, n)."""
    F, c, n, _ = tables.shape
    return np.ascontiguousarray(tables.transpose(0, 2, 1, 3)).reshape(F * n, c * n)


def _rows(values: Sequence[Array], n: int) -> Array:
    out = np.zeros((len(values), n))
    for f, each in enumerate(values):
        out[f, : len(each)] = each
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
    """The tables of geometric stiffening (·, ·, n, n), zero where a body has none."""
    F, N = len(bending), len(frames)
    out = {
        "of_acceleration": np.zeros((F, 3, n, n)),
        "of_turning": np.zeros((F, 3, n, n)),
        "of_spin": np.zeros((F, 6, n, n)),
        "of_load": np.zeros((N, 6, n, n)),
    }
    causes = {"of_acceleration": "acceleration", "of_turning": "angular_acceleration", "of_spin": "centrifugal"}
    for f, each in enumerate(bending):
        for table, cause in causes.items():
            if cause in each.reduced.stiffening:
                value = each.reduced.stiffening[cause]
                out[table][f, :, : value.shape[1], : value.shape[2]] = value
    for k, frame in enumerate(frames):
        value = bending[frame.flexible].reduced.stiffening.get(f"interface.{_interface(bending, frame).name}")
        if value is not None:
            out["of_load"][k, : len(value), : value.shape[1], : value.shape[2]] = value
    return {table: 0.5 * (value + np.swapaxes(value, -1, -2)) for table, value in out.items()}


def first_modal_rows(bodies: int, bending: Sequence[Bending]) -> NDArray[np.int64]:
    """Row of z where the modes of each flexible body begin, then one past the last."""
    return bodies + np.cumsum([0, *(-(-len(each.reduced.eigenvalues) // 6) for each in bending)])
