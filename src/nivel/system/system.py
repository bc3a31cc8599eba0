"""A machine in numbers: the record of the kernels, its initial state, and the names of everything in it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from nivel.elements.facts import Coupled, StateFact
from nivel.kernels.record.record import Control, Record
from nivel.lazy import Struct, field, nivel, replace
from nivel.machine.units.tree import Node as Tree
from nivel.system.layout import FrameLayout
from nivel.system.tables import Array, index_array

if TYPE_CHECKING:
    from nivel.elements.circuits.nodes import Node
    from nivel.system.signals.unit import Unit


class Equations(Struct):
    """What a formulation asks of the layout of the state: velocities a rigid body, and whether normalisation is a row."""

    velocities: int
    normalisation: bool


class StateMap(Struct):
    """What the entries of y are.

    plain : (n, 2) where a position stands and where its rate, q̇ = v. turns : (n, 2) where four Euler parameters stand and where their
    body-axis angular velocity. units : of every entry, "m", "1", "m/s" or "1/s", "" for those of forces and energies.
    """

    plain: NDArray[np.uint32]
    turns: NDArray[np.uint32]
    units: tuple[str, ...]


class System(Struct):
    """The numbers of one machine for one formulation.

    rows : name of every constraint row of the formulation, e.g. ``hinge.s.x``; the first `machine_rows` belong to joints, couplings
    and drivers. row_owner : name of the joint, coupling or driver of each of these. velocity_rows : those of
    them that hold velocities alone, as of wheels that do not slip. point_masses : (B,) bodies that do not turn.
    coupled : what each element acts on or depends on. states : first-order states of elements, in the order of `Elements.state`.
    nodes : of hydraulic circuits. friction_loads : on what those depend that are functions, by the number of the friction.
    frame_markers : markers that are frames of bodies. marker_owners : `joints.hinge`, …: what each marker belongs to.
    input_functions : the function of each input. units : of others that its control calls.
    modes : names of the modal coordinates. gradient_sizes : (modes,) what those of gradients are measured by [kg^½ m], 0 for others.
    as_placed : combinations that keep the value that they have as the machine is placed.
    switching : the function of each switch.
    size : length of the machine [m], the scale of its tolerances. state_map : what the entries of y are; None: as `absolute_map`.
    tree_names : what each velocity of a tree is the rate of, e.g. `hinge.angle`; empty in absolute coordinates.
    """

    record: Record
    equations: Equations
    layout: FrameLayout
    bodies: tuple[str, ...]
    joints: tuple[str, ...]
    coupled: tuple[Coupled, ...]
    states: tuple[StateFact, ...]
    input_functions: tuple[int, ...]
    nodes: tuple[Node, ...]
    frictions: tuple[str, ...]
    friction_loads: Mapping[int, Coupled]
    events: tuple[str, ...]
    rows: tuple[str, ...]
    row_owner: tuple[str, ...]
    velocity_rows: frozenset[int]
    row_units: tuple[str, ...]
    coordinate_units: tuple[str, ...]
    point_masses: NDArray[np.bool_]
    frame_markers: frozenset[int]
    marker_owners: tuple[str, ...]
    as_placed: NDArray[np.bool_]
    size: float
    start: Array
    state_map: StateMap | None = None
    tree_names: tuple[str, ...] = ()
    modes: tuple[str, ...] = ()
    gradient_sizes: Array = field(default_factory=lambda: np.zeros(0))
    units: tuple[Unit, ...] = ()
    switching: tuple[Tree, ...] = ()

    @property
    def body_count(self) -> int:
        return len(self.bodies)

    @property
    def machine_rows(self) -> int:
        return len(self.row_owner)

    @property
    def freedoms(self) -> int:
        """Degrees of freedom of the bodies without any constraint."""
        return 6 * self.body_count - 3 * int(self.point_masses.sum())

    @property
    def positions(self) -> int:
        """Length of q."""
        if self.state_map is None:
            return 7 * self.body_count
        return len(self.state_map.plain) + 4 * len(self.state_map.turns)

    @property
    def map(self) -> StateMap:
        """What the entries of y are."""
        return self.state_map or self._absolute_map()

    def _absolute_map(self) -> StateMap:
        count, width = self.body_count, self.equations.velocities
        plain, turns, units = [], [], ["m", "m", "m", "1", "1", "1", "1"] * count
        for b in range(count):
            q, v = 7 * b, 7 * count + width * b
            plain += [(q + i, v + i) for i in range(7 if self.equations.normalisation else 3)]
            if not self.equations.normalisation:
                turns.append((q + 3, v + 3))
            units += ["m/s"] * 3 + ["1/s"] * (width - 3)
        units += [""] * len(self.start_of_states)
        return StateMap(index_array(plain, 2), index_array(turns, 2), tuple(units))

    def state(self, q: Array, velocity: Array, angular_velocity_b: Array) -> Array:
        """State y = (q, v, x) in Euler parameters from q (7 B,), Ṙ (B, 3) [m/s] and ω̄ (B, 3) [rad/s, body axes]."""
        count, per_body = self.body_count, self.equations.velocities
        v = np.zeros((count, per_body))
        v[:, :3] = velocity
        if self.equations.normalisation:
            v[:, 3:] = parameter_rates(q.reshape(count, 7)[:, 3:], angular_velocity_b)
        else:
            v[:, 3:] = angular_velocity_b
        return np.concatenate([q, v.ravel(), self.start_of_states])

    @property
    def start_of_states(self) -> Array:
        """x at t = 0: states of elements, then work of external forces and dissipated energy [J]."""
        return np.array([*(fact.start for fact in self.states), 0.0, 0.0])

    def modal_sizes(self) -> Array:
        """(modes,) [kg^½ m] what modal coordinates are measured by: modes of unit modal mass move the machine by about p/√m, and stretch
        the gradients of a node as if these had its mass at their tips."""
        whole = float(np.sqrt(self.record.bodies.mass.sum())) * self.size
        out = np.full(len(self.modes), whole)
        own = self.gradient_sizes[: len(out)]
        out[np.flatnonzero(own)] = own[own > 0.0]
        return out

    def hold_sliders(self, y: Array) -> None:
        """Hold each slider that a beam carries on the element where it is in the state y, until it is told to go on."""
        tree, coordinates = self.record.tree, self.record.coordinates
        for k, (n, along) in enumerate(tree.slider.astype(int).tolist()):
            first, last = coordinates.start[along : along + 2].astype(int)
            stations = coordinates.station[first + 1 : last]
            tree.element[k, 0] = (
                first + 1 + nivel.elements.joints.on_beams.element_of(stations, float(y[int(tree.place[n, 0])]))
            )

    def known_rank(self, rank: int) -> System:
        """The same system prepared for `rank` independent rows: with redundant ones, for the rank-revealing path.

        Its control is its own: machines in several coordinates share what the kernels leave, not what steers them.
        """
        control = self.record.control
        record = self.record._replace(
            control=Control(**{name: getattr(control, name).copy() for name in Control._fields})
        )
        rows = len(record.saddle.row)
        if rank < rows:
            saddle = record.saddle._replace(
                dense=np.zeros((rows, rows)), null=np.zeros((rows, rows - rank)), pivot=np.zeros(rows, dtype=np.uint32)
            )
            record = record._replace(saddle=saddle)
        record.control.rank[0] = rank
        return replace(self, record=record)


def parameter_rates(theta: Array, angular_velocity_b: Array) -> Array:
    """θ̇ = ½ Ēᵀ ω̄ for rows of θ (n, 4) and ω̄ (n, 3) [rad/s, body axes]; for a small rotation vector, the change of θ."""
    e0, e1, e2, e3 = theta.T
    x, y, z = 0.5 * angular_velocity_b.T
    return np.column_stack(
        [-e1 * x - e2 * y - e3 * z, e0 * x - e3 * y + e2 * z, e3 * x + e0 * y - e1 * z, -e2 * x + e1 * y + e0 * z]
    )
