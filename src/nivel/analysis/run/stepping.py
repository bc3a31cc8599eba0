"""A machine that moves step by step, as its caller asks: for control in Python, learning, and coupling with other programs."""

import hashlib
import json
from collections.abc import Mapping, Sequence
from functools import cached_property
from math import isfinite
from os import PathLike, fspath
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.plan.plan import Plan, plan_run
from nivel.analysis.preparation.attributes import run_attributes
from nivel.analysis.preparation.memory import in_one_piece
from nivel.analysis.preparation.preparation import Prepared, SharedLoads, are_open
from nivel.analysis.run import prepared_state
from nivel.analysis.run.dynamics import BEFORE_A_JAM, Loop, failure_of, jam_of, start_loop, taken_events
from nivel.analysis.run.fitting import fitted
from nivel.analysis.run.narrow_features import remembered
from nivel.analysis.run.prepared_state import Placing
from nivel.errors import Fault, ModelError, SolveError, refuse
from nivel.files.target import written
from nivel.files.writer import write_machine
from nivel.integrate.loop import run as of_run
from nivel.integrate.loop.loop import advance
from nivel.integrate.loop.run import Run
from nivel.integrate.loop.sink import Header
from nivel.kernels.core.block import Handle
from nivel.kernels.core.status import BUDGET_SPENT, BUFFER_FULL, DONE, OK
from nivel.kernels.output.observe import observe
from nivel.kernels.record.function import CONSTANT
from nivel.kernels.signals.watch import watch
from nivel.lazy import Struct, field
from nivel.machine.machine_record import MachineRecord
from nivel.results.frames.contents import MemoryContents
from nivel.results.frames.csv_table import columns
from nivel.results.frames.summary import Occurrence
from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.system.layout import VARIABLES
from nivel.words.arguments import plain
from nivel.words.wording import shown, unknown_word

ENDLESS: Final = 2**62  # steps
NOTHING: Final = np.zeros((0, 0))
# joints that other lengths open are closed to this share of their sizes, in so many corrections at most
CLOSED: Final = 1e-10
CORRECTIONS: Final = 20
LARGEST: Final = float(np.finfo(float).max)
NO_RANGE: Final = (1.0, -1.0)
# variables of frames that redundant joints have no part in
UNSHARED: Final = frozenset(
    name for name, *_ in VARIABLES if not name.startswith(("joint_force", "joint_torque", "constraint_force"))
)
PLACED: Final = 1e-9  # share of the machine's size by which bodies may miss their places


class Snapshot(Struct):
    """The whole state of a simulation at one moment: what goes on from it repeats the motion to the last bit.

    time : [s]. machine : digest of the machine and its settings. arrays : everything that the simulation remembers. units :
    what its units of other programs have saved. structure : names of all that it is made of, by kind.
    """

    time: float
    machine: str = field(repr=False)
    arrays: tuple[NDArray[Any], ...] = field(repr=False)
    units: tuple[bytes, ...] = field(default=(), repr=False)
    structure: prepared_state.Structure = field(default_factory=dict, repr=False)

    def save(self, path: str | PathLike[str]) -> None:
        """Write it to a file (NumPy's `.npz`); an existing file is replaced. Raises ModelError where it cannot be written."""
        named = {f"a{k}": array for k, array in enumerate(self.arrays)}
        named |= {f"f{k}": np.frombuffer(content, dtype=np.uint8) for k, content in enumerate(self.units)}
        with written(path, "saved state") as draft, draft.open("wb") as file:
            facts = {"time": self.time, "machine": self.machine, "structure": json.dumps(dict(self.structure))}
            np.savez(file, **facts, **named)  # type: ignore[arg-type]

    @classmethod
    def open(cls, path: str | PathLike[str]) -> "Snapshot":
        """Read a file that `save` wrote. Raises ModelError where it is none."""
        try:
            with np.load(path, allow_pickle=False) as data:
                units = tuple(data[name].tobytes() for name in data.files if name.startswith("f"))
                arrays = tuple(data[f"a{k}"] for k in range(len(data.files) - 3 - len(units)))
                structure = {kind: tuple(names) for kind, names in json.loads(str(data["structure"])).items()}
                return cls(float(data["time"]), str(data["machine"]), arrays, units, structure)
        except (OSError, ValueError, KeyError, EOFError) as error:
            raise ModelError(f"{fspath(path)} is no saved state of a simulation: {error}") from error


