"""The history of a run at its start: clocks, counters, scales of errors, room for frames and events, and nothing remembered."""

from fractions import Fraction
from typing import Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.implicit import constraint_index
from nivel.analysis.curves.corners import corners
from nivel.analysis.plan.settings import RunSettings
from nivel.analysis.preparation.preparation import Prepared
from nivel.integrate.explicit.dormand_prince import COUNTS as COUNTS_STIFF
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.run import Run
from nivel.integrate.stabilise import STABILISATIONS
from nivel.judge.after.checks.friction import STILL
from nivel.judge.before.refusals import WHOLE
from nivel.judge.during.lockup import can_be_asked
from nivel.kernels.elements import friction as columns
from nivel.kernels.output.observe import observe
from nivel.kernels.record.record import SAMPLE, WATCH, Sampled
from nivel.kernels.signals.functions import sample
from nivel.kernels.signals.watch import watch
from nivel.kernels.solve.saddle import CONTRADICTORY, MOST_UNSETTLED
from nivel.lazy import nivel
from nivel.motion.direct import VISIBLE
from nivel.system.elimination.partition import forget
from nivel.system.signals.control import ONCE, ratio_of
from nivel.system.system import Array, System
from nivel.system.tables import ON_SOIL, OVER_HEIGHTS, rows_of

BUFFER_BYTES = 1_000_000
EVENT_ROWS = 1000
WINDOWS = 256
# Stiction stops a joint within this many steps, and within more where a method would not be stable: 1/τ times a step is this share of
# what it holds.
STICK_STEPS, STICK_SHARE = 2.0, 0.8
# Where an implicit method chooses its steps, within STICK [s] at this tolerance, and with the root of that; what comes to rest does so too
# late by 2/40 of the tolerance (see `_sticking_time`). Where an explicit one does, within its two steps at the tolerance SLACK.
STICK, STICK_TOLERANCE, LATE, SLACK = 1e-5, 1e-8, 1.0 / 20.0, 1e-6
# Fixed steps that make a time in which a machine moves by its own length, at least.
LONG = 1e4
# Positions open by more than this share of the scales of their rows are beyond all drift, where nobody can tell whether the machine jams.
TORN = 0.1
# The tolerance of steps of fixed size that end at switches: what a switch may do to the state unseen, as a share of its scales.
AT_SWITCHES = 1e-9
# Scale of what nothing depends on.
UNSEEN = 1e30


