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


def __getattr__(name: str) -> type[Any]:
    return COMPONENTS.record_named(name)


def __dir__() -> list[str]:
    return sorted(COMPONENTS.names)
