"""Connections of hydraulic circuits: each leads somewhere; and their fluids: one for each, gases where gas may flow. Reads raw data too:
one fault hides no other."""

from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any, Final

from nivel.elements.circuits import COMPONENTS, record_of
from nivel.elements.circuits.chambers import SINGLE, Actuator
from nivel.elements.circuits.component import SENSING, Component
from nivel.machine.core.index import Index, Place, as_list, elements
from nivel.machine.core.record import entry
from nivel.machine.laws.symbols import paths_in, symbol_faults
from nivel.machine.units.tree import Parameters
from nivel.machine.uses.coordinate_reference import UnknownCoordinateError, find, unknown_name

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


SIGNAL: Final = "load-sensing"
MOST_PUMPS: Final = 8  # of an engine
BOUNDING: Final = ("margin", "cut_off_curve")  # with these the pressure sets the displacement of a pump


def hydraulic_faults(machine: Any, index: Index, parameters: Parameters) -> Faults:
    """Place and message of everything that is wrong."""
    components = elements(machine, "hydraulics")
    nodes = node_types(components)
    used: set[str] = set()
    for at, component in enumerate(components):
        place: Place = ("hydraulics", at)
        kind = record_of(entry(component, "type"))
        yield from _of_ports(component, nodes, used, place)
        yield from _of_fluid(component, index, place)
        yield from _of_signal(component, index, used, place)
        yield from _of_angle(component, index, place)
        yield from _of_engine(component, index, place)
        if kind is not None:
            yield from symbol_faults(component, place, index, parameters, kind.functions)
            yield from _late(component, kind.functions, index, parameters, place)
    for at, component in enumerate(components):
        yield from _unconnected(component, used, ("hydraulics", at))
    yield from _unrelieved(components, nodes)
    yield from fluid_faults(machine, makers(components))


def with_named_nodes(data: Any) -> Any:
    """`data` of a machine in which a node that two components name, and that none of them makes, is a volume of the usual size.

    One name alone may be a slip, and of several fluids none is known: these stay faults. So does what valves return to and pumps draw
    from, which is a tank.
    """
    components = elements(data, "hydraulics") if isinstance(data, Mapping) else []
    if not isinstance(entry(data, "hydraulics"), list | tuple) or len(elements(data, "fluids")) > 1:
        return data
    known = {*node_types(components), *(str(entry(each, "name")) for each in components)}
    named: Counter[str] = Counter()
    for component in components:
        sensing = (record_of(str(entry(component, "type"))) or Component).sensing
        named.update({node for port, node in ports_of(component).items() if port not in sensing})
    known |= _tanks_meant(components)
    met = [node for node, count in named.items() if count > 1 and node not in known and node.isidentifier()]
    return {**data, "hydraulics": [*components, *({"name": node, "type": "volume"} for node in met)]} if met else data


def _tanks_meant(components: Any) -> set[str]:
    """What valves return to and pumps draw from."""
    ports = [(str(entry(each, "type")), ports_of(each)) for each in components]
    drawn = {its["A"] for type_, its in ports if type_ == "pump" and "A" in its}
    return drawn & {its["T"] for _, its in ports if "T" in its}


def node_types(components: Any) -> dict[str, str]:
    """The nodes of a circuit: name → type of the component that makes it."""
    out: dict[str, str] = {}
    for component in components:
        name, type_ = entry(component, "name"), str(entry(component, "type"))
        if not isinstance(name, str) or type_ not in COMPONENTS:
            continue
        ports = ports_of(component)
        single = entry(component, "acting") in SINGLE
        for node in COMPONENTS[type_].record.nodes_in(component):
            attached = node[1:] in ports and _has_chambers(type_)
            if not attached and not (single and node == ".B"):
                out[f"{name}{node}"] = type_
    return out


def _has_chambers(type_: str) -> bool:
    return type_ in COMPONENTS and issubclass(COMPONENTS[type_].record, Actuator)


def makers(components: Any) -> dict[str, Any]:
    """The component that makes each node."""
    return {node: component for component in components for node in node_types([component])}


