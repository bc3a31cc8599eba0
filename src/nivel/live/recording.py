"""Recording of a live run, as it is kept in a file: its parts, and the motions from the start on that they make up. While the run goes on
it is written into a journal.

A journal begins with a line of text that says what it is, and a line of JSON: what is recorded. Then come blocks, each a head and rows of
float64 numbers. A block that is whole can be read, however the program ended: the journal of a killed run ends with its last whole block.
"""

import json
import struct
import zlib
from collections.abc import Iterator, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import IO, Any, Final, NamedTuple
from zipfile import ZIP_DEFLATED, BadZipFile, ZipFile

import numpy as np

import nivel
from nivel.errors import ModelError
from nivel.files.target import Growing
from nivel.lazy import Struct, field
from nivel.live.preparation import Pace
from nivel.machine.core.vectors import Array
from nivel.machine.laws.time_function import Table
from nivel.machine.machine_record import MachineRecord
from nivel.native.store import whole

UNFINISHED: Final = ".part"
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
    return target.with_name(target.name + UNFINISHED)


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


class _Kept(Struct, frozen=False):
    """A part in a journal: where its ticks and frames stand."""

    before: int
    ticks: int
    tape: list[Block] = field(default_factory=list)
    frames: list[Block] = field(default_factory=list)
    whole: bool = True


def _kept_in(file: IO[bytes], start: int, *, last_whole: bool) -> list[_Kept]:
    """The parts of a journal whose blocks begin at `start`."""
    out: list[_Kept] = []
    for block in blocks_in(file, start):
        if block.kind == PART:
            before, ticks = rows_of(file, [block], block.columns)[0]
            out.append(_Kept(int(before), int(ticks)))
        elif block.kind == TICKS:
            out[-1].tape.append(block)
        elif block.kind == FRAMES:
            out[-1].frames.append(block)
        elif block.kind == GAP:
            out[-1].whole = False
    if out and not last_whole:
        out[-1].whole = False
    return out


def _columns(blocks: Sequence[Block]) -> int:
    return blocks[0].columns if blocks else 1


def parts_in(file: IO[bytes], *, last_whole: bool) -> list[Part]:
    """The parts of a journal. last_whole : whether the last one ends where its motion did. Raises ValueError."""
    _, start = about_in(file)
    kept = _kept_in(file, start, last_whole=last_whole)
    # a part without a tick has the columns of the others
    inputs = max((_columns(each.tape) for each in kept), default=1)
    width = max((_columns(each.frames) for each in kept), default=1)
    return [
        Part(
            each.before,
            each.ticks,
            Take(rows_of(file, each.tape, inputs), rows_of(file, each.frames, width), each.whole),
        )
        for each in kept
    ]


def complete(journal: Journal, target: Path, *, last_whole: bool) -> None:
    """Write what a journal has into the recording `target`, in one atomic step, and remove the journal.

    It goes from file to file, so a long run need not fit in memory. Raises OSError; then the journal stays.
    """
    file = journal.file
    about, start = about_in(file)
    kept = _kept_in(file, start, last_whole=last_whole)
    about["parts"] = [[each.before, each.ticks, each.whole] for each in kept]
    with whole(target) as draft, ZipFile(draft, "w", ZIP_DEFLATED) as archive:
        with archive.open("about.npy", "w") as out:
            np.lib.format.write_array(out, np.array(json.dumps(about)))
        for k, each in enumerate(kept):
            _copy(file, each.tape, archive, f"tape_{k}.npy")
            _copy(file, each.frames, archive, f"frames_{k}.npy")
    journal.discard()


def _copy(file: IO[bytes], blocks: Sequence[Block], archive: ZipFile, name: str) -> None:
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
        about, parts = _from_journal(Path(path)) if is_journal(Path(path)) else _from_archive(path)
    except FileNotFoundError:
        left = journal_of(Path(path))
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
        about, _ = about_in(file)
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
