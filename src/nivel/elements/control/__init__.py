"""Control: blocks that compute signals, continuous or sampled."""

from typing import TYPE_CHECKING, Annotated, Any, Final

from nivel.elements.kind import Kind, Kinds, OneOf

BLOCKS: Final = Kinds[Kind](__name__, noun="block")

if TYPE_CHECKING:
    from nivel.machine.control.block import Block

    ControlBlock = Block
else:
    ControlBlock = Annotated[Any, OneOf(BLOCKS)]


def __getattr__(name: str) -> type[Any]:
    return BLOCKS.record_named(name)


def __dir__() -> list[str]:
    return sorted(BLOCKS.names)
