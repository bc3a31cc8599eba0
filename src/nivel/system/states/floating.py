"""q = (R, θ of every body, p), v = (Ṙ, ω̄ of every body, ṗ): with the modes of flexible bodies, which start undeformed.

A machine is assembled with its flexible bodies rigid. Here their markers move to frames at the interfaces, which are bodies behind the
ground, and every block of C_q of such a marker gets further ones for the modes.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.kernels.bodies.floating_dynamics import pass_flexible, solve_flexible
from nivel.kernels.record.record import FACTORS, MODES, NONE, Bodies, Friction, Record, Saddle
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.shape import Mesh
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.system.elimination.elimination import plan
from nivel.system.elimination.partition import RELUCTANCE, partition, velocities_named
from nivel.system.flexible import Bending, Frame, bending_bodies, first_modal_rows, flexible_tables
from nivel.system.joint_frames import marker_place
from nivel.system.layout import first_columns, with_modal_coordinates
from nivel.system.system import Array, StateMap, System
from nivel.system.tables import index_array, longer, work_arrays

Blocks = list[tuple[int, int, int, int]]


# A marker belongs to an interface this near, as a share of the extent of the body.
NEAR = 1e-4


def arrange(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The machine with modes, undeformed at the start.

    Raises ModelError naming every marker of a flexible body that is at no interface of it.
    """
    del settings
    bending = bending_bodies(machine)
    system, start = with_modes(absolute, y, rank, bending, carried_markers(absolute, machine, bending))
    hooks = system.record.hooks
    address = hooks.address.copy()
    address[MODES], address[FACTORS] = pass_flexible.address, solve_flexible.address
    return replace(system, record=system.record._replace(hooks=hooks._replace(address=address))), start


def carried_markers(absolute: System, machine: MachineRecord, bending: Sequence[Bending]) -> dict[int, tuple[int, int]]:
    """Flexible body and interface of every marker that is at one.

    Raises ModelError naming every joint, force, sensor and marker, also one that nothing uses, and every shape that is at none.
    """
    markers, found, faults = absolute.record.markers, {}, []
    for f, each in enumerate(bending):
        body, used = machine.bodies[each.body], set()
        for marker in np.flatnonzero(markers.body == each.body).tolist():
            if marker in absolute.frame_markers:
                continue
            owner, point = absolute.marker_owners[marker], markers.position_b[marker]
            if each.beam and owner != f"beams.{each.beam}":
                continue  # everything but its gradients is fixed to the frame of a node
            used.add(owner)
            nearest = interface_at(each, point)
            if nearest is None:
                faults.append(_away(owner, body.name, point, each))
            else:
                found[marker] = (f, nearest)
        for owner, point in () if each.beam else _further(machine, body):
            if owner not in used and interface_at(each, point) is None:
                faults.append(_away(owner, body.name, point, each))
    if faults:
        raise ModelError(list(dict.fromkeys(faults)))
    return found


def interface_at(bending: Bending, point: Array) -> int | None:
    """Which interface of a flexible body is at `point` (3,) [m] in its frame."""
    reduced = bending.reduced
    extent = float(np.ptp(reduced.position, axis=0).max(initial=0.0))
    places = np.array([interface.position for interface in reduced.interfaces]).reshape(-1, 3)
    distance = np.linalg.norm(places - point, axis=1)
    return int(np.argmin(distance)) if np.any(distance <= NEAR * extent) else None


def _further(machine: MachineRecord, body: Body) -> Iterator[tuple[str, Array]]:
    """What belongs to a flexible body whether or not something uses it: its markers, and its shape."""
    for marker in machine.markers:
        if marker.body == body.name:
            yield f"markers.{marker.name}", marker_place(machine, marker)[1]
    if body.shape is not None and not isinstance(body.shape, Mesh):
        yield f"bodies.{body.name}.shape", np.array(body.shape.centre or (0.0, 0.0, 0.0), dtype=float)


