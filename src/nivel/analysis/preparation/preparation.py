"""A machine made ready to run: built, assembled, refused where no method could follow it, and put into the coordinates of the run."""

from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.assemble import Assembly, assemble
from nivel.analysis.assembly.branches import both_assemblies
from nivel.analysis.assembly.equations import MotionEquations, equations
from nivel.analysis.assembly.implicit import ResidualOptions, constraint_index, with_residual
from nivel.analysis.assembly.named_freedoms import touches_ground
from nivel.analysis.assembly.penalties import bound_pivots, penalise, refuse_unknown_rows, soft_rows
from nivel.analysis.assembly.redundancy import Redundancy, analyse, modal_rows
from nivel.analysis.assembly.unique_reactions import exact_joints, leave_out, rows_everywhere
from nivel.analysis.curves.corners import allowed_steps, corners, jumping_functions
from nivel.analysis.plan.plan import Methods
from nivel.analysis.preparation.memory import in_one_piece
from nivel.errors import Fault, ModelError, refuse
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.sink import Header, Sink
from nivel.judge.before.refusals import deep_starts, moved_nodes, struck_nodes, uncertain_loads, unsettled_multipliers
from nivel.kernels.core.arrays import copied
from nivel.kernels.record.record import Record
from nivel.known import Beam
from nivel.lazy import Struct, all_kept, nivel, replace
from nivel.machine.machine_record import MachineRecord
from nivel.motion.catalogue import FORMULATIONS, PathFacts, path_of
from nivel.motion.shared_loads import share_loads
from nivel.results.motion import rotation_matrices
from nivel.system.elimination.partition import DIRECTIONS, PARAMETERS, refuse_dependent
from nivel.system.system import Array, System


class Assembled(NamedTuple):
    """The equations of a machine in absolute coordinates, and its state as assembled."""

    motion: MotionEquations
    assembly: Assembly


class _Records(NamedTuple):
    """Records that may have arrays in common."""

    motion: Record
    absolute: Record


class Rest(Protocol):
    """An equilibrium from which a run starts: positions q of bodies and modes, in absolute coordinates, and states of elements."""

    @property
    def q(self) -> Array: ...

    @property
    def states(self) -> Array: ...

    def assembled(self, motion: MotionEquations, assembly: Assembly) -> Assembly:
        """The assembly with the bodies there, at rest."""
        ...


class Prepared(Struct):
    """A machine ready to run: where its equations are, these and its state at the start in the coordinates of the run, both again in
    absolute ones as assembled, its redundancy, the number of its drivers, the integrator of its settings, its beams, and the corners [s]
    of its functions of time at which the steps of the loop have to end; where steps are chosen, how long they may be in which part [s];
    its functions that jump with the motion, in words; the machine itself; the methods."""

    path: PathFacts
    motion: MotionEquations
    start: Array
    absolute: MotionEquations
    assembly: Assembly
    redundancy: Redundancy
    drivers: int
    integrator: IntegratorFacts
    beams: tuple[Beam, ...] = ()
    corners: tuple[float, ...] = ()
    allowed: Array | None = None
    jumping: tuple[str, ...] = ()
    machine: MachineRecord | None = None
    methods: Methods | None = None

    def again(self) -> "Prepared | None":
        """The same, not yet run, with records of its own, for a run beside it; None where records point to each other or to units."""
        if self.motion.twin is not None or self.motion.system.units:
            return None
        return self._with(copied(_Records(self.motion.system.record, self.absolute.system.record)))

    def in_one_piece(self) -> "tuple[Prepared, NDArray[np.uint8] | None]":
        """The same with its records in one piece of memory, and that piece; as it is, with none, where records point to each other."""
        if self.motion.twin is not None:
            return self, None
        own, piece = in_one_piece(_Records(self.motion.system.record, self.absolute.system.record))
        return self._with(own), piece

    def _with(self, records: _Records) -> "Prepared":
        motion, absolute = (
            replace(each, system=replace(each.system, record=record))
            for each, record in zip((self.motion, self.absolute), records, strict=True)
        )
        return replace(self, motion=motion, absolute=absolute)

    @property
    def guards_circuits(self) -> bool:
        """Whether the steps of a run guard the pressures of circuits."""
        return bool(self.integrator.guarded and self.motion.system.nodes)