class Simulation:
    """A machine in motion: ``sim = machine.start(step="1 ms")``, then ``sim.step()`` or ``sim.advance(0.1)``.

    ``sim.time`` and ``sim["hinge.angle"]`` say where it is; names are those of results. ``sim.state`` keeps the moment,
    ``sim.restore(state)`` goes back to it. verified : no; nothing estimates the error of the steps, and ``sim.result()`` says so.
    """

    verified: Final = False

    def __init__(
        self, plan: Plan, *, source: str = "", record: bool = False, ready: tuple[Plan, Prepared] | None = None
    ) -> None:
        """ready : the plan with its integrator, and the machine made ready, where that is done already."""
        refuse_chosen_steps(plan)
        plan, prepared = ready or fitted(plan, prepared_state.prepare(plan.methods))
        self._plan, self.settings = plan, plan.settings
        self.prepared: Prepared
        self.prepared, piece = prepared.in_one_piece()
        self._motion = motion = self.prepared.motion
        self._system = system = motion.system
        self.loop, own = _endless(self.prepared, plan, whole=piece is not None)
        self._run: Run = self.loop.history.record
        self._advance = prepared_state.BoundEntry(advance, self.loop.addresses, keep=self.loop)
        self.pieces = None if piece is None or own is None else (piece, own)
        kept = self.pieces or remembered(self._run, motion)
        # what is remembered of units but their own memory
        every = [array for unit in system.units for array in unit.arrays]
        self._kept = [*kept, *(array for array in every if array.size and array.dtype != np.uint64)]
        self._counter, self._clock = self._run.counter.data, self._run.clock.data  # quicker to read than arrays
        self._step = float(plan.settings.step)
        names = [fact.name for fact in system.states]
        self._states = {name: len(self._run.y) - 2 - len(names) + k for k, name in enumerate(names)}  # places in y
        inputs = plan.machine.inputs
        self._inputs = {each.name: place for each, place in zip(inputs, system.input_functions, strict=True)}
        self._ranges = {each.name: each.range for each in inputs}
        self._quick_ranges = {
            name: (max(low, -LARGEST), min(high, LARGEST)) for name, (low, high) in self._ranges.items()
        }
        # quicker to read and write than arrays
        self._kind: Any
        self._value: Any
        self._kind, self._value = system.record.functions.kind.data, system.record.functions.value.data
        self._y: Any
        self._previous: Any
        self._y, self._previous = self._run.y.data, self._run.previous.data
        self._feeds_back = bool(system.record.control.stabilise[:2].any())
        layout = system.layout
        self._loads = SharedLoads.of(self.prepared) if are_open(self.prepared) else None
        self._header = Header(layout, run_attributes(plan.machine, source, self.prepared, plan.settings, plan.reason))
        self._frame = np.zeros((1, layout.width))
        address = int(motion.handle.address)
        self._evaluate = prepared_state.BoundEntry(
            motion.kernels.evaluate, (address, self._run.y, self._run.rate), keep=motion
        )
        self._write = prepared_state.BoundEntry(observe, (address, self._run.y, self._frame[0]), keep=motion)
        self._numbers: Any = self._frame[0].data
        self._places: dict[str, int] = {}  # of single numbers in the frame
        self._observed = -np.inf
        self._now = Result(MemoryContents(self._header, self._frame, dict(self._header.attributes)))
        self._views: dict[str, NDArray[np.float64]] = {}
        self._events: list[Occurrence] = []
        self._memory = Memory()
        self._memory.begin(self._header)
        self._counter[of_run.EVERY] = plan.settings.every if record else ENDLESS
        self._recorded = record
        self._failure: dict[str, str] = {}
        self.go(0)

    # --- moving ---

    @property
    def time(self) -> float:
        """[s]"""
        return self._clock[of_run.TIME]

    @property
    def step_size(self) -> float:
        """[s]"""
        return self._step

    @property
    def steps(self) -> int:
        """Steps done since the start."""
        return self._counter[of_run.DONE_STEPS]

    def step(self, inputs: Mapping[str, float] | None = None) -> None:
        """One step of the integrator. inputs : values of inputs and states of the machine, set before the step; inputs keep them until
        they are set again.

        Raises SolveError where the step fails, and ModelError where the simulation is over, or `inputs` has a name that is neither.
        """
        if inputs:
            self.set_inputs(inputs)
        self.go(1)

    def advance(self, duration: float, inputs: Mapping[str, float] | None = None) -> None:
        """As many steps as fill `duration` [s], a multiple of the step, in one compiled call; an event may end it earlier."""
        count = self.count_of(duration)
        if inputs:
            self.set_inputs(inputs)
        self.go(count)

    def count_of(self, duration: float) -> int:
        """Steps that fill `duration` [s]. Raises ModelError where it is no multiple of the step."""
        value = plain(duration)
        if not isinstance(value, int | float) or isinstance(value, bool):
            raise ModelError(Fault.at("duration", f"a number of seconds was expected, got {shown(duration)}"))
        count = round(value / self._step) if np.isfinite(value) else -1
        if count < 0 or abs(count * self._step - value) > 1e-6 * self._step:
            message = f"{value:g} s is not a multiple of the step, {self._step:g} s"
            raise ModelError(Fault.at("duration", message))
        return count

    def go(self, steps: int) -> None:
        """So many steps in one compiled call. Raises as `step` does."""
        counter = self._counter
        if counter[of_run.STOPPED]:
            raise ModelError(self._over)
        target = counter[of_run.DONE_STEPS] + steps
        counter[of_run.BUDGET] = steps
        status = self._advance()
        while status == BUFFER_FULL:
            self._take_frames()
            counter[of_run.BUDGET] = target - counter[of_run.DONE_STEPS]
            status = self._advance()
        if counter[of_run.EVENTS]:
            self._events += taken_events(self._run, self._system.events)
        if status not in (BUDGET_SPENT, DONE):
            self._fail(status)

    @property
    def _over(self) -> str:
        return f"the simulation is over: the event `{self.stopped_by}` ended it at t = {self.time:.6g} s"

    def _fail(self, status: int) -> None:
        jam = jam_of(self.prepared, self.settings, self._run) if status in BEFORE_A_JAM else None
        message, advice, time = failure_of(self.prepared, self.settings, self._run, status, jam)
        self._failure = {"outcome": "failed", "failure": message}
        raise SolveError(message, time=time, advice=advice, result=self.result() if self._recorded else None)

    def set_inputs(self, inputs: Mapping[str, float]) -> None:
        """Give inputs and states their values, and evaluate again what depends on them."""
        if type(inputs) is not dict and not isinstance(inputs, Mapping):
            said = f"values by name were expected, {{'push': 200}}, got {shown(inputs)}; how long a step is says the machine"
            raise ModelError(Fault.at("inputs", said))
        changed, kinds, values = False, self._kind, self._value
        for name, value in inputs.items():
            place = self._inputs.get(name)
            # what is wrong, or no plain number, is looked at closer
            low, high = self._quick_ranges.get(name, NO_RANGE)
            number = value if isinstance(value, float) and low <= value <= high else self._checked(name, value)
            if place is None:
                place = self._states[name]
                if self._y[place] != number:
                    self._y[place] = self._previous[place] = number
                    changed = True
            elif kinds[place] != CONSTANT or values[place] != number:
                kinds[place], values[place] = CONSTANT, number
                changed = True
        if changed:
            self._counter[of_run.RESTART] = 1
            self.moved()

    def place(self, coordinates: Mapping[str, float], rates: Mapping[str, float] | None = None) -> None:
        """Give joint coordinates [m, rad] and their rates [m/s, rad/s] other values, with all joints closed.

        Coordinates that the joints leave free keep their values and rates. What no coordinate describes, as a body that nothing holds,
        moves as little as it can. The time, states of elements and inputs stay, and the energy balance goes on from the new place.
        Raises ModelError for an unknown name, for values that the joints do not allow (nothing is changed then), for machines with
        flexible bodies, and where the simulation is over.
        """
        if self._counter[of_run.STOPPED]:
            raise ModelError(self._over)
        wanted = self._coordinates(coordinates, "coordinates"), self._coordinates(rates or {}, "rates")
        if not (wanted[0] or wanted[1]):
            return
        if self._observed != self._clock[of_run.TIME]:
            self._observe()
        posture = {name: self._view(name) for name in ("position", "orientation", "velocity", "angular_velocity")}
        system, y = self._system, self._run.y
        reference, states = system.record.coordinates.reference, y[len(y) - len(system.start_of_states) :]
        reference = self._measured(reference)
        placed = self._placing.placed(self.time, posture, reference, states.copy(), wanted)
        kept, error = self.state, float(self._view("energy_error"))
        y[:] = self._run.previous[:] = placed.y
        reference = system.record.coordinates.reference
        reference[:] = placed.reference
        self._counter[of_run.RESTART] = 1
        self._begin_again()
        if np.abs(self._view("position") - placed.position).max() > PLACED * system.size:
            self.restore(kept)
            message = "joint coordinates cannot be set in these coordinates: use coordinates='relative' or 'absolute'"
            raise ModelError(Fault.at("coordinates", message))
        system.record.control.energy[2] += float(self._view("energy_error")) - error  # the balance goes on from here
        self._observe()

    def _measured(self, reference: NDArray[np.float64]) -> NDArray[np.float64]:
        """Reference of the measured coordinates; of joints those that the frame shows, with all their turns."""
        out = reference.copy()
        out[self._system.record.joints.coordinate] = self._view("joint_coordinate")
        return out

    @cached_property
    def _placing(self) -> Placing:
        return Placing(self._plan.methods, self.prepared)

    def _coordinates(self, values: Mapping[str, float], what: str) -> dict[str, float]:
        """Numbers by joint coordinate. Raises ModelError."""
        known = list(self.coordinates)
        if not isinstance(values, Mapping):
            said = f"numbers by joint coordinate were expected, {{'hinge.angle': 0.1}}, got {shown(values)}"
            raise ModelError(Fault.at(what, said))
        faults, out = [], {}
        for name, value in values.items():
            number = plain(value)
            if name not in known:
                faults.append(Fault.at(what, unknown_word(str(name), known, "joint coordinate")))
            elif not isinstance(number, int | float) or isinstance(number, bool) or not isfinite(number):
                faults.append(Fault.at(f"{what}.{name}", f"a finite number was expected, got {shown(value)}"))
            else:
                out[name] = float(number)
        refuse(faults)
        return out

    def moved(self) -> None:
        """Evaluate the state, which was not reached by steps: another moment of the motion stands in the memory."""
        self._observed = -np.inf
        self._evaluate.number.value = self._clock[of_run.TIME]
        status = self._evaluate()
        if status != OK:
            self._fail(status)

    def _begin_again(self) -> None:
        """Evaluate the state, which was not reached by steps, and take the sides of events there."""
        self.moved()
        values = self._run.event_values
        if values.shape[1]:
            watch.code(self._motion.handle.address, 0, self.time)
            values[[of_run.BEFORE, of_run.AFTER]] = self._system.record.watched.value[: values.shape[1]]
            values[of_run.SIDE] = np.sign(values[of_run.BEFORE])
        self._observe()

    def check_input(self, name: str, least: float, greatest: float) -> None:
        """Raise ModelError for a name that is no input or state, and where it cannot have one of two values."""
        low, high = self._quick_ranges.get(name, NO_RANGE)
        if not (low <= least and greatest <= high):
            for value in (least, greatest):
                self._checked(name, float(value))

    @property
    def machine_name(self) -> str:
        """Name of the machine."""
        return self._plan.machine.name

    def _checked(self, name: str, value: float) -> float:
        """The value of an input or a state as a number. Raises ModelError."""
        if name not in self._inputs and name not in self._states:
            known = [*self._inputs, *self._states]
            raise ModelError(Fault.at("inputs", unknown_word(str(name), known, "input or state")))
        number = value if type(value) is float else plain(value)
        if not isinstance(number, int | float) or not isfinite(number):
            raise ModelError(Fault.at(f"inputs.{name}", f"a finite number was expected, got {shown(value)}"))
        if name in self._ranges and not self._ranges[name][0] <= number <= self._ranges[name][1]:
            low, high = self._ranges[name]
            message = f"{number:g} is outside the range from {low:g} to {high:g}"
            raise ModelError(Fault.at(f"inputs.{name}", message))
        return float(number)

    # --- reading ---

    def __getitem__(self, name: str) -> Any:
        """The present value of `name`: a number, or an array of its components. Names and units are those of results."""
        if name == "time":
            return self.time
        if self._observed != self._clock[of_run.TIME]:
            self._observe()
        place = self._places.get(name)
        if place is not None:
            return self._numbers[place]
        view = self._views.get(name)
        if view is None:
            view = self._views[name] = self._view(name)
            if not view.ndim:
                self._places[name] = (view.ctypes.data - self._frame.ctypes.data) // view.itemsize
                return float(view)
        return view.copy()

    def _view(self, name: str) -> NDArray[np.float64]:
        """The numbers of `name` in the frame of the present state."""
        return self._selected(self._frame[0], name)

    def columns_of(self, name: str) -> tuple[NDArray[np.intp], bool]:
        """Where the numbers of `name` stand in a frame; and whether loads that redundant joints share are among them."""
        shared = self._loads is not None and self._now.selection(name).variable not in UNSHARED
        return self._selected(np.arange(self._frame.shape[1]), name), shared

    def _selected(self, frame: NDArray[Any], name: str) -> NDArray[Any]:
        found = self._now.selection(name)
        variable = self._now.variables[found.variable]
        sizes = [len(self._now.coordinates[dim]) for dim in variable.dims[1:]]
        return frame[variable.columns].reshape(sizes)[(*found.where[1:], ...)]

    def __contains__(self, name: object) -> bool:
        return name in self._now

    @property
    def names(self) -> tuple[str, ...]:
        """Everything that can be asked for."""
        return self._now.names

    def components(self, names: Sequence[str]) -> tuple[str, ...]:
        """The names of the single numbers that these names stand for: `bob.position` for three. Raises ModelError."""
        return tuple(columns(self._now, names))

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The joint coordinates, which `place` sets."""
        return tuple(self._system.layout.coordinates["joint_coordinate"])

    @property
    def scene(self) -> dict[str, Any]:
        """Bodies and joints as the viewer and the report draw them."""
        return self._now.scene

    def _observe(self) -> None:
        """Write the frame of the present state, with accelerations and reactions free of Baumgarte's feedback."""
        time = self._clock[of_run.TIME]
        if self._feeds_back:
            feedback = self._system.record.control.stabilise
            kept = feedback.copy()
            feedback[:2] = 0.0
            self._motion.evaluate(time, self._run.y)
            feedback[:] = kept
        self._numbers[0] = self._write.number.value = time
        self._write()
        if self._loads is not None:
            self._loads.share(self._frame)
        self._observed = time

    @property
    def events(self) -> tuple[Occurrence, ...]:
        """The events so far, each with `name`, `time` [s] and `direction`."""
        return tuple(self._events)

    def noted(self, events: Sequence[Occurrence]) -> None:
        """Note events that came while the motion was made elsewhere."""
        self._events += events

    @property
    def places_of_inputs(self) -> dict[str, tuple[bool, int]]:
        """Of inputs and states by name: whether it is a state, and its place among those of the run or among the functions."""
        inputs = {name: (False, int(place)) for name, place in self._inputs.items()}
        return {**{name: (True, place) for name, place in self._states.items()}, **inputs}

    @property
    def stopped_by(self) -> str:
        """Name of the event that ended the simulation; empty while it can go on."""
        number = self._counter[of_run.STOPPED]
        return self._system.events[number - 1] if number else ""

    def result(self) -> Result:
        """The frames so far as a result, one every `output_interval` from the start; for simulations started with ``record=True``."""
        if not self._recorded:
            raise ModelError("nothing was recorded: start the simulation with `record=True`")
        self._take_frames()
        return self._memory.close({"outcome": "done", **self._failure})

    def _take_frames(self) -> None:
        filled = self._counter[of_run.FRAMES]
        if filled and self._recorded:
            frames = self._run.frames[:filled]
            if self._loads is not None:
                self._loads.share(frames)
            self._memory.take(frames)
        self._counter[of_run.FRAMES] = 0

    # --- keeping ---

    @property
    def state(self) -> Snapshot:
        """This moment, to be restored or saved."""
        self._take_frames()
        arrays = tuple(array.copy() for array in self._kept)
        units = tuple(unit.state() for unit in self._system.units)
        return Snapshot(self.time, self._digest, arrays, units, self._structure)

    def restore(self, state: Snapshot) -> None:
        """Go back, or on, to a moment of this machine with these settings: the motion repeats to the last bit.

        A state of a machine with the same structure and other numbers gives its motion to this one: time, joint coordinates, velocities,
        states, inputs and memories. Joints that other lengths open are closed again, and energies are referred to this moment.
        Raises ModelError for a state of another structure, which it names, and where joints cannot be closed; nothing is changed then.
        """
        if not isinstance(state, Snapshot):
            raise ModelError(f"a state of a simulation, `sim.state`, was expected, got {shown(state)}")
        mine, given = self._kept, state.arrays
        fits = len(mine) == len(given) and all(a.shape == b.shape for a, b in zip(mine, given, strict=True))
        if state.machine != self._digest or not fits:
            prepared_state.refuse_other_structure(self._structure, state.structure)
            if not fits:
                raise ModelError("the state is of another machine, or of other settings of the simulation")
            self._take_over(state)
            return
        if self._recorded:
            self._take_frames()
            self._memory.forget_after(state.time)
        addresses = self._addresses_of_units()
        for array, kept in zip(mine, given, strict=True):
            array[...] = kept
        for arguments, places, own in addresses:
            arguments[places] = own
        for unit, content in zip(self._system.units, state.units, strict=True):
            unit.restore(content)
        self._counter[of_run.FRAMES] = 0
        self._failure = {}
        if self._events:
            self._events = [event for event in self._events if event.time <= state.time]
        self._observed = -np.inf

    def _take_over(self, state: Snapshot) -> None:
        """Go on with the motion of a machine that has other numbers."""
        before = self.state
        if self._recorded:
            self._memory.forget_after(state.time)
        prepared_state.carry_over(self._kept, state.arrays, self.prepared, self._run)
        for unit, content in zip(self._system.units, state.units, strict=True):
            unit.restore(content)
        self._events = [event for event in self._events if event.time <= state.time]
        try:
            self._close_again()
            self._previous[:] = self._y[:]
            self._counter[of_run.RESTART] = 1
            self._begin_again()
        except (ModelError, SolveError):
            self.restore(before)
            raise
        energy = self._system.record.control.energy
        energy[2] += float(self._view("energy_error"))
        self._observe()

    def _close_again(self) -> None:
        constraints = self._system.record.constraints
        correct, address = self.loop.correct, self._motion.handle.address
        motion, time = self._motion, self._clock[of_run.TIME]
        for _ in range(CORRECTIONS):
            motion.evaluate(time, self._run.y)
            rows = slice(0, len(constraints.C))
            if np.max(np.abs(constraints.C[rows]) / constraints.scale[rows], initial=0.0) <= CLOSED:
                return
            correct(address, time, self._run.y)
        opened = np.abs(constraints.C) / constraints.scale
        worst = float(np.max(opened, initial=0.0))
        message = (
            f"the joints of this machine cannot be closed where the state is: one is open by {worst:.2g} of its size"
        )
        raise ModelError(f"{message}; give states to machines whose lengths differ less")

    @cached_property
    def _structure(self) -> prepared_state.Structure:
        return prepared_state.structure_of(self._plan, self.prepared)

    def copy(self) -> "Simulation":
        """Another one at this moment, which goes on by itself; what was recorded stays with this one."""
        return _revived(self._plan.machine, str(self._header.attributes["machine_source"]), self._recorded, self.state)

    def __reduce__(self) -> tuple[Any, ...]:
        """For `pickle` and `copy`: the machine with its settings, and this moment."""
        source = str(self._header.attributes["machine_source"])
        return _revived, (self._plan.machine, source, self._recorded, self.state)

    @cached_property
    def _digest(self) -> str:
        text = write_machine(self._plan.machine) + json.dumps(self.settings.as_dict(), sort_keys=True, default=str)
        return hashlib.sha256(text.encode()).hexdigest()

    def _addresses_of_units(self) -> list[tuple[NDArray[Any], NDArray[Any], NDArray[Any]]]:
        """Arguments of functions, places among them of addresses of records of units, and these: they are no part of a state."""
        if not self._system.units:
            return []
        motion, functions = self._motion, self._system.record.functions
        laws = [np.uint64(unit.law.address) for unit in self._system.units]
        places = functions.span[np.isin(functions.address, laws), 3]
        twin = () if motion.twin is None else (motion.twin.record.functions,)
        return [(each.arguments, places, each.arguments[places].copy()) for each in (functions, *twin)]

    def __repr__(self) -> str:
        return f"<Simulation of {self._plan.machine.name}: t = {self.time:.6g} s, {self.steps} steps of {self._step:g} s, not verified>"


