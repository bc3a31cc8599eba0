"""What a live run was, as it is kept in a file: its parts, and the motions from the start on that they make up."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Final
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.live.preparation import Pace
from nivel.machine import MachineRecord, Table

Array = NDArray[np.float64]
FORMAT: Final = 2
ENDING: Final = ".live.npz"


@dataclass(frozen=True)
class Take:
    """One motion from the start on. tape (ticks, inputs): values of the inputs at the ends of ticks. frames (n, width), those that were
    kept. whole : whether its ticks were kept until it ended."""

    tape: Array
    frames: Array
    whole: bool = True

    @property
    def ticks(self) -> int:
        """How many."""
        return len(self.tape)

    def up_to(self, ticks: int, time: float) -> Take:
        """The beginning of the take: so many ticks, and frames up to a time [s]."""
        return Take(self.tape[:ticks], self.frames[self.frames[:, 0] <= time * (1.0 + 1e-12)], self.whole)

    def then(self, other: Take) -> Take:
        """This take, and how it went on."""
        tape, frames = np.concatenate([self.tape, other.tape]), np.concatenate([self.frames, other.frames])
        return Take(tape, frames, other.whole)


@dataclass(frozen=True)
class Part:
    """Motion between two moments at which the machine was put somewhere else.

    before : number of the part that it goes on from, after `ticks` ticks from the start; -1: it begins at the start. own : its motion.
    """

    before: int
    ticks: int
    own: Take


def takes_of(parts: Sequence[Part], pace: Pace) -> list[Take]:
    """Parts put together: all motions from the start on, each as it went on after its last jump."""
    out: list[Take] = []
    for each in parts:
        out.append(each.own if each.before < 0 else _joined(out[each.before], each, pace))
    return [take for take, each in zip(out, parts, strict=True) if each.own.ticks]


def _joined(before: Take, part: Part, pace: Pace) -> Take:
    first = before.up_to(part.ticks, part.ticks * pace.tick)
    if first.ticks < part.ticks:  # what leads to this part was not kept
        return Take(first.tape, first.frames, whole=False)
    return first.then(part.own)


@dataclass(frozen=True)
class Recording:
    """A recording from a file. settings : given for the run. has_code : whether laws of the machine are functions in Python."""

    machine: MachineRecord
    source: str
    settings: dict[str, Any]
    pace: Pace
    takes: tuple[Take, ...]
    has_code: bool = False

    def inputs(self, take: Take) -> dict[str, Table]:
        """What every input did, as tables of time; points on straight lines are left out."""
        out = {}
        for k, each in enumerate(self.machine.inputs):
            values = np.concatenate([[each.rest_value], take.tape[:, k]])
            change = np.diff(values)
            corner = np.concatenate([[True], np.abs(np.diff(change)) > 1e-12 * (each.range[1] - each.range[0]), [True]])
            at = np.flatnonzero(corner)
            out[each.name] = Table(tuple((at * self.pace.tick).tolist()), tuple(values[at].tolist()))
        return out


def write_recording(
    path: str | PathLike[str],
    machine: MachineRecord,
    source: str,
    settings: Mapping[str, Any],
    pace: Pace,
    parts: Sequence[Part],
) -> None:
    """Write a run. Raises ModelError where the file cannot be written."""
    about = {
        "format": FORMAT,
        "machine": machine.model_dump(mode="json", by_alias=True, exclude_none=True),
        "source": source,
        "settings": dict(settings),
        "pace": [pace.step, pace.substeps, pace.every],
        "parts": [[each.before, each.ticks, each.own.whole] for each in parts],
    }
    arrays: dict[str, Any] = {"about": np.array(json.dumps(about))}
    for k, each in enumerate(parts):
        arrays[f"tape_{k}"], arrays[f"frames_{k}"] = each.own.tape, each.own.frames
    try:
        with Path(path).open("wb") as file:
            np.savez_compressed(file, **arrays)
    except OSError as error:
        raise ModelError(
            f"the recording {fspath(path)} cannot be written: {(error.strerror or str(error)).lower()}"
        ) from None


def read_recording(path: str | PathLike[str]) -> Recording:
    """Read a recording. Raises ModelError where the file is none."""
    try:
        with np.load(path, allow_pickle=False) as stored:
            about = json.loads(str(stored["about"]))
            if about["format"] != FORMAT:
                raise ModelError(
                    f"{fspath(path)} was written by another version of nivel (format {about['format']}, this one reads {FORMAT})"
                )
            parts = [
                Part(before, ticks, Take(stored[f"tape_{k}"], stored[f"frames_{k}"], whole))
                for k, (before, ticks, whole) in enumerate(about["parts"])
            ]
    except FileNotFoundError:
        raise ModelError(f"there is no file {fspath(path)}") from None
    except (OSError, ValueError, KeyError, EOFError, BadZipFile):
        raise ModelError(
            f"{fspath(path)} is no recording of a live run, which `nivel live --record FILE` writes"
        ) from None
    step, substeps, every = about["pace"]
    machine = MachineRecord.model_validate_json(json.dumps(about["machine"]))
    pace = Pace(step, int(substeps), int(every))
    return Recording(
        machine, about["source"], about["settings"], pace, tuple(takes_of(parts, pace)), _has_code(about["machine"])
    )


def _has_code(written: Any) -> bool:
    """Whether a Python law stands somewhere in what was written of a machine."""
    if isinstance(written, dict):
        return {"source", "function"} <= set(written) or any(map(_has_code, written.values()))
    return isinstance(written, list) and any(map(_has_code, written))
