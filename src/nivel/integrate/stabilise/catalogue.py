"""Stabilisation methods by name."""

from __future__ import annotations

from types import ModuleType

from nivel.integrate.stabilise import baumgarte, direct, geometric, none

STABILISATIONS: dict[str, ModuleType] = {"none": none, "baumgarte": baumgarte, "direct": direct, "geometric": geometric}