def start_history(
    prepared: Prepared, settings: RunSettings, facts: IntegratorFacts, ends: int = 0, at_switches: bool = False
) -> Run:
    """History of a run at its start: energies referred to the assembled state, joint angles followed from it, nothing remembered. ends : of
    so many steps it is kept when they ended. at_switches : steps of fixed size end where chosen ones do."""
    system, y = prepared.motion.system, prepared.start.copy()
    width, count = system.layout.width, _counters(settings, facts)
    rows = max(2, min(4096, BUFFER_BYTES // (8 * width)))
    newton = len(y) if count[of_run.NEWTON] and not facts.residual else 0
    numbers = np.zeros(facts.numbers)
    numbers[: len(settings.constants)] = settings.constants
    if prepared.methods is not None and prepared.methods.stiff is not None:
        numbers[COUNTS_STIFF] = 1.0
    _forget_runs(prepared, settings, facts)
    system.hold_sliders(y)
    _begin_states(prepared, y)
    refer_energies(prepared, y)
    at_switches = at_switches and settings.steps > 0
    values = _watch(system, chosen=settings.steps == 0 or at_switches)
    count[of_run.SWITCHED] = values > len(system.record.watched.event)
    clock, ending = _clock(prepared, settings), prepared.corners
    if at_switches:
        clock[of_run.TOLERANCE] = AT_SWITCHES
        if prepared.machine is not None and not facts.knows_corners:
            ending = corners(prepared.machine, with_values=True)
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
        raised=_raised(system, y).astype(np.uint32),
        stages=np.zeros((facts.stages, len(y))),
        numbers=numbers,
        matrix=np.zeros((newton, newton)),
        pivot=np.zeros(newton, dtype=np.uint32),
        plain=system.map.plain,
        turns=system.map.turns,
        dense=np.zeros((of_run.DENSE_ROWS, len(y))),
        frames=np.zeros((rows, width)),
        event_values=np.zeros((of_run.VALUE_ROWS, values)),
        samples=np.zeros(len(system.record.sampled.state), dtype=np.int64),
        corners=np.array(ending, dtype=float),
        pace=_pace(prepared, settings),
        events=np.zeros((EVENT_ROWS if len(system.record.watched.event) else 0, 3)),
        ends=np.zeros(ends),
        windows=np.full((WINDOWS if ends else 0, 3), np.inf),
    )


def go_on_with(prepared: Prepared, settings: RunSettings, run: Run) -> Run:
    """History of a run that goes on from its accepted state with the integrator of `prepared`: all that it remembers but steps."""
    facts, motion, t = prepared.integrator, prepared.motion, float(run.clock[of_run.TIME])
    newton = motion.system.record.newton
    if len(newton.level):
        newton.level[0] = constraint_index(settings.formulation, settings.stabilisation, prepared.path)
    run.counter[of_run.ORDER], run.counter[of_run.RESTART], run.counter[of_run.EVALUATED] = facts.order, 1, 1
    run.rate[:] = motion.evaluate(t, run.y)[1]
    numbers, stages = np.zeros(facts.numbers), np.zeros((facts.stages, len(run.y)))
    return run._replace(stages=stages, numbers=numbers, corners=np.zeros(0))


def _clock(prepared: Prepared, settings: RunSettings) -> Array:
    clock = np.zeros(of_run.CLOCKS)
    step = _step_ratio(prepared.motion.system.record.sampled, settings.step)
    clock[of_run.STEP_TICKS], clock[of_run.TICK_RATE] = step.numerator, step.denominator
    clock[of_run.STEP], clock[of_run.END] = settings.step, settings.duration
    clock[of_run.INTERVAL] = settings.output_interval
    clock[of_run.TOLERANCE], clock[of_run.LARGEST] = settings.tolerance or 0.0, settings.largest_step
    clock[of_run.SHOWN], clock[of_run.HORIZON] = -np.inf, np.inf
    clock[of_run.OPEN_LIMIT] = _open_limit(prepared, settings)
    if settings.corrector is not None:
        clock[of_run.CORRECTOR_TOLERANCE] = settings.corrector.tolerance
    return clock


def _step_ratio(sampled: Sampled, step: float) -> Fraction:
    """A step [s] as a ratio of whole numbers: a whole part of the time between samples, where there are samples."""
    for each, rate in zip(sampled.ticks, sampled.rate, strict=True):
        if 0.0 < each < ONCE:
            period = Fraction(each) / Fraction(rate)
            count = max(1, round(period / Fraction(step)))
            if abs(period / count - Fraction(step)) <= WHOLE * step:
                return period / count
    return ratio_of(step)


def _pace(prepared: Prepared, settings: RunSettings) -> Array:
    """Nothing done yet, and steps as long as the settings and the functions of time allow."""
    pace = np.zeros((of_run.PACES, of_run.PARTS))
    pace[of_run.LEAST] = np.inf
    pace[of_run.ALLOWED] = settings.largest_step
    if prepared.allowed is not None:
        pace[of_run.ALLOWED] = np.minimum(pace[of_run.ALLOWED], prepared.allowed)
    return pace


def _open_limit(prepared: Prepared, settings: RunSettings) -> float:
    """The share of the scales of the constraints by which positions may be open until it is asked whether the machine jams."""
    if not can_be_asked(prepared):
        return TORN
    return VISIBLE if STABILISATIONS[settings.stabilisation].corrects else CONTRADICTORY


def _counters(settings: RunSettings, facts: IntegratorFacts) -> NDArray[np.int64]:
    count = np.zeros(of_run.COUNTS, dtype=np.int64)
    count[of_run.ALL_STEPS], count[of_run.EVERY], count[of_run.LAST_FRAME] = settings.steps, settings.every, -1
    count[of_run.ORDER] = facts.order
    if settings.corrector is not None:
        count[of_run.MOST_ITERATIONS] = settings.corrector.most_iterations
        count[of_run.NEWTON] = int(settings.corrector.iteration == "newton")
    return count


def _forget_runs(prepared: Prepared, settings: RunSettings, facts: IntegratorFacts) -> None:
    """Everything that the record remembers of runs before, and what it has to know of this one."""
    record = prepared.motion.system.record
    for unit in prepared.motion.system.units:
        unit.begin()
    stick = _sticking_time(prepared, settings, facts)
    record.control.iterations[1:] = 0, MOST_UNSETTLED
    forget(record.partition, formulas=facts.needs == "accelerations")
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
    record.watched.followed[:] = 0
    record.watched.held[:] = 0.0
    record.sampled.came[:] = 0
    record.circuit.guard[:] = 0.0
    record.circuit.secant[:] = facts.guarded
    record.elements.memory[:] = 0.0
    record.elements.proposal[:] = 0.0
    record.friction.force[:], record.friction.work[:] = 0.0, 0.0
    # Bristles need no limit where steps are chosen, nor in implicit methods.
    follows = settings.steps == 0 or facts.residual
    record.control.stick[:] = stick, 0.0 if follows else stick
    if len(record.friction.columns):
        turns = record.friction.columns[:, columns.ROTATES] == 1
        record.friction.number[:, columns.REST] = (
            STILL * np.where(turns, 1.0, prepared.motion.system.size) / settings.duration
        )


def _sticking_time(prepared: Prepared, settings: RunSettings, facts: IntegratorFacts) -> float:
    """[s] within which stiction stops a joint.

    What decelerates at a comes to rest too far by 2 a τ² at most. Where steps are chosen that is a tenth of the tolerance, as a share
    of the machine's size or a radian, for the weight and for the accelerations at the start; and τ is STICK at most. An explicit method,
    whose steps it limits, has two steps at the tolerance SLACK and less below.
    """
    if settings.tolerance is None:
        return max(STICK_STEPS, 1.0 / (STICK_SHARE * facts.held)) * settings.step
    if not facts.residual:
        return STICK_STEPS * settings.step * min(1.0, (settings.tolerance / SLACK) ** 0.5)
    if not len(prepared.motion.system.record.friction.columns):
        return settings.step
    prepared.motion.system.record.control.stick[0] = settings.step
    system, rate = prepared.motion.system, prepared.motion.evaluate(0.0, prepared.start)[1]
    gravity = float(np.linalg.norm(system.record.bodies.gravity))
    units = np.array(system.map.units)
    fastest = {unit: float(np.max(np.abs(rate[units == unit]), initial=0.0)) for unit in ("m/s", "1/s")}
    scales = ((system.size, max(fastest["m/s"], gravity)), (1.0, fastest["1/s"]))
    squares = [STICK**2 / STICK_TOLERANCE, *(LATE * size / a for size, a in scales if 0.0 < a < np.inf)]
    return min(settings.step, (settings.tolerance * min(squares)) ** 0.5)


def _begin_states(prepared: Prepared, y: Array) -> None:
    """States that begin with what a function gives at t = 0, from there on: energies are referred to them."""
    motion, sampled = prepared.motion, prepared.motion.system.record.sampled
    begins = (sampled.ticks >= ONCE) & (sampled.first == 0.0)
    sampled.due[:] = begins  # an earlier run may have left others
    if not begins.any():
        return
    motion.evaluate(0.0, y)
    sample.code(motion.handle.address, 0, 0.0)
    first = len(y) - len(motion.system.start_of_states)
    y[first + sampled.state[begins]] = sampled.value[begins]


def refer_energies(prepared: Prepared, y: Array) -> None:
    """Energies of the record are referred to the state y."""
    motion = prepared.motion
    energy = motion.system.record.control.energy
    energy[:] = 0.0
    motion.evaluate(0.0, y)
    observe(motion.handle.address, 0.0, y, np.zeros(motion.system.layout.width))
    energy[2] = energy[0] + energy[1]


def _watch(system: System, *, chosen: bool) -> int:
    """Number of values whose zeros are looked for: events, and where steps are chosen, contacts, stops and switches."""
    watched = system.record.watched
    if chosen:
        watched.followed[0] = int(len(watched.surface) > 0)
    count = len(watched.event) + (len(watched.surface) + len(watched.switch) if chosen else 0)
    if count:
        system.record.hooks.address[WATCH] = watch.address
    watched.followed[3:] = rows_of(system.record.elements, ON_SOIL)
    if watched.followed[4]:
        system.record.hooks.address[SAMPLE] = nivel.elements.contacts.on_soil.sample.address
    first, last = rows_of(system.record.elements, OVER_HEIGHTS)
    if last > first:
        watched.followed[1:3] = first, last
        system.record.hooks.address[WATCH] = nivel.elements.contacts.height_way.watch.address
        heights = nivel.elements.contacts.heights
        system.record.elements.number[first:last, [heights.MISSED, heights.SEEN]] = 0.0
    return count


# energy that counts in a circuit without bodies [J]
JOULE: Final = 1.0


def _scales(system: System, y: Array, duration: float) -> Array:
    """What errors of the entries of y are measured by, at least: the machine's length, a radian, these once in the run, its energy at
    such a speed; states of elements by their own scales.

    The largest value that an entry has taken so far counts where it is larger.
    """
    mass = float(system.record.bodies.mass.sum())
    energies = (
        float(system.record.control.energy[0]),
        mass * float(np.linalg.norm(system.record.bodies.gravity)) * system.size,
        0.5 * mass * (system.size / duration) ** 2,
    )
    energy = max(*energies, 1e-300 if mass else JOULE)
    floors = {"m": system.size, "1": 1.0, "m/s": system.size / duration, "1/s": 1.0 / duration}
    units = np.array(system.map.units)
    scale = np.array([floors.get(unit, 0.0) for unit in units])
    scale[units == "kg^0.5 m"] = system.modal_sizes()
    scale[units == "kg^0.5 m/s"] = system.modal_sizes() / duration
    of_states = [UNSEEN if fact.integral else fact.scale for fact in system.states]
    scale[len(scale) - len(system.start_of_states) :] = [*of_states, energy, energy]
    return np.where(_raised(system, y), np.maximum(scale, np.abs(y)), scale)


def _raised(system: System, y: Array) -> NDArray[np.bool_]:
    """Whether the scale of each entry of y follows its largest value."""
    out = np.ones(len(y), dtype=bool)
    of_states = [fact.relative and not fact.integral for fact in system.states]
    out[len(y) - len(system.start_of_states) :] = [*of_states, True, True]
    return out