def _away(owner: str, body: str, point: Array, bending: Bending) -> Fault:
    """The fault of an element that acts on a flexible body where it has no interface."""

    def place(values: Array) -> str:
        return ", ".join(f"{value:.6g}" for value in values)

    there = ", ".join(f"{each.name} at ({place(each.position)})" for each in bending.reduced.interfaces)
    message = (
        f"is at ({place(point)}) m in the axes of the flexible body `{body}`, where it has no interface; they are {there or 'none'}: "
        f"name one of them as `interface`, move it there, or add an interface to the model and reduce it again"
    )
    return Fault.at(owner, message)


def with_modes(
    absolute: System, y: Array, rank: int, bending: Sequence[Bending], carried: dict[int, tuple[int, int]]
) -> tuple[System, Array]:
    """The system, in coordinates of single bodies, with those that are `bending`, and its state for y of the rigid one.

    carried : markers at interfaces: (number of the flexible body, number of the interface).
    """
    old, count = absolute.record, absolute.body_count
    places = sorted(set(carried.values()))
    frames = [Frame(*place) for place in places]
    markers = old.markers._replace(body=old.markers.body.copy(), position_b=old.markers.position_b.copy())
    for marker, place in carried.items():
        k = places.index(place)
        markers.body[marker] = count + 1 + k
        markers.position_b[marker] -= bending[place[0]].reduced.interfaces[place[1]].position
    at = {marker: places.index(place) for marker, place in carried.items()}
    saddle, block = _saddle(old, count, bending, at)
    flexible = flexible_tables(count, bending, frames, block)
    record = old._replace(
        markers=markers,
        bodies=_with_frames(old.bodies, len(frames)),
        saddle=saddle,
        flexible=flexible,
        friction=_with_modal_blocks(old.friction, saddle, len(old.constraints.C)),
    )
    record = record._replace(
        frames=record.frames._replace(
            R=record.bodies.R, theta=record.bodies.theta, Rdot=record.bodies.Rdot, Rddot=record.bodies.Rddot
        )
    )
    modes = len(flexible.p)
    names = tuple(
        f"{absolute.bodies[each.body]}.{k + 1}" for each in bending for k in range(len(each.reduced.eigenvalues))
    )
    layout = with_modal_coordinates(absolute.layout, names)
    system = replace(
        absolute,
        record=record._replace(
            outputs=old.outputs._replace(column=index_array(first_columns(layout, absolute.states), 1))
        ),
        layout=layout,
        state_map=_map(absolute, modes),
        start=np.zeros(0),
        modes=names,
        gradient_sizes=_gradient_sizes(bending),
    )
    positions, end = absolute.positions, _end_of_velocities(absolute)
    start = np.concatenate([y[:positions], np.zeros(modes), y[positions:end], np.zeros(modes), y[end:]])
    return system.known_rank(rank), start


def _gradient_sizes(bending: Sequence[Bending]) -> Array:
    """(modes,) [kg^½ m] √m times reach of nodes of beams, 0 for the modes of other bodies."""
    return np.array(
        [
            np.sqrt(each.reduced.mass) * float(np.ptp(each.reduced.position, axis=0).max()) if each.beam else 0.0
            for each in bending
            for _ in each.reduced.eigenvalues
        ]
    )


def _with_frames(bodies: Bodies, frames: int) -> Bodies:
    """With work arrays for frames behind the ground."""
    return bodies._replace(**{name: longer(array, len(array) + frames) for name, array in work_arrays(bodies).items()})


def _with_modal_blocks(friction: Friction, saddle: Saddle, rows: int) -> Friction:
    """With the places of the extra rows' blocks among all, those of modes too. rows : of the constraints."""
    extra = saddle.block[int(saddle.blocks[0]) :, 0]
    ends = int(saddle.blocks[0]) + np.searchsorted(extra, rows + np.arange(len(friction.force) + 1))
    return friction._replace(
        block=index_array(np.column_stack([ends[:-1], ends[1:]]), 2),
        change=np.zeros((len(friction.force), *saddle.z.shape)),
    )


