"""A machine prepared at a state: its start, its equilibrium, or a moment of a run; with the residual that exact derivatives need.

Motion of one simulation carried over to another of a machine with the same structure and other numbers.
What is carried is what the motion remembers: time, state, turns of angles, memories of forces and friction, samples and inputs. Masses,
lengths and laws stay those of the machine that takes it.
"""

import ctypes
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from importlib import import_module
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.closing import Wishes, close_positions, least_change
from nivel.analysis.assembly.equations import MotionEquations, equations
from nivel.analysis.assembly.implicit import ResidualOptions, with_residual
from nivel.analysis.assembly.named_freedoms import coordinate_derivatives, freedoms
from nivel.analysis.assembly.velocities import whitened
from nivel.analysis.plan.plan import Methods, Plan
from nivel.analysis.preparation import preparation
from nivel.analysis.preparation.memory import Role, leaves
from nivel.analysis.preparation.preparation import Prepared, arranged
from nivel.analysis.progress.log import Listener
from nivel.analysis.run.dynamics import march
from nivel.errors import Fault, ModelError, SolveError, refuse
from nivel.integrate.loop.run import ALL_STEPS, BUDGET, END, EVERY, FRAMES, LAST_FRAME, OPEN_LIMIT, TOLERANCE, Run
from nivel.integrate.loop.sink import Header
from nivel.lazy import Struct, nivel
from nivel.native.entry import Entry
from nivel.native.signature import BROKEN, IN_C, RESULT_IN_C
from nivel.results.memory import Memory
from nivel.results.motion import rotation_matrices
from nivel.system.system import Array, System

# every derivative along directions, none by hand
OPTIONS = ResidualOptions(along=True)


class Moment(Struct):
    """The equations of a machine with their residual, a time t [s] and the state y; prepared : as it starts."""

    prepared: Prepared
    motion: MotionEquations
    t: float
    y: Array


class Posture(Struct):
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


Structure = Mapping[str, tuple[str, ...]]

# entries of clocks and counters that belong to a simulation, not to its motion
OWN_CLOCKS, OWN_COUNTERS = (END, TOLERANCE, OPEN_LIMIT), (ALL_STEPS, EVERY, FRAMES, LAST_FRAME, BUDGET)


def structure_of(plan: Plan, prepared: Prepared) -> Structure:
    """Names of all that a state is made of, and how it is stepped."""
    system, settings = prepared.motion.system, plan.settings
    layout, machine = system.layout, plan.machine
    return {
        "integrator": (settings.integrator,),
        "step": (f"{settings.step:.17g} s",),
        "coordinates": (prepared.path.module.rpartition(".")[2],),
        "formulation": (plan.methods.formulation,),
        "body": system.bodies,
        "joint": system.joints,
        "joint coordinate": tuple(layout.coordinates["joint_coordinate"]),
        "constraint row": system.rows,
        "force": tuple(f"{force.name} ({force.type})" for force in machine.forces),
        "state": tuple(fact.name for fact in system.states),
        "mode": system.modes,
        "event": system.events,
        "input": tuple(each.name for each in machine.inputs),
        "coordinate of the tree": system.tree_names,
        "number of the state": (str(len(prepared.start)),),
    }


def refuse_other_structure(mine: Structure, given: Structure) -> None:
    """Raise ModelError with what a state of another structure has in place of this one's."""
    for kind, names in mine.items():
        other = tuple(given.get(kind, ()))
        if names == other:
            continue
        more, less = ([name for name in a if name not in b] for a, b in ((other, names), (names, other)))
        if len(names) == len(other) == 1 or not (more or less):
            said = f"its {kind} is {', '.join(other) or 'not known'}, not {', '.join(names)}"
        else:
            parts = [f"it has the {kind} `{more[0]}`, which is not here"] if more else []
            said = "; ".join([*parts, *([f"it lacks the {kind} `{less[0]}`"] if less else [])])
        raise ModelError(f"the state is of another machine: {said}")


def carry_over(kept: Sequence[NDArray[Any]], given: Sequence[NDArray[Any]], prepared: Prepared, run: Run) -> None:
    """Put what a state remembers of a motion into `prepared` and `run`, whose memory is `kept`. given : arrays of the state."""
    for mine, theirs in _pairs(kept, given, prepared, run):
        if mine is run.clock or mine is run.counter:
            own = list(OWN_CLOCKS if mine is run.clock else OWN_COUNTERS)
            values = mine[own].copy()
            mine[...] = theirs
            mine[own] = values
        else:
            mine[...] = theirs


