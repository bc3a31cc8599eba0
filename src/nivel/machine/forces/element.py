"""Base of all forces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Final

from nivel.machine.core.checked import Checked
from nivel.machine.core.record import Name
from nivel.machine.core.usual import POWER
from nivel.machine.given import Usual

OUTPUTS: Final = ("magnitude", "power")


class ForceElement(Checked):
    """A named element that loads bodies.

    outputs : what a sensor can read of it. turns : it may turn a body, which a point mass cannot be. stiff : it may be stiff, that is, do
    much work in a short time. usual : what its outputs are between.
    """

    collection: ClassVar[str] = "forces"
    outputs: ClassVar[tuple[str, ...]] = OUTPUTS
    turns: ClassVar[bool] = False
    stiff: ClassVar[bool] = True
    usual: ClassVar[Mapping[str, Usual]] = {"power": POWER}

    name: Name
    if TYPE_CHECKING:  # the word of every kind
        type: Any
