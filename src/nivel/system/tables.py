"""Tables that fill while a machine is built, each with the arrays that it becomes."""

from collections.abc import Sequence
from functools import reduce
from itertools import pairwise
from typing import Any, Final, TypeVar, get_args, get_type_hints

import numpy as np
from numpy.typing import NDArray

from nivel.elements.facts import Coupled, StateFact
from nivel.kernels.bodies.coordinate import ALONG, LAST_ANGLE
from nivel.kernels.bodies.driven_turn import BASE
from nivel.kernels.bodies.measure import COMBINED
from nivel.kernels.record.circuit_record import CircuitTangent
from nivel.kernels.record.hook import FAMILIES, Family
from nivel.kernels.record.record import NONE, Bodies, Circuit, Coordinates, Elements, Markers
from nivel.known import Node
from nivel.lazy import Struct, dataclass, field, nivel

Array = NDArray[np.float64]
AnyRecord = TypeVar("AnyRecord", bound=tuple[Any, ...])


def index_array(values: object, columns: int) -> NDArray[np.uint32]:
    """uint32 array of `values`: (n, columns), or (n,) for one column."""
    array = np.array(values, dtype=np.uint32)
    return array.reshape(-1) if columns == 1 else array.reshape(-1, columns)


def zeros(names: str, *shape: int) -> dict[str, Any]:
    """Arrays of one shape for work, by the names of their fields."""
    return {name: np.zeros(shape) for name in names.split()}


def empty(record_class: type[AnyRecord]) -> AnyRecord:
    """A record without numbers: all its arrays are empty."""
    kinds = (get_args(kind) for kind in get_type_hints(record_class, include_extras=True).values())
    return record_class(*(np.zeros((0,) * dimensions, _number_type(array)) for array, dimensions, _ in kinds))


def _number_type(array: Any) -> Any:
    """That of NDArray[…]: of its type of data, or from NumPy 2.5 on of the alias itself."""
    last = get_args(array)[-1]
    return (get_args(last) or (last,))[0]


OVER_HEIGHTS: Final = "nivel.elements.contacts.heights:apply_over_heights"
ON_SOIL: Final = "nivel.elements.contacts.on_soil:apply"


def rows_of(elements: Elements, family: str) -> tuple[int, int]:
    """First element of a family, `module:function`, and one past the last; twice zero where there is none."""
    for address, (first, last) in zip(elements.address, elements.span, strict=True):
        if (found := FAMILIES.get(int(address))) is not None and found.code.name == f"{family}.code":
            return int(first), int(last)
    return 0, 0


def longer(array: Array, count: int) -> Array:
    """A copy with `count` rows, the further ones like the last."""
    return np.concatenate([array, np.repeat(array[-1:], count - len(array), axis=0)])


def work_arrays(bodies: Bodies) -> dict[str, Array]:
    """What the kernels find of bodies: one row for each, and for the ground."""
    names = ("R", "theta", "A", "Rdot", "omega", "omega_b", "c", "wrench", "Rddot", "alpha_b")
    return {name: getattr(bodies, name) for name in names}


def padded(rows: Sequence[Sequence[float]], fill: float) -> Array:
    """(n, longest) with `fill` where a row ends earlier."""
    out = np.full((len(rows), max((len(row) for row in rows), default=0)), fill, dtype=float)
    for k, row in enumerate(rows):
        out[k, : len(row)] = row
    return out


@dataclass
class MarkerTable:
    """Frames on bodies."""

    body: list[int] = field(default_factory=list)
    position: list[Array] = field(default_factory=list)
    frame: list[Array] = field(default_factory=list)

    def add(self, body: int, position: Array, frame: Array) -> int:
        """Index of a new marker at `position` (3,) with axes `frame` (3, 3), both in body axes."""
        self.body.append(body)
        self.position.append(position)
        self.frame.append(frame)
        return len(self.body) - 1

    def arrays(self) -> Markers:
        count = len(self.body)
        return Markers(
            body=index_array(self.body, 1),
            position_b=np.array(self.position, dtype=float).reshape(count, 3),
            frame_b=np.array(self.frame, dtype=float).reshape(count, 3, 3),
            **zeros("u r rdot bias", count, 3),
            A=np.zeros((count, 3, 3)),
        )


class Rail(Struct):
    """A beam that something slides on: markers of its nodes, their places along the unstressed line, that of the slider as placed [m]."""

    nodes: tuple[int, ...]
    stations: tuple[float, ...]
    place: float


class Wheel(Struct):
    """A wheel that rolls on a plane: its marker, radius of the circle in its rim and of the crown about that [m]."""

    marker: int
    circle: float
    crown: float