def _pairs(
    kept: Sequence[NDArray[Any]], given: Sequence[NDArray[Any]], prepared: Prepared, run: Run
) -> Iterator[tuple[NDArray[Any], NDArray[Any]]]:
    """Arrays that are carried, and what the state has for them."""
    record, functions = prepared.motion.system.record, prepared.motion.system.record.functions
    for leaf in (*leaves(run), *leaves(record)):
        is_carried = leaf.role is Role.STATE or (leaf.role is Role.BEGUN and leaf.name.startswith("friction."))
        if is_carried and leaf.array.size:
            yield leaf.array, _found(leaf.array, kept, given)
    inputs = list(prepared.motion.system.input_functions)
    for array in (functions.kind, functions.value):
        if inputs:
            theirs, all_of_it = _found(array, kept, given), array.copy()
            all_of_it[inputs] = theirs[inputs]
            yield array, all_of_it


def _found(array: NDArray[Any], kept: Sequence[NDArray[Any]], given: Sequence[NDArray[Any]]) -> NDArray[Any]:
    """What a state has for an array, which is one of those kept or lies in one of them."""
    begin, size = array.ctypes.data, array.nbytes
    for mine, theirs in zip(kept, given, strict=True):
        first = mine.ctypes.data
        if first <= begin and begin + size <= first + mine.nbytes:
            part = np.ascontiguousarray(theirs).reshape(-1).view(np.uint8)[begin - first : begin - first + size]
            return part.view(array.dtype).reshape(array.shape)
    raise ModelError("the state is of another machine, or of other settings of the simulation")


def prepare(methods: Methods) -> Prepared:
    """Build and assemble the machine of these methods and put it into the coordinates of the run.

    Raises ModelError as `nivel.analysis.preparation.preparation.prepare` does; SolveError where there is no equilibrium to start from.
    """
    if methods.machine.simulation.start != "equilibrium":
        return preparation.prepare(methods)
    return preparation.prepare(methods, equilibrium=nivel.analysis.statics.start.settled)


# Joint coordinates and rates of a machine in motion, set by its caller: bodies and velocities follow, with all joints closed.
#
# Coordinates that the joints leave free keep their values and rates. What no joint coordinate describes moves as little as it can; of
# velocities, by the change of the least kinetic energy.

# velocities are solved for so often: the second solution takes the round-off of the first one away
SOLUTIONS: Final = 2
# rates may miss what is asked of them by this share of the largest one
MISSED: Final = 1e-9


class Placed(Struct):
    """A state in the coordinates of a run, the measured coordinates there, and the places (B, 3) [m] of the bodies."""

    y: Array
    reference: Array
    position: Array


