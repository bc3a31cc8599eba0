"""Coolers in numbers."""

from __future__ import annotations

from nivel.kernels.hydraulics import cooler, restriction
from nivel.machine.hydraulics import Cooler
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.restrictions import add_flow, rated


def add_cooler(builder: SystemBuilder, component: Cooler) -> None:
    """The flow through a cooler, and the heat that it takes."""
    ends = component.ports["A"], component.ports["B"]
    add_flow(builder, component.name, "flow", ends, rated(component, 0.0))
    flow = len(builder.outputs.entries) - 1
    first = builder.outputs.add((f"hydraulics.{component.name}.heat", "W", f"heat that {component.name} takes"))
    functions = [builder.function(component.heat_conductance), builder.function(component.coolant_temperature)]
    columns = [first, builder.node(ends[0]), builder.node(ends[1]), flow, *functions]
    builder.elements.add(cooler.apply, columns)


KINDS = (ComponentKind(Cooler, add_cooler, (restriction.apply, cooler.apply), symbols.cooler),)
