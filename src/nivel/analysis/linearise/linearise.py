"""A whole linearisation: the linear model of a machine, with its trust report."""

import json
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.instant import NOTHING, Instant, Lanes, frame_axes, frame_place
from nivel.analysis.linearise.eigenvalues import Complex, Eigen, eigenvalues, graded
from nivel.analysis.linearise.ports import (
    Catalogue,
    Input,
    Opened,
    PressureStates,
    pressure_states,
    seen,
    transformation,
    transformed,
)
from nivel.analysis.linearise.reduction import Reduction, velocity_names
from nivel.analysis.linearise.rotation import rotating
from nivel.analysis.linearise.sampled import at_rest, held_values, sampled_model, samples_of, unrest
from nivel.analysis.linearise.validity import judged, kinks, let_slide, signed
from nivel.analysis.plan.plan import Methods, Plan, methods_of
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.prepared_state import Moment, Posture, at_posture, at_start, run_until
from nivel.elements.control.dynamics import LinearSystem
from nivel.errors import Fault, ModelError, SolveError, refuse
from nivel.judge.after.other_elements import other_elements
from nivel.judge.after.report import assess
from nivel.judge.after.subject import Linearisation, OtherVibrations, Sweep, Variant
from nivel.judge.before.analyses import MOST, not_smooth
from nivel.lazy import Struct, replace
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.analyses import EQUILIBRIUM, ROTATION, LineariseSettings
from nivel.results.analyses.linear_model import LinearModel
from nivel.results.analyses.linear_sweep import LinearSweep
from nivel.results.analyses.mode_motion import Posed
from nivel.results.analyses.sampled_model import SampledModel
from nivel.system.system import Array
from nivel.words.wording import first_of

# Linear model of a machine record about a state, and what its trust report looks at.

NAMED = 6  # states in a sentence


class _States(Struct):
    """Names and units of (s, w, x), and their sizes."""

    names: list[str]
    units: list[str]
    scale: Array


def linear_model(
    opened: Opened,
    methods: Methods,
    settings: LineariseSettings,
    *,
    posture: Posture | None = None,
    source: str = "",
    listener: Listener | None = None,
) -> tuple[LinearModel, Linearisation]:
    """The linear model of a machine, without its trust report, and the subject of that. methods : of it with neutral settings.
    posture : of a moment of a run, where it is wanted.

    Raises ModelError for what has no linear equations, SolveError where they cannot be evaluated.
    """
    (listener or Listener()).say("linearising")
    machine = opened.machine

    def slide(motion: MotionEquations, t: float, y: Array) -> None:
        refuse(not_smooth(machine, let_slide(motion, t, y)))

    moment = at_start(methods, slide) if posture is None else at_posture(methods, posture, slide)
    moment = rotating(moment) if settings.about == ROTATION else moment
    instant = Instant(moment.motion, moment.t, moment.y)
    if instant.n > MOST:
        message = f"{instant.n} velocities are more than the {MOST} of which full matrices are made: use `nivel statics --modes`"
        raise ModelError(Fault.at("linearise", message))
    catalogue = Catalogue(machine, instant, opened)
    inputs, outputs = catalogue.chosen(settings.inputs, settings.outputs)
    pressures = pressure_states(instant.system.states, catalogue.outputs)
    shown = [*outputs, *(catalogue.outputs[name] for name in pressures.outputs)]
    linear = judged(catalogue, moment, instant, inputs, shown)
    reduction, places, rates = linear.reduction, linear.places, linear.rates
    count = len(outputs)
    whole = linear.space._replace(C=linear.space.C[:count], D=linear.space.D[:count])
    of_pressures = linear.space.C[count:]
    every, moving = _states(instant, reduction), len(places) + len(rates)
    if settings.inputs is None:
        inputs, whole = _with_samples(whole, inputs, instant, moving)
    space, states, kept = _opened(whole, every, inputs, moving, instant)
    noise = reduction.noise()[np.ix_(kept, kept)]
    apart = graded(reduction, whole, np.concatenate([places, rates]))
    scale = _timed(states.scale, space.A, len(places), len(places) + len(rates))
    drift = None if linear.drift is None else linear.drift[np.ix_(kept, kept)]
    found = eigenvalues(space.A, scale, noise, None if apart is None else apart.kept(kept), drift)
    bent = kinks(reduction)
    unsteady = linear.unsteady or tuple(_unrest_of_samples(machine, instant))
    jumps = any(each.jumps for each in bent)
    steady = not unsteady and not jumps
    found = found if steady else found.unknown()
    shift, turn = _shapes(instant, reduction, found, places)
    zeros = _zeros(found, states)
    T, states = _with_pressures(of_pressures[:, kept], pressures, states, kept, moving)
    space, found = transformed(space, T), seen(found, T)
    signs = np.concatenate([places, rates])
    sampled = _sampled(machine, reduction, whole, every, signs, (kept, T, states.names)) if steady else None
    second = [rates[:, None] * each * rates for each in reduction.second_order()]
    posed = _posed(machine, source, moment, instant, settings)
    model = LinearModel(
        name=machine.name,
        time=moment.t,
        about=settings.words,
        coordinates=methods.coordinates,
        states=tuple(states.names),
        state_units=tuple(states.units),
        inputs=tuple(each.name for each in inputs),
        input_units=tuple(each.units for each in inputs),
        outputs=tuple(each.name for each in outputs),
        output_units=tuple(each.units for each in outputs),
        A=space.A,
        B=space.B,
        C=space.C,
        D=space.D,
        M=second[0],
        damping=second[1],
        K=second[2],
        eigenvalues=found.values,
        structural=found.zero,
        round_off=found.known,
        right=found.right,
        left=found.left,
        shift=shift,
        turn=turn,
        structural_zeros=zeros,
        steady=steady,
        no_modes="" if steady else _no_modes(settings, moves=linear.moves, jumps=jumps),
        remarks=linear.remarks,
        posed=posed,
        sampled=sampled,
    )
    return model, Linearisation(
        outcome="done",
        machine=machine,
        prepared=moment.prepared,
        eigenvalues=found.values,
        round_off=found.known,
        moves=linear.moves,
        unsteady=unsteady,
        kinks=tuple(bent),
        reached=0.0 if posture is None else posture.t,
        assembly=json.loads(str(posed.attributes.get("assembly", "{}"))) if posture is None else {},
        size=instant.system.size,
    )


