"""Connections and settings of circuits that are right by themselves and fit badly together: what is reversed, what leads nowhere, what one
setting makes of another one."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from functools import cached_property
from itertools import product
from typing import Any, Final

import numpy as np

from nivel.elements.circuits.accumulators import Accumulator
from nivel.elements.circuits.chambers import Actuator
from nivel.elements.circuits.check_valves import CheckValve, CounterbalanceValve
from nivel.elements.circuits.component import Component
from nivel.elements.circuits.directional_valves import DirectionalValve
from nivel.elements.circuits.load_sensing import LoadSensing
from nivel.elements.circuits.pilot_valves import PilotReducingValve
from nivel.elements.circuits.pressure_valves import Compensator, ReducingValve, ReliefValve
from nivel.elements.circuits.pumps import FlowSource, Pump
from nivel.elements.circuits.ranges import PUMP_DISPLACEMENT
from nivel.elements.circuits.rotary import RotaryMachine
from nivel.elements.circuits.sections import Section
from nivel.elements.circuits.spool_valves import SpoolValve
from nivel.elements.circuits.tanks import Reservoir, Tank, Volume
from nivel.errors import Finding
from nivel.lazy import Struct
from nivel.machine.laws.varying_value import Expression, Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.quantity import PlainVolume
from nivel.machine.units.tree import ExpressionError, Time, leaves
from nivel.machine.uses.hydraulic_uses import makers, ports_of

Said = Iterator[Finding]
LOW: Final = 6e5  # Pa; a tank of a constant pressure up to this one takes what returns
BAR, LITRE_PER_MINUTE = 1e5, 1e-3 / 60.0
FAR_BEYOND: Final = 3.0  # of a full command; less may be a gain that saturates
MOST_SIGNALS: Final = 4  # at the ends of whose ranges a command is tried
LARGEST: Final = PUMP_DISPLACEMENT.most * 1e-6 / (2.0 * math.pi)  # [m³/rad] of pumps that are built


class Circuit(Struct):
    """The components of a machine, and what meets at their nodes."""

    components: tuple[Component, ...]

    @cached_property
    def low(self) -> frozenset[str]:
        """Tanks of low pressure."""
        tanks = (each for each in self.components if isinstance(each, Tank | Reservoir))
        return frozenset(each.name for each in tanks if isinstance(each.pressure, float | int) and each.pressure <= LOW)

    @cached_property
    def pumped(self) -> dict[str, Component]:
        """The nodes into which pumps deliver."""
        return {each.ports[each.delivers]: each for each in self.components if each.delivers in each.ports}

    @cached_property
    def chambers(self) -> frozenset[str]:
        """The nodes that are chambers of actuators, or lines of motors."""
        out: set[str] = set()
        for each in self.components:
            if isinstance(each, Actuator):
                out |= {each.ports.get(chamber, f"{each.name}.{chamber}") for chamber in each.chambers}
            elif isinstance(each, RotaryMachine) and not isinstance(each, Pump):
                out |= {each.ports[port] for port in "AB" if port in each.ports}
        return frozenset(out)

    @cached_property
    def flowing(self) -> Counter[str]:
        """How many ports through which fluid flows meet at each node."""
        ports = ((each, port, node) for each in self.components for port, node in each.ports.items())
        return Counter(node for each, port, node in ports if port not in each.sensing)

    @cached_property
    def settings(self) -> dict[str, tuple[ReliefValve, float]]:
        """The lowest constant setting of a relief valve at each node, absolute at a tank of low pressure [Pa]."""
        out: dict[str, tuple[ReliefValve, float]] = {}
        for each in self.components:
            if isinstance(each, ReliefValve) and isinstance(each.opens_at, float | int):
                known = out.get(each.ports["P"])
                if known is None or each.opens_at < known[1]:
                    out[each.ports["P"]] = each, float(each.opens_at)
        return out


def circuit_remarks(components: tuple[Component, ...]) -> Said:
    """What fits badly together."""
    circuit = Circuit(components)
    for each in components:
        for remarks in (_reversed_pump, _reversed_valve, _leads_nowhere, _against_relief, _of_load_sensing):
            yield from remarks(circuit, each)


def _of(component: Component, key: str, message: str) -> Finding:
    """What fits badly at a component, or at this key of it."""
    return Finding(f"hydraulics.{component.name}.{key}".removesuffix("."), message)


def _swapped(a: str, b: str, component: Component) -> str:
    return f"{{{a}: {component.ports[b]}, {b}: {component.ports[a]}}}"


def _reversed_pump(circuit: Circuit, each: Component) -> Said:
    if not isinstance(each, Pump | FlowSource):
        return
    a, b = each.ports["A"], each.ports["B"]
    if b in circuit.low and a not in circuit.low:
        what = f"the pump is reversed: it takes fluid from `{a}` and delivers it into the tank `{b}`"
        yield _of(each, "", f"{what}; A is its suction side: write `ports: {_swapped('A', 'B', each)}`")
    elif a in circuit.low:
        key, example = ("speed", "1500 rpm") if isinstance(each, Pump) else ("flow", "40 L/min")
        given = getattr(each, key)
        if isinstance(given, float | int) and given < 0.0:
            what = f"the pump turns backwards and delivers into the tank `{a}`"
            yield _of(each, key, f"{what}: write `{key}` without a minus")
        if isinstance(given, float | int) and given == 0.0:
            yield _of(each, key, f"the pump stands still; write for example `{key}: {example}`")


def _reversed_valve(circuit: Circuit, each: Component) -> Said:
    ports = each.ports
    if isinstance(each, DirectionalValve | Section | SpoolValve) and "P" in ports and "T" in ports:
        if ports["P"] in circuit.low and ports["T"] not in circuit.low:
            what = f"P is connected to the tank `{ports['P']}` and T to `{ports['T']}`"
            yield _of(each, "", f"the valve is reversed: {what}; write {_swapped('P', 'T', each)} in its `ports`")
        tank = next((x for x in circuit.components if x.name == ports["T"]), None)
        if (
            isinstance(tank, Tank)
            and isinstance(tank.pressure, float | int)
            and tank.pressure > LOW
            and tank.fluid is None
        ):
            what = f"T leads to `{tank.name}`, which has {tank.pressure / BAR:.4g} bar; a return line has a tank of low"
            yield _of(each, "", f"{what} pressure: write `{{type: tank, pressure: 2 bar}}`")
    if isinstance(each, ReliefValve) and ports["P"] in circuit.low and ports["T"] not in circuit.low:
        what = f"it would open from the tank `{ports['P']}` to `{ports['T']}`"
        yield _of(each, "", f"the relief valve is reversed: {what}; write `ports: {_swapped('P', 'T', each)}`")
    if isinstance(each, CheckValve) and "X" not in ports and ports["B"] in circuit.pumped:
        behind = {*circuit.low, *circuit.pumped}
        what = f"it lets fluid pass from `{ports['A']}` to the pump line `{ports['B']}` alone"
        if ports["A"] not in behind:
            yield _of(each, "", f"the check valve is reversed: {what}; write `ports: {_swapped('A', 'B', each)}`")
    if isinstance(each, CounterbalanceValve) and ports["V"] in circuit.chambers and ports["L"] not in circuit.chambers:
        what = f"L is the side of the load, and `{ports['V']}` at V is a chamber"
        yield _of(each, "", f"the valve is reversed: {what}; write {_swapped('L', 'V', each)} in its `ports`")
    if isinstance(each, CounterbalanceValve) and ports["X"] == ports["L"]:
        advice = "connect X to the other side of the actuator, such as `X: lift.B`"
        yield _of(each, "", f"its pilot X is its own load L; {advice}")


def _leads_nowhere(circuit: Circuit, each: Component) -> Said:
    if isinstance(each, Volume) and circuit.flowing[each.name] == 1 and each.start is None:
        other = next(
            x for x in circuit.components if each.name in {n for p, n in x.ports.items() if p not in x.sensing}
        )
        if isinstance(other, Actuator):
            return
        what = f"`{other.name}` alone is connected to the volume `{each.name}`, which leads nowhere"
        yield _of(each, "", f"{what}; name `{each.name}` in the `ports` of a second component")


def _against_relief(circuit: Circuit, each: Component) -> Said:
    if isinstance(each, Pump | FlowSource) and each.ports["B"] in circuit.settings:
        relief, setting = circuit.settings[each.ports["B"]]
        # the pump itself is remarked on
        given = 0.0 if isinstance(each, Pump) and each.displacement > LARGEST else _flow_of(each)
        passes = relief.conductance * math.sqrt(setting + relief.opening_range)
        if given > 1.05 * passes > 0.0:
            rated = f"flow: {math.ceil(given / LITRE_PER_MINUTE * 1.2)} L/min, pressure_drop: {setting / BAR:.4g} bar"
            what = f"it passes {passes / LITRE_PER_MINUTE:.3g} L/min where it is wholly open"
            yield _of(
                relief,
                "flow",
                f"{what}, and `{each.name}` delivers {given / LITRE_PER_MINUTE:.3g} L/min: the pressure rises beyond its "
                f"setting; write for example `{rated}`",
            )
        if isinstance(each, Pump) and each.cut_off is not None and each.cut_off >= setting:
            yield _of(
                each,
                "cut_off",
                f"`{relief.name}` opens at {setting / BAR:.4g} bar, before the `cut_off` of {each.cut_off / BAR:.4g} bar; "
                f"write for example `cut_off: {0.9 * setting / BAR:.4g} bar`",
            )
    if isinstance(each, Accumulator) and each.ports["A"] in circuit.settings:
        relief, setting = circuit.settings[each.ports["A"]]
        if each.precharge >= setting:
            yield _of(
                each,
                "precharge",
                f"`{relief.name}` opens at {setting / BAR:.4g} bar, below the precharge of {each.precharge / BAR:.4g} bar: it stays "
                f"empty; write for example `precharge: {0.6 * setting / BAR:.4g} bar`",
            )
    if isinstance(each, ReducingValve | PilotReducingValve) and each.ports["P"] in circuit.settings:
        relief, setting = circuit.settings[each.ports["P"]]
        if isinstance(each.pressure, float | int) and each.pressure >= setting:
            yield _of(
                each,
                "pressure",
                f"`{relief.name}` keeps P below {setting / BAR:.4g} bar, and it would reduce to {each.pressure / BAR:.4g} bar: it is "
                f"always open; write for example `pressure: {0.5 * setting / BAR:.4g} bar`",
            )


def _flow_of(each: Pump | FlowSource) -> float:
    """[m³/s] of a pump at a constant speed; 0 where it varies."""
    if isinstance(each, FlowSource):
        return float(each.flow) if isinstance(each.flow, float | int) else 0.0
    setting = each.setting if isinstance(each.setting, float | int) else 1.0
    return each.displacement * each.speed * setting if isinstance(each.speed, float | int) else 0.0


def _of_load_sensing(circuit: Circuit, each: Component) -> Said:
    if isinstance(each, LoadSensing):
        if not any(each.name in other.ports.values() for other in circuit.components):
            advice = f"name it in the `ports` of a pump or a compensator: `LS: {each.name}`"
            yield _of(each, "", f"nothing reads this signal; {advice}")
        heard = set(each.valves)
        pumps = [x for x in circuit.components if isinstance(x, Pump) and x.ports.get("LS") == each.name]
        lines = {pump.ports["B"] for pump in pumps}
        behind = {x.ports["A"] for x in circuit.components if isinstance(x, Compensator) and x.ports["P"] in lines}
        for valve in circuit.components:
            if not isinstance(valve, DirectionalValve | Section) or valve.name in heard:
                continue
            if valve.ports.get("P") in lines | behind and {"A", "B", "T"} <= {*valve.ports}:
                said = ", ".join([*each.valves, valve.name])
                what = f"takes from the line of the load-sensing pump, and `{each.name}` does not know its load"
                yield _of(valve, "", f"it {what}; write `valves: [{said}]` there")
    if isinstance(each, Pump) and each.margin is not None:
        for other in circuit.components:
            holds = isinstance(other, Compensator) or (isinstance(other, Section) and other.compensation == "pre")
            if not holds or other.ports.get("LS") != each.ports.get("LS") or getattr(other, "saturation_share", None):
                continue
            margin = other.margin  # type: ignore[attr-defined]
            if isinstance(margin, float | int) and margin >= each.margin:
                yield _of(
                    other,
                    "margin",
                    f"the pump stands {each.margin / BAR:.4g} bar above LS, and the compensator would hold {margin / BAR:.4g} bar of "
                    f"it: it is always open; write for example `margin: {0.4 * each.margin / BAR:.3g} bar`",
                )


def volume_remarks(machine: MachineRecord) -> Said:
    """Displacements per angle, volumes that nothing fills, and commands far beyond the full one."""
    yield from _of_volumes(machine)
    yield from _unfillable(machine)
    yield from _of_commands(machine)


def _of_commands(machine: MachineRecord) -> Said:
    """Commands of valves that are of the size of percents."""
    ranges = {f"{each.name}.value": each.range for each in machine.inputs}
    limits = {f"{block.name}.value": getattr(block, "limits", None) for block in machine.control}
    ranges |= {path: ends for path, ends in limits.items() if ends}
    for component in machine.hydraulics:
        command = getattr(component, "command", None)
        largest = _largest_of(command, ranges, machine.simulation.duration or 1.0)
        if FAR_BEYOND < largest < math.inf:
            text = command.text if isinstance(command, Expression) else "…"
            message = f"a command of 1 is the full one, and this reaches {largest:.4g}: percent? Write `command: ({text})/100`"
            yield _of(component, "command", message)


def _largest_of(command: Any, ranges: Mapping[str, tuple[float, float]], duration: float) -> float:
    """The largest magnitude that a function reaches over a run at the ends of these ranges; 0 where it depends on other signals."""
    if isinstance(command, Table):
        return max(map(abs, command.values))
    if (
        not isinstance(command, Expression)
        or len(command.signals) > MOST_SIGNALS
        or not ranges.keys() >= {*command.signals}
    ):
        return 0.0
    times = np.linspace(0.0, duration, 201 if Time() in leaves(command.tree) else 1).tolist()
    largest = 0.0
    for ends in product(*(ranges[path] for path in command.signals)):
        known = dict(zip(command.signals, ends, strict=True))
        for time in times:
            with suppress(ExpressionError):  # where it has no value
                largest = max(largest, abs(command(time, known)))
    return largest


def _of_volumes(machine: MachineRecord) -> Said:
    """Displacements of pumps and motors that were given as volumes: per radian they are 2π times those per turn."""
    for component in machine.hydraulics:
        volume = getattr(component, "displacement", None)
        if isinstance(component, RotaryMachine) and isinstance(volume, PlainVolume):
            size, per_turn = f"{volume * 1e6:.6g} cm^3", f"{volume * 2e6 * math.pi:.4g} cm^3/rev"
            message = (
                f"`displacement` is a volume per angle: `{size}` counts as {size}/rad, which is {per_turn}; catalogues state it per turn: "
                f"write `displacement: {size}/rev`, or `{size}/rad` where that is meant"
            )
            yield _of(component, "displacement", message)


def _unfillable(machine: MachineRecord) -> Said:
    """Chambers and volumes of liquid into which nothing can flow, and whose pressure is not given."""
    gases = {fluid.name for fluid in machine.fluids if fluid.type == "ideal-gas"}
    only_gas = len(gases) == len(machine.fluids) == 1
    filled = _filled(machine.hydraulics)
    for node, maker in makers(machine.hydraulics).items():
        if node in filled or not isinstance(maker, Volume | Actuator):
            continue
        chamber = node.rpartition(".")[2]
        start = maker.start if isinstance(maker, Volume) else getattr(maker, f"start_{chamber}")
        if start is not None or (only_gas if maker.fluid is None else maker.fluid in gases):
            continue  # filled by hand, or a spring
        which = "it" if isinstance(maker, Volume) else f"its chamber {chamber}"
        advice = f"name `{node}` in the `ports` of a component through which fluid comes to it"
        message = f"nothing can flow into {which}, which stays as full as it is at the start; {advice}"
        yield _of(maker, "", message)


def _filled(components: Iterable[Component]) -> set[str]:
    """Nodes into which fluid can flow: through a component, or from a second chamber that is part of the same volume."""
    inlets = [ports_of(each)[port] for each in components for port in each.inlets if port in ports_of(each)]
    parts = Counter(node for each in components if isinstance(each, Actuator) for node in ports_of(each).values())
    return {*inlets, *(node for node, count in parts.items() if count > 1)}
