"""Motion in time: build, assemble, march in chunks, feed the sinks."""

from __future__ import annotations

import time as clock_of_python
from collections.abc import Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

import numpy as np

from nivel.analysis.assemble import Assembly, assemble
from nivel.analysis.choice import choose_cut, slides
from nivel.analysis.combinations import refuse_combinations
from nivel.analysis.corners import corners
from nivel.analysis.equations import MotionEquations, equations
from nivel.analysis.ground import touches_ground
from nivel.analysis.implicit import Wanted, constraint_index, equip
from nivel.analysis.interrupt import interruptible
from nivel.analysis.listener import Progress
from nivel.analysis.mobility import bound_pivots
from nivel.analysis.modal_rows import modal_rows
from nivel.analysis.modal_stiffness import integrator_of
from nivel.analysis.outcome import failure
from nivel.analysis.penalties import feedback, penalise
from nivel.analysis.redundancy import Redundancy, analyse
from nivel.analysis.refusals import (
    refuse_conserved_drivers,
    refuse_deep_starts,
    refuse_for_shared_mass,
    refuse_friction_at_jumps,
    refuse_moved_nodes,
    refuse_rough_motions,
    refuse_stiction_over_steps,
    refuse_struck_nodes,
    refuse_uncertain_loads,
    refuse_unsettled_multipliers,
)
from nivel.analysis.settings import RunSettings
from nivel.errors import Fault, ModelError
from nivel.kernels.handle import Handle
from nivel.kernels.record import WATCH
from nivel.kernels.saddle import MOST_UNSETTLED
from nivel.kernels.status import BUDGET_SPENT, BUFFER_FULL, CONTRADICTION, DONE
from nivel.machine.beam import Beam
from nivel.machine.machine_record import MachineRecord
from nivel.march.catalogue import IntegratorFacts, chooses
from nivel.march.run import (
    ALL_STEPS,
    BUDGET,
    CLOCKS,
    CONSERVE,
    CORRECTOR_TOLERANCE,
    COUNTS,
    DENSE_ROWS,
    DONE_STEPS,
    END,
    EVALUATIONS,
    EVENTS,
    EVERY,
    FACTORISATIONS,
    FRAMES,
    INTERVAL,
    ITERATIONS,
    LARGEST,
    LAST_FRAME,
    MOST_ITERATIONS,
    NEWTON,
    ORDER,
    REJECTED,
    SHOWN,
    STEP,
    STOPPED,
    SWITCHED,
    TIME,
    TOLERANCE,
    UNCONSERVED,
    Run,
)
from nivel.march.sink import Sink
from nivel.march.stabilise.catalogue import STABILISATIONS
from nivel.motion.catalogue import FORMULATIONS, PathFacts, path_of
from nivel.results.occurrence import Occurrence
from nivel.system.beam_nodes import with_nodes
from nivel.system.partition import forget
from nivel.system.system import Array, System

# A chunk of the loop lasts about this long [s]; between chunks frames are written and Ctrl-C is looked at.
CHUNK = 0.05
BUFFER_BYTES = 1_000_000
EVENT_ROWS = 1000
# Stiction stops a joint within this many steps.
STICK_STEPS = 2.0
# Fixed steps that make a time in which a machine moves by its own length, at least.
LONG = 1e4


@dataclass(frozen=True)
class Prepared:
    """A machine ready to run: where its equations are, these and its state at the start in the coordinates of the run, both again in
    absolute ones as assembled, its redundancy, the number of its drivers, the integrator of its settings, its beams."""

    path: PathFacts
    motion: MotionEquations
    start: Array
    absolute: MotionEquations
    assembly: Assembly
    redundancy: Redundancy
    drivers: int
    integrator: IntegratorFacts
    beams: tuple[Beam, ...] = ()


@dataclass
class Finished:
    """How a run ended. outcome: done, interrupted or failed; failure: (message, advice, time [s]).

    events : in the order of time. stopped_by : name of the event that ended the run. asked_to_stop : Ctrl-C came; also while the last
    steps were made, so that the run itself is done.
    """

    outcome: str
    events: list[Occurrence] = field(default_factory=list)
    stopped_by: str = ""
    asked_to_stop: bool = False
    timing: dict[str, float] = field(default_factory=dict)
    failure: tuple[str, str, float] | None = None


