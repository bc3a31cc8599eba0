"""What all components of a hydraulic circuit share: a name, and ports that are connected to nodes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from pydantic import BeforeValidator, Field, WithJsonSchema

from nivel.machine.checked import Checked, Problem
from nivel.machine.coefficient import Pressure, VolumeFlow
from nivel.machine.quantity import fault, shown
from nivel.machine.record import Name, unknown_word


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


class Component(Checked):
    """A named part of a circuit.

    needs : ports that must be connected; may : those that may be. nodes : what of it others connect to, "" for itself, ".A" for its
    chamber A. functions : fields that may vary. early : signals known before flows are; late : the others.
    """

    collection: ClassVar[str] = "hydraulics"
    needs: ClassVar[tuple[str, ...]] = ()
    may: ClassVar[tuple[str, ...]] = ()
    nodes: ClassVar[tuple[str, ...]] = ()
    functions: ClassVar[tuple[str, ...]] = ()
    early: ClassVar[tuple[str, ...]] = ()
    late: ClassVar[tuple[str, ...]] = ()

    name: Name
    if TYPE_CHECKING:  # the word of every kind
        type: Any
    ports: Ports = Field(default={}, description="nodes that the ports are connected to")

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


class Rated(Component):
    """A component with a flow from a catalogue: `flow` at `pressure_drop`, fully open."""

    flow: VolumeFlow = Field(description="through one edge, fully open, at `pressure_drop`")
    pressure_drop: Pressure = Field(description="at which `flow` is measured")
    transition: Pressure = Field(default=0.5e5, description="difference of pressure below which the root is rounded")

    @property
    def conductance(self) -> float:
        """K [m³/s/√Pa] of Q = K √Δp."""
        return self.flow / self.pressure_drop**0.5
