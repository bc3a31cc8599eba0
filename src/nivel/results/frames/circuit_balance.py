"""Balance of the components of a circuit over a run: the largest flow and difference of pressure of each, and the energy that it takes,
gives and loses.

Losses are ∫ Σ Q Δp dt of all edges of a component, of gas those of its available energy at the temperature around it, of pumps and motors
∫ (P - Q Δp) dt with the power P into the shaft. The exact losses, with the energy that fluid stores as it is compressed, are those of the
trust report.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.elements.circuits.fluids import ATMOSPHERE, REFERENCE_PRESSURE
from nivel.elements.circuits.spool_valves import ends_of
from nivel.lazy import Struct
from nivel.results.scales import Readable

START: Final = "hydraulics."
# ports that the flows of components go from and to, where their names do not say; "" is the component itself, M, N, C, X, Y nodes within it
ENDS: Final[dict[str, dict[str, tuple[str, str]]]] = {
    "orifice": {"flow": ("A", "B")},
    "pipe": {"flow": ("A", "B")},
    "cooler": {"flow": ("A", "B")},
    "accumulator": {"flow": ("A", "")},
    "check-valve": {"flow": ("A", "B")},
    "relief-valve": {"flow": ("P", "T")},
    "unloading-valve": {"flow": ("P", "T")},
    "sequence-valve": {"flow": ("P", "A"), "check_flow": ("A", "P")},
    "reducing-valve": {"flow": ("P", "A"), "relief_flow": ("A", "T")},
    "compensator": {"flow": ("P", "A")},
    "counterbalance-valve": {
        "flow": ("L", "V"),
        "check_flow": ("V", "L"),
        "pilot_flow": ("X", "Y"),
        "drain_flow": ("Y", "V"),
    },
    "cartridge-valve": {"flow": ("A", "B")},
    "shuttle-valve": {"flow_A": ("A", "C"), "flow_B": ("B", "C")},
    "flushing-valve": {"flow_A": ("A", "C"), "flow_B": ("B", "C")},
    "priority-valve": {"flow_CF": ("P", "CF"), "flow_EF": ("P", "EF")},
    "flow-divider": {
        "orifice_flow_A": ("P", "M"),
        "orifice_flow_B": ("P", "N"),
        "flow_A": ("M", "A"),
        "flow_B": ("N", "B"),
    },
    "flow-control": {
        "flow": ("M", "A"),
        "compensator_flow": ("P", "M"),
        "bypass_flow": ("P", "T"),
        "check_flow": ("A", "P"),
    },
    "pilot-relief-valve": {"flow": ("P", "T"), "orifice_flow": ("P", "X"), "pilot_flow": ("X", "T")},
    "pilot-reducing-valve": {"flow": ("P", "A"), "orifice_flow": ("A", "X"), "pilot_flow": ("X", "T")},
    "brake-valve": {
        "flow_A": ("A", "VA"),
        "flow_B": ("B", "VB"),
        "check_flow_A": ("VA", "A"),
        "check_flow_B": ("VB", "B"),
    },
    "section": {"flow_PM_back": ("P", "M")},
    "ejector": {"flow": ("P", "R"), "suction_flow": ("A", "R")},
    "soft-start": {"flow": ("P", "A"), "throttled_flow": ("P", "A")},
    "tube": {"flow_B": ("A", "B")},
    "pump": {"flow": ("A", "B")},
    "hydraulic-motor": {"flow": ("A", "B")},
    "flow-source": {"flow": ("A", "B")},
}
DRIVEN: Final = ("pump", "hydraulic-motor", "flow-source")
INNER: Final = ("M", "N", "C", "R", "X", "Y")


class ComponentBalance(Struct):
    """Of one component: the largest flow [m³/s] and difference of pressure [Pa], both without their signs, and over the run the energies
    [J] that it takes from a shaft, that it gives to bodies, and that it loses."""

    name: str
    type: str
    flow: float
    difference: float
    supplied: float
    delivered: float
    lost: float


def component_balances(result: Readable, record: Mapping[str, Any]) -> list[ComponentBalance]:
    """Of all components through which fluid flows or that move something, those that lose most first; record : of the machine, as JSON."""
    time = np.asarray(result.time, dtype=float)
    if len(time) < 2:
        return []
    found = (_of(result, time, data) for data in record.get("hydraulics") or ())
    return sorted((each for each in found if each is not None), key=lambda each: -each.lost)


def _of(result: Readable, time: NDArray[np.float64], data: Mapping[str, Any]) -> ComponentBalance | None:
    name, kind = str(data["name"]), str(data["type"])
    edges = list(_edges(result, data))
    power = _history(result, f"{START}{name}.power")
    if not edges and power is None:
        return None
    flow = max((float(np.max(np.abs(flow))) for flow, _ in edges), default=0.0)
    difference = max((float(np.max(np.abs(drop))) for _, drop in edges), default=0.0)
    throttled = sum((flow * drop for flow, drop in edges), np.zeros(len(time)))
    lost, supplied, delivered = throttled, np.zeros(len(time)), np.zeros(len(time))
    if kind in DRIVEN and power is not None:
        lost = power + throttled  # fluid goes from A to B against the pressure
        supplied, delivered = np.maximum(power, 0.0), np.maximum(-power, 0.0)
    elif kind == "engine" and power is not None:
        supplied = power
    elif power is not None:
        delivered = power
        flow, difference = _of_piston(result, data)
    energies = (float(np.trapezoid(each, time)) for each in (supplied, delivered, lost))
    return ComponentBalance(name, kind, flow, difference, *energies)


def _of_piston(result: Readable, data: Mapping[str, Any]) -> tuple[float, float]:
    """The largest flow into the side A of an actuator [m³/s], and the largest difference of pressure of its sides, or of A and the air."""
    name = str(data["name"])
    speed = _history(result, f"{START}{name}.speed")
    sides = {"name": name, "ports": {side: f"{name}.{side}" for side in "AB"} | (data.get("ports") or {})}
    a, b = (_pressure(result, sides, side) for side in "AB")
    diameter = data.get("piston") or next(iter(data.get("stages") or ()), 0.0)
    area = data.get("displacement") or 0.25 * math.pi * float(diameter) ** 2
    flow = 0.0 if speed is None else float(area) * float(np.max(np.abs(speed)))
    difference = 0.0 if a is None else float(np.max(np.abs(a - (ATMOSPHERE if b is None else b))))
    return flow, difference


def _edges(result: Readable, data: Mapping[str, Any]) -> Iterator[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """(flow [m³/s], difference of pressure [Pa]) over time of every edge; of gas what stands for that difference in its loss."""
    name, kind = str(data["name"]), str(data["type"])
    # flows of gas [m³/s] are those at 1 bar, and lose ṁ R T₀ ln(p_a/p_b) of their available energy
    known, gas = ENDS.get(kind, {}), data.get("sonic_conductance") is not None or kind == "tube"
    for variable in result.variables:
        if not variable.startswith(f"{START}{name}."):
            continue
        quantity = variable.rpartition(".")[2]
        ends = known.get(quantity) or _named(quantity, data)
        if ends is None:
            continue
        flow = _history(result, variable)
        a, b = (_pressure(result, data, port) for port in ends)
        if flow is not None and a is not None and b is not None:
            yield flow, REFERENCE_PRESSURE * np.log(a / b) if gas else a - b


def _named(quantity: str, data: Mapping[str, Any]) -> tuple[str, str] | None:
    """The ends of `flow_PA`, `centre_flow_PT`, `float_flow_BT` and the like."""
    _, flows, pair = quantity.rpartition("flow_")
    if not flows:
        if quantity == "compensator_flow" and data.get("type") == "section":
            return ("P", "M") if data.get("compensation") == "pre" else ("M", "C")
        return None
    return ends_of(pair) or ((pair[0], pair[1]) if len(pair) == 2 else None)


def _pressure(result: Readable, data: Mapping[str, Any], port: str) -> NDArray[np.float64] | None:
    """Pressure at a port, or in a node within the component; P in place of an M that a valve of three ways does not have."""
    name, ports = str(data["name"]), data.get("ports") or {}
    if port == "":
        return _history(result, f"{START}{name}.pressure")
    node = ports.get(port)
    if node is None and port in INNER:
        inner = _history(result, f"{START}{name}.pressure_{port}")
        return inner if inner is not None else _pressure(result, data, "P") if "P" in ports else None
    if node is None:
        return None
    owner, _, chamber = str(node).partition(".")
    if not chamber:
        return _history(result, f"{START}{owner}.pressure")
    behind_cushion = _history(result, f"{START}{owner}.pressure_port_{chamber}")
    return behind_cushion if behind_cushion is not None else _history(result, f"{START}{owner}.pressure_{chamber}")


def _history(result: Readable, name: str) -> NDArray[np.float64] | None:
    return np.asarray(result.array(name), dtype=float).ravel() if name in result.variables else None


def pressures_at(result: Readable, frame: int) -> dict[str, float]:
    """Pressures of circuits [Pa] in one frame, by the name of the variable."""
    names = [name for name in result.variables if name.startswith("hydraulics.") and ".pressure" in name]
    return {name: float(np.asarray(result.array(name), dtype=float).ravel()[frame]) for name in names}
