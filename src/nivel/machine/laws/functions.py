"""All functions of a machine, wherever they stand: what its loads, circuits, blocks and inputs do over time, place and speed.

They are found by what they are, in the fields of its parts and of the parts of these; a new section is looked at by itself.
"""

from collections.abc import Iterator
from types import NoneType

from nivel.known import Block, Driver, State
from nivel.lazy import Struct, nivel
from nivel.machine.core.record import Record
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.laws.varying_value import Expression, Table

AXES = "xyz"
NUMBERS_AND_WORDS = float, int, str, NoneType


class Sampling(Struct):
    """When a function is looked at: every `period` [s] from `offset` [s] on; a period of zero: at events only."""

    period: float
    offset: float = 0.0


class MachineFunction(Struct):
    """A function of one part of a machine.

    name : as users know it, `push.vector.x`. section : of the machine, `forces`. part : name of the part. motion : it drives, and has
    derivatives. sampling : when it is looked at; None: in every step.
    """

    name: str
    section: str
    part: str
    function: Expression | Table | PythonLaw
    motion: bool = False
    sampling: Sampling | None = None


def functions_of(machine: Record) -> Iterator[MachineFunction]:
    """All functions of a machine, those that do not vary left out, section by section; found once by `MachineRecord.functions`."""
    for section in type(machine).model_fields:
        value = getattr(machine, section)
        for part in value if isinstance(value, tuple) else (value,):
            if isinstance(part, Block):
                yield from _of_block(section, part)
            elif isinstance(part, Record):
                yield from _of_part(section, part)


def _of_part(section: str, part: Record) -> Iterator[MachineFunction]:
    name = str(getattr(part, "name", None) or section)
    sampling = Sampling(part.every or 0.0) if isinstance(part, State) and part.update is not None else None
    for place, function in functions_in(part):
        moves = isinstance(part, Driver) and place not in nivel.elements.joints.drivers.RATES
        yield MachineFunction(f"{name}.{place}", section, name, function, moves, sampling)


def _of_block(section: str, block: Block) -> Iterator[MachineFunction]:
    """Those that a block computes with; its laws, which bring nothing of their own over time, are left out."""
    for part in block.parts:
        function, sampled = part.function, part.role in ("sample", "memory")
        sampling = Sampling(block.period, block.offset + part.offset) if sampled else None
        if isinstance(function, Expression | Table) or (isinstance(function, PythonLaw) and part.key):
            yield MachineFunction(block.path(part.name), section, block.name, function, sampling=sampling)


def functions_in(record: Record) -> Iterator[tuple[str, Expression | Table | PythonLaw]]:
    """The functions in the fields of a record, each with its place, `vector.x`."""
    for field in type(record).model_fields:
        value = getattr(record, field)
        if not isinstance(value, NUMBERS_AND_WORDS):
            yield from _in_value(field, value)


def _in_value(place: str, value: object) -> Iterator[tuple[str, Expression | Table | PythonLaw]]:
    match value:
        case Expression() | Table() | PythonLaw():
            yield place, value
        case Record():
            for inner, function in functions_in(value):
                yield f"{place}.{inner}", function
        case tuple() | list():
            names = AXES if len(value) == 3 else range(1, len(value) + 1)
            for name, each in zip(names, value, strict=True):
                if not isinstance(each, NUMBERS_AND_WORDS):
                    yield from _in_value(f"{place}.{name}", each)
        case dict():
            for name, each in value.items():
                yield from _in_value(f"{place}.{name}", each)
