"""Control in words: blocks that compute signals, continuous or sampled, one file for each family."""

from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema

from nivel.machine.control.algebra import DeadZone, Gain, Limit, Lookup, SignalBlock, Sum, Switch
from nivel.machine.control.block import Block
from nivel.machine.control.c_function import CBlock
from nivel.machine.control.cascade import Cascade
from nivel.machine.control.dynamics import (
    Derivative,
    HighPass,
    Integrator,
    LeadLag,
    LowPass,
    Notch,
    StateSpace,
    TransferFunction,
)
from nivel.machine.control.fmu import FmuBlock
from nivel.machine.control.held import Delay, Hysteresis, MovingAverage, RateLimit
from nivel.machine.control.pid import Pid
from nivel.machine.control.profile import Trapezoid, Waypoints
from nivel.machine.control.state_machine import StateMachine
from nivel.machine.control.unit import UnitBlock
from nivel.machine.control.user_block import UserBlock
from nivel.machine.given import Field

BLOCKS: list[type[Block]] = [
    SignalBlock,
    Gain,
    Sum,
    Limit,
    DeadZone,
    Switch,
    Lookup,
    Pid,
    Cascade,
    Integrator,
    Derivative,
    TransferFunction,
    StateSpace,
    LowPass,
    HighPass,
    Notch,
    LeadLag,
    RateLimit,
    Delay,
    MovingAverage,
    Hysteresis,
    StateMachine,
    Trapezoid,
    Waypoints,
    UserBlock,
    FmuBlock,
    CBlock,
]
BLOCK_TYPES: dict[str, type[Block]] = {str(kind.model_fields["type"].default): kind for kind in BLOCKS}


class _AnyBlock:
    """A record of one of BLOCKS, told apart by its `type`."""

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return handler.generate_schema(Annotated[reduce(or_, BLOCKS), Field(discriminator="type")])


if TYPE_CHECKING:
    ControlBlock = Block
else:
    ControlBlock = _AnyBlock

__all__ = [
    "BLOCKS",
    "BLOCK_TYPES",
    "Block",
    "CBlock",
    "Cascade",
    "ControlBlock",
    "DeadZone",
    "Delay",
    "Derivative",
    "FmuBlock",
    "Gain",
    "HighPass",
    "Hysteresis",
    "Integrator",
    "LeadLag",
    "Limit",
    "Lookup",
    "LowPass",
    "MovingAverage",
    "Notch",
    "Pid",
    "RateLimit",
    "SignalBlock",
    "StateMachine",
    "StateSpace",
    "Sum",
    "Switch",
    "TransferFunction",
    "Trapezoid",
    "UnitBlock",
    "UserBlock",
    "Waypoints",
]