def _no_modes(settings: LineariseSettings, *, moves: bool, jumps: bool) -> str:
    """Why there are no modes, and what to do. jumps : a force does at this state."""
    if jumps:
        why, remedy = "a force jumps at this state", "linearise about a state beside the jump"
    elif moves:
        why = "the machine moves and its linear equations change"
        remedy = "linearise about an equilibrium (`--about equilibrium`) or a steady rotation (`--about rotation`)"
    elif settings.about == EQUILIBRIUM:
        why, remedy = "in this equilibrium states still change", "start the machine with values that stay"
    else:
        why = "the machine is not in equilibrium there"
        remedy = "linearise about one (`--about equilibrium`), or start at rest in one"
    return f"no modes of motion about {settings.words} are given, because {why}: {remedy}"


def _states(instant: Instant, reduction: Reduction) -> _States:
    names = velocity_names(instant.system)
    places, rates = ([names[instant.free[k]] for k in each] for each in reduction.chosen)
    length = instant.length[instant.free]
    facts = instant.system.states
    return _States(
        [name for name, _ in places] + [f"{name}.rate" for name, _ in rates] + [fact.result for fact in facts],
        [unit for _, unit in places] + [f"{unit}/s" for _, unit in rates] + [fact.units for fact in facts],
        np.concatenate([length[reduction.selected], length[reduction.moving], [fact.scale or 1.0 for fact in facts]]),
    )


def _with_samples(
    space: LinearSystem, inputs: Sequence[Input], instant: Instant, moving: int
) -> tuple[list[Input], LinearSystem]:
    """The inputs, and sampled values that the machine reads."""
    facts = instant.system.states
    own = [k for k, fact in enumerate(facts) if fact.sampled and np.any(space.A[:, moving + k])]
    more = [Input(facts[k].result, facts[k].units, "state", (k,)) for k in own]
    B, D = (np.hstack([each, np.zeros((len(each), len(more)))]) for each in (space.B, space.D))
    return [*inputs, *more], LinearSystem(space.A, B, space.C, D)


