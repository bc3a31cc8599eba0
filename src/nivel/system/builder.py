"""A machine half way from words to numbers: what has been numbered so far, by name."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import numpy as np

from nivel.elements.facts import Coupled, StateFact
from nivel.elements.rows import Row
from nivel.kernels.bodies.coordinate import DISTANCE, ROTATION
from nivel.kernels.record.function import ANGULAR_VELOCITY, COORDINATE, OUTPUT, POSITION, RATE, STATE, VELOCITY
from nivel.kernels.record.hook import Family
from nivel.known import PartFunction
from nivel.lazy import dataclass, field
from nivel.machine.core.element import End, GlobalPoint, Marker
from nivel.machine.laws.symbols import find_symbol, is_output
from nivel.machine.laws.time_function import TimeFunction
from nivel.machine.laws.varying_value import Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.formula import LinearFunction
from nivel.machine.uses.coordinate_reference import Kind, resolve
from nivel.system.joint_frames import Directions, Placed, as_placed, marker_place, seen_from
from nivel.system.laws.functions import FunctionTable, Signal
from nivel.system.laws.integrated import integrated
from nivel.system.tables import Array, CircuitTable, CoordinateTable, ElementTable, MarkerTable, OutputTable

GROUND = "ground"
AXES = "xyz"
NOTHING = Coupled(frozenset())


@dataclass
class SystemBuilder:
    """Tables of a machine and the indices of what has a name in it. Body number len(machine.bodies) is the ground.

    joint_coordinates : index of every joint coordinate by `JOINT.COORDINATE`, once the joints are built.
    frictions : (columns of index, of number) of `nivel.kernels.elements.friction`. friction_names : of each, the force or its patch.
    friction_loads : of those whose load is a function, what it depends on. transmissions : of couplings and screw joints by name the row,
    and its factors of coordinates.
    owners : `joints.hinge`, `markers.tip`, …: what made each marker. noted : the bodies and states used in each `noting`.
    inputs : the signal of every input. input_functions : the function of each, in the order of the machine. control : the signal of every
    part of a block by its path.
    behind_signals : what a part that is no state depends on. functions_of : the function of every part.
    samples : states that take what a function gives at an offset [s] and after each period, None: once.
    """

    machine: MachineRecord
    markers: MarkerTable = field(default_factory=MarkerTable)
    coordinates: CoordinateTable = field(default_factory=CoordinateTable)
    functions: FunctionTable = field(default_factory=FunctionTable)
    elements: ElementTable = field(default_factory=ElementTable)
    outputs: OutputTable = field(default_factory=OutputTable)
    circuit: CircuitTable = field(default_factory=CircuitTable)
    joint_coordinates: dict[str, int] = field(default_factory=dict)
    frictions: list[tuple[list[int], list[float]]] = field(default_factory=list)
    friction_names: list[str] = field(default_factory=list)
    friction_loads: dict[int, Coupled] = field(default_factory=dict)
    transmissions: dict[str, tuple[int, dict[int, float]]] = field(default_factory=dict)
    noted: list[Coupled] = field(default_factory=list)
    owners: list[str] = field(default_factory=list)
    inputs: dict[str, Signal] = field(default_factory=dict)
    input_functions: list[int] = field(default_factory=list)
    control: dict[str, Signal] = field(default_factory=dict)
    behind_signals: dict[str, Coupled] = field(default_factory=dict)
    functions_of: dict[str, int] = field(default_factory=dict)
    samples: list[tuple[int, LinearFunction | TimeFunction, float | None, float]] = field(default_factory=list)
    _owner: str = ""
    _noting: set[int] = field(default_factory=set)
    _noting_states: set[int] = field(default_factory=set)
    _named: dict[str, int] = field(default_factory=dict)
    _frames: dict[str, int] = field(default_factory=dict)
    _tips: dict[tuple[str, int], int] = field(default_factory=dict)

    def add(self, family: Family, row: Row, memory: int = 0, surfaces: tuple[int, ...] = ()) -> None:
        """Give a row to a family, which keeps `memory` numbers from state to state. surfaces : those of these that are about a surface."""
        self.elements.add(family, row.columns, row.numbers, memory, surfaces)

    def body(self, name: str) -> int:
        """Index of a body or the ground."""
        return self._bodies[name]

    def __post_init__(self) -> None:
        names = [body.name for body in self.machine.bodies]
        self._bodies = {name: k for k, name in enumerate((*names, GROUND))}
        self.directions = Directions(self.machine.assembly.parallel)

    @contextmanager
    def noting(self) -> Iterator[None]:
        """Append the bodies whose markers and coordinates are asked for inside, and the states, to `noted`."""
        self._noting.clear()
        self._noting_states.clear()
        yield
        self.noted.append(Coupled(frozenset(self._noting), frozenset(self._noting_states)))

    @contextmanager
    def within(self, owner: str) -> Iterator[None]:
        """Markers made inside are those of this element."""
        before, self._owner = self._owner, owner
        yield
        self._owner = before

    def _note(self, *markers: int) -> None:
        self._noting.update(self.markers.body[marker] for marker in markers)

    def place(self, placed: Placed) -> int:
        """Index of a new marker: body, point and axes in the body's frame."""
        body, point, axes = placed
        marker = self.markers.add(self.body(body), point, axes)
        self.owners.append(self._owner)
        self._note(marker)
        return marker

    def marker(self, name: str) -> int:
        """Index of the marker called `name`."""
        if name not in self._named:
            record = self.machine.marker_named[name]
            with self.within(f"markers.{name}"):
                self._named[name] = self.place(marker_place(self.machine, record))
        self._note(self._named[name])
        return self._named[name]

    def place_of(self, marker: str) -> Placed:
        """Body, point and axes, in the body's frame, of a marker."""
        return marker_place(self.machine, self.machine.marker_named[marker])

    def frame(self, body: str) -> int:
        """Index of the marker that is the frame of a body or of the ground."""
        if body not in self._frames:
            self._frames[body] = self.place((body, np.zeros(3), np.eye(3)))
        self._note(self._frames[body])
        return self._frames[body]

    def tip(self, body: str, axis: int, reach: float) -> int:
        """Index of the marker at a reach [m] along an axis of a node, which is the tip of its gradient there."""
        if (body, axis) not in self._tips:
            self._tips[body, axis] = self.place((body, reach * np.eye(3)[axis], np.eye(3)))
        self._note(self._tips[body, axis])
        return self._tips[body, axis]

    @property
    def frame_markers(self) -> Iterable[int]:
        """The markers that are frames of bodies."""
        return self._frames.values()

    def marker_or_ground(self, name: str | None) -> int:
        """Index of the marker called `name`; without one, the global frame."""
        return self.frame(GROUND) if name in (None, GROUND) else self.marker(str(name))

    def end(self, end: End) -> int:
        """Index of the marker where something acts: a name, a marker on the spot, or a point given in global axes."""
        match end:
            case str():
                return self.marker(end)
            case Marker():
                return self.place(marker_place(self.machine, end))
            case GlobalPoint(body, point):
                return self.place(seen_from(self.machine, body, np.array(point, dtype=float), np.eye(3)))

    def as_placed(self, end: End) -> Placed:
        """Body, global point and global axes of where something acts, as the file places its body."""
        return as_placed(self.machine, end)

    def seen_from(self, body: str, point: Array, axes: Array) -> Placed:
        """A global point (3,) and axes (3, 3) in the frame of a body, as the file places it."""
        return seen_from(self.machine, body, point, axes)

    def ends(self, ends: tuple[End, End]) -> tuple[int, int]:
        """Indices of the markers at both ends."""
        return self.end(ends[0]), self.end(ends[1])

    def coordinate(self, reference: str, kind: Kind | None = None) -> int:
        """Index of a joint coordinate, which is measured in every evaluation from now on."""
        joint, name = resolve(reference, self.machine.joints, kind)
        return self._measured(f"{joint}.{name}")

    def add_friction(self, name: str, index: list[int], numbers: list[float]) -> None:
        """A friction with these columns and numbers, for the element called `name`; it depends on all that was asked for by the element."""
        self.friction_loads[len(self.frictions)] = Coupled(frozenset(self._noting), frozenset(self._noting_states))
        self.frictions.append((index, numbers))
        self.friction_names.append(name)

    def own_state(self, fact: StateFact) -> int:
        """Index of a new state: what adds to its rate is said by the kernel of its element."""
        self.elements.own_state(fact)
        return self.state(fact.name)

    def state(self, name: str) -> int:
        """Index of the state of this name, which the element being added reads or feeds."""
        index = self.elements.state(name)
        self._noting_states.add(index)
        return index

    def touch_state(self, number: int) -> None:
        """The element being added reads or feeds this state."""
        self._noting_states.add(number)

    def node(self, name: str) -> int:
        """Number of the node of a circuit of this name, on which the element being added acts or depends."""
        self.note(self.circuit.depends.get(name, NOTHING))
        return self.circuit.index(name)

    def note(self, coupled: Coupled) -> None:
        """The element being added depends on all this."""
        self._noting.update(coupled.bodies)
        self._noting_states.update(coupled.states)

    def measure_all(self) -> None:
        """All joint coordinates are measured in every evaluation from now on."""
        for name in self.joint_coordinates:
            self._measured(name)

    def _measured(self, name: str) -> int:
        index = self.joint_coordinates[name]
        self._note(*self.coordinates.markers(index))
        return self.coordinates.use(index)

    def function(
        self,
        value: PartFunction,
        local: dict[str, Signal] | None = None,
        *,
        motion: bool = False,
        switching: bool = True,
        sampled: bool = False,
    ) -> int:
        """Index of a new function; `local` are the symbols that only this one knows.

        switching : every evaluation finds its value, and once. sampled : only samples and events ask for it, at instants that count.
        """

        def find(path: str) -> Signal:
            return local[path] if local is not None and path in local else self.signal(path)

        end = self.machine.simulation.duration
        return self.functions.add(
            value, find, motion=motion, end=end, switching=switching and not sampled, beyond=not sampled
        )

    def way(self, rate: TimeFunction, order: int, start: float = 0.0) -> int:
        """Index of the function of time whose derivative of this order is `rate`; start : its first derivative at t = 0, of order two."""
        return self.functions.add_way(*integrated(rate, order, self.machine.simulation.duration, start))

    def spline(self, table: Table, order: int) -> int:
        """Index of the derivative of this order (0: the value) of a cubic table of a signal, which goes on straight beyond its ends."""
        return self.functions.add_spline(table, order, self.signal)

    def signal_at(self, path: str) -> Signal:
        """The signal of a part of a block; what it depends on is noted."""
        kind, index, component = self.control[path]
        if kind == STATE:
            self._noting_states.add(index)
        elif path in self.behind_signals:
            self._noting |= self.behind_signals[path].bodies
            self._noting_states |= self.behind_signals[path].states
        return kind, index, component

    def signal(self, path: str) -> Signal:
        """The signal that a symbol of the machine stands for; a coordinate among them is measured from now on."""
        if path in self.control:
            return self.signal_at(path)
        symbol = find_symbol(path, self.machine)
        if symbol.section == "joints":
            name = symbol.quantity.removesuffix("_rate")
            index = self._measured(f"{symbol.name}.{name}")
            return (COORDINATE if name == symbol.quantity else RATE, index, 0)
        if symbol.section == "inputs":
            return self.inputs[symbol.name]
        if symbol.section == "forces" and is_output(symbol, self.machine.index):
            return (OUTPUT, self.outputs.index(f"force.{path}"), 0)
        if symbol.section in ("states", "forces"):
            return (STATE, self.state(symbol.name if symbol.section == "states" else path), 0)
        if symbol.section == "hydraulics":
            output, coupled = self.circuit.signals[path]
            self.note(coupled)
            return (OUTPUT, output, 0)
        if symbol.section == "sensors":
            sensor = next(sensor for sensor in self.machine.sensors if sensor.name == symbol.name)
            ends = sensor.distance or sensor.angle
            assert ends is not None  # the symbol was found
            kind = DISTANCE if sensor.distance is not None else ROTATION
            index = self.coordinates.use(self.coordinates.add(kind, *self.ends(ends)))
            return (RATE if symbol.quantity == "rate" else COORDINATE, index, 0)
        marker = self.marker(symbol.name) if symbol.section == "markers" else self.frame(symbol.name)
        kind = {"v": VELOCITY, "w": ANGULAR_VELOCITY}.get(symbol.quantity[0], POSITION)
        return kind, marker, AXES.index(symbol.quantity[-1])
