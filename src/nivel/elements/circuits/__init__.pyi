# Written by `python packaging/write_settings.py` from the records. Do not edit.
# fmt: off
# ruff: noqa
# pyright: reportOptionalMemberAccess=false
"""Components of hydraulic and pneumatic circuits, a file for each family of kinds."""

from typing import TYPE_CHECKING, Annotated, Any

from nivel.elements.kind import Kinds, OneOf
from nivel.known import Component, ComponentKind

COMPONENTS: Kinds[ComponentKind] = Kinds(__name__, noun="component")

if TYPE_CHECKING:
    HydraulicComponent = Component
else:
    HydraulicComponent = Annotated[Any, OneOf(COMPONENTS)]


def record_of(word: object) -> type[Component] | None:
    """The record of components of a type; None where there are none."""
    kind = COMPONENTS.get(str(word))
    return None if kind is None else kind.record

from nivel.elements.circuits.accumulators import Accumulator as Accumulator
from nivel.elements.circuits.actuators import HydraulicCylinder as HydraulicCylinder
from nivel.elements.circuits.actuators import RotaryActuator as RotaryActuator
from nivel.elements.circuits.actuators import TelescopicCylinder as TelescopicCylinder
from nivel.elements.circuits.check_valves import BrakeValve as BrakeValve
from nivel.elements.circuits.check_valves import CheckValve as CheckValve
from nivel.elements.circuits.check_valves import CounterbalanceValve as CounterbalanceValve
from nivel.elements.circuits.check_valves import FlushingValve as FlushingValve
from nivel.elements.circuits.check_valves import QuickExhaust as QuickExhaust
from nivel.elements.circuits.check_valves import ShuttleValve as ShuttleValve
from nivel.elements.circuits.coolers import Cooler as Cooler
from nivel.elements.circuits.directional_valves import DirectionalValve as DirectionalValve
from nivel.elements.circuits.ejectors import Ejector as Ejector
from nivel.elements.circuits.engines import Engine as Engine
from nivel.elements.circuits.flow_valves import FlowControl as FlowControl
from nivel.elements.circuits.flow_valves import FlowDivider as FlowDivider
from nivel.elements.circuits.flow_valves import PriorityValve as PriorityValve
from nivel.elements.circuits.fluids import Fluid as Fluid
from nivel.elements.circuits.fluids import Gas as Gas
from nivel.elements.circuits.lines import Line as Line
from nivel.elements.circuits.lines import Pipe as Pipe
from nivel.elements.circuits.load_sensing import LoadSensing as LoadSensing
from nivel.elements.circuits.pilot_valves import CartridgeValve as CartridgeValve
from nivel.elements.circuits.pilot_valves import PilotReducingValve as PilotReducingValve
from nivel.elements.circuits.pilot_valves import PilotReliefValve as PilotReliefValve
from nivel.elements.circuits.pressure_valves import Compensator as Compensator
from nivel.elements.circuits.pressure_valves import CrossPortRelief as CrossPortRelief
from nivel.elements.circuits.pressure_valves import ReducingValve as ReducingValve
from nivel.elements.circuits.pressure_valves import ReliefValve as ReliefValve
from nivel.elements.circuits.pressure_valves import SequenceValve as SequenceValve
from nivel.elements.circuits.pressure_valves import SoftStart as SoftStart
from nivel.elements.circuits.pressure_valves import UnloadingValve as UnloadingValve
from nivel.elements.circuits.pumps import FlowSource as FlowSource
from nivel.elements.circuits.pumps import HydraulicMotor as HydraulicMotor
from nivel.elements.circuits.pumps import Pump as Pump
from nivel.elements.circuits.restrictions import Orifice as Orifice
from nivel.elements.circuits.sections import Section as Section
from nivel.elements.circuits.spool_valves import SpoolValve as SpoolValve
from nivel.elements.circuits.tanks import Reservoir as Reservoir
from nivel.elements.circuits.tanks import Tank as Tank
from nivel.elements.circuits.tanks import Volume as Volume
from nivel.elements.circuits.tubes import Tube as Tube