def _opened(
    space: LinearSystem, states: _States, inputs: Sequence[Input], moving: int, instant: Instant
) -> tuple[LinearSystem, _States, NDArray[np.intp]]:
    """States of elements that are inputs become columns of B; also which states are left. moving : states before them.

    Left out are sampled states, and states on which nothing depends, as what a pump has delivered, but where an output shows them.
    """
    taken = {moving + each.place[0]: k for k, each in enumerate(inputs) if each.kind == "state"}
    facts = instant.system.states
    idle = {moving + k for k, fact in enumerate(facts) if fact.integral and not np.any(space.C[:, moving + k])}
    idle |= {moving + k for k, fact in enumerate(facts) if fact.sampled}
    kept = np.array([k for k in range(len(space.A)) if k not in taken and k not in idle], dtype=np.intp)
    B, D = space.B.copy(), space.D.copy()
    for column, k in taken.items():
        B[:, k], D[:, k] = space.A[:, column], space.C[:, column]
    out = LinearSystem(space.A[np.ix_(kept, kept)], B[kept], space.C[:, kept], D)
    left = _States([states.names[k] for k in kept], [states.units[k] for k in kept], states.scale[kept])
    return out, left, kept


def _with_pressures(
    rows: Array, pressures: PressureStates, states: _States, kept: NDArray[np.intp], moving: int
) -> tuple[Array, _States]:
    """(T, states) by which pressures stand in place of masses. rows (pressures, kept) : of the pressures."""
    place = {int(whole): k for k, whole in enumerate(kept)}
    own = [(place[moving + k], row, name) for row, (k, name) in enumerate(pressures.pairs) if moving + k in place]
    T, replaced = transformation(rows[[row for _, row, _ in own]], [k for k, _, _ in own], states.scale)
    names, units = list(states.names), list(states.units)
    for k, _, name in own:
        if k in replaced:
            names[k], units[k] = name, "Pa"
    return T, _States(names, units, np.abs(T) @ states.scale)


def _unrest_of_samples(machine: MachineRecord, instant: Instant) -> list[str]:
    samples = samples_of(instant)
    return unrest(instant, samples, held_values(machine, instant)) if samples else []


def _sampled(
    machine: MachineRecord,
    reduction: Reduction,
    whole: LinearSystem,
    states: _States,
    signs: Array,
    continuous: tuple[NDArray[np.intp], Array, Sequence[str]],
) -> SampledModel | None:
    """The machine with its sampled values; None where there are none. continuous : states that are none, T of these and their names."""
    instant, (kept, T, known) = reduction.instant, continuous
    held, moving = held_values(machine, instant), len(signs)
    samples = [each for each in samples_of(instant) if each.state not in held]
    if not samples:
        return None
    own = list(dict.fromkeys(each.state for each in samples))
    order = np.concatenate([kept, moving + np.array(own, dtype=np.intp)])
    laws = at_rest(instant, lambda: signed(reduction.evaluated_again().state_space(), signs).A)
    F = np.eye(len(whole.A))
    F[moving + np.array(own)] += laws[moving + np.array(own)]
    A, count = whole.A[np.ix_(order, order)], len(kept)
    A[count:] = 0.0
    turned = np.eye(len(order))
    turned[:count, :count] = T
    placed = [replace(each, state=count + own.index(each.state)) for each in samples]
    acting = [count + k for k in range(len(own)) if np.any(A[:count, count + k])]
    names = [*known, *(states.names[moving + k] for k in own)]
    return sampled_model(A, F[np.ix_(order, order)], states.scale[order], names, placed, turned, acting)


def _timed(scale: Array, A: Array, m: int, moving: int) -> Array:
    """Sizes of the states, those of rates (from m to `moving`) by the fastest vibration that stiffness alone would make."""
    stiffness = np.abs(A[m:moving, :m] * scale[:m] / scale[m:moving, None])
    out = scale.copy()
    out[m:moving] *= np.sqrt(float(np.max(stiffness, initial=0.0))) or 1.0
    return out


def _shapes(instant: Instant, reduction: Reduction, found: Eigen, signs: Array) -> tuple[Complex, Complex]:
    """(shift, turn), each (n, B, 3): what body frames do in each eigenvector."""
    count, m = instant.system.body_count, len(signs)

    def read(own: Instant) -> Lanes:
        places = np.array([frame_place(own, b) for b in range(count)])
        axes = own.twin.bodies.A[:count]
        return np.concatenate([places.reshape(-1, len(NOTHING)), axes.reshape(-1, len(NOTHING))])

    if not count or not m or len(found.values) == 0:
        return np.zeros((len(found.values), count, 3), complex), np.zeros((len(found.values), count, 3), complex)
    seen = instant.along("q", read).seen @ (reduction.positions * signs)
    axes = instant.read(read)[3 * count :].reshape(count, 3, 3)
    spins = np.einsum("bijk,blj->bilk", seen[3 * count :].reshape(count, 3, 3, m), axes)
    turns = 0.5 * np.stack(
        [spins[:, 2, 1] - spins[:, 1, 2], spins[:, 0, 2] - spins[:, 2, 0], spins[:, 1, 0] - spins[:, 0, 1]], axis=1
    )
    x = found.right[:m]
    shift = np.einsum("bim,mk->kbi", seen[: 3 * count].reshape(count, 3, m), x)
    return shift, np.einsum("bim,mk->kbi", turns, x)