def prepare(machine: MachineRecord, formulation: str = "newton-euler", coordinates: str = "absolute") -> Prepared:
    """Build and assemble `machine`, for the rotations, cut joints and penalties of its own settings.

    Raises ModelError where it cannot be closed, starts in a singular position, or has friction of no certain load.
    """
    machine = with_nodes(machine)
    refuse_for_shared_mass(machine, formulation, coordinates)
    motion = equations(machine)
    assembly = assemble(machine, motion)
    refuse_moved_nodes(machine, assembly.moved, motion.system.size)
    refuse_struck_nodes(machine, assembly.velocity_change, *_speeds(motion.system, assembly.y))
    rest = None
    if machine.simulation.start == "equilibrium":
        from nivel.analysis.statics.start import settled  # is built of what is prepared here

        rest = settled(machine)
        assembly = rest.assembled(motion, assembly)
    rigid = analyse(motion, 0.0, assembly.y)
    redundancy = analyse(motion, 0.0, assembly.y, modal_rows(machine, motion.system)) if machine.is_flexible else rigid
    if redundancy.singular_rows:
        rows = ", ".join(redundancy.singular_rows)
        message = f"the machine starts in a singular position: {rows} adds nothing here but does nearby; start it a little aside"
        raise ModelError(Fault("", 0, 0, "machine", message))
    refuse_uncertain_loads(machine, redundancy)
    refuse_conserved_drivers(machine)
    refuse_stiction_over_steps(machine)
    refuse_rough_motions(machine)
    refuse_friction_at_jumps(machine)
    rank = motion.system.machine_rows - len(redundancy.redundant_rows)
    known = motion.system.known_rank(motion.system.machine_rows - len(rigid.redundant_rows))
    absolute = MotionEquations(known, motion.kernels)
    refuse_deep_starts(machine, absolute, assembly.y)
    sliding = slides(machine, coordinates, formulation)
    kinds = {"flexible": machine.is_flexible, "shared": machine.shares_mass, "sliding": sliding}
    facts = path_of(coordinates, formulation, machine.simulation.rotations, **kinds)
    if facts is None:
        raise ModelError(refuse_combinations(machine.simulation.replace(formulation=formulation), coordinates))
    motion.system.record.coordinates.reference[:] = assembly.reference
    arrange = import_module(facts.arrangement).arrange
    system, y = arrange(machine, motion.system, assembly.y, rank, choose_cut(machine))
    if rest is not None and machine.is_flexible:
        # with the modes bent by the loads
        if coordinates == "relative":
            arrange_deformed = import_module(facts.arrangement).arrange_deformed
            system, y = arrange_deformed(machine, motion.system, rest.q, rank, choose_cut(machine))
        else:
            # the bodies are there already
            y[system.positions - len(system.modes) : system.positions] = rest.q[7 * system.body_count :]
    prepared = MotionEquations(system, import_module(facts.module))
    integrator = integrator_of(machine, coordinates)
    if sliding or machine.shares_mass:
        prepared = _balanced(machine, prepared, y, coordinates, integrator)
    elif FORMULATIONS[formulation].factor > 0.0:
        prepared = penalise(prepared, y, machine.simulation, FORMULATIONS[formulation])
    else:
        bound_pivots(prepared, y)
    if integrator.residual:
        if constraint_index(formulation, machine.simulation.stabilisation, facts) == 3:
            refuse_unsettled_multipliers(machine, len(prepared.system.record.saddle.row))
        free = not touches_ground(machine, prepared.system) if integrator.whole else None
        wanted = Wanted(
            whole=integrator.over_step(machine.is_flexible),
            corners=corners(machine),
            shifted=integrator.shifted,
            balance=sliding or machine.shares_mass,
            along=integrator.along,
            free=free,
            filtered=integrator.filters and chooses(machine.simulation.integrator, machine.simulation.step_control),
            accelerations=integrator.accelerations,
            compliance=prepared.system.record.saddle.shift if FORMULATIONS[formulation].factor > 0.0 else None,
        )
        prepared = equip(prepared, y, coordinates, wanted, facts)
    return Prepared(facts, prepared, y, absolute, assembly, redundancy, len(machine.drivers), integrator, machine.beams)