@all_kept()
def prepare(
    methods: Methods,
    given: Assembled | None = None,
    residual: ResidualOptions | None = None,
    equilibrium: Callable[[MachineRecord, Assembled], Rest] | None = None,
) -> Prepared:
    """Build and assemble the machine of these methods; given : the machine is built and assembled already.

    residual : what is asked of the residual of an implicit integrator, in place of what that asks. equilibrium : finds the one from
    which the machine starts, with a record that it may change; None : it starts as given.

    Raises ModelError where it cannot be closed, starts in a singular position, or has friction of no certain load.
    """
    machine, path, integrator = methods.machine, methods.path, methods.integrator
    motion, assembly = given or _assembled(machine)
    jumping = jumping_functions(machine)  # before an equilibrium is looked for: the machine at rest has the same
    rest = None
    if equilibrium is not None:
        system = replace(motion.system, record=copied(motion.system.record))
        rest = equilibrium(machine, Assembled(replace(motion, system=system), assembly))
        assembly = rest.assembled(motion, assembly)
    redundancy, absolute = _independent_rows(machine, motion, assembly.y)
    refuse(uncertain_loads(machine, redundancy, partial(_exactly_constrained, machine, motion, assembly.y, redundancy)))
    refuse(deep_starts(machine, absolute, assembly.y))
    motion.system.record.coordinates.reference[:] = assembly.reference
    system, y = absolute.system, assembly.y
    if machine.hydraulics:
        system, y = nivel.analysis.assembly.circuit_start.circuit_start(machine, absolute, y)
    assembly = replace(assembly, y=y)
    motion = replace(motion, system=replace(motion.system, states=system.states))
    absolute = replace(absolute, system=system)
    rank = motion.system.machine_rows - len(redundancy.redundant_rows)
    system, y = arranged(motion.system, assembly.y, rest, rank, methods)
    if len(system.record.saddle.dense):
        _leave_out_repeated(system, motion, assembly.y, methods)
    refuse_unknown_rows(system, machine.simulation, penalised=methods.penalised)
    prepared = _formulated(MotionEquations(system, import_module(path.module)), y, methods)
    if wanted := machine.simulation.independent if methods.coordinates == "independent" else ():
        prepared.evaluate(0.0, y)
        ways = PARAMETERS if system.equations.normalisation else DIRECTIONS
        refuse_dependent(prepared.system.record.partition, wanted, system.bodies, ways)
    if integrator.needs == "circuits":
        prepared = replace(prepared, system=nivel.system.circuit_tangent.with_circuit_tangent(prepared.system))
    if integrator.residual:
        prepared = with_residual(prepared, y, methods.coordinates, residual or _wanted(prepared, y, methods), path)
    return Prepared(
        path,
        prepared,
        y,
        absolute,
        assembly,
        redundancy,
        sum(driver.row_count for driver in machine.drivers),
        integrator,
        machine.beams,
        corners(machine, with_values=True) if methods.chooses_steps and not integrator.knows_corners else (),
        allowed_steps(machine, machine.simulation.duration) if methods.chooses_steps else None,
        jumping,
        machine,
        methods,
    )


def with_integrator(prepared: Prepared, methods: Methods, y: Array) -> Prepared:
    """A machine in motion, in the state y, for another integrator of the same equations. What it remembers stays: records have their
    arrays in common."""
    motion, integrator = prepared.motion, methods.integrator
    equipped = with_residual(motion, y, methods.coordinates, _wanted(motion, y, methods), methods.path)
    return replace(prepared, motion=equipped, integrator=integrator, methods=methods, corners=())


def _exactly_constrained(
    machine: MachineRecord, motion: MotionEquations, y: Array, redundancy: Redundancy
) -> tuple[str, ...]:
    """Changes of joints after which no constraint repeats another."""
    motion.evaluate(0.0, y)
    return exact_joints(machine, motion, redundancy.non_unique_joints)


def _assembled(machine: MachineRecord) -> Assembled:
    """The equations of the machine in absolute coordinates, and its state as assembled."""
    motion = equations(machine)
    assembly = assemble(machine, motion)
    refuse(moved_nodes(machine, assembly.moved, motion.system.size))
    refuse(struck_nodes(machine, assembly.velocity_change, *_speeds(motion.system, assembly.y)))
    return Assembled(motion, assembly)


