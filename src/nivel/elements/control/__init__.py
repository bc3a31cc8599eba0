"""Control: blocks that compute signals, continuous or sampled."""

from typing import TYPE_CHECKING, Annotated, Final

from nivel.elements.kind import Kind, Kinds, OneOf
from nivel.machine.control.block import Block

BLOCKS: Final = Kinds[Kind](__name__, noun="block")

if TYPE_CHECKING:
    ControlBlock = Block
else:
    ControlBlock = Annotated[Block, OneOf(BLOCKS)]