def _speeds(system: System, y: Array) -> tuple[float, float]:
    """The largest speed [m/s] and angular speed [rad/s] of a body, in absolute coordinates."""
    velocities = y[system.positions :][: 6 * system.body_count].reshape(-1, 2, 3)
    largest = np.linalg.norm(velocities, axis=2).max(axis=0, initial=0.0)
    return float(largest[0]), float(largest[1])


def _balanced(
    machine: MachineRecord, prepared: MotionEquations, y: Array, coordinates: str, integrator: IntegratorFacts
) -> MotionEquations:
    """The equations of a machine whose bodies have mass in common, or are carried by beams along which they slide. Pivots, which the latter
    have none of, are judged by the masses lumped at the bodies."""
    if not len(prepared.system.record.tree.slider):
        lumped = path_of(coordinates, "newton-euler", machine.simulation.rotations, flexible=machine.is_flexible)
        assert lumped is not None
        bound_pivots(MotionEquations(prepared.system, import_module(lumped.module)), y)
    if integrator.residual:
        return prepared
    return equip(prepared, y, coordinates, Wanted(balance=True))


def march(
    prepared: Prepared,
    settings: RunSettings,
    sinks: Sequence[Sink],
    *,
    progress: Progress | None = None,
    chunk_steps: int | None = None,
) -> Finished:
    """Run `prepared` and give every frame to all `sinks` (already begun).

    progress : called with the time reached [s] after every chunk. chunk_steps : steps a chunk, instead of as many as fit into 50 ms;
    the result does not depend on it.
    """
    system = prepared.motion.system
    stabilisation = STABILISATIONS[settings.stabilisation]
    alpha, beta = settings.baumgarte or (None, None)
    system.record.control.stabilise[:] = stabilisation.coefficients(settings.step, alpha, beta)
    if settings.penalty is not None:
        system.record.control.stabilise[:2] = feedback(settings.penalty, settings.step, stabilisation.CORRECTS)
    kernels = prepared.motion.kernels
    correct = import_module(prepared.path.correction).correct if stabilisation.CORRECTS else kernels.keep
    facts = prepared.integrator
    step = getattr(import_module(facts.module), facts.function)
    advance = import_module("nivel.march.loop").advance
    run = _start(prepared, settings, facts)
    run.counter[CONSERVE] = int(stabilisation.CONSERVES)
    machine, history = prepared.motion.handle, Handle(run)
    finished = Finished("done")
    wall = clock_of_python.perf_counter()
    budget, loop_seconds, status = chunk_steps or 1, 0.0, BUDGET_SPENT
    with interruptible() as interrupted:
        while status in (BUDGET_SPENT, BUFFER_FULL):
            run.counter[BUDGET] = budget
            begin = clock_of_python.process_time()
            status = advance(kernels.evaluate, correct, step, machine.address, history.address)
            spent = clock_of_python.process_time() - begin
            loop_seconds += spent
            _give(run, sinks)
            finished.events += _taken_events(run, system.events)
            if progress is not None:
                progress(float(run.clock[TIME]))
            if chunk_steps is None and status == BUDGET_SPENT:
                budget = (
                    max(1, min(2 * budget, int(budget * CHUNK / max(spent, 1e-9))))
                    if spent < CHUNK
                    else max(1, budget // 2)
                )
            if status in (BUDGET_SPENT, BUFFER_FULL) and interrupted():
                finished.outcome = "interrupted"
                break
        finished.asked_to_stop = interrupted()
    if run.counter[STOPPED]:
        finished.stopped_by = system.events[run.counter[STOPPED] - 1]
    if status not in (BUDGET_SPENT, BUFFER_FULL, DONE):
        finished.outcome = "failed"
        step_size = float(run.clock[STEP])
        explicit = settings.steps > 0 and not (facts.implicit or facts.residual)
        message, advice = failure(
            prepared.motion,
            status,
            float(run.clock[TIME]),
            step_size,
            run.previous,
            chosen=settings.steps == 0,
            beams=prepared.beams if explicit else (),
        )
        finished.failure = (message, advice, float(run.clock[TIME]))
        if status != CONTRADICTION:
            _keep_last(prepared.motion, run, sinks)
    finished.timing = {
        "steps": int(run.counter[DONE_STEPS]),
        "evaluations": int(run.counter[EVALUATIONS]),
        "iterations": int(run.counter[ITERATIONS]) + int(system.record.control.iterations[1]),
        "factorisations": int(run.counter[FACTORISATIONS]),
        "rejected": int(run.counter[REJECTED]),
        "unconserved": int(run.counter[UNCONSERVED]),
        "partitions": _partitions_changed(system),
        "loop_seconds": loop_seconds,
        "wall_seconds": clock_of_python.perf_counter() - wall,
    }
    return finished


def _keep_last(motion: MotionEquations, run: Run, sinks: Sequence[Sink]) -> None:
    """Give the last accepted state before a failure, where it lies after the last frame and its accelerations are numbers."""
    t, feedback = float(run.clock[TIME]), motion.system.record.control.stabilise[:2]
    if not t > run.clock[SHOWN] or not np.isfinite(run.previous).all():
        return
    kept = feedback.copy()
    # as in all frames, accelerations are those without Baumgarte's feedback
    feedback[:] = 0.0
    if motion.holds(t, run.previous):
        frame = np.zeros((1, motion.system.layout.width))
        frame[0, 0] = t
        observe: Any = import_module("nivel.kernels.observe").observe
        observe(motion.handle.address, t, run.previous, frame[0])
        if np.isfinite(frame).all():
            for sink in sinks:
                sink.take(frame)
    feedback[:] = kept


def _partitions_changed(system: System) -> int:
    """How often independent coordinates were chosen anew during the run."""
    return max(0, int(system.record.partition.choices.sum()) - 1)


def _start(prepared: Prepared, settings: RunSettings, facts: IntegratorFacts) -> Run:
    """History of a run at its start: energies referred to the assembled state, joint angles followed from it, nothing remembered."""
    system = prepared.motion.system
    y = prepared.start.copy()
    width = system.layout.width
    rows = max(2, min(4096, BUFFER_BYTES // (8 * width)))
    clock = np.zeros(CLOCKS)
    clock[STEP], clock[END], clock[INTERVAL] = settings.step, settings.duration, settings.output_interval
    clock[TOLERANCE], clock[LARGEST] = settings.tolerance or 0.0, settings.largest_step
    clock[SHOWN] = -np.inf
    count = np.zeros(COUNTS, dtype=np.int64)
    count[ALL_STEPS], count[EVERY], count[LAST_FRAME] = settings.steps, settings.every, -1
    count[ORDER] = facts.order
    if settings.corrector is not None:
        clock[CORRECTOR_TOLERANCE] = settings.corrector.tolerance
        count[MOST_ITERATIONS] = settings.corrector.most_iterations
        count[NEWTON] = int(settings.corrector.iteration == "newton")
    newton = len(y) if count[NEWTON] and not facts.residual else 0
    numbers = np.zeros(facts.numbers)
    numbers[: len(settings.constants)] = settings.constants
    record = system.record
    record.control.iterations[1:] = 0, MOST_UNSETTLED
    forget(record.partition, formulas=facts.accelerations)
    record.newton.kept[:] = 0.0
    record.newton.balanced[0] = 0.0
    record.residual.vdot[:] = 0.0
    record.residual.lam[:] = 0.0
    if settings.corrector is not None:
        record.newton.settings[:2] = settings.corrector.tolerance, settings.corrector.most_iterations
        record.newton.settings[2] = settings.corrector.matrix == "full"
    if len(record.newton.level):
        record.newton.level[0] = constraint_index(settings.formulation, settings.stabilisation, prepared.path)
    record.coordinates.reference[:] = prepared.assembly.reference
    system.hold_sliders(y)
    record.watched.followed[:] = 0
    record.elements.memory[:] = 0.0
    record.elements.proposal[:] = 0.0
    record.friction.force[:] = 0.0
    # Where steps are chosen, the first one is still what the user calls a short time: stiction stops within two of them, and the error
    # control makes steps as short as that takes. Bristles need no limit there, nor in implicit methods.
    follows = settings.steps == 0 or facts.residual
    record.control.stick[:] = STICK_STEPS * settings.step, 0.0 if follows else STICK_STEPS * settings.step
    system.record.control.energy[:] = 0.0
    prepared.motion.evaluate(0.0, y)
    observe: Any = import_module("nivel.kernels.observe").observe
    observe(prepared.motion.handle.address, 0.0, y, np.zeros(width))
    energy = system.record.control.energy
    energy[2] = energy[0] + energy[1]
    values = _watch(system, chosen=settings.steps == 0)
    count[SWITCHED] = record.watched.followed[0]
    return Run(
        clock=clock,
        counter=count,
        y=y,
        rate=np.zeros_like(y),
        previous=y.copy(),
        scratch=np.zeros_like(y),
        trial=np.zeros_like(y),
        # a run of fixed steps takes no notice of how many more follow
        scale=_scales(system, y, min(settings.duration, LONG * settings.step) if settings.steps else settings.duration),
        stages=np.zeros((facts.stages, len(y))),
        numbers=numbers,
        matrix=np.zeros((newton, newton)),
        pivot=np.zeros(newton, dtype=np.uint32),
        plain=system.map.plain,
        turns=system.map.turns,
        dense=np.zeros((DENSE_ROWS, len(y))),
        frames=np.zeros((rows, width)),
        event_values=np.zeros((6, values)),
        events=np.zeros((EVENT_ROWS if len(record.watched.event) else 0, 3)),
    )


def _watch(system: System, *, chosen: bool) -> int:
    """Number of values whose zeros are looked for: events, and where steps are chosen, contacts and stops."""
    watched = system.record.watched
    if chosen:
        watched.followed[0] = int(len(watched.surface) > 0)
    count = len(watched.event) + (len(watched.surface) if watched.followed[0] else 0)
    if count:
        system.record.hooks.address[WATCH] = import_module("nivel.kernels.watch").watch.address
    return count


def _scales(system: System, y: Array, duration: float) -> Array:
    """What errors of the entries of y are measured by, at least: the machine's length, a radian, these once in the run, its energy at
    such a speed; the deflections of bristles by that in which they slide.

    The largest value that an entry has taken so far counts where it is larger.
    """
    mass = float(system.record.bodies.mass.sum())
    energies = (
        float(system.record.control.energy[0]),
        _weight_energy(system),
        0.5 * mass * (system.size / duration) ** 2,
    )
    energy = max(*energies, 1e-300)
    floors = {"m": system.size, "1": 1.0, "m/s": system.size / duration, "1/s": 1.0 / duration}
    units = np.array(system.map.units)
    scale = np.array([floors.get(unit, 0.0) for unit in units])
    scale[units == "kg^0.5 m"] = system.modal_sizes()
    scale[units == "kg^0.5 m/s"] = system.modal_sizes() / duration
    states = len(system.record.elements.state)
    scale[len(scale) - 2 - states : -2] = _deflections(system)
    scale[-2:] = energy
    return np.maximum(scale, np.abs(y))


def _deflections(system: System) -> Array:
    """Deflection [m] of bristles in steady sliding, coefficient/bristle_stiffness, in the order of their states."""
    record = system.record
    out = np.zeros(len(record.elements.state))
    if len(out):
        columns: Any = import_module("nivel.kernels.friction")
        state = record.friction.columns[:, columns.STATE]
        has = state < len(out)
        numbers = record.friction.number[has]
        out[state[has]] = numbers[:, columns.KINETIC] / numbers[:, columns.STIFFNESS]
    return out


def _weight_energy(system: System) -> float:
    bodies = system.record.bodies
    return float(bodies.mass.sum() * np.linalg.norm(bodies.gravity) * system.size)


def _give(run: Run, sinks: Sequence[Sink]) -> None:
    filled = int(run.counter[FRAMES])
    if filled:
        for sink in sinks:
            sink.take(run.frames[:filled])
        run.counter[FRAMES] = 0


def _taken_events(run: Run, names: tuple[str, ...]) -> list[Occurrence]:
    """Events of the buffer, which is empty then."""
    filled = int(run.counter[EVENTS])
    run.counter[EVENTS] = 0
    return [
        Occurrence(names[int(number)], float(time), "rising" if direction > 0.0 else "falling")
        for time, number, direction in run.events[:filled]
    ]