@dataclass
class CoordinateTable:
    """Scalars measured between two markers, or a slider and the nodes of its rail, or combined of others; the same one is measured once."""

    what: list[tuple[int, int, int, int]] = field(default_factory=list)  # kind, first marker, second marker, axis
    rails: dict[int, Rail] = field(default_factory=dict)  # of sliders
    wheels: dict[int, Wheel] = field(default_factory=dict)  # of what rolls
    # of driven orientations the first function, and the axes of the turns, see `nivel.kernels.bodies.driven_turn`
    targets: dict[int, tuple[int, str]] = field(default_factory=dict)
    sums: dict[int, tuple[tuple[int, float], ...]] = field(
        default_factory=dict
    )  # of combined ones: coordinates, factors
    active: set[int] = field(default_factory=set)
    _index: dict[tuple[int, int, int, int], int] = field(default_factory=dict)

    def add(self, kind: int, first: int, second: int, axis: int = 0) -> int:
        """Index of the coordinate of this `kind` (see `nivel.kernels.bodies.coordinate`) between two markers."""
        entry = (kind, first, second, axis)
        if entry not in self._index:
            self._index[entry] = len(self.what)
            self.what.append(entry)
        return self._index[entry]

    def on_rail(self, kind: int, slider: int, rail: Rail) -> int:
        """The same for a kind of slider; it is followed through its place along the rail."""
        along = self.add(ALONG, slider, rail.nodes[0])
        index = along if kind == ALONG else self.add(kind, slider, rail.nodes[0], along)
        self.rails[index] = rail
        return index

    def on_plane(self, kind: int, plane: int, wheel: Wheel, axis: int) -> int:
        """The same for a kind of wheel on a plane."""
        index = self.add(kind, plane, wheel.marker, axis)
        self.wheels[index] = wheel
        return index

    def on_target(self, kind: int, reference: int, marker: int, target: tuple[int, str]) -> int:
        """The same for a component of the turn of a marker against its target: its first function, and the axes of its turns."""
        index = self.add(kind, reference, marker, NONE)
        self.targets[index] = target
        return index

    def combined(self, terms: tuple[tuple[int, float], ...]) -> int:
        """Index of a new coordinate Σ factor coordinate, of others that every evaluation measures."""
        for coordinate, _ in terms:
            self.use(coordinate)
        self.what.append((COMBINED, NONE, NONE, NONE))
        index = len(self.what) - 1
        self.sums[index] = terms
        return self.use(index)

    def markers(self, coordinate: int) -> tuple[int, ...]:
        """Markers that a coordinate looks at, one for each of its parts."""
        if coordinate in self.sums:
            return tuple(marker for each, _ in self.sums[coordinate] for marker in self.markers(each))
        _, first, second, _ = self.what[coordinate]
        return (first, *self.rails[coordinate].nodes) if coordinate in self.rails else (first, second)

    def use(self, coordinate: int) -> int:
        """The same index; the coordinate is measured in every evaluation from now on."""
        self.active.add(coordinate)
        return coordinate

    def arrays(self) -> Coordinates:
        count = len(self.what)
        markers = [self.markers(k) for k in range(count)]
        stations = [self._numbers(k) for k in range(count)]
        parts = sum(map(len, markers))
        followed = [k for k, entry in enumerate(self.what) if entry[0] <= LAST_ANGLE or entry[0] == ALONG]
        return Coordinates(
            what=index_array(self.what, 4),
            active=index_array(sorted(self.active), 1),
            start=np.cumsum([0, *map(len, markers)]).astype(np.uint32),
            part_marker=index_array([marker for each in markers for marker in each], 1),
            station=np.array([place for each in stations for place in each], dtype=float),
            followed=index_array(followed, 1),
            reference=np.array([self.rails[k].place if k in self.rails else 0.0 for k in range(count)], dtype=float),
            **zeros("value rate bias", count),
            J=np.zeros((parts + 2, 6)),
        )

    def _numbers(self, coordinate: int) -> tuple[float, ...]:
        """A number for each part: stations of the nodes of a rail, radii of a wheel, what says the target of a turn, factors and numbers
        of what is combined."""
        if coordinate in self.sums:
            terms = self.sums[coordinate]
            return tuple(
                n for each, factor in terms for n in (factor, float(each), *[0.0] * (len(self.markers(each)) - 2))
            )
        if coordinate in self.rails:
            return 0.0, *self.rails[coordinate].stations
        if coordinate in self.targets:
            function, axes = self.targets[coordinate]
            digits = ("xyz".index(axis) + 1 for axis in axes)
            return float(function), float(reduce(lambda code, digit: BASE * code + digit, digits, 0))
        wheel = self.wheels.get(coordinate)
        return (wheel.circle, wheel.crown) if wheel is not None else (0.0, 0.0)