def _revived(machine: MachineRecord, source: str, recorded: bool, state: Snapshot) -> Simulation:
    """A simulation of this machine, with its own settings, at a moment of one."""
    sim = Simulation(plan_run(machine, stepwise=True), source=source, record=recorded)
    sim.restore(state)
    return sim


def refuse_chosen_steps(plan: Plan) -> None:
    """Raise ModelError where the integrator chooses its steps: a step would have no length of its own."""
    if plan.settings.steps == 0:
        name = plan.settings.integrator
        message = (
            f"`{name}` chooses its steps here; a simulation that is stepped needs a fixed one: integrator='rk4' has"
        )
        raise ModelError(Fault.at("integrator", message))


def _endless(prepared: Prepared, plan: Plan, *, whole: bool) -> tuple[Loop, NDArray[np.uint8] | None]:
    """The compiled loop of a run without an end; where it is asked for, with all of the run in one piece of memory, and that, but
    its frames and its pace, which no fixed step reads."""
    loop = start_loop(prepared, plan.settings)
    run: Run = loop.history.record
    run.counter[of_run.ALL_STEPS], run.clock[of_run.END] = ENDLESS, np.inf
    if not whole:
        return loop, None
    own, piece = in_one_piece(run._replace(frames=NOTHING, pace=NOTHING))
    return loop._replace(history=Handle(own._replace(frames=run.frames, pace=run.pace))), piece
