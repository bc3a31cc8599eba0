# Written by `python packaging/write_settings.py` from the records. Do not edit.
# fmt: off
# ruff: noqa
# pyright: reportOptionalMemberAccess=false
"""Control: blocks that compute signals, continuous or sampled."""

from typing import TYPE_CHECKING, Annotated, Any, Final

from nivel.elements.kind import Kind, Kinds, OneOf

BLOCKS: Final = Kinds[Kind](__name__, noun="block")

if TYPE_CHECKING:
    from nivel.machine.control.block import Block

    ControlBlock = Block
else:
    ControlBlock = Annotated[Any, OneOf(BLOCKS)]

from nivel.elements.control.blocks import DeadZone as DeadZone
from nivel.elements.control.blocks import Gain as Gain
from nivel.elements.control.blocks import Limit as Limit
from nivel.elements.control.blocks import Lookup as Lookup
from nivel.elements.control.blocks import Map as Map
from nivel.elements.control.blocks import SignalBlock as SignalBlock
from nivel.elements.control.blocks import Sum as Sum
from nivel.elements.control.blocks import Switch as Switch
from nivel.elements.control.controllers import Cascade as Cascade
from nivel.elements.control.controllers import Pid as Pid
from nivel.elements.control.dynamics import Derivative as Derivative
from nivel.elements.control.dynamics import HighPass as HighPass
from nivel.elements.control.dynamics import Integrator as Integrator
from nivel.elements.control.dynamics import LeadLag as LeadLag
from nivel.elements.control.dynamics import LowPass as LowPass
from nivel.elements.control.dynamics import Notch as Notch
from nivel.elements.control.dynamics import StateSpace as StateSpace
from nivel.elements.control.dynamics import TransferFunction as TransferFunction
from nivel.elements.control.held import Delay as Delay
from nivel.elements.control.held import Hold as Hold
from nivel.elements.control.held import Hysteresis as Hysteresis
from nivel.elements.control.held import MovingAverage as MovingAverage
from nivel.elements.control.held import RateLimit as RateLimit
from nivel.elements.control.imperfections import Bus as Bus
from nivel.elements.control.imperfections import Noise as Noise
from nivel.elements.control.imperfections import Quantiser as Quantiser
from nivel.elements.control.profile import Trapezoid as Trapezoid
from nivel.elements.control.profile import Waypoints as Waypoints
from nivel.elements.control.state_machine import StateMachine as StateMachine
from nivel.elements.control.units import CBlock as CBlock
from nivel.elements.control.units import FmuBlock as FmuBlock
from nivel.elements.control.units import UserBlock as UserBlock
from nivel.elements.control.vehicle_driver import VehicleDriver as VehicleDriver
