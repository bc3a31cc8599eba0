"""A unit of a machine, an FMU or a C function: what all of them have in common."""

from abc import ABC, abstractmethod
from contextlib import suppress
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from nivel.errors import Fault, ModelError
from nivel.kernels.core.block import Handle
from nivel.kernels.record.hook import Family
from nivel.machine.control.part import UnitFacts

if TYPE_CHECKING:
    from nivel.kernels.signals.c_function import CFunction
    from nivel.kernels.signals.fmu import Fmu

Facts = TypeVar("Facts", bound=UnitFacts)
Data = TypeVar("Data", bound="CFunction | Fmu")


class Unit(ABC, Generic[Facts, Data]):
    """The unit of a block as a machine in numbers has it. law : what calls it, with the record of the `handle`."""

    law: ClassVar[Family]
    facts: Facts
    record: Data
    handle: Handle

    @property
    @abstractmethod
    def failure(self) -> str:
        """What went wrong in the run, as a sentence without a full stop; empty where nothing did."""

    @property
    def arrays(self) -> list[Any]:
        """What a saved state has of it besides what the unit itself saves."""
        return [self.record.number, self.record.time, self.record.outputs]

    @abstractmethod
    def begin(self) -> None:
        """A new instance for a run. Raises ModelError where it cannot be had."""

    @abstractmethod
    def end(self) -> None:
        """Free the instance of the last run."""

    def __del__(self) -> None:
        with suppress(Exception):  # at the end of the process parts of Python are gone
            self.end()

    @abstractmethod
    def state(self) -> bytes:
        """The state that the unit saves itself. Raises ModelError where it cannot."""

    @abstractmethod
    def restore(self, content: bytes) -> None:
        """Go back to a state. Raises ModelError where the unit refuses it."""

    def _fault(self, message: str, key: str = "file") -> ModelError:
        return ModelError(Fault.at(f"control.{self.facts.block}.{key}", message))


class OwnUnit(Unit[Facts, Data]):
    """A unit that can be called without compiled kernels, as its process does where it has one of its own."""

    @abstractmethod
    def go(self, begin: float, step: float | None, inputs: bytes) -> bytes:
        """Outputs at the time `begin` [s] at which it begins, or a step later; the failure is set where there are none."""
