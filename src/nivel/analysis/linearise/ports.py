"""Inputs and outputs of linear equations, by the names that results and machine files have for them.

Commands and inputs as states that stay: linear equations have their columns as those of an input.
The law of a command becomes that law and a state x without a rate, which is zero: c + x. An input of the machine becomes a state of its
name, so that everything goes on reading it. Derivatives with respect to such states are exact, as those of all states.
"""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import Any, Final, TypeVar

import numpy as np

from nivel.analysis.assembly.instant import NOTHING, Instant, Lanes, frame_place, frame_velocity
from nivel.analysis.linearise.eigenvalues import Eigen
from nivel.analysis.linearise.reduction import Ports
from nivel.elements.circuits.component import Component
from nivel.elements.control.dynamics import LinearSystem
from nivel.elements.facts import StateFact
from nivel.elements.forces.actuators import Motor
from nivel.errors import Fault, ModelError, refuse
from nivel.kernels.record.record import SENSE
from nivel.kernels.signals import sensor
from nivel.lazy import Struct
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.signals.input import State
from nivel.system.layout import reported
from nivel.system.system import Array

# what moves a circuit: inputs of its linear equations where none are named
COMMANDS: Final = ("command", "current")
UNITS: Final = {
    "command": "1",
    "current": "A",
    "flow": "m^3/s",
    "load": "N m",
    "margin": "Pa",
    "opening": "1",
    "opens_at": "Pa",
    "pressure": "Pa",
    "setting": "1",
    "speed": "rad/s",
    "torque_limit": "N m",
}


class Opened(Struct):
    """A machine whose commands are states. states : name of an input of its linear equations → (name of its state, unit).

    commands : those of its circuits that are inputs without being named.
    """

    machine: MachineRecord
    states: dict[str, tuple[str, str]]
    commands: tuple[str, ...] = ()


def opened(machine: MachineRecord, wanted: Sequence[str] | None, time: float) -> Opened:
    """The machine at `time` [s] with these inputs as states, those of them that are inputs or laws of a circuit; None: its commands.

    Raises ModelError for laws to which nothing can be added.
    """
    known = {
        f"{component.name}.{key}": (component, key) for component in machine.hydraulics for key in _varying(component)
    }
    commands = () if wanted is not None else tuple(name for name, (_, key) in known.items() if key in COMMANDS)
    inputs = {each.name: each for each in machine.inputs}
    names = dict.fromkeys(name.removeprefix("hydraulics.") for name in (commands if wanted is None else wanted))
    taken = {each.name for section in (machine.states, machine.inputs, machine.control) for each in section}
    states: dict[str, tuple[str, str]] = {}
    added: list[State] = []
    laws: dict[str, dict[str, Expression]] = {}
    for name in names:
        if name in inputs:
            course = inputs[name].course
            value = course(time) if isinstance(course, Table) else float(course)
            added.append(State(name=name, rate=0.0, start=value))
            states[name] = (name, inputs[name].units or "1")
        elif name in known:
            component, key = known[name]
            own = _free_name(f"{component.name}_{key}", taken)
            laws.setdefault(component.name, {})[key] = _sum(f"hydraulics.{name}", getattr(component, key), own, time)
            added.append(State(name=own, rate=0.0))
            states[name] = (own, UNITS.get(key, ""))
    if not added:
        return Opened(machine, {})
    left = tuple(each for each in machine.inputs if each.name not in states)
    components = tuple(each.replace(**laws[each.name]) if each.name in laws else each for each in machine.hydraulics)
    changed = machine.replace(inputs=left, states=(*machine.states, *added), hydraulics=components)
    return Opened(changed, states, commands)


def _varying(component: Component) -> Iterator[str]:
    return (key for key in type(component).functions if getattr(component, key) is not None)


