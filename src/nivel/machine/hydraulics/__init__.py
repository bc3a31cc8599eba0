"""Hydraulic circuits in words: fluids, and components by name, connected at nodes."""

from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema

from nivel.machine.given import Field
from nivel.machine.hydraulics.actuators import (
    Actuator,
    Cushion,
    HydraulicCylinder,
    PistonFriction,
    RotaryActuator,
    TelescopicCylinder,
)
from nivel.machine.hydraulics.component import Component
from nivel.machine.hydraulics.cooler import Cooler
from nivel.machine.hydraulics.directional import DirectionalValve
from nivel.machine.hydraulics.flow_valves import FlowControl, FlowDivider, PriorityValve, ShuttleValve
from nivel.machine.hydraulics.fluid import AnyFluid, Fluid, Gas
from nivel.machine.hydraulics.machines import Engine, FlowSource, HydraulicMotor, Pump
from nivel.machine.hydraulics.maps import HoseExpansion
from nivel.machine.hydraulics.nodes import Accumulator, LoadSensing, Reservoir, Tank, Volume
from nivel.machine.hydraulics.pneumatic_valves import Ejector, QuickExhaust, SoftStart
from nivel.machine.hydraulics.pressure_valves import (
    BrakeValve,
    CartridgeValve,
    CrossPortRelief,
    PilotReducingValve,
    PilotReliefValve,
    SequenceValve,
    UnloadingValve,
)
from nivel.machine.hydraulics.restrictions import Line, Orifice, Pipe, Tube
from nivel.machine.hydraulics.sections import Section
from nivel.machine.hydraulics.spool_valve import Edge, Notch, Solenoid, SpoolValve
from nivel.machine.hydraulics.switching import Switching
from nivel.machine.hydraulics.valves import (
    CheckValve,
    Compensator,
    CounterbalanceValve,
    ReducingValve,
    ReliefValve,
)

COMPONENTS: list[type[Component]] = [
    Volume,
    Tank,
    Reservoir,
    Accumulator,
    LoadSensing,
    Orifice,
    Pipe,
    Line,
    Cooler,
    Tube,
    CheckValve,
    ReliefValve,
    CounterbalanceValve,
    ReducingValve,
    Compensator,
    DirectionalValve,
    SpoolValve,
    Section,
    FlowControl,
    FlowDivider,
    PriorityValve,
    ShuttleValve,
    UnloadingValve,
    SequenceValve,
    PilotReliefValve,
    PilotReducingValve,
    CartridgeValve,
    CrossPortRelief,
    BrakeValve,
    QuickExhaust,
    SoftStart,
    Ejector,
    FlowSource,
    Engine,
    Pump,
    HydraulicMotor,
    HydraulicCylinder,
    TelescopicCylinder,
    RotaryActuator,
]
COMPONENT_OF: dict[str, type[Component]] = {
    component.model_fields["type"].default: component for component in COMPONENTS
}


class _AnyComponent:
    """A record of one of COMPONENTS, told apart by its `type`."""

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return handler.generate_schema(Annotated[reduce(or_, COMPONENTS), Field(discriminator="type")])


if TYPE_CHECKING:
    HydraulicComponent = Component
else:
    HydraulicComponent = _AnyComponent


def register(kind: type[Component]) -> None:
    """Add a kind of component. Machines know it from when their record is built anew (`MachineRecord.model_rebuild`)."""
    COMPONENTS.append(kind)
    COMPONENT_OF[kind.model_fields["type"].default] = kind


__all__ = [
    "COMPONENTS",
    "COMPONENT_OF",
    "Accumulator",
    "Actuator",
    "AnyFluid",
    "BrakeValve",
    "CartridgeValve",
    "CheckValve",
    "Compensator",
    "Component",
    "Cooler",
    "CounterbalanceValve",
    "CrossPortRelief",
    "Cushion",
    "DirectionalValve",
    "Edge",
    "Ejector",
    "Engine",
    "FlowControl",
    "FlowDivider",
    "FlowSource",
    "Fluid",
    "Gas",
    "HoseExpansion",
    "HydraulicComponent",
    "HydraulicCylinder",
    "HydraulicMotor",
    "Line",
    "LoadSensing",
    "Notch",
    "Orifice",
    "PilotReducingValve",
    "PilotReliefValve",
    "Pipe",
    "PistonFriction",
    "PriorityValve",
    "Pump",
    "QuickExhaust",
    "ReducingValve",
    "ReliefValve",
    "Reservoir",
    "RotaryActuator",
    "Section",
    "SequenceValve",
    "ShuttleValve",
    "SoftStart",
    "Solenoid",
    "SpoolValve",
    "Switching",
    "Tank",
    "TelescopicCylinder",
    "Tube",
    "UnloadingValve",
    "Volume",
    "register",
]