def ports_of(component: Any) -> Mapping[str, str]:
    """The connections of a component, as far as they make sense."""
    ports = entry(component, "ports")
    return {k: v for k, v in ports.items() if isinstance(v, str)} if isinstance(ports, Mapping) else {}


def _of_ports(component: Any, nodes: Mapping[str, str], used: set[str], place: Place) -> Faults:
    type_ = str(entry(component, "type"))
    seen: dict[str, str] = {}
    sensing = (record_of(type_) or Component).sensing
    for port, node in ports_of(component).items():
        where = (*place, "ports", port)
        if port not in sensing or nodes.get(node) != "volume":  # a tank may be felt alone
            used.add(node)
        if node not in nodes:
            whole = [each for each in nodes if each.startswith(f"{node}.")]
            hint = f"; a chamber of it is needed: {' or '.join(f'`{each}`' for each in whole)}" if whole else ""
            said = f"`{node}` is no node of the circuit{hint}" if hint else unknown_name("node", node, tuple(nodes))
            if "did you mean" not in said and node.isidentifier():
                is_tank = port == "T" or ((type_, port) == ("pump", "A") and "tank" not in nodes.values())
                meant = "{type: tank}" if is_tank else "{type: volume, volume: 0.2 L}"
                said += f"; {'for a tank' if is_tank else 'where components meet,'} add `{node}: {meant}`"
            yield where, said
        elif nodes[node] == SIGNAL and port not in sensing:
            yield where, f"`{node}` is a signal, into which nothing flows; a port {' or '.join(SENSING)} may read it"
        elif _has_chambers(type_) and nodes[node] != "volume":
            yield where, f"a chamber is part of a volume, and `{node}` is a {nodes[node]}"
        elif port not in sensing:
            seen[port] = node
    if len(seen) > 1 and len(set(seen.values())) == 1 and not _has_chambers(type_):
        node = next(iter(seen.values()))
        yield (*place, "ports"), f"ports {' and '.join(seen)} are all connected to `{node}`: nothing would flow"


def _of_fluid(component: Any, index: Index, place: Place) -> Faults:
    type_ = record_of(entry(component, "type"))
    if type_ is None or "fluid" not in type_.model_fields:
        return
    fluid = entry(component, "fluid")
    if isinstance(fluid, str) and fluid not in index.fluids:
        yield (*place, "fluid"), unknown_name("fluid", fluid, index.fluids)
    if fluid is None and len(index.fluids) > 1:
        yield place, f"`fluid` is missing: there are {', '.join(f'`{each}`' for each in index.fluids)}"


def _of_signal(component: Any, index: Index, used: set[str], place: Place) -> Faults:
    """The valves whose loads a signal is made of."""
    for at, name in enumerate(as_list(entry(component, "valves"))):
        valve = index.hydraulics.get(name) if isinstance(name, str) else None
        if valve is None:
            known = [each for each, its in index.hydraulics.items() if _has_a_load(its)]
            yield (*place, "valves", at), unknown_name("valve", str(name), tuple(known))
        elif not _has_a_load(valve):
            yield (*place, "valves", at), f"`{name}` is no 4/3 directional valve or section, whose load could be sensed"
        else:
            used.update(ports_of(valve).values())


def _has_a_load(valve: Any) -> bool:
    """Whether a valve feeds A or B, one at a time, from P."""
    kind = record_of(entry(valve, "type"))
    if kind is None or not kind.loads:
        return False
    return kind.ports_in(valve) >= {"P", "T", "A", "B"}


def _of_angle(component: Any, index: Index, place: Place) -> Faults:
    """The coordinate of what turns is an angle."""
    reference = entry(component, "coordinate")
    if not isinstance(reference, str):
        return
    kind = "length" if entry(component, "edges") else "angle"
    try:
        find(reference, index.joints, kind)
    except UnknownCoordinateError:
        try:
            find(reference, index.joints)
        except UnknownCoordinateError:
            return  # reported as one that does not exist
        what = "an angle; a spool needs a length" if kind == "length" else "a length; what turns needs an angle"
        yield (*place, "coordinate"), f"`{reference}` is {what}"


