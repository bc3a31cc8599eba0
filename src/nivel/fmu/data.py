"""The numbers of a machine as a file: what `sources/nivel_fmu.c` reads when a unit is instantiated."""

from __future__ import annotations

import struct
from collections.abc import Iterator

import numpy as np

from nivel.c_library.exported import Exported, Output
from nivel.fmu.parameters import Followed

MAGIC = 0x324D464E
# value references: outputs have their places in a frame
INPUT, PARAMETER = 1 << 20, 2 << 20
OFFSET, PRIME = 14695981039346656037, 1099511628211


def outputs_of(machine: Exported) -> tuple[Output, ...]:
    """What a unit has as outputs, by ascending places: neither the time nor inputs, which are variables of their own."""
    own = {f"{each.name}.value" for each in machine.inputs}
    chosen = (each for each in machine.outputs if each.place and each.name not in own)
    return tuple(sorted(chosen, key=lambda each: each.place))


def machine_data(found: Followed, token: str) -> bytes:
    """The file. token : that of the unit."""
    machine = found.machine
    places = [each.place for each in outputs_of(machine)] + [each.followed for each in machine.inputs]
    numbers = {**machine.numbers, "output_count": len(places)}
    numbers["size"] = machine.size_for(len(places))
    names = [name for failure in machine.failures for name in failure.names]
    texts = [token, *machine.codes, *(failure.sentence for failure in machine.failures), *names]
    energy = machine.image.byte_of(machine.loop.machine.record.control.energy.ctypes.data)
    counts = len(machine.codes), len(names), len(found.parameters), len(found.words), energy, len(found.terms)
    rest = b"".join(
        [
            struct.pack("<6Q", *counts),
            struct.pack(f"<{len(numbers)}Q", *numbers.values()),
            *_tables(found),
            np.array(machine.image.words.nonzero()[0], dtype="<u4").tobytes(),
            np.array(places, dtype="<u4").tobytes(),
            *(text.encode() + b"\0" for text in texts),
        ]
    )
    rest += bytes(-len(rest) % 8)
    return struct.pack("<2Q", MAGIC, _sum(rest)) + rest


def _tables(found: Followed) -> Iterator[bytes]:
    machine, image = found.machine, found.machine.image
    yield image.words[image.words.nonzero()[0]].astype("<u8").tobytes()
    for each in machine.inputs:
        yield struct.pack("<2I2d", each.kind, each.value, each.low, each.high)
    if (numbers := found.numbers) is not None:
        defaults = [each.value for each in found.parameters]
        yield np.array([defaults, found.least, numbers.centres, numbers.widths], dtype="<f8").T.tobytes()
        for word, *law in zip(found.words, numbers.constants, numbers.powers, numbers.signs, strict=True):
            yield struct.pack("<Q3d", word, *law)
        for number, parameter in found.terms:
            law = *numbers.factors[number, parameter], *numbers.divisors[number, parameter]
            yield struct.pack("<2I8d", number, parameter, *law)
    for word, byte in image.inner.items():
        yield struct.pack("<2I", word, byte)
    for word, symbol in image.outer.items():
        yield struct.pack("<2I", word, machine.codes.index(symbol))
    first = 0
    for failure in machine.failures:
        yield struct.pack("<3I", failure.status, first, len(failure.names))
        first += len(failure.names)


def _sum(content: bytes) -> int:
    """The sum of Fowler, Noll and Vo over words of eight bytes."""
    out = OFFSET
    for word in np.frombuffer(content, dtype="<u8").tolist():
        out = (out ^ word) * PRIME & 0xFFFFFFFFFFFFFFFF
    return out
