"""What a live run was: the inputs of all its ticks and its frames, kept while it goes on, and written to one file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from os import PathLike, fspath
from pathlib import Path
from typing import Any, Final
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.integrate.paced import DONE, SHOWN, Live
from nivel.live.preparation import Pace
from nivel.machine import MachineRecord, Table

Array = NDArray[np.float64]
FORMAT: Final = 1
ENDING: Final = ".live.npz"
SHORTEST: Final = 1.0  # s of a take that is worth to be kept when the machine is reset


@dataclass
class Take:
    """One motion from the start on. tape (ticks, inputs): values of the inputs at the ends of ticks. frames (n, width).

    whole : whether no tick and no frame is missing.
    """

    tape: list[Array] = field(default_factory=list)
    frames: list[Array] = field(default_factory=list)
    whole: bool = True

    @property
    def ticks(self) -> int:
        """How many."""
        return sum(len(each) for each in self.tape)

    def up_to(self, ticks: int, time: float) -> Take:
        """The beginning of the take: so many ticks, and frames up to a time [s]."""
        tape = np.concatenate(self.tape)[:ticks] if self.tape else None
        frames = np.concatenate(self.frames) if self.frames else None
        kept = None if frames is None else frames[frames[:, 0] <= time * (1.0 + 1e-12)]
        return Take([] if tape is None else [tape], [] if kept is None else [kept], self.whole)


class Recorder:
    """Takes ticks and frames out of the shared memory as long as they are there."""

    def __init__(self, live: Live, pace: Pace) -> None:
        self._live, self._pace = live, pace
        self._ticks, self._shown = 0, int(live.control[SHOWN])
        self.takes: list[Take] = [Take()]

    @property
    def take(self) -> Take:
        """The present one."""
        return self.takes[-1]

    def gather(self) -> Array:
        """New ticks and frames; returns these frames (n, width)."""
        live, take = self._live, self.take
        done, rows = int(live.control[DONE]), len(live.tape)
        if done - self._ticks > rows - 1024:
            take.whole = False
        elif done > self._ticks:
            take.tape.append(live.tape[np.arange(self._ticks, done) % rows])
        self._ticks = max(done, self._ticks)
        return self._gather_frames(take, done)

    def _gather_frames(self, take: Take, done: int) -> Array:
        live = self._live
        shown, ring = int(live.control[SHOWN]), len(live.frames)
        first = self._shown
        if shown - first > ring - 4:
            take.whole, first = False, shown - 1
        frames = live.frames[np.arange(first, shown) % ring]
        self._shown = shown
        # Frames that were asked for, to be seen while nothing moves, are none of the run: they come at other times, after the run's own,
        # or at the start before its first tick.
        at = frames[:, 0]
        first_of_run = np.flatnonzero(at == 0.0)[-1:] if done else np.zeros(0, dtype=np.intp)
        newer = (at > (take.frames[-1][-1, 0] if take.frames else 0.0)) & self._is_regular(at)
        newer[1:] &= at[1:] != at[:-1]
        if not take.frames:
            newer[first_of_run] = True
        if newer.any():
            take.frames.append(frames[newer])
        return frames

    def _is_regular(self, times: Array) -> NDArray[np.bool_]:
        """Whether frames are among those that the run makes by itself."""
        number = times / (self._pace.every * self._pace.tick)
        return np.abs(number - np.round(number)) < 1e-6

    def detach(self, live: Live) -> None:
        """Look at a copy of the memory, which goes."""
        self._live = live

    def begin_again(self, ticks: int) -> None:
        """The machine is put back to where it was after so many ticks."""
        old = self.take
        again = old.up_to(ticks, ticks * self._pace.tick)
        if (old.ticks - ticks) * self._pace.tick < SHORTEST:
            self.takes.pop()
        self.takes.append(again)
        self._ticks, self._shown = ticks, int(self._live.control[SHOWN]) - 1


@dataclass(frozen=True)
class Recording:
    """A recording from a file. record : of the machine; settings : given for the run; pace; takes."""

    machine: MachineRecord
    source: str
    settings: dict[str, Any]
    pace: Pace
    takes: tuple[Take, ...]

    def inputs(self, take: Take) -> dict[str, Table]:
        """What every input did, as tables of time; points on straight lines are left out."""
        tape = np.concatenate(take.tape)
        out = {}
        for k, each in enumerate(self.machine.inputs):
            values = np.concatenate([[each.rest_value], tape[:, k]])
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
    takes: list[Take],
) -> None:
    """Write takes that have ticks. Raises ModelError where the file cannot be written."""
    kept = [take for take in takes if take.ticks]
    about = {
        "format": FORMAT,
        "machine": machine.model_dump(mode="json", by_alias=True, exclude_none=True),
        "source": source,
        "settings": dict(settings),
        "pace": [pace.step, pace.substeps, pace.every],
        "whole": [take.whole for take in kept],
    }
    arrays: dict[str, Any] = {"about": np.array(json.dumps(about))}
    for k, take in enumerate(kept):
        arrays[f"tape_{k}"] = np.concatenate(take.tape)
        arrays[f"frames_{k}"] = np.concatenate(take.frames) if take.frames else np.zeros((0, 1))
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
            takes = [
                Take([stored[f"tape_{k}"]], [stored[f"frames_{k}"]], whole) for k, whole in enumerate(about["whole"])
            ]
    except FileNotFoundError:
        raise ModelError(f"there is no file {fspath(path)}") from None
    except (OSError, ValueError, KeyError, EOFError, BadZipFile):
        raise ModelError(
            f"{fspath(path)} is no recording of a live run, which `nivel live --record FILE` writes"
        ) from None
    if about["format"] != FORMAT:
        raise ModelError(f"{fspath(path)} was written by another version of nivel (format {about['format']})")
    step, substeps, every = about["pace"]
    machine = MachineRecord.model_validate_json(json.dumps(about["machine"]))
    return Recording(machine, about["source"], about["settings"], Pace(step, int(substeps), int(every)), tuple(takes))
