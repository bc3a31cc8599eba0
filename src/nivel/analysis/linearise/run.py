"""Linear model of a machine record about a state, and what its trust report looks at."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from nivel.analysis.assembly.instant import Instant
from nivel.analysis.assembly.lanes import NOTHING, Lanes
from nivel.analysis.assembly.user_frames import frame_axes, frame_place
from nivel.analysis.linearise.eigenvalues import Complex, Eigen, eigenvalues
from nivel.analysis.linearise.kinks import kinks
from nivel.analysis.linearise.names import velocity_names
from nivel.analysis.linearise.ports import Catalogue, Input
from nivel.analysis.linearise.reduction import Reduction, StateSpace
from nivel.analysis.linearise.refusals import MOST, refuse_jumps
from nivel.analysis.linearise.rotation import rotating
from nivel.analysis.linearise.validity import judged
from nivel.analysis.linearise.vibrations_apart import graded
from nivel.analysis.plan.plan import Methods
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.progress.listener import Listener
from nivel.analysis.run.prepared_state import Moment, Posture, at_posture, at_start
from nivel.analysis.trust.subject import Linearisation
from nivel.errors import Fault, ModelError
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.linearise import ROTATION, LineariseSettings
from nivel.results.analyses.linear_model import LinearModel
from nivel.results.analyses.linear_motion import Posed
from nivel.system.system import Array

NAMED = 6  # states in a sentence


@dataclass(frozen=True)
class _States:
    """Names and units of (s, w, x), and their sizes."""

    names: list[str]
    units: list[str]
    scale: Array


def linear_model(
    machine: MachineRecord,
    methods: Methods,
    settings: LineariseSettings,
    *,
    posture: Posture | None = None,
    source: str = "",
    listener: Listener | None = None,
) -> tuple[LinearModel, Linearisation]:
    """The linear model of `machine`, without its trust report, and the subject of that. methods : of the machine with neutral settings.
    posture : of a moment of a run, where it is wanted.

    Raises ModelError for what has no linear equations, SolveError where they cannot be evaluated.
    """
    (listener or Listener()).say("linearising")
    refuse_jumps(machine)
    moment = at_start(methods) if posture is None else at_posture(methods, posture)
    moment = rotating(moment) if settings.about == ROTATION else moment
    instant = Instant(moment.motion, moment.t, moment.y)
    _refuse_large(instant)
    catalogue = Catalogue(machine, instant)
    inputs, outputs = catalogue.chosen(settings.inputs, settings.outputs)
    linear = judged(catalogue, moment, instant, inputs, outputs)
    reduction, whole, places, rates = linear.reduction, linear.space, linear.places, linear.rates
    states = _states(instant, reduction)
    integrals = [k for k, fact in enumerate(instant.system.states) if fact.integral]
    space, states, inputs, kept = _opened(whole, states, inputs, len(places) + len(rates), integrals)
    noise = reduction.noise()[np.ix_(kept, kept)]
    apart = graded(reduction, whole, np.concatenate([places, rates]))
    scale = _timed(states.scale, space.A, len(places), len(places) + len(rates))
    drift = None if linear.drift is None else linear.drift[np.ix_(kept, kept)]
    found = eigenvalues(space.A, scale, noise, None if apart is None else apart.kept(kept), drift)
    bent = kinks(reduction)
    steady = not linear.unsteady and not any(each.jumps for each in bent)
    found = found if steady else found.unknown()
    shift, turn = _shapes(instant, reduction, found, places)
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
        right=found.right,
        left=found.left,
        shift=shift,
        turn=turn,
        structural_zeros=_zeros(found, states),
        steady=steady,
        remarks=linear.remarks,
        posed=posed,
    )
    return model, Linearisation(
        outcome="done",
        machine=machine,
        prepared=moment.prepared,
        eigenvalues=found.values,
        moves=linear.moves,
        unsteady=linear.unsteady,
        kinks=tuple(bent),
        reached=0.0 if posture is None else posture.t,
        assembly=json.loads(str(posed.attributes.get("assembly", "{}"))) if posture is None else {},
        size=instant.system.size,
    )


def _refuse_large(instant: Instant) -> None:
    if instant.n > MOST:
        message = f"{instant.n} velocities are more than the {MOST} of which full matrices are made: use `nivel statics --modes`"
        raise ModelError(Fault("", 0, 0, "linearise", message))


def _states(instant: Instant, reduction: Reduction) -> _States:
    names = velocity_names(instant.system)
    places, rates = ([names[instant.free[k]] for k in each] for each in reduction.chosen)
    length = instant.length[instant.free]
    facts = instant.system.states
    return _States(
        [name for name, _ in places] + [f"{name}.rate" for name, _ in rates] + [f"state.{fact.name}" for fact in facts],
        [unit for _, unit in places] + [f"{unit}/s" for _, unit in rates] + [fact.units for fact in facts],
        np.concatenate([length[reduction.selected], length[reduction.moving], [fact.scale or 1.0 for fact in facts]]),
    )


def _opened(
    space: StateSpace, states: _States, inputs: Sequence[Input], moving: int, integrals: Sequence[int]
) -> tuple[StateSpace, _States, list[Input], NDArray[np.intp]]:
    """States of elements that are inputs become columns of B; also which states are left. moving : states before them.

    integrals : states on which nothing depends, as what a pump has delivered; left out but where an output shows them.
    """
    taken = {moving + each.place[0]: k for k, each in enumerate(inputs) if each.kind == "state"}
    idle = {moving + k for k in integrals if not np.any(space.C[:, moving + k])}
    kept = np.array([k for k in range(len(space.A)) if k not in taken and k not in idle], dtype=np.intp)
    B, D = space.B.copy(), space.D.copy()
    for column, k in taken.items():
        B[:, k], D[:, k] = space.A[:, column], space.C[:, column]
    out = StateSpace(space.A[np.ix_(kept, kept)], B[kept], space.C[:, kept], D)
    left = _States([states.names[k] for k in kept], [states.units[k] for k in kept], states.scale[kept])
    return out, left, list(inputs), kept


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
    """Sentences on the eigenvalues that are exactly zero."""
    out = []
    single = [states.names[group[0]] for group in found.zeros if len(group) == 1]
    if single:
        out.append(f"{len(single)} exactly zero, by structure: no stiffness acts on {_listed(single)}")
    for group in dict.fromkeys(group for group in found.zeros if len(group) > 1):
        names = [states.names[k] for k in group]
        out.append(f"{found.zeros.count(group)} exactly zero, of a rigid motion of {_listed(names)}")
    return tuple(out)


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names[:NAMED]) + (f" and {len(names) - NAMED} more" if len(names) > NAMED else "")


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
