"""The journal of a live run: the file that its recording is written into while it goes on.

It begins with a line of text that says what it is, and a line of JSON: what is recorded. Then come blocks, each a head and rows of float64
numbers. A block that is whole can be read, however the program ended: the journal of a killed run ends with its last whole block.
"""

import json
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any, Final, NamedTuple

import numpy as np

from nivel.errors import ModelError
from nivel.files.target import Growing
from nivel.machine.core.vectors import Array

ENDING: Final = ".part"
FIRST_LINE: Final = b"recording of `nivel live` that was not completed; `nivel replay FILE` plays it\n"
HEAD: Final = struct.Struct("<IIIII")  # kind, rows, columns, sum of the payload, sum of the four numbers before
# kinds of blocks: inputs of ticks; frames; a new part, of which the row is [part before, ticks]; ticks are missing
TICKS, FRAMES, PART, GAP = 1, 2, 3, 4


class Block(NamedTuple):
    """Where rows of numbers stand in a journal. start : of the first [bytes]."""

    kind: int
    rows: int
    columns: int
    start: int

    @property
    def size(self) -> int:
        """Bytes of all rows."""
        return 8 * self.rows * self.columns


def journal_of(target: Path) -> Path:
    """The journal of the recording `target`: beside it, with the ending `.part`."""
    return target.with_name(target.name + ENDING)


def check_journal(path: Path, *, force: bool) -> None:
    """Refuse to write over the journal of an earlier run. Raises ModelError."""
    if path.exists() and not force:
        raise ModelError(
            f"{path} holds what a run recorded that was killed: `nivel replay {path}` plays it; rename it, or use --force to overwrite it"
        )


class Journal:
    """Blocks written one after the other. Raises ModelError where the file cannot be created, or another run writes it."""

    def __init__(self, path: Path, about: dict[str, Any], *, force: bool = False) -> None:
        self.path = path
        check_journal(path, force=force)
        try:
            self._growing = Growing(path)
            self._growing.claim()
            self.file.truncate(0)
            self._growing.add(FIRST_LINE + json.dumps(about).encode() + b"\n")
        except BlockingIOError:
            raise ModelError(f"another run is recording into {path}; give this one another name (--record)") from None
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise ModelError(f"the recording {path} cannot be created: {reason}") from None

    def append(self, kind: int, rows: Array) -> None:
        """One more block. Raises OSError, as on a full disk; the journal is then as it was before."""
        payload = np.ascontiguousarray(rows, "<f8").tobytes()
        numbers = kind, *rows.shape, zlib.crc32(payload)
        self._growing.add(HEAD.pack(*numbers, zlib.crc32(HEAD.pack(*numbers, 0))) + payload)

    @property
    def file(self) -> IO[bytes]:
        """The open file; where it is at does not matter to the journal."""
        return self._growing.stream

    def close(self) -> None:
        """Write no more; the file stays."""
        self.file.close()

    def discard(self) -> None:
        """Remove the file."""
        self.path.unlink(missing_ok=True)
        self.close()


def is_journal(path: Path) -> bool:
    """Whether a file begins as journals do. Raises OSError."""
    with path.open("rb") as file:
        return file.read(len(FIRST_LINE)) == FIRST_LINE


def about_in(file: IO[bytes]) -> tuple[dict[str, Any], int]:
    """What is recorded in a journal, and where its blocks begin. Raises ValueError where that is not whole."""
    file.seek(0)
    lines = b""
    while lines.count(b"\n") < 2:
        more = file.read(1 << 16)
        if not more:
            raise ValueError("the journal has no blocks")
        lines += more
    first, second, _ = lines.split(b"\n", 2)
    return json.loads(second), len(first) + len(second) + 2


def blocks_in(file: IO[bytes], start: int) -> Iterator[Block]:
    """The blocks from `start` on, until the first one that is not whole."""
    while True:
        file.seek(start)
        head = file.read(HEAD.size)
        if len(head) < HEAD.size:
            return
        *numbers, checked = HEAD.unpack(head)
        if zlib.crc32(HEAD.pack(*numbers, 0)) != checked:
            return
        kind, rows, columns, checked = numbers
        block = Block(kind, rows, columns, start + HEAD.size)
        payload = file.read(block.size)
        if len(payload) < block.size or zlib.crc32(payload) != checked:
            return
        yield block
        start = block.start + block.size


def rows_of(file: IO[bytes], blocks: list[Block], columns: int) -> Array:
    """The numbers of blocks one after the other (rows, columns)."""
    out = np.zeros((sum(each.rows for each in blocks), columns))
    row = 0
    for each in blocks:
        file.seek(each.start)
        out[row : row + each.rows] = np.frombuffer(file.read(each.size), "<f8").reshape(each.rows, each.columns)
        row += each.rows
    return out