def _speeds(system: System, y: Array) -> tuple[float, float]:
    """The largest speed [m/s] and angular speed [rad/s] of a body, in absolute coordinates."""
    velocities = y[system.positions :][: 6 * system.body_count].reshape(-1, 2, 3)
    largest = np.linalg.norm(velocities, axis=2).max(axis=0, initial=0.0)
    return float(largest[0]), float(largest[1])


def _independent_rows(machine: MachineRecord, motion: MotionEquations, y: Array) -> tuple[Redundancy, MotionEquations]:
    """What rows of the constraints repeat at the start, and the equations that know how many do.

    Raises ModelError in a singular position.
    """
    rigid = analyse(motion, 0.0, y)
    redundancy = analyse(motion, 0.0, y, modal_rows(machine, motion.system)) if machine.is_flexible else rigid
    if redundancy.singular_rows:
        rows = ", ".join(redundancy.singular_rows)
        both = "" if machine.is_flexible or machine.beams else both_assemblies(machine, y)
        aside = both or "start it a little aside"
        message = f"the machine starts in a singular position: {rows} adds nothing here but does nearby. {aside}"
        raise ModelError(Fault.at("machine", message))
    known = motion.system.known_rank(motion.system.machine_rows - len(rigid.redundant_rows))
    return redundancy, MotionEquations(known, motion.kernels)


def _leave_out_repeated(system: System, absolute: MotionEquations, assembled: Array, methods: Methods) -> None:
    """Leave the rows that repeat others everywhere out of the factor of S. Rows of joints that carry bodies are there already.

    absolute : the equations in absolute coordinates, which know of no redundancy; assembled : their state.
    """
    if methods.machine.is_flexible or methods.solves_residual or methods.penalised:
        return
    left = set(system.record.saddle.row.tolist())
    carrying = [row for row in range(system.machine_rows) if row not in left]
    leave_out(system, rows_everywhere(absolute, assembled, methods.machine.simulation.duration, carrying))


def arranged(absolute: System, y: Array, rest: Rest | None, rank: int, methods: Methods) -> tuple[System, Array]:
    """The system and its state y, given in absolute coordinates, in those of the path; with the modes bent by the loads of the equilibrium
    `rest` from which the run starts."""
    arrange = methods.path.arrange
    machine = methods.machine
    system, start = arrange(machine, absolute, y, rank, methods.cut)
    if rest is None:
        return system, start
    if machine.is_flexible and methods.coordinates == "relative":
        system, start = nivel.system.states.flexible_tree.arrange_deformed(machine, absolute, rest.q, rank, methods.cut)
    elif machine.is_flexible:
        # the bodies are there already
        start[system.positions - len(system.modes) : system.positions] = rest.q[7 * system.body_count :]
    start[len(start) - len(system.start_of_states) :][: len(rest.states)] = rest.states
    return system, start


def _formulated(motion: MotionEquations, y: Array, methods: Methods) -> MotionEquations:
    """The equations, with constraints as the formulation has them enter, or mass as bodies have it in common."""
    if methods.solves_residual:
        return _balanced(motion, y, methods)
    if methods.penalised:
        return penalise(motion, y, methods.machine.simulation, FORMULATIONS[methods.formulation])
    bound_pivots(motion, y)
    return motion


def _balanced(motion: MotionEquations, y: Array, methods: Methods) -> MotionEquations:
    """The equations of a machine whose bodies have mass in common, or are carried by beams along which they slide. Pivots, which the latter
    have none of, are judged by the masses lumped at the bodies."""
    machine, coordinates = methods.machine, methods.coordinates
    if not len(motion.system.record.tree.slider):
        lumped = path_of(coordinates, "newton-euler", machine.simulation.rotations, flexible=machine.is_flexible)
        assert lumped is not None
        bound_pivots(MotionEquations(motion.system, import_module(lumped.module)), y)
    if methods.integrator.residual:
        return motion
    return with_residual(motion, y, coordinates, ResidualOptions(balance=True))


