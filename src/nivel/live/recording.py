"""Recording of a live run, as it is kept in a file: its parts, and the motions from the start on that they make up."""

import json
from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import IO, Any, Final
from zipfile import ZIP_DEFLATED, BadZipFile, ZipFile

import numpy as np

import nivel
from nivel.errors import ModelError
from nivel.lazy import Struct, dataclass, field
from nivel.live import journal as journals
from nivel.live.preparation import Pace
from nivel.machine.core.vectors import Array
from nivel.machine.laws.time_function import Table
from nivel.machine.machine_record import MachineRecord
from nivel.native.store import whole

FORMAT: Final = 2
ENDING: Final = ".live.npz"


class Take(Struct):
    """One motion from the start on. tape (ticks, inputs): values of the inputs at the ends of ticks. frames (n, width), those that were
    kept. whole : whether its ticks were kept until it ended."""

    tape: Array
    frames: Array
    whole: bool = True

    @property
    def ticks(self) -> int:
        """How many."""
        return len(self.tape)

    def up_to(self, ticks: int, time: float) -> "Take":
        """The beginning of the take: so many ticks, and frames up to a time [s]."""
        return Take(self.tape[:ticks], self.frames[self.frames[:, 0] <= time * (1.0 + 1e-12)], self.whole)

    def then(self, other: "Take") -> "Take":
        """This take, and how it went on."""
        tape, frames = np.concatenate([self.tape, other.tape]), np.concatenate([self.frames, other.frames])
        return Take(tape, frames, other.whole)


class Part(Struct):
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


class Recording(Struct):
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


def about_run(machine: MachineRecord, source: str, settings: Mapping[str, Any], pace: Pace) -> dict[str, Any]:
    """What stands in a recording besides its numbers, as JSON has it."""
    return {
        "format": FORMAT,
        "nivel_version": nivel.__version__,
        "machine": machine.model_dump(mode="json", by_alias=True, exclude_none=True),
        "source": source,
        "settings": dict(settings),
        "pace": [pace.step, pace.substeps, pace.every],
    }


@dataclass
class _Kept:
    """A part in a journal: where its ticks and frames stand."""

    before: int
    ticks: int
    tape: list[journals.Block] = field(default_factory=list)
    frames: list[journals.Block] = field(default_factory=list)
    whole: bool = True


def _kept_in(file: IO[bytes], start: int, *, last_whole: bool) -> list[_Kept]:
    """The parts of a journal whose blocks begin at `start`."""
    out: list[_Kept] = []
    for block in journals.blocks_in(file, start):
        if block.kind == journals.PART:
            before, ticks = journals.rows_of(file, [block], block.columns)[0]
            out.append(_Kept(int(before), int(ticks)))
        elif block.kind == journals.TICKS:
            out[-1].tape.append(block)
        elif block.kind == journals.FRAMES:
            out[-1].frames.append(block)
        elif block.kind == journals.GAP:
            out[-1].whole = False
    if out and not last_whole:
        out[-1].whole = False
    return out


def _columns(blocks: Sequence[journals.Block]) -> int:
    return blocks[0].columns if blocks else 1


def parts_in(file: IO[bytes], *, last_whole: bool) -> list[Part]:
    """The parts of a journal. last_whole : whether the last one ends where its motion did. Raises ValueError."""
    _, start = journals.about_in(file)
    kept = _kept_in(file, start, last_whole=last_whole)
    # a part without a tick has the columns of the others
    inputs = max((_columns(each.tape) for each in kept), default=1)
    width = max((_columns(each.frames) for each in kept), default=1)
    return [
        Part(
            each.before,
            each.ticks,
            Take(journals.rows_of(file, each.tape, inputs), journals.rows_of(file, each.frames, width), each.whole),
        )
        for each in kept
    ]


def complete(journal: journals.Journal, target: Path, *, last_whole: bool) -> None:
    """Write what a journal has into the recording `target`, in one atomic step, and remove the journal.

    It goes from file to file, so a long run need not fit in memory. Raises OSError; then the journal stays.
    """
    file = journal.file
    about, start = journals.about_in(file)
    kept = _kept_in(file, start, last_whole=last_whole)
    about["parts"] = [[each.before, each.ticks, each.whole] for each in kept]
    with whole(target) as draft, ZipFile(draft, "w", ZIP_DEFLATED) as archive:
        with archive.open("about.npy", "w") as out:
            np.lib.format.write_array(out, np.array(json.dumps(about)))
        for k, each in enumerate(kept):
            _copy(file, each.tape, archive, f"tape_{k}.npy")
            _copy(file, each.frames, archive, f"frames_{k}.npy")
    journal.discard()


def _copy(file: IO[bytes], blocks: Sequence[journals.Block], archive: ZipFile, name: str) -> None:
    """The numbers of blocks as an array of an archive of NumPy."""
    shape = sum(each.rows for each in blocks), _columns(blocks)
    with archive.open(name, "w", force_zip64=True) as out:
        np.lib.format.write_array_header_1_0(out, {"descr": "<f8", "fortran_order": False, "shape": shape})
        for each in blocks:
            file.seek(each.start)
            out.write(file.read(each.size))


def read_recording(path: str | PathLike[str]) -> Recording:
    """Read a recording, or the journal of a run that was killed or goes on. Raises ModelError where the file is none."""
    try:
        about, parts = _from_journal(Path(path)) if journals.is_journal(Path(path)) else _from_archive(path)
    except FileNotFoundError:
        left = journals.journal_of(Path(path))
        if left.exists():
            raise ModelError(
                f"there is no file {fspath(path)}, but {left}, which a run wrote that was killed or goes on: `nivel replay {left}`"
            ) from None
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


def _from_archive(path: str | PathLike[str]) -> tuple[dict[str, Any], list[Part]]:
    with np.load(path, allow_pickle=False) as stored:
        about = json.loads(str(stored["about"]))
        _refuse_other_format(path, about)
        return about, [
            Part(before, ticks, Take(stored[f"tape_{k}"], stored[f"frames_{k}"], whole))
            for k, (before, ticks, whole) in enumerate(about["parts"])
        ]


def _from_journal(path: Path) -> tuple[dict[str, Any], list[Part]]:
    with path.open("rb") as file:
        about, _ = journals.about_in(file)
        _refuse_other_format(path, about)
        return about, parts_in(file, last_whole=False)


def _refuse_other_format(path: str | PathLike[str], about: dict[str, Any]) -> None:
    if about["format"] != FORMAT:
        raise ModelError(
            f"{fspath(path)} was written by nivel {about.get('nivel_version', '0.1.0')} in format {about['format']} of "
            f"recordings; nivel {nivel.__version__}, which runs here, reads format {FORMAT}: "
            "replay it with the version that wrote it"
        )


def _has_code(written: Any) -> bool:
    """Whether a Python law stands somewhere in what was written of a machine."""
    if isinstance(written, dict):
        return {"source", "function"} <= set(written) or any(map(_has_code, written.values()))
    return isinstance(written, list) and any(map(_has_code, written))