def _of_engine(component: Any, index: Index, place: Place) -> Faults:
    name = entry(component, "engine")
    if isinstance(name, str) and entry(index.hydraulics.get(name), "type") != "engine":
        known = [each for each, its in index.hydraulics.items() if entry(its, "type") == "engine"]
        yield (*place, "engine"), unknown_name("engine", name, tuple(known))
    elif isinstance(name, str):
        turned = [each for each, its in index.hydraulics.items() if entry(its, "engine") == name]
        if entry(component, "name") in turned[MOST_PUMPS:]:
            yield (*place, "engine"), f"an engine turns up to {MOST_PUMPS} pumps, `{name}` already has as many"


def _late(component: Any, keys: tuple[str, ...], index: Index, parameters: Parameters, place: Place) -> Faults:
    """Signals of components that are known only after what a component is told."""
    for key in keys:
        for where, path in paths_in(entry(component, key), (*place, key), index, parameters):
            name, _, quantity = path.partition(".")
            kind = record_of(entry(index.hydraulics.get(name), "type"))
            if kind is not None and quantity in kind.late and name not in index.joints and name not in index.states:
                early = [f"`{name}.{each}`" for each in kind.early]
                hint = f"{' or '.join(early)}, or " if early else ""
                yield (
                    where,
                    f"`{path}` follows from the flows, and cannot steer them at once; use {hint}a state that follows it",
                )
            if entry(component, "type") == "tank" and (name in index.control or kind is not None):
                yield where, f"`{path}` follows from pressures, of which this is one; use a state that follows it"


def _unconnected(component: Any, used: set[str], place: Place) -> Faults:
    """Nodes that nothing is connected to: closed volumes without an outlet."""
    name, type_ = entry(component, "name"), str(entry(component, "type"))
    if not isinstance(name, str) or not (type_ in ("volume", "tank") or _has_chambers(type_)):
        return
    for node in node_types([component]):
        if node in used:
            continue
        if type_ == "volume":
            what = f"nothing flows into the volume `{node}` or out of it"
            yield place, f"{what}; name it in the `ports` of a component, at another port than {' or '.join(SENSING)}"
        elif type_ == "tank":
            yield place, f"nothing is connected to `{node}`; name it in the `ports` of a component"


def _unrelieved(components: Any, nodes: Mapping[str, str]) -> Faults:
    """Pumps of a fixed displacement behind which nothing bounds the pressure."""
    joined: dict[str, set[str]] = {}
    safe: set[str] = set()
    for component in components:
        kind, ports = (record_of(entry(component, "type")) or Component), ports_of(component)
        if kind.relieves in ports:
            safe.add(ports[kind.relieves])
        for a, b in kind.passes:
            if a in ports and b in ports:
                joined.setdefault(ports[a], set()).add(ports[b])
        if (
            entry(component, "coordinate") is not None and len(ports) > 1
        ):  # a spool, or a motor, that pressures may move
            for node in ports.values():
                joined.setdefault(node, set()).update(ports.values())
    tanks = [name for name, type_ in nodes.items() if type_ in ("tank", "reservoir")]
    tank = next(iter(tanks), "tank")
    for at, component in enumerate(components):
        kind, ports = (record_of(entry(component, "type")) or Component), ports_of(component)
        if kind.delivers not in ports or any(entry(component, key) is not None for key in BOUNDING):
            continue
        node = ports[kind.delivers]
        reached, front = {node}, [node]
        while front:
            front = [node for each in front for node in joined.get(each, ()) if node not in reached]
            reached.update(front)
        if node in nodes and not reached & safe.union(tanks):
            rating = "opens_at: 250 bar, opening_range: 25 bar, flow: 120 L/min, pressure_drop: 250 bar"
            line = f"safety: {{type: relief-valve, ports: {{P: {node}, T: {tank}}}, {rating}}}"
            behind = next((each for each in components if ports_of(each).get("A") == node and _delivers(each)), None)
            row = f", from which `{entry(behind, 'name')}` takes: of two pumps in a row the first may deliver more than the second"
            what = f"no relief valve bounds the pressure at `{node}`{row if behind is not None else ''}"
            yield ("hydraulics", at), f"{what}; add one such as `{line}`"


def _delivers(component: Any) -> bool:
    return bool((record_of(str(entry(component, "type"))) or Component).delivers)