def _wanted(motion: MotionEquations, y: Array, methods: Methods) -> ResidualOptions:
    """What the integrator asks of the residual. Raises ModelError where multipliers would never settle."""
    machine, saddle, integrator = methods.machine, motion.system.record.saddle, methods.integrator
    simulation = machine.simulation
    if constraint_index(methods.formulation, simulation.stabilisation, methods.path) == 3:
        refuse(unsettled_multipliers(machine, len(saddle.row)))
    compliance = saddle.shift if methods.penalised else None
    if len(saddle.dense) and not methods.solves_residual:
        compliance = soft_rows(motion, y)
    return ResidualOptions(
        whole=integrator.over_step,
        corners=corners(machine, at_begin=integrator.ends == "jumps"),
        shifted=integrator.needs == "complex shifts",
        balance=methods.solves_residual,
        along=integrator.needs == "directions",
        free=not touches_ground(machine, motion.system) if integrator.needs == "whole steps" else None,
        filtered=integrator.optional_control and methods.chooses_steps,
        accelerations=integrator.needs == "accelerations",
        compliance=compliance,
    )


# Loads of redundant joints in frames, shared by least norm: of runs in relative and independent coordinates, and of equilibria.
#
# Costs one evaluation of the constraints a frame, and nothing where no constraint is redundant.

FROM_FRAME = ("position", "orientation", "velocity", "angular_velocity", "joint_coordinate")


class SharedLoads(Struct, frozen=False):
    """The equations in absolute coordinates, with a record of their own, and the state of a frame in them."""

    motion: MotionEquations
    y: Array

    @classmethod
    def of(cls, prepared: Prepared, *, keeps_sparse: bool = True) -> "SharedLoads | None":
        """None where no reaction is open; and for flexible bodies and beams, whose stiffness decides how loads are shared.

        keeps_sparse : rows that repeat others everywhere are looked for, which takes as long as some hundred frames of a small machine.
        """
        of_run, machine = prepared.motion.system, prepared.machine
        if machine is None or not prepared.redundancy.redundant_rows:
            return None
        if machine.is_flexible or machine.beams or prepared.absolute.system.layout != of_run.layout:
            return None
        own = replace(prepared.absolute.system, record=copied(prepared.absolute.system.record))
        motion, y = MotionEquations(own, prepared.absolute.kernels), prepared.assembly.y.copy()
        if keeps_sparse and not own.units:  # these remember how often they are asked
            leave_out(own, rows_everywhere(motion, y, machine.simulation.duration))
        return cls(motion, y)

    def share(self, frames: NDArray[np.float64]) -> None:
        """Overwrite multipliers, reactions and efforts of frames (n, width)."""
        system, y = self.motion.system, self.y
        columns = {each.name: each.columns for each in system.layout.variables if each.name in FROM_FRAME}
        count, record = system.body_count, system.record
        q, v = y[: 7 * count].reshape(count, 7), y[7 * count : 13 * count].reshape(count, 6)
        address = self.motion.handle.address
        for frame in frames:
            place, theta, velocity, omega, coordinates = (frame[columns[name]] for name in FROM_FRAME)
            q[:, :3], q[:, 3:] = place.reshape(count, 3), theta.reshape(count, 4)
            v[:, :3] = velocity.reshape(count, 3)
            v[:, 3:] = np.einsum("bij,bi->bj", rotation_matrices(q[:, 3:]), omega.reshape(count, 3))
            record.coordinates.reference[record.joints.coordinate] = coordinates
            share_loads(address, float(frame[0]), y, frame)


class SharingSink(Struct):
    """Other sinks behind shared loads."""

    loads: SharedLoads
    sinks: Sequence[Sink]

    def begin(self, header: Header) -> None:
        for sink in self.sinks:
            sink.begin(header)

    def take(self, frames: NDArray[np.float64]) -> None:
        self.loads.share(frames)
        for sink in self.sinks:
            sink.take(frames)


def are_open(prepared: Prepared) -> bool:
    """Whether frames of a run lack the loads of least norm, which those in absolute coordinates have already."""
    return bool(prepared.motion.system.tree_names or prepared.path.dependent)


def sharing(prepared: Prepared, sinks: Sequence[Sink]) -> Sequence[Sink]:
    """The sinks, behind shared loads where these are needed."""
    loads = SharedLoads.of(prepared) if are_open(prepared) else None
    return sinks if loads is None else (SharingSink(loads, sinks),)
