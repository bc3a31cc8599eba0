"""Signals of a component that expressions, sensors and results can read."""

from __future__ import annotations

from typing import Any

from nivel.machine.core.record import entry
from nivel.machine.hydraulics import COMPONENT_OF


def signals_of(component: Any) -> tuple[str, ...]:
    """Names of the quantities of a component, a record or raw data: `pressure`, `flow_PA`, …"""
    kind = COMPONENT_OF.get(str(entry(component, "type")))
    return () if kind is None else kind.signals_in(component)
