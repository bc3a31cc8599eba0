"""Journals: a line for each variant that is finished, so that an interrupted study, search or comparison goes on where it was.

A line that was not written to its end, because the program was killed or the disk was full, does not count.
"""

import base64
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from threading import Lock
from time import monotonic
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel import __version__
from nivel.errors import ModelError, SolveError
from nivel.files.target import Growing, check_target, reason_of
from nivel.model import Model

FORMAT: Final = 1
SUFFIX: Final = ".journal"
SYNCHRONISED: Final = 1.0  # [s] what is older has reached the disk, and survives a loss of power
READ: Final = 1 << 16  # bytes, more than a first line has
NO_ROOM: Final = "Free some space and go on with --resume."

Row = Mapping[str, Any]


def fingerprint(machine: Model, *parts: object) -> str:
    """Of all that the numbers of a study depend on: its machine, the files that this names, and other parts, which tell by their `repr`."""
    record = machine.record.model_dump(mode="json")
    listed = (json.dumps(record, sort_keys=True), *_contents(record), *map(repr, parts))
    return sha256("\n".join(listed).encode()).hexdigest()


def _contents(data: Any) -> Iterator[str]:
    """Digests of the files that a record names and does not contain."""
    if isinstance(data, dict):
        file = data.get("file")
        if isinstance(file, str) and file and Path(file).is_file():
            yield sha256(Path(file).read_bytes()).hexdigest()
    for each in data.values() if isinstance(data, dict) else data if isinstance(data, list) else ():
        yield from _contents(each)


@contextmanager
def open_journal(
    target: Path | None, of: str, what: str, *, resume: bool = False, force: bool = False, sources: Sequence[Path] = ()
) -> "Iterator[Journal | None]":
    """The journal beside `target`, the data file of a study; None without one. of : its fingerprint. what : `variants`, for messages.

    When the block ends it is removed where it is `complete`. Raises ModelError where there is a journal that is neither to be used nor
    replaced, or the data file exists.
    """
    if target is None:
        yield None
        return
    path = target.with_name(target.name + SUFFIX)
    going_on = resume and path.exists()
    if not going_on:
        check_target(target, "data file", force=force or resume, sources=sources)
        if path.exists() and not force:
            done = f"{count_finished(path)} {what}"
            raise ModelError(
                f"{path} has {done} of an interrupted study: go on with --resume, or begin anew with --force"
            )
    journal = Journal(target, of, anew=not going_on)
    try:
        yield journal
    finally:
        journal.close()


class Journal:
    """The journal of the data file `target`, open for further rows. of : fingerprint of the study. rows : those that are finished, by
    number. anew : without those of a journal that exists. complete : they are in the data file. facts : what else was found out, which
    rows carry along.

    Raises ModelError where it is of another study, or of another version of nivel, cannot be written, or another process writes it.
    """

    def __init__(self, target: Path, of: str, *, anew: bool = False) -> None:
        self.target, self.path = target, (path := target.with_name(target.name + SUFFIX))
        self.rows, self.complete, self.facts = dict[int, Row](), False, dict[str, Any]()
        self._lock, self._synchronised = Lock(), monotonic()
        try:
            self._growing = Growing(path)
        except OSError as error:
            raise ModelError(f"the journal {path} cannot be written: {reason_of(error)}") from None
        try:
            self._open(of, anew)
        except BaseException:
            self._growing.stream.close()
            raise

    def _open(self, of: str, anew: bool) -> None:
        """Begin, or read what is there. Raises ModelError."""
        path, first, stream = self.path, {"format": FORMAT, "nivel": __version__, "study": of}, self._growing.stream
        try:
            self._growing.claim()
            if anew or b"\n" not in stream.read(READ):  # killed before its first line was written
                stream.truncate(0)
                self._write(first)
                return
        except BlockingIOError:
            raise ModelError(f"another process goes on with {path}; wait for its end") from None
        except OSError as error:
            path.unlink(missing_ok=True)
            raise ModelError(f"the journal {path} cannot be written: {reason_of(error)}") from None
        head, rows, self._growing.end = _read(path)
        if head != first:
            other = (
                "another version of nivel" if head["study"] == of else "another study, or the machine was changed since"
            )
            raise ModelError(f"{path} is the journal of {other}; begin anew with --force")
        stream.truncate(self._growing.end)
        for row in rows.values():
            self.facts.update(row.pop("facts", {}))
        self.rows.update(rows)

    def add(self, row: Row, number: int | None = None) -> None:
        """Keep what is finished; number : by default the next. Raises SolveError where the disk is full: what was kept before stays."""
        with self._lock:
            number = len(self.rows) if number is None else number
            try:
                self._write({"number": number, "facts": self.facts, **row})
                self.rows[number] = row
            except OSError as error:
                message = f"the journal {self.path} cannot be written further: {reason_of(error)}"
                raise SolveError(message, time=0.0, advice=NO_ROOM) from None

    def _write(self, content: Row) -> None:
        self._growing.add(json.dumps(content).encode() + b"\n")
        if monotonic() - self._synchronised > SYNCHRONISED:
            os.fsync(self._growing.stream.fileno())
            self._synchronised = monotonic()

    def close(self) -> None:
        """End it; it is removed where it is complete, or has no rows."""
        if self.complete or not self.rows:
            self.path.unlink(missing_ok=True)
        self._growing.stream.close()


def count_finished(path: Path) -> int:
    """Number of rows in a journal. Raises ModelError."""
    return len(_read(path)[1])


def _read(path: Path) -> tuple[dict[str, Any], dict[int, dict[str, Any]], int]:
    """First line, rows by number, and the length [bytes] of what was written to its end. Raises ModelError."""
    lines: list[dict[str, Any]] = []
    length = 0
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ModelError(f"the journal {path} cannot be read: {reason_of(error)}") from None
    for line in content.splitlines(keepends=True):
        try:
            data = json.loads(line) if line.endswith(b"\n") else None
        except ValueError:  # the line was cut
            break
        if not isinstance(data, dict) or (lines and "number" not in data):
            break
        lines.append(data)
        length += len(line)
    if not lines and b"\n" not in content:
        return {}, {}, 0
    if not lines or "study" not in lines[0]:
        raise ModelError(f"{path} is no journal of a study; begin anew with --force")
    return lines[0], {row.pop("number"): row for row in lines[1:]}, length


def packed(values: NDArray[Any]) -> list[Any]:
    """Kind, shape and bytes of an array: to the last bit."""
    values = np.ascontiguousarray(values)
    return [values.dtype.str, list(values.shape), base64.b64encode(values.tobytes()).decode()]


def unpacked(row: list[Any]) -> NDArray[Any]:
    """The array of `packed`."""
    kind, shape, content = row
    return np.frombuffer(base64.b64decode(content), dtype=kind).reshape(shape)
