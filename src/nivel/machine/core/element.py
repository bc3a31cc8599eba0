"""Base of all forces, and the inequalities of elements that have a state."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Final, NamedTuple

from nivel.known import MachineRecord
from nivel.machine.core.checked import Checked
from nivel.machine.core.record import Name
from nivel.machine.given import POWER, Usual

OUTPUTS: Final = ("magnitude", "power")
# of an element and its numbers over time (`nivel.judge.after.checks.states`): an array over time
History = Callable[[Any, Any], Any]


class Acts(NamedTuple):
    """An effort where an overlap is positive, and none where it is negative.

    sides : words for what the element is without the overlap, and with it. like : output or field of the record whose units the overlap
    has. overlap, its rate where it is known, effort. always : of the element, whether every overlap that grows has an effort. applies : of
    the element, whether it has these sides.
    """

    sides: tuple[str, str]
    like: str
    overlap: History
    effort: History
    rate: History | None = None
    always: Callable[[Any], bool] = lambda _: True
    applies: Callable[[Any], bool] = lambda _: True


class Holds(NamedTuple):
    """Dry friction: an effort below its limit holds, and at the limit it slides.

    like : output or field of the record whose units the slip has. effort, its limit at rest, the limit below which it holds, and the rate
    of slip. one_way : the effort is not negative, and below its limit neither is the slip. applies : of the element, whether it has this
    friction.
    """

    like: str
    effort: History
    limit: History
    sliding: History
    slip: History
    one_way: bool = False
    applies: Callable[[Any], bool] = lambda _: True


Inequalities = tuple[Acts | Holds, ...]


class ForceElement(Checked):
    """A named element that loads bodies.

    outputs : what a sensor can read of it. locks : it holds with what is wanted, up to its capacity. turns : it may turn a body, which a
    point mass cannot be. stiff : it may be stiff, that is, do much work in a short time. usual : what its outputs are between.
    inequalities : that its state obeys at all times.
    """

    collection: ClassVar[str] = "forces"
    outputs: ClassVar[tuple[str, ...]] = OUTPUTS
    locks: ClassVar[bool] = False
    turns: ClassVar[bool] = False
    stiff: ClassVar[bool] = True
    usual: ClassVar[Mapping[str, Usual]] = {"power": POWER}
    inequalities: ClassVar[Inequalities] = ()

    name: Name
    if TYPE_CHECKING:  # the word of every kind
        type: Any

    @property
    def sticks(self) -> bool:
        """Whether friction of it can hold bodies at rest: its efforts are unknowns of the equations of motion."""
        return self.locks

    def remarks(self, machine: MachineRecord) -> Iterator[tuple[str, str]]:
        """Key and text of what is right by itself in it, and may be a slip."""
        return iter(())
