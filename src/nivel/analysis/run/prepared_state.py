"""A machine prepared at a state: its start, its equilibrium, or a moment of a run; with the residual that exact derivatives need."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.implicit import ResidualOptions, with_residual
from nivel.analysis.plan.plan import Methods, Plan
from nivel.analysis.preparation.preparation import Prepared, arranged
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.preparation import prepare
from nivel.errors import Fault, ModelError, SolveError
from nivel.integrate.loop.sink import Header
from nivel.lazy import dataclass
from nivel.native.entry import Entry
from nivel.native.signature import BROKEN, IN_C, RESULT_IN_C
from nivel.results.memory import Memory
from nivel.results.motion import rotation_matrices
from nivel.system.system import Array

# every derivative along directions, none by hand
OPTIONS = ResidualOptions(along=True)


@dataclass(frozen=True)
class Moment:
    """The equations of a machine with their residual, a time t [s] and the state y; prepared : as it starts."""

    prepared: Prepared
    motion: MotionEquations
    t: float
    y: Array


@dataclass(frozen=True)
class Posture:
    """A state in absolute coordinates: q, Ṙ, ω̄ of all bodies, states of elements by name, modes and their rates, angles of joints."""

    t: float
    q: Array
    velocity: Array
    angular_velocity_b: Array
    states: Mapping[str, float]
    modes: Array
    modal_rates: Array
    reference: Array


Change = Callable[[MotionEquations, float, Array], None]


def at_start(methods: Methods, change: Change | None = None) -> Moment:
    """The machine as it starts by its settings. change : is made to its equations, for the time and state that it is called with."""
    prepared = prepare(methods)
    if change is not None:
        change(prepared.motion, 0.0, prepared.start)
    return _with_residual(prepared, prepared.motion, 0.0, prepared.start, prepared.assembly.reference, methods)


def at_posture(methods: Methods, posture: Posture, change: Change | None = None) -> Moment:
    """The machine in a posture; change : as of `at_start`. Raises ModelError for flexible bodies in relative coordinates."""
    prepared = prepare(methods)
    if len(posture.modes) and methods.coordinates == "relative":
        message = "a moment of a run of flexible bodies is known in absolute coordinates: use --coordinates absolute"
        raise ModelError(Fault.at("coordinates", message))
    absolute = prepared.absolute.system
    y = absolute.state(posture.q, posture.velocity, posture.angular_velocity_b)
    absolute.record.coordinates.reference[:] = posture.reference
    rank = absolute.machine_rows - len(prepared.redundancy.redundant_rows)
    system, start = arranged(absolute, y, None, rank, methods)
    modes = len(posture.modes)
    if modes:
        start[system.positions - modes : system.positions] = posture.modes
        end = len(start) - len(system.start_of_states)
        start[end - modes : end] = posture.modal_rates
    first = len(start) - len(system.start_of_states)
    for k, fact in enumerate(system.states):
        start[first + k] = posture.states.get(fact.name, start[first + k])
    motion = MotionEquations(system, import_module(methods.path.module))
    if change is not None:
        change(motion, posture.t, start)
    return _with_residual(prepared, motion, posture.t, start, posture.reference, methods)


def _with_residual(
    prepared: Prepared, motion: MotionEquations, t: float, y: Array, reference: Array, methods: Methods
) -> Moment:
    equipped = with_residual(motion, y, methods.coordinates, OPTIONS)
    equipped.system.record.coordinates.reference[:] = reference
    return Moment(prepared, equipped, t, y)


def run_until(plan: Plan, listener: Listener) -> Posture:
    """The posture at the end of a run as planned. Raises SolveError where the run fails."""
    prepared, sink = prepare(plan.methods), Memory()
    layout = prepared.motion.system.layout
    sink.begin(Header(layout, {}))
    listener.say("running", plan.settings.duration)
    outcome = march(prepared, plan.settings, [sink], progress=listener.progress)
    if outcome.asked_to_stop:
        raise KeyboardInterrupt
    result = sink.result()
    if outcome.failure is not None:
        message, advice, at = outcome.failure
        raise SolveError(f"the run to the state failed: {message}", time=at, advice=advice)
    last = {name: result.array(name)[-1] for name in ("position", "orientation", "velocity", "angular_velocity")}
    system, count = prepared.motion.system, prepared.motion.system.body_count
    q = np.hstack([last["position"], last["orientation"]]).reshape(count, 7)
    turned = rotation_matrices(q[:, 3:])
    modal = [result.array(name)[-1] if system.modes else np.zeros(0) for name in ("modal_coordinate", "modal_rate")]
    return Posture(
        t=float(result.time[-1]),
        q=q.ravel(),
        velocity=last["velocity"],
        angular_velocity_b=np.einsum("bij,bi->bj", turned, last["angular_velocity"]),
        states={fact.name: float(result.array(fact.result)[-1]) for fact in system.states},
        modes=modal[0],
        modal_rates=modal[1],
        reference=system.record.coordinates.reference.copy(),
    )


class BoundEntry:
    """A function that calls an entry with the same addresses and arrays every time, and returns its status.

    arguments : addresses, and arrays where the entry takes vectors, or a dual number. `number` is what it takes as a number; at first 0.
    keep : what the addresses are of, kept alive with it.
    """

    def __init__(self, entry: Entry, arguments: Sequence[int | NDArray[Any]], keep: object = None) -> None:
        self._keep = keep, arguments
        self.number = ctypes.c_double(0.0)
        given, parts, kinds = iter(arguments), [], []
        for word in entry.signature.arguments:
            kinds += IN_C[word]
            if word == "number":
                parts.append(self.number)
            elif isinstance(value := next(given), np.ndarray):
                parts += [ctypes.c_void_p(value.ctypes.data), ctypes.c_int64(value.size)][: len(IN_C[word])]
            else:
                parts.append(IN_C[word][0](int(value)))
        function = ctypes.CFUNCTYPE(RESULT_IN_C[entry.signature.result], *kinds)(entry.address)
        self._call: Any = partial(function, *parts)

    def __call__(self) -> int:
        status: int = self._call()
        if status == BROKEN:
            raise RuntimeError("a kernel has raised an exception, which it must not do: a fault of nivel or of a law")
        return status