def _zeros(found: Eigen, states: _States) -> tuple[str, ...]:
    out = []
    single = [states.names[group[0]] for group in found.zeros if len(group) == 1]
    if single:
        out.append(f"{len(single)} exactly zero, by structure: no stiffness acts on {first_of(single, NAMED)}")
    for group in dict.fromkeys(group for group in found.zeros if len(group) > 1):
        names = [states.names[k] for k in group]
        out.append(f"{found.zeros.count(group)} exactly zero, of a rigid motion of {first_of(names, NAMED)}")
    return tuple(out)


def _posed(machine: MachineRecord, source: str, moment: Moment, instant: Instant, settings: LineariseSettings) -> Posed:
    """What it takes to show modes: the machine, and where its bodies are."""
    count = instant.system.body_count

    attributes = run_attributes(machine, source, moment.prepared, settings)
    own = instant
    own.value()
    places = np.array([frame_place(own, b)[..., 0] for b in range(count)]).reshape(count, 3)
    axes = np.array([frame_axes(own, b)[..., 0] for b in range(count)]).reshape(count, 3, 3)
    theta = Rotation.from_matrix(axes).as_quat(scalar_first=True)
    return Posed(tuple(own.system.bodies), places, theta, own.system.size, {**attributes, "outcome": "done"})


def other_vibrations(
    opened: Opened, methods: Methods, settings: LineariseSettings, run: Plan | None
) -> OtherVibrations | None:
    """What the trust report compares the vibrations with; None where there are no beams. run : to the state, or None."""
    pair = other_elements(opened.machine)
    if pair is None:
        return None
    try:
        posture = None
        if run is not None:
            its = other_elements(run.machine)
            assert its is not None  # it has the same beams
            at = methods_of(its.machine, run.methods.formulation, run.methods.coordinates)
            posture = run_until(replace(run, machine=its.machine, methods=at), Listener())
        its_methods = methods_of(pair.machine, methods.formulation, methods.coordinates)
        model, _ = linear_model(replace(opened, machine=pair.machine), its_methods, settings, posture=posture)
    except (ModelError, SolveError) as error:
        return OtherVibrations(pair, np.zeros(0, dtype=np.complex128), str(error))
    return OtherVibrations(pair, model.eigenvalues)


def linearise(
    opened: Opened,
    methods: Methods,
    settings: LineariseSettings,
    *,
    run: Plan | None = None,
    source: str = "",
    listener: Listener | None = None,
) -> LinearModel:
    """The linear model of a machine. methods : of it with neutral settings. run : to the state that it is about, or None.

    Raises ModelError for what has no linear equations, SolveError where they cannot be evaluated.
    """
    posture = None if run is None else run_until(run, listener or Listener())
    model, subject = linear_model(opened, methods, settings, posture=posture, source=source, listener=listener)
    if settings.verify:
        subject = replace(subject, others=other_vibrations(opened, methods, settings, run))
    return replace(model, trust=assess(subject))


def over(parameter: str, unit: str, values: Sequence[float], models: Sequence[LinearModel]) -> LinearSweep:
    """The models at ascending values of a parameter. Raises ModelError where their states differ, or values do not ascend."""
    seen = tuple(
        Variant(
            f"{parameter} = {value:g} {unit}".rstrip(),
            "done",
            "",
            model.trust.light,
            model.trust.verified,
            _worst(model),
        )
        for value, model in zip(values, models, strict=True)
    )
    without = models[0].trust.headline if models else ""
    trust = assess(Sweep(outcome="done", variants=seen, by="the trust reports", without=f"each model is {without}"))
    return LinearSweep(parameter, unit, np.array(values), tuple(models), trust)


def _worst(model: LinearModel) -> str:
    """The first line that is not green, or the headline."""
    return next((item.text for item in model.trust.items if item.verdict != "green"), model.trust.headline)
