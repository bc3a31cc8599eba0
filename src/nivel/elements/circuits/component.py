"""Base of all components of a hydraulic circuit: a name, and ports that are connected to nodes."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Final

from pydantic import BeforeValidator, WithJsonSchema

from nivel.elements.circuits import ranges
from nivel.machine.core.coefficient import Share, SonicConductance
from nivel.machine.core.element import Inequalities
from nivel.machine.core.record import Checked, Name, Problem, entry, superfluous, unknown_word
from nivel.machine.given import Field, Maybe, Usual
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import fault, shown


def _connections(value: Any) -> Any:
    if not isinstance(value, Mapping):
        raise fault(f"a mapping of ports to nodes such as {{P: supply, T: tank}} was expected, got {shown(value)}")
    for port, node in value.items():
        if not isinstance(node, str):
            raise fault(f"port {port}: the name of a node was expected, got {shown(node)}")
    return {str(port): str(node) for port, node in value.items()}


Ports = Annotated[
    dict[str, str],
    BeforeValidator(_connections),
    WithJsonSchema({"type": "object", "additionalProperties": {"type": "string"}}),
]

SENSING: Final = ("LS", "X")  # ports that feel a pressure and take no flow


class Component(Checked):
    """A named part of a circuit.

    needs : ports that must be connected; may : those that may be. nodes : what of it others connect to, "" for itself, ".A" for its
    chamber A. functions : fields that may vary. early : signals known before flows are; late : the others. gases, liquids : whether
    gas, or a liquid, may flow through it. passes : pairs of ports (from, to) between which fluid passes at any pressure; delivers :
    port into which it delivers a given flow, whatever the pressure; relieves : port whose pressure it bounds. These ask for a relief
    valve where none is reached. sensing : ports that feel a pressure and take no flow. loads : whether a load-sensing signal may take
    the load of A or B from it. usual : what its results are between, by the words with which their names begin. inequalities : that its
    state obeys at all times.
    """

    collection: ClassVar[str] = "hydraulics"
    needs: ClassVar[tuple[str, ...]] = ()
    may: ClassVar[tuple[str, ...]] = ()
    nodes: ClassVar[tuple[str, ...]] = ()
    functions: ClassVar[tuple[str, ...]] = ()
    early: ClassVar[tuple[str, ...]] = ()
    late: ClassVar[tuple[str, ...]] = ()
    gases: ClassVar[bool] = False
    liquids: ClassVar[bool] = True
    passes: ClassVar[tuple[tuple[str, str], ...]] = ()
    delivers: ClassVar[str] = ""
    relieves: ClassVar[str] = ""
    sensing: ClassVar[tuple[str, ...]] = SENSING
    loads: ClassVar[bool] = False
    usual: ClassVar[Mapping[str, Usual]] = {"pressure": ranges.PRESSURE, "flow": ranges.FLOW, "power": ranges.POWER}
    inequalities: ClassVar[Inequalities] = ()

    name: Name
    if TYPE_CHECKING:  # the word of every kind
        type: Any
    ports: Ports = Field("nodes that the ports are connected to", default={})

    def node(self, place: str) -> str:
        """The node at a port; `.M` is one within the component."""
        return self.ports.get(place, f"{self.name}{place}")

    @property
    def inlets(self) -> tuple[str, ...]:
        """Ports out of which fluid can come into what is connected to them."""
        return tuple(port for port in self.ports if port not in self.sensing)

    @classmethod
    def signals_in(cls, data: Any) -> tuple[str, ...]:
        """Names of its quantities, by a record or raw data."""
        return (*cls.early, *cls.late)

    @classmethod
    def nodes_in(cls, data: Any) -> tuple[str, ...]:
        """Those of `nodes` that it has, by a record or raw data."""
        return cls.nodes

    @classmethod
    def ports_in(cls, data: Any) -> set[str]:
        """Ports that are connected, by a record or raw data."""
        ports = entry(data, "ports")
        return {str(port) for port in ports} if isinstance(ports, Mapping) else set()

    def problems(self) -> Iterator[Problem]:
        yield from self.problems_of_ports(self.needs, self.may)

    def problems_of_ports(self, needs: tuple[str, ...], may: tuple[str, ...] = ()) -> Iterator[Problem]:
        """Ports that are missing, and those that there are not."""
        known = (*needs, *may)
        for port in self.ports:
            if port not in known:
                what = unknown_word(port, known, "port") if known else f"a {self.type} has no ports"
                yield Problem(("ports", port), what, at_key=True)
        missing = [port for port in needs if port not in self.ports]
        if missing:
            example = ", ".join(f"{port}: {self.ports.get(port, '…')}" for port in needs)
            what = f"port {missing[0]} is" if len(missing) == 1 else f"ports {', '.join(missing)} are"
            yield Problem((), f"{what} not connected; write `ports: {{{example}}}`")


def problem_of_share(key: str, value: object, least: float) -> Iterator[Problem]:
    """A constant that is not between `least` and one. What varies is cut off there."""
    if isinstance(value, float | int) and not least <= value <= 1.0:
        yield Problem((key,), f"a share from {least:g} to 1 was expected, got {value:g}")


class Rating(Checked):
    """What a catalogue states of a restriction: of liquids `flow` at `pressure_drop`, of gases the numbers of ISO 6358."""

    flow: Maybe[ranges.Flow] = Field("through one edge, fully open, at `pressure_drop`", default=None)
    pressure_drop: Maybe[ranges.Drop] = Field("at which `flow` is measured", default=None)
    sonic_conductance: Maybe[SonicConductance] = Field("of gases: C of ISO 6358", default=None)
    critical_ratio: Maybe[Share] = Field("of gases: b of ISO 6358; default 0.3", default=None)

    @property
    def is_of_gas(self) -> bool:
        """Whether it is rated for gases."""
        return self.sonic_conductance is not None

    @property
    def conductance(self) -> float:
        """K [m³/s/√Pa] of Q = K √Δp; 0 where no flow is given."""
        return self.flow / self.pressure_drop**0.5 if self.flow and self.pressure_drop else 0.0

    def problems_of_rating(self) -> Iterator[Problem]:
        """One of both ratings, and all of it."""
        missing = [name for name in ("flow", "pressure_drop") if getattr(self, name) is None]
        if self.sonic_conductance is None:
            if missing:
                yield Problem((), f"{_listed(missing)} missing: a catalogue states a flow at a difference of pressure")
            if self.critical_ratio is not None:
                yield superfluous("critical_ratio", "belongs to a `sonic_conductance`, of gases")
        else:
            for name in ("flow", "pressure_drop"):
                if name not in missing:
                    yield superfluous(name, "is of liquids, and `sonic_conductance` of gases; give one of them")
            if self.critical_ratio == 1.0:
                yield Problem(("critical_ratio",), "a ratio of pressures below 1 was expected, got 1")


def _listed(names: list[str]) -> str:
    quoted = [f"`{name}`" for name in names]
    return f"{' and '.join(quoted)} {'is' if len(quoted) == 1 else 'are'}"


class Rated(Rating, Component):
    """A component with a flow from a catalogue, fully open."""

    transition: ranges.Drop = Field("difference of pressure below which the root is rounded", default=0.5e5)

    def problems(self) -> Iterator[Problem]:
        yield from Component.problems(self)
        yield from self.problems_of_rating()


VaryingPressure = Annotated[OneFunction, varying("pressure")]
VaryingTemperature = Annotated[OneFunction, varying("temperature")]
