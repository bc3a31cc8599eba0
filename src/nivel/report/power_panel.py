"""Power flow of the circuit of a run, as the report draws it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from nivel.looks.circuit.power_flow import PowerFlow, power_diagram, power_flow
from nivel.results.frames.circuit_balance import ComponentBalance
from nivel.results.result import Result

TOTALS = ("supplied", "lost", "delivered")


def power_picture(result: Result, record: Mapping[str, Any], balances: Sequence[ComponentBalance]) -> str:
    """SVG of the power flow over the run; empty without a circuit through which energy flows."""
    flow = circuit_power(result, record, balances)
    return "" if flow is None else power_diagram(flow)


def circuit_power(result: Result, record: Mapping[str, Any], balances: Sequence[ComponentBalance]) -> PowerFlow | None:
    """What goes into the circuit of a run and comes out of it; None without a circuit, and for a run without a duration."""
    names = {each: f"state.hydraulics.{each}" for each in TOTALS} | {"stored": "hydraulics.stored"}
    if len(result.time) < 2 or any(name not in result.variables for name in names.values()):
        return None
    ends = {key: np.ravel(result.array(name)) for key, name in names.items()}
    totals = {key: float(values[-1] - values[0]) for key, values in ends.items()}
    if not np.all(np.isfinite(list(totals.values()))):
        return None
    components = record.get("hydraulics") or ()
    engines = {str(each["name"]): str(each["engine"]) for each in components if each.get("engine")}
    duration = float(result.time[-1] - result.time[0])
    return power_flow([asdict(each) for each in balances], totals, engines, duration)