def _saddle(old: Record, count: int, bending: Sequence[Bending], at: dict[int, int]) -> tuple[Saddle, Blocks]:
    """The saddle with blocks for the modes, and `Flexible.block`."""
    flexible_of = {each.body: f for f, each in enumerate(bending)}
    first = first_modal_rows(count, bending)
    own = int(old.saddle.blocks[0])
    rows: Blocks = []
    table: Blocks = []
    kept = -1  # blocks of the first group
    for group in (old.saddle.block[:own].tolist(), old.saddle.block[own:].tolist()):
        for row, part, marker, body in group:
            rows.append((row, part, marker, body))
            if body not in flexible_of or part == NONE:
                continue
            f = flexible_of[body]
            table.append((len(rows) - 1, at.get(marker, NONE), f, len(rows)))
            if marker in at:
                rows += [(row, part, marker, int(first[f]) + k) for k in range(int(first[f + 1] - first[f]))]
        kept = len(rows) if kept < 0 else kept
    block = index_array(rows, 4)
    groups = [list(range(a, b)) for a, b in old.joints.rows.tolist() if b > a]
    named = {row for group in groups for row in group}
    groups += [[row] for row in range(len(old.saddle.row)) if row not in named]
    elimination = plan(groups, block[:kept, 0].tolist(), block[:kept, 3].tolist())
    saddle = old.saddle._replace(
        block=block,
        blocks=np.array([kept], dtype=np.uint32),
        **vars(elimination),
        W=np.zeros((len(block), old.saddle.W.shape[1])),
        z=np.zeros((int(first[-1]), old.saddle.z.shape[1])),
        S=np.zeros(len(elimination.S_row)),
        L=np.zeros(len(elimination.L_row)),
    )
    return saddle, table


def _end_of_velocities(rigid: System) -> int:
    """One past the last velocity in its state."""
    return len(rigid.map.units) - len(rigid.start_of_states)


def _map(rigid: System, modes: int) -> StateMap:
    """What the entries of y are: modal coordinates stand behind all other positions, their rates behind all other velocities."""
    old, positions, end = rigid.map, rigid.positions, _end_of_velocities(rigid)

    def place(index: int) -> int:
        return index if index < positions else index + modes if index < end else index + 2 * modes

    plain = [(place(q), place(v)) for q, v in old.plain.tolist()]
    plain += [(positions + j, end + modes + j) for j in range(modes)]
    turns = [(place(q), place(v)) for q, v in old.turns.tolist()]
    units = [*old.units[:positions], *["kg^0.5 m"] * modes, *old.units[positions:end]]
    units += [*["kg^0.5 m/s"] * modes, *old.units[end:]]
    return StateMap(index_array(plain, 2), index_array(turns, 2), tuple(units))


def arrange_independent(
    machine: MachineRecord, absolute: System, y: Array, rank: int, settings: SimulationSettings
) -> tuple[System, Array]:
    """The machine with modes and the arrays of a partition, which has modal velocities among the independent ones where it can.

    Raises ModelError naming every marker of a flexible body that is at no interface of it.
    """
    system, start = arrange(machine, absolute, y, rank, settings)
    record = system.record
    # modes of unit modal mass move their body by about p/√m; they too are independent where they can
    mass = np.repeat(
        record.bodies.mass[record.flexible.body], np.diff(record.flexible.mode.astype(int), axis=1).ravel()
    )
    modal, wanted = RELUCTANCE * system.size * np.sqrt(mass), velocities_named(settings.independent, system.bodies)
    arrays = partition(system.body_count, len(system.rows), rank, system.size, modal, wanted)
    return replace(system, record=record._replace(partition=arrays)), start
