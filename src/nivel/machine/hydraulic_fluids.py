"""Fluids of circuits and the components in which they flow: one fluid for each, and gases where gas may flow."""

from collections.abc import Iterator, Mapping
from typing import Any, Final

from nivel.elements.circuits import COMPONENTS, record_of
from nivel.machine.core.index import Place, elements
from nivel.machine.core.record import entry

Faults = Iterator[tuple[Place, str]]
GAS: Final = "ideal-gas"
KINDS: Final = ("liquid", GAS)
DEFAULT: Final = ""  # name of the fluid of a machine without `fluids`
RATED: Final = "`sonic_conductance`, in dm^3/(s*bar), and `critical_ratio`"
OF_LIQUIDS: Final = ("wall_modulus",)
# keys of components, of liquids whose temperature is a state; the first one of gases too
WARM: Final = {"tank": ("temperature",), "cooler": ("heat_conductance",)}
WALLS: Final = "heat_conductance"
HOW: Final = "write `isothermal: false` and a `grade` in its fluid"
OF_GASES: Final = ("heat_transfer",)


def fluid_faults(machine: Any, nodes: Mapping[str, Any]) -> Faults:
    """Place and message of everything that is wrong. nodes : the component that makes each."""
    kinds = {str(entry(each, "name")): str(entry(each, "type") or "liquid") for each in elements(machine, "fluids")}
    kinds = kinds or {DEFAULT: "liquid"}
    warm = {str(entry(each, "name")) for each in elements(machine, "fluids") if entry(each, "isothermal") is False}
    for at, component in enumerate(elements(machine, "hydraulics")):
        place: Place = ("hydraulics", at)
        touched = _touched(component, nodes, kinds)
        if len(set(touched.values())) > 1:
            said = ", ".join(f"{node} of {fluid}" for node, fluid in touched.items())
            yield place, f"one component carries one fluid; its nodes are {said}"
        elif touched and (kind := kinds[fluid := next(iter(touched.values()))]) in KINDS:
            yield from _of_kind(component, place, kind == GAS)
            yield from _of_warmth(component, place, kind == GAS, fluid in warm)


def _touched(component: Any, nodes: Mapping[str, Any], kinds: Mapping[str, str]) -> dict[str, str]:
    """The fluid of each node that a component is, or is connected to; what cannot be told is left out."""
    ports = entry(component, "ports")
    connected = [node for node in ports.values() if isinstance(node, str)] if isinstance(ports, Mapping) else []
    made = {node: component for node, maker in nodes.items() if maker is component}
    found = {node: nodes[node] for node in connected if node in nodes} | made
    only = next(iter(kinds)) if len(kinds) == 1 else None
    fluids = {node: entry(maker, "fluid") or only for node, maker in found.items() if _holds_fluid(maker)}
    return {node: fluid for node, fluid in fluids.items() if isinstance(fluid, str) and fluid in kinds}


def _holds_fluid(maker: Any) -> bool:
    kind = record_of(entry(maker, "type"))
    return kind is not None and "fluid" in kind.model_fields


def _of_kind(component: Any, place: Place, gas: bool) -> Faults:
    """What does not belong to liquids, or to gases."""
    type_ = str(entry(component, "type"))
    kind = record_of(type_)
    if kind is None:
        return
    name = f"{'an' if type_[0] in 'aeiou' else 'a'} {type_}"
    if gas and not kind.gases:
        known = ", ".join(f"`{word}`" for word, each in COMPONENTS.items() if each.record.gases)
        yield (*place, "type"), f"{name} is for liquids; circuits of gas know {known}"
        return
    if not gas and not kind.liquids:
        yield (*place, "type"), f"{name} is for gases; write a fluid such as `fluids: {{air: {{type: ideal-gas}}}}`"
        return
    for key in OF_LIQUIDS if gas else OF_GASES:
        if entry(component, key) is not None:
            yield (*place, key), f"`{key}` belongs to {'liquids' if gas else 'gases'}"
    rated = [(place, component), *(((*place, key), entry(component, key)) for key in ("cushion_A", "cushion_B"))]
    for where, rating in rated:
        if gas and entry(rating, "flow") is not None:
            yield (*where, "flow"), f"a flow at a difference of pressure is of liquids; gases have {RATED}"
        if not gas and entry(rating, "sonic_conductance") is not None:
            yield (
                (*where, "sonic_conductance"),
                "a sonic conductance is of gases; liquids have `flow` at `pressure_drop`",
            )


def _of_warmth(component: Any, place: Place, gas: bool, warm: bool) -> Faults:
    """What belongs to fluids whose temperature is a state."""
    own = WARM.get(str(entry(component, "type")), ())
    if not warm:
        for key in own:
            if entry(component, key) is not None:
                yield (*place, key), f"`{key}` belongs to a liquid whose temperature is a state; {HOW}"
    if WALLS not in own and not (gas or warm) and entry(component, WALLS) is not None:
        yield (*place, WALLS), f"`{WALLS}` belongs to gases, and to liquids whose temperature is a state; {HOW}"
