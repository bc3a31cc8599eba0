"""A journal of a study: a line for each variant that is finished, so that an interrupted study goes on where it was.

A line that was not written to its end, because the program was killed, does not count.
"""

from __future__ import annotations

import base64
import json
import os
from collections.abc import Mapping
from dataclasses import fields
from hashlib import sha256
from pathlib import Path
from typing import Any, BinaryIO, Self

import numpy as np
from numpy.typing import NDArray

from nivel import __version__
from nivel.analysis.sweep.outputs import Number
from nivel.analysis.sweep.task import Task
from nivel.analysis.sweep.variant import Saved, VariantRun
from nivel.analysis.sweep.variants import Variants
from nivel.errors import ModelError

FORMAT = 1
SUFFIX = ".journal"


def fingerprint(task: Task, variants: Variants) -> str:
    """Of all that the numbers of a study depend on."""
    outputs = {name: output.model_dump(mode="json") for name, output in task.outputs.items()}
    parts = (
        task.machine.record.model_dump_json(),
        task.analysis,
        repr(sorted(task.settings.items())),
        json.dumps(outputs, sort_keys=True),
        repr((task.save, task.verify, task.time_limit, task.judge)),
        repr(variants.values),
    )
    return sha256("\n".join(parts).encode()).hexdigest()


class Journal:
    """The journal at `path`, open for further variants; `finished` has those that are in it, by number."""

    def __init__(self, path: Path, stream: BinaryIO, finished: dict[int, VariantRun]) -> None:
        self.path, self.finished = path, finished
        self._stream = stream

    @classmethod
    def begin(cls, path: Path, of: str) -> Self:
        """A new journal; one that exists is replaced. of : fingerprint of the study. Raises ModelError where it cannot be written."""
        try:
            stream = path.open("wb")
        except OSError as error:
            raise ModelError(
                f"the journal {path} cannot be written: {(error.strerror or str(error)).lower()}"
            ) from None
        journal = cls(path, stream, {})
        journal._write({"format": FORMAT, "nivel": __version__, "study": of})
        return journal

    @classmethod
    def go_on(cls, path: Path, of: str) -> Self:
        """A journal that exists. Raises ModelError where it is of another study, or of another version of nivel."""
        head, finished, length = _read(path)
        if head != {"format": FORMAT, "nivel": __version__, "study": of}:
            other = (
                "another version of nivel"
                if head.get("study") == of
                else "another study, or the machine was changed since"
            )
            raise ModelError(f"{path} is the journal of {other}; begin anew with --force")
        stream = path.open("r+b")
        stream.truncate(length)
        stream.seek(length)
        return cls(path, stream, finished)

    def add(self, number: int, run: VariantRun) -> None:
        """Keep a variant that is finished."""
        self.finished[number] = run
        self._write({"number": number, **_to_json(run)})

    def _write(self, content: Mapping[str, Any]) -> None:
        self._stream.write(json.dumps(content).encode() + b"\n")
        self._stream.flush()

    def close(self, *, remove: bool) -> None:
        """End it. remove : its numbers are in the data file."""
        self._stream.close()
        if remove:
            self.path.unlink(missing_ok=True)


def count_finished(path: Path) -> int:
    """Number of variants in a journal."""
    return len(_read(path)[1])


def _read(path: Path) -> tuple[dict[str, Any], dict[int, VariantRun], int]:
    """First line, variants by number, and the length [bytes] of what was written to its end. Raises ModelError."""
    head: dict[str, Any] = {}
    finished: dict[int, VariantRun] = {}
    length = 0
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ModelError(f"the journal {path} cannot be read: {(error.strerror or str(error)).lower()}") from None
    for line in content.splitlines(keepends=True):
        try:
            data = json.loads(line) if line.endswith(b"\n") else None
            if not isinstance(data, dict):
                break
            if head:
                finished[int(data.pop("number"))] = _from_json(data)
            else:
                head = data
        except (ValueError, KeyError, TypeError):
            break
        length += len(line)
    if "study" not in head:
        raise ModelError(f"{path} is no journal of a study; begin anew with --force")
    return head, finished, length


def _to_json(run: VariantRun) -> dict[str, Any]:
    out = {each.name: getattr(run, each.name) for each in fields(run)}
    out["time"] = _packed(run.time)
    out["outputs"] = {name: list(number) for name, number in run.outputs.items()}
    out["saved"] = {
        name: [each.dims, dict(each.names), each.units, each.long_name, _packed(each.values)]
        for name, each in run.saved.items()
    }
    return out


def _from_json(data: dict[str, Any]) -> VariantRun:
    outputs = {name: Number(*each) for name, each in data.pop("outputs").items()}
    saved = {
        name: Saved(tuple(dims), {dim: tuple(its) for dim, its in names.items()}, units, long_name, _unpacked(values))
        for name, (dims, names, units, long_name, values) in data.pop("saved").items()
    }
    return VariantRun(**{**data, "time": _unpacked(data["time"]), "outputs": outputs, "saved": saved})


def _packed(values: NDArray[Any]) -> list[Any]:
    """Kind, shape and bytes of an array: to the last bit."""
    values = np.ascontiguousarray(values)
    return [values.dtype.str, list(values.shape), base64.b64encode(values.tobytes()).decode()]


def _unpacked(packed: list[Any]) -> NDArray[Any]:
    kind, shape, content = packed
    return np.frombuffer(base64.b64decode(content), dtype=kind).reshape(shape)


def replace_file(written: Path, target: Path) -> None:
    """Put a file that was written to its end in the place of `target`, at once."""
    with written.open("rb") as stream:
        os.fsync(stream.fileno())
    written.replace(target)
