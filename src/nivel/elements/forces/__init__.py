"""Forces: what loads bodies by their state, by time or by signals, without taking a freedom away."""

from typing import TYPE_CHECKING, Annotated, Any, Final

from nivel.elements.kind import Kind, Kinds, OneOf
from nivel.machine.core.element import ForceElement

FORCES: Final = Kinds[Kind](__name__, "nivel.elements.contacts", noun="force")

if TYPE_CHECKING:
    Force = ForceElement
else:
    Force = Annotated[ForceElement, OneOf(FORCES)]


def __getattr__(name: str) -> type[Any]:
    return FORCES.record_named(name)


def __dir__() -> list[str]:
    return sorted(FORCES.names)
