"""Signals of a component that expressions, sensors and results can read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from nivel.machine.core.record import entry
from nivel.machine.hydraulics import COMPONENT_OF
from nivel.machine.hydraulics.directional import EDGES, centre_pairs


def signals_of(component: Any) -> tuple[str, ...]:
    """Names of the quantities of a component, a record or raw data: `pressure`, `flow_PA`, …"""
    kind = COMPONENT_OF.get(str(entry(component, "type")))
    if kind is None:
        return ()
    if entry(component, "type") == "directional-valve":
        ways, centre = str(entry(component, "ways")), str(entry(component, "centre") or "closed")
        pairs = [edge for edges in EDGES.get(ways, ()) for edge in edges]
        pairs += [edge for edge in centre_pairs(ways, centre) if edge not in pairs]
        return ("position", *(f"flow_{pair}" for pair in pairs))
    ports = entry(component, "ports")
    if entry(component, "type") == "reducing-valve" and not (isinstance(ports, Mapping) and "T" in ports):
        return tuple(each for each in kind.late if each != "relief_flow")
    single = entry(component, "acting") == "single" or entry(component, "type") == "telescopic-cylinder"
    return tuple(each for each in (*kind.early, *kind.late) if not (single and each == "pressure_B"))
