"""Cylinders and rotary actuators in numbers; their chambers and pistons are those of `nivel.system.hydraulics.nodes`."""

from __future__ import annotations

from nivel.kernels.hydraulics import piston, restriction, spool
from nivel.machine.hydraulics import HydraulicCylinder, RotaryActuator, TelescopicCylinder
from nivel.system.builder import SystemBuilder
from nivel.system.hydraulics import symbols
from nivel.system.hydraulics.kind import ComponentKind
from nivel.system.hydraulics.nodes import chamber_node, chamber_nodes
from nivel.system.hydraulics.restrictions import TRANSITION, add_flow, add_poppet, rated

# difference of pressure at which the check valve beside a cushion opens, and from there to fully open [Pa]
CHECK, CHECK_OF_GAS = (0.5e5, 3e5), (0.05e5, 0.2e5)
OF_PISTONS = (piston.displace, piston.guide, piston.press)


def add_seal(builder: SystemBuilder, component: HydraulicCylinder | RotaryActuator) -> None:
    """The leak past a piston or vane."""
    if component.seal_leakage:
        inner = (chamber_node(component, "A"), chamber_node(component, "B"))
        add_flow(builder, component.name, "seal_flow", inner, [0.0, TRANSITION, component.seal_leakage])


def add_cylinder(builder: SystemBuilder, component: HydraulicCylinder) -> None:
    """The throttled outlets of a cylinder, each with a check valve beside it, and the leak past its piston."""
    add_seal(builder, component)
    for chamber in component.chambers:
        cushion = getattr(component, f"cushion_{chamber}")
        if cushion is None:
            continue
        inner, port = chamber_node(component, chamber), f"{component.name}.{chamber}"
        head = rated(cushion, 0.0)
        end, sign = (0.0, 1.0) if chamber == "A" else (component.stroke, -1.0)
        position, coupled = builder.circuit.signals[f"{component.name}.position"]
        builder.note(coupled)
        numbers = [*head, sign, end, cushion.length, 1.0, cushion.least_opening]
        add_flow(
            builder, component.name, f"cushion_flow_{chamber}", (inner, port), numbers, (restriction.CUSHION, position)
        )
        opens_at, opening_range = CHECK_OF_GAS if builder.circuit.nodes[inner].gas else CHECK
        numbers = (opening_range, 0.0, -1.0, 0.0)
        opening = add_poppet(builder, component.name, f"check_{chamber}", {port: 1.0, inner: -1.0}, numbers, opens_at)
        add_flow(builder, component.name, f"check_flow_{chamber}", (port, inner), head, opening)


KINDS = (
    ComponentKind(
        HydraulicCylinder,
        add_cylinder,
        (*OF_PISTONS, spool.lift, restriction.apply),
        symbols.cylinder,
        chamber_nodes,
    ),
    ComponentKind(TelescopicCylinder, None, OF_PISTONS, symbols.telescope, chamber_nodes),
    ComponentKind(RotaryActuator, add_seal, (*OF_PISTONS, restriction.apply), symbols.rotary, chamber_nodes),
)