class Placing:
    """What it takes to place a machine that runs.

    Raises ModelError for machines with flexible bodies.
    """

    def __init__(self, methods: Methods, prepared: Prepared) -> None:
        machine = methods.machine
        if machine.is_flexible:
            message = (
                "joint coordinates of a machine with flexible bodies cannot be set while it moves: restore a state"
            )
            raise ModelError(Fault.at("flexible", message))
        self._methods, self._prepared = methods, prepared
        self._motion = equations(machine, measured=True)
        system = self._motion.system
        names = system.layout.coordinates["joint_coordinate"]
        self._place = dict(zip(names, system.record.joints.coordinate.tolist(), strict=True))
        self._weight = np.array([body.assembly_weight for body in machine.bodies], dtype=float)

    def placed(
        self,
        t: float,
        posture: Mapping[str, Array],
        reference: Array,
        states: Array,
        wanted: tuple[Mapping[str, float], Mapping[str, float]],
    ) -> Placed:
        """The state with the wanted values and rates by joint coordinate.

        posture : position, orientation, velocity, angular_velocity of all bodies now, as in results; reference : of the measured
        coordinates; states : of elements, the last entries of y. Raises ModelError where the joints do not allow it.
        """
        motion, (values, rates) = self._motion, wanted
        system, functions = motion.system, self._prepared.motion.system.record.functions
        # inputs have the values that the run has set
        system.record.functions.kind[:], system.record.functions.value[:] = functions.kind, functions.value
        y = _absolute(system, posture, states)
        system.record.coordinates.reference[:] = reference
        motion.evaluate(t, y)
        now = {name: float(system.record.coordinates.value[k]) for name, k in self._place.items()}
        speeds = {name: float(system.record.coordinates.rate[k]) for name, k in self._place.items()}
        if values:
            self._close(t, y, {**{name: now[name] for name in self._keeping(values)}, **values}, values)
        q = y[: system.positions].reshape(-1, 7)
        y = _absolute(system, {**posture, "position": q[:, :3], "orientation": q[:, 3:]}, states)
        motion.evaluate(t, y)
        self._fit_rates(t, y, {**{name: speeds[name] for name in self._keeping(rates)}, **rates}, rates)
        found = system.record.coordinates.reference.copy()
        return Placed(
            self._in_run_coordinates(y, found, states), found, y[: system.positions].reshape(-1, 7)[:, :3].copy()
        )

    def _keeping(self, wanted: Mapping[str, float]) -> list[str]:
        """The other joint coordinates that may keep what they have."""
        here = freedoms(self._motion)
        others = [name for name in self._place if name not in wanted]
        if here is None:
            return others if len(self._methods.machine.joints) <= len(self._methods.machine.bodies) else []
        own = coordinate_derivatives(self._motion, [self._place[name] for name in wanted])
        rows = coordinate_derivatives(self._motion, [self._place[name] for name in others])
        return [others[k] for k in here.keeping(own, [row[None] for row in rows])]

    def _close(self, t: float, y: Array, values: Mapping[str, float], wanted: Mapping[str, float]) -> None:
        """Close all joints with these values of coordinates; with the wanted ones alone where not all can be kept."""
        before, reference = y.copy(), self._motion.system.record.coordinates.reference.copy()
        for each in (values, wanted):
            y[:] = before
            self._motion.system.record.coordinates.reference[:] = reference
            wishes = Wishes(
                self._weight,
                np.zeros(len(self._weight), dtype=bool),
                tuple((name, self._place[name], value) for name, value in each.items()),
            )
            with np.errstate(over="ignore", invalid="ignore"):
                if close_positions(self._motion, t, y, wishes):
                    return
        faults = [
            Fault.at(name, f"the joints do not allow the value {value:.6g}; values that they tie together need one")
            for name, value in wanted.items()
        ]
        raise ModelError(faults)

    def _fit_rates(self, t: float, y: Array, rates: Mapping[str, float], wanted: Mapping[str, float]) -> None:
        """Give the joints velocities that fit, with these rates. The state last evaluated is y."""
        motion, system = self._motion, self._motion.system
        record, count, rows = system.record, system.body_count, slice(0, system.machine_rows)
        chosen, aims = [self._place[name] for name in rates], np.array([*rates.values()])
        units = [1.0 if name.partition(".")[2].startswith("angle") else system.size for name in rates]
        scale = np.append(record.constraints.scale[rows], units)
        ways = whitened(system, np.ones((count, 6), dtype=bool), 0.0)
        velocities = y[system.positions : system.positions + 6 * count].reshape(count, 6)
        for _ in range(SOLUTIONS):
            target = np.append(-record.constraints.Cdot[rows], aims - record.coordinates.rate[chosen])
            change = least_change(motion, target, chosen, scale, ways).reshape(count, 6)
            velocities[:, :3] += change[:, :3] * system.size
            velocities[:, 3:] += change[:, 3:]
            motion.evaluate(t, y)
        fastest = max(1.0, *(abs(rate) for rate in rates.values())) if rates else 1.0
        faults = []
        for name, rate in wanted.items():
            got = float(record.coordinates.rate[self._place[name]])
            if not abs(got - rate) <= MISSED * fastest * max(1.0, system.size):
                faults.append(Fault.at(name, f"the joints do not allow the rate {rate:.6g}: the nearest is {got:.6g}"))
        refuse(faults)

    def _in_run_coordinates(self, y: Array, reference: Array, states: Array) -> Array:
        """The state in the coordinates of the run. y : in absolute ones."""
        prepared, methods = self._prepared, self._methods
        absolute = self._motion.system
        arrange = methods.path.arrange
        rank = absolute.machine_rows - len(prepared.redundancy.redundant_rows)
        _, out = arrange(methods.machine, absolute, y, rank, methods.cut)
        out[len(out) - len(states) :] = states
        tree = prepared.motion.system.record.tree
        for (coordinate, place), (sign, offset) in zip(tree.counted.tolist(), tree.turn.tolist(), strict=True):
            # angles of the tree count turns, of which an assembled posture knows nothing
            turns = (sign * (reference[coordinate] - offset) - out[place]) / (2.0 * np.pi)
            out[place] += 2.0 * np.pi * np.round(turns)
        return out


def _absolute(system: System, posture: Mapping[str, Array], states: Array) -> Array:
    q = np.hstack([posture["position"], posture["orientation"]])
    omega_b = np.einsum("bij,bi->bj", rotation_matrices(q[:, 3:]), posture["angular_velocity"])
    y = system.state(q.ravel(), posture["velocity"], omega_b)
    y[len(y) - len(states) :] = states
    return y