def _free_name(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    taken.add(name)
    return name


def _sum(place: str, law: Any, state: str, time: float) -> Expression:
    """A law and a state. Raises ModelError where there is no sum."""
    match law:
        case Expression():
            return Expression(f"({law.text}) + {state}.value")
        case Table() if not law.signals:
            return Expression(f"{law(time)!r} + {state}.value")
        case float() | int():
            return Expression(f"{float(law)!r} + {state}.value")
    key = place.rpartition(".")[2]
    message = f"no input can be added to a table of a signal or a law in Python: write it as `{key}: lever.value`, with an input `lever`"
    raise ModelError(Fault.at(place, message))


XYZ = "xyz"
PREFIXES = ("sensor", "hydraulics", "control")  # that may be left out
T = TypeVar("T")


class Output(Struct):
    """A number that the machine shows. read : it, from the twin of an instant whose markers and coordinates are measured."""

    name: str
    units: str
    read: Callable[[Instant], Lanes]


class Input(Struct):
    """What acts on the machine. kind : effort (of `shown`, by its rate), drive (acceleration of a row) or state (its value).

    place : coordinate, row or state; body and axis of forces on a body.
    """

    name: str
    units: str
    kind: str
    place: tuple[int, ...]


class Catalogue:
    """All inputs and outputs that a machine has; `instant` is in its coordinates."""

    def __init__(self, machine: MachineRecord, instant: Instant, opened: Opened | None = None) -> None:
        self.machine, self.instant, self.system = machine, instant, instant.system
        self.opened = opened or Opened(machine, {})
        self.coordinates = list(self.system.layout.coordinates["joint_coordinate"])
        self.index = self.system.record.joints.coordinate.astype(np.int64)
        self.outputs: dict[str, Output] = {each.name: each for each in self._outputs()}
        self.inputs: dict[str, Input] = {each.name: each for each in self._inputs()}

    def default_inputs(self) -> list[str]:
        """Motors, drivers, commands of circuits, and sampled values that the machine reads."""
        drivers = {driver.name for driver in self.machine.drivers}
        motors = [force.name for force in self.machine.forces if isinstance(force, Motor)]
        return [*motors, *(_motion(name) for _, name, _ in self._rows(drivers)), *self.opened.commands]

    def default_outputs(self) -> list[str]:
        """Sensors; without any the joint coordinates and the pressures of volumes."""
        measured = [name for name in self.outputs if name.startswith("sensor.")]
        return measured or [*self.coordinates, *pressure_states(self.system.states, self.outputs).outputs]

    def chosen(self, inputs: Sequence[str] | None, outputs: Sequence[str] | None) -> tuple[list[Input], list[Output]]:
        """Those of these names. Raises ModelError with every name that leads nowhere."""
        faults: list[Fault] = []
        taken = [self._find(self._whole(name), self.inputs, "inputs", faults) for name in inputs or ()]
        if inputs is None:
            taken = [self.inputs[name] for name in self.default_inputs()]
        seen = [self._find(self._whole(name), self.outputs, "outputs", faults) for name in outputs or ()]
        if outputs is None:
            seen = [self.outputs[name] for name in self.default_outputs()]
        refuse(faults)
        return [each for each in taken if each is not None], [each for each in seen if each is not None]

    @staticmethod
    def _find(name: str, known: Mapping[str, T], field: str, faults: list[Fault]) -> T | None:
        found = next((known[path] for path in (name, *(f"{word}.{name}" for word in PREFIXES)) if path in known), None)
        if found is None:
            near = get_close_matches(name, known, n=3, cutoff=0.5)
            hint = f"did you mean {' or '.join(near)}?" if near else f"there are {', '.join(list(known)[:8])} …"
            faults.append(Fault.at(f"linearise.{field}", f"there is no {field[:-1]} `{name}`; {hint}"))
        return found

    # --- outputs ---

    def _outputs(self) -> list[Output]:
        system, units = self.system, self.system.coordinate_units
        out: list[Output] = []
        for name, k, unit in zip(self.coordinates, self.index.tolist(), units, strict=True):
            out.append(Output(name, unit, lambda own, k=k: own.twin.coordinates.value[k]))
            out.append(Output(f"{name}.rate", f"{unit}/s", lambda own, k=k: own.twin.coordinates.rate[k]))
        out += [each for b, body in enumerate(system.bodies) for each in self._of_body(b, body)]
        for k, fact in enumerate(system.states):
            out.append(Output(fact.result, fact.units, lambda own, k=k: own.twin.residual.y[own.first_state + k]))
        drivers = {driver.name for driver in self.machine.drivers}
        for row, name, unit in self._rows(drivers):
            effort = "N" if unit == "m" else "N m"
            out.append(
                Output(f"driver.{_motion(name)}.effort", effort, lambda own, row=row: -own.twin.residual.lam[row])
            )
        values = reported(system.layout, len(system.record.outputs.value))
        for k, each in enumerate(values):
            if each.name.startswith(("sensor.", "force.", "hydraulics.", "control.")):
                out.append(Output(each.name, each.units, lambda own, k=k: own.twin.outputs.value[k]))
        return out

    def _rows(self, owners: set[str]) -> list[tuple[int, str, str]]:
        """(row of the residual, its name, unit) of the rows of these owners."""
        row = self.instant.record.residual.row.tolist()
        system = self.system
        return [
            (k, system.rows[r], system.row_units[r])
            for k, r in enumerate(row)
            if r < len(system.row_owner) and system.row_owner[r] in owners
        ]

    def _of_body(self, b: int, body: str) -> list[Output]:
        out = []
        for i, axis in enumerate(XYZ):
            out += [
                Output(f"{body}.position.{axis}", "m", lambda own, i=i: frame_place(own, b)[i]),
                Output(f"{body}.velocity.{axis}", "m/s", lambda own, i=i: frame_velocity(own, b)[i]),
                Output(f"{body}.angular_velocity.{axis}", "rad/s", lambda own, i=i: own.twin.bodies.omega[b, i]),
            ]
        return out

    def reader(self, outputs: Sequence[Output]) -> Callable[[Instant], Lanes]:
        """What reads these outputs from the twin."""
        has_sensors = bool(self.system.record.hooks.address[SENSE])

        def read(own: Instant) -> Lanes:
            own.place_markers()
            own.measure_coordinates()
            if has_sensors:
                own.sense(sensor.apply)
            return np.array([each.read(own) for each in outputs]).reshape(-1, len(NOTHING))

        return read

    # --- inputs ---

    def _inputs(self) -> list[Input]:
        system = self.system
        effort = {"rad": "N m", "m": "N"}
        units = dict(zip(self.coordinates, system.coordinate_units, strict=True))
        out = [
            Input(name, effort.get(units[name], ""), "effort", (k,))
            for name, k in zip(self.coordinates, self.index.tolist(), strict=True)
        ]
        by_name = {each.name: each for each in out}
        for force in self.machine.forces:
            if isinstance(force, Motor):
                whole = self._whole(force.coordinate)
                out.append(Input(force.name, by_name[whole].units, "effort", by_name[whole].place))
        for row, name, unit in self._rows({driver.name for driver in self.machine.drivers}):
            out.append(Input(_motion(name), f"{'rad' if unit == '1' else unit}/s^2", "drive", (row,)))
        places = {fact.name: k for k, fact in enumerate(system.states)}
        out += [Input(name, unit, "state", (places[state],)) for name, (state, unit) in self.opened.states.items()]
        out += [Input(fact.result, fact.units, "state", (k,)) for k, fact in enumerate(system.states)]
        for b, body in enumerate(system.bodies):
            out += [Input(f"{body}.force.{axis}", "N", "force", (b, i)) for i, axis in enumerate(XYZ)]
            out += [Input(f"{body}.torque.{axis}", "N m", "torque", (b, i)) for i, axis in enumerate(XYZ)]
        return out

    def _whole(self, reference: str) -> str:
        """The full name of a joint coordinate that is mentioned by its joint alone; anything else as it is."""
        found = [name for name in self.coordinates if name.startswith(f"{reference}.")]
        return found[0] if len(found) == 1 else reference

    def ports(self, inputs: Sequence[Input]) -> Ports:
        """The generalised forces of inputs, and the rows that they prescribe."""
        own = self.instant
        force, held = np.zeros((own.n, len(inputs))), np.zeros((own.rows, len(inputs)))

        def rates(twin_of: Instant) -> Lanes:
            twin_of.place_markers()
            twin_of.measure_coordinates()
            return np.array([_rate(twin_of, each) for each in inputs])

        if inputs:
            force[own.free] = own.along("v", rates).seen.T
        opened: list[int] = []
        for k, each in enumerate(inputs):
            if each.kind == "drive":
                held[each.place[0], k] = 1.0
                opened.append(each.place[0])
        return Ports(force, held, np.array(opened, dtype=np.intp))


def _rate(own: Instant, each: Input) -> Lanes:
    """The velocity on which an input does work; 0 where it does none."""
    if each.kind == "effort":
        return own.twin.coordinates.rate[each.place[0]]
    if each.kind == "force":
        return frame_velocity(own, each.place[0])[each.place[1]]
    if each.kind == "torque":
        return own.twin.bodies.omega[each.place]
    return NOTHING


def _motion(row: str) -> str:
    """The motion that a driver prescribes by a row: the driver itself, or `DRIVER.x` of a pose."""
    return row.removesuffix(".driver")


# Pressures in place of the masses of fluid as states of linear equations.
#
# Circuits are computed with the mass of fluid in each volume, of gas with its inner energy beside it. With the changes δp of the pressures,
# which are linear in all states, x' = T x:  A' = T A T⁻¹,  B' = T B,  C' = C T⁻¹. Eigenvalues are the same; participation factors then say
# which pressures take part.

# a state of a volume makes its pressure if it makes this share of it at least, for its size
MAKES = 1e-9
# of the sum of the magnitudes of its terms, what is known of a number
ROUND_OFF = 1e-13


class PressureStates(Struct):
    """The states of volumes and the outputs of their pressures: (number of the state, name of the output)."""

    pairs: tuple[tuple[int, str], ...]

    @property
    def outputs(self) -> list[str]:
        """Names of the pressures."""
        return [name for _, name in self.pairs]


def pressure_states(facts: Sequence[StateFact], outputs: Collection[str]) -> PressureStates:
    """Those of a machine: the state of each volume is its mass, of gas its inner energy."""
    names = {fact.name: k for k, fact in enumerate(facts)}
    pairs = []
    for name, k in names.items():
        owner, _, quantity = name.rpartition(".")
        if not quantity.startswith("mass"):
            continue
        pressure = f"hydraulics.{owner}.{quantity.replace('mass', 'pressure', 1)}"
        if pressure in outputs:
            pairs.append((names.get(f"{owner}.{quantity.replace('mass', 'energy', 1)}", k), pressure))
    return PressureStates(tuple(pairs))


def transformation(rows: Array, places: Sequence[int], scale: Array) -> tuple[Array, set[int]]:
    """T (n, n): one but for the rows of these places, which are `rows` (k, n), and the places that were replaced. A row whose own state
    does not make the pressure stays."""
    T, replaced = np.eye(len(scale)), set[int]()
    for row, place in zip(rows, places, strict=True):
        if abs(row[place]) * scale[place] > MAKES * np.max(np.abs(row) * scale, initial=0.0):
            T[place] = row
            replaced.add(place)
    return T, replaced


def transformed(space: LinearSystem, T: Array) -> LinearSystem:
    """The same equations for T x, without what is left of terms that cancel."""
    back: Array = np.asarray(np.linalg.inv(T), dtype=np.float64)

    def product(*factors: Array) -> Array:
        whole, size = factors[0], np.abs(factors[0])
        for each in factors[1:]:
            whole, size = whole @ each, size @ np.abs(each)
        return np.where(np.abs(whole) > ROUND_OFF * size, whole, 0.0)

    return LinearSystem(product(T, space.A, back), product(T, space.B), product(space.C, back), space.D)


def seen(found: Eigen, T: Array) -> Eigen:
    """Eigenvectors of the equations for T x."""
    back: Array = np.asarray(np.linalg.inv(T), dtype=np.float64)
    return Eigen(found.values, found.zero, T @ found.right, back.T @ found.left, found.zeros, found.known)