@dataclass
class ElementTable:
    """Forces by family, a family being named by its kernel's module, and the first-order states of all elements."""

    families: dict[Family, list[tuple[list[int], list[float], int, tuple[int, ...]]]] = field(default_factory=dict)
    _states: dict[str, StateFact | None] = field(default_factory=dict)

    def add(
        self,
        family: Family,
        index: list[int],
        number: list[float] | None = None,
        memory: int = 0,
        surfaces: tuple[int, ...] = (),
    ) -> None:
        """A force of `family` with these columns, which keeps `memory` numbers from state to state.

        surfaces : those of the numbers that are about a surface, which touches or not.
        """
        self.families.setdefault(family, []).append((index, number or [], memory, surfaces))

    def state(self, name: str) -> int:
        """Number of the first-order state of this name, which an element owns or will own."""
        self._states.setdefault(name, None)
        return list(self._states).index(name)

    def own_state(self, fact: StateFact) -> int:
        """Number of a state that gets its facts from its owner."""
        self._states[fact.name] = fact
        return self.state(fact.name)

    def order(self, families: Sequence[Family], last: str) -> None:
        """Call these families before all others, in this order, and that of the name `last` behind all others."""
        first = {family: self.families[family] for family in families if family in self.families}
        others = sorted(self.families, key=lambda family: family.code.name == f"{last}.code")
        self.families = first | {family: self.families[family] for family in others}

    @property
    def states(self) -> tuple[StateFact, ...]:
        """The states of all elements, in the order of their numbers."""
        return tuple(fact for fact in self._states.values() if fact is not None)

    def surfaces(self) -> list[tuple[int, int]]:
        """(element, place in its memory) of all surfaces."""
        elements = [element for family in self.families.values() for element in family]
        return [(k, place) for k, element in enumerate(elements) for place in element[3]]

    def arrays(self) -> Elements:
        """The tables of all elements."""
        elements = [element for family in self.families.values() for element in family]
        stops = np.cumsum([0, *(len(family) for family in self.families.values())])
        index = padded([element[0] for element in elements], NONE)
        kept = (len(elements), max((element[2] for element in elements), default=0))
        return Elements(
            address=np.array([family.address for family in self.families], dtype=np.uint64),
            span=index_array(list(pairwise(stops)), 2),
            columns=index.astype(np.uint32),
            number=padded([element[1] for element in elements], 0.0),
            **zeros("memory proposal depth depth_rate", *kept),
            **zeros("state state_rate", len(self.states)),
        )


@dataclass
class CircuitTable:
    """Nodes by name, fluids as rows of `Circuit.fluid`, that of each component by its number, signals by path with what they depend
    on."""

    nodes: dict[str, Node] = field(default_factory=dict)
    fluids: list[tuple[float, ...]] = field(default_factory=list)
    fluid: dict[str, int] = field(default_factory=dict)
    depends: dict[str, Coupled] = field(default_factory=dict)
    signals: dict[str, tuple[int, Coupled]] = field(default_factory=dict)

    def index(self, name: str) -> int:
        """Number of a node."""
        return list(self.nodes).index(name)

    def arrays(self) -> Circuit:
        """The tables."""
        nodes, count = list(self.nodes.values()), len(self.nodes)
        flowing = [(node.fluid, node.state if node.is_volume else NONE, node.energy, node.warmth) for node in nodes]
        return Circuit(
            node=index_array(flowing, 4),
            fluid=padded(self.fluids, 0.0),
            room=padded([nivel.elements.circuits.volumes.filled_room(node.room) for node in nodes], 0.0),
            secant=np.zeros(1, dtype=np.uint32),
            guard=np.zeros(2),
            known=np.zeros((count, 8)),
            **zeros("kept volume volume_rate pressure density enthalpy temperature", count),
            inflow=np.zeros(2 * count),
            power=np.zeros(4),
            stored=np.zeros(1),
            tangent=empty(CircuitTangent),
        )


@dataclass
class OutputTable:
    """What forces, couplings, drivers and sensors report: name, units, long name."""

    entries: list[tuple[str, str, str]] = field(default_factory=list)

    def add(self, *entries: tuple[str, str, str]) -> int:
        """Index of the first of new outputs."""
        self.entries.extend(entries)
        return len(self.entries) - len(entries)

    def index(self, name: str) -> int:
        """Index of the output with this name. Raises ValueError where there is none."""
        return [entry[0] for entry in self.entries].index(name)
