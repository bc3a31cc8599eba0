"""The process of a unit that has one of its own: it loads the unit and answers until its run ends."""

import io
import sys
from multiprocessing import connection
from typing import Any

import numpy as np

from nivel.errors import ModelError
from nivel.system.signals.unit import OwnUnit
from nivel.system.signals.units import unit_here

_Connection: Any = connection.Connection if sys.platform != "win32" else connection.PipeConnection  # type: ignore[attr-defined]


def main() -> None:
    """Answer questions of the pipe whose number stands in the arguments."""
    link = _Connection(int(sys.argv[1]))
    try:
        _, facts = link.recv()
        try:
            unit = unit_here(facts)
        except ModelError as problem:
            link.send(problem)
            return
        link.send(None)
        while True:
            what, *given = link.recv()
            try:
                link.send(_answer(unit, what, given))
            except ModelError as problem:
                link.send(problem)
    except EOFError:
        pass


def _answer(unit: OwnUnit, what: str, given: list[Any]) -> Any:
    match what:
        case "go":
            outputs = unit.go(*given)
            return unit.failure, outputs
        case "begin":
            return unit.begin()
        case "state":
            return _packed(unit)
        case "restore":
            return _restore(unit, given[0])
    raise AssertionError(what)


def _packed(unit: OwnUnit) -> bytes:
    """What the unit saves itself, and its arrays."""
    file = io.BytesIO()
    np.savez(file, np.frombuffer(unit.state(), dtype=np.uint8), *unit.arrays)
    return file.getvalue()


def _restore(unit: OwnUnit, content: bytes) -> None:
    """Raises ModelError where the content is no state of the unit."""
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as data:
            own, *arrays = (data[name] for name in data.files)
        for array, kept in zip(unit.arrays, arrays, strict=True):
            array[...] = kept
    except (OSError, ValueError, KeyError, EOFError) as problem:
        raise ModelError(f"a saved state of a unit cannot be read: {problem}") from None
    unit.restore(own.tobytes())
