"""Write a result file while the run goes on.

Two forms of the same NetCDF-4 file. While the run goes on it is in HDF5's SWMR mode (single writer, multiple readers)
and flushed after every block of frames: other processes read it, and a killed run leaves everything up to its last
block. A block of many variables takes long to write, so the next one waits PATIENCE times as long. When the run is over
the file is rewritten, compressed and in chunks that run along time, beside the first one, and takes its place in one
atomic step.
"""

import os
from math import prod
from pathlib import Path
from shutil import copyfile
from time import perf_counter, thread_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError, SolveError
from nivel.files.target import Space, check_target, reason_of, status, written
from nivel.integrate.loop.sink import Header
from nivel.lazy import h5py
from nivel.native.store import whole
from nivel.results.frames.contents import Contents, MemoryContents, name_in_file, resolved, shape_of
from nivel.results.frames.stored import StoredContents
from nivel.results.result import Result
from nivel.system.layout import Variable

Attributes = dict[str, str | float | int]

RUNNING_CHUNK = 64 * 1024  # bytes: a chunk that is not full is written again at each flush, so it is small
FINAL_CHUNK = 512 * 1024  # bytes: reading the history of one body touches few chunks, reading all of them is fast
FINAL_ROWS = 16 * 1024  # frames of a chunk, at most: long runs can be read in parts
HEADER = 256 * 1024  # bytes
LAST_WORDS = 32 * 1024  # bytes kept free, so that a file that cannot grow any more can still say why
INDEX = 4096  # bytes
NO_ROOM = "Free some space, write elsewhere (--out), or keep fewer frames (--output-interval)."
MOST_KEPT = 256 * 1024 * 1024  # bytes of frames that are also kept in memory, so that they need not be read back
# A block that took more than QUICK [s] of the processor to write has the next one wait so many times as long.
QUICK, PATIENCE = 0.05, 4.0
CONVENTIONS = "CF-1.11"
COMPRESSION_LEVEL = 2  # gzip after shuffle: higher levels save about 3 % more and take twice as long


class Store:
    """Sink that writes a result file: `begin`, `take` …, then `close` gives the result.

    An existing file is replaced only with `force`; a folder, a device or a pipe never is. What is wrong with the path
    raises ModelError here, before anything is computed; what fails later, on a full disk for instance, SolveError.
    """

    def __init__(self, path: str | os.PathLike[str], force: bool = False) -> None:
        self.path = Path(path)
        self._force = force
        self._file: Any = None
        self._own: os.stat_result | None = None  # of the file that was created
        self._space: Space | None = None
        self._chunks = 0  # bytes of one chunk of every variable, with what HDF5 needs to find it
        self._variables: list[tuple[Variable, tuple[int, ...]]] = []
        self._header: Header | None = None
        self._waiting: list[NDArray[np.float64]] = []  # frames that are not yet in the file
        self._due = 0.0  # [s] of the clock, from which on the next block is written
        self._kept: list[NDArray[np.float64]] | None = []  # frames that were taken; None where they are many
        check_target(self.path, "result file", force=force)

    def begin(self, header: Header) -> None:
        """Create all variables and attributes, then let readers in."""
        self._header, self._kept, self._waiting, self._due = header, [], [], 0.0
        variables, coordinates = resolved(header)
        self._variables = [(variable, shape_of(variable, coordinates)) for variable in variables.values()]
        try:
            if self._force:
                # what stood there when the run began may have been replaced
                check_target(self.path, "result file", force=True)
                self.path.unlink(missing_ok=True)  # who reads the old file keeps it
            self._file = h5py.File(self.path, "x", libver="latest", locking="best-effort", track_order=True)
            self._own = self.path.stat()
            self._space = Space(self.path, self._file)
            self._space.ensure(_header_size(header.attributes))
        except OSError as error:
            if self._file is not None:
                self._file.close()
                self.path.unlink(missing_ok=True)
            self._file, self._space = None, None
            raise ModelError(f"the result file {self.path} cannot be created: {reason_of(error)}") from error
        _write_header(self._file, self._variables, coordinates, header.attributes, 0, _running_chunks)
        shapes = ((), *(shape for _, shape in self._variables))
        self._chunks = sum(8 * prod(_running_chunks(shape, 0)["chunks"]) + INDEX for shape in shapes)
        self._file.swmr_mode = True
        self._file.flush()

    def take(self, frames: NDArray[np.float64]) -> None:
        """Append frames (n, width). The time is written last: a frame whose time can be read is complete."""
        if self._space is None:
            raise RuntimeError("a sink must begin before it takes frames")
        self._waiting.append(frames.copy())
        if self._kept is not None:
            self._kept.append(self._waiting[-1])
            self._kept = self._kept if sum(each.nbytes for each in self._kept) <= MOST_KEPT else None
        if perf_counter() >= self._due:
            self._write()

    def _write(self) -> None:
        """Append the frames that wait."""
        if not self._waiting or self._space is None:
            return
        self._refuse_foreign()
        frames, self._waiting = np.concatenate(self._waiting), []
        begin = thread_time()
        try:
            self._space.ensure(2 * frames.nbytes + self._chunks + LAST_WORDS)
        except OSError as error:
            raise self._given_up(reason_of(error)) from error
        for variable, shape in self._variables:
            _append(self._file, variable.name, frames[:, variable.columns].reshape(len(frames), *shape))
        self._file.flush()
        _append(self._file, "time", frames[:, 0])
        self._file.flush()
        spent = thread_time() - begin
        self._due = perf_counter() + PATIENCE * spent if spent > QUICK else 0.0

    def _refuse_foreign(self) -> None:
        """Raise SolveError where another run has put its file in the place of this one, which it must not touch."""
        found = status(self.path, "result file")
        if self._own is not None and (found is None or not os.path.samestat(found, self._own)):
            self._finish()
            message = f"the result file {self.path} was removed or replaced while the run went on"
            raise SolveError(message, time=0.0, advice="Let every run write a file of its own (--out).")

    def _given_up(self, reason: str) -> SolveError:
        """Close the file as it is; it says why it ends there."""
        self._finish()
        times = StoredContents(self.path).read("time")
        until = float(times[-1]) if len(times) else 0.0
        readable = f"it is readable up to t = {until:.6g} s" if len(times) else "it holds no frame"
        failure = f"the result file {self.path} cannot be written further: {reason}; {readable}"
        _note(self.path, {"outcome": "failed", "failure": failure, "advice": NO_ROOM})
        return SolveError(failure, time=until, advice=NO_ROOM, result=Result(StoredContents(self.path)))

    def _finish(self) -> None:
        if self._space is not None:
            self._space.close()
        self._file, self._space = None, None

    def discard(self) -> None:
        """Give up what was written; the file is removed."""
        self._refuse_foreign()
        self._finish()
        self.path.unlink(missing_ok=True)

    def result(self) -> Result:
        """What was taken so far; the run may go on."""
        self._write()
        return Result(self._contents({}))

    def _contents(self, attributes: Attributes) -> StoredContents:
        """What the file holds; `attributes` replace those of the header."""
        if self._kept is None or self._header is None:
            return StoredContents(self.path)
        frames = np.concatenate([np.empty((0, self._header.layout.width)), *self._kept])
        both = {**self._header.attributes, "Conventions": CONVENTIONS, **attributes}
        return StoredContents.of(self.path, MemoryContents(self._header, frames, both))

    def close(self, attributes: Attributes) -> Result:
        """Rewrite the file in its final form; `attributes` (`outcome`, `trust`, …) replace those of the header."""
        if self._file is None:
            raise RuntimeError("a sink must begin before it gives a result")
        self._write()
        self._refuse_foreign()
        self._finish()
        rewrite(self.path, attributes, self._contents({}))
        return Result(self._contents(attributes))


def rewrite(path: Path, attributes: Attributes, contents: StoredContents | None = None) -> None:
    """Replace the file at `path`, which nobody writes, by its final form, in one atomic step. contents : of that file, where known.

    When this fails, for instance because the disk is full, the file stays as it was, with the new attributes if they
    find place.
    """
    try:
        with whole(path) as draft:
            _write_final(contents or StoredContents(path), draft, attributes)
    except OSError as error:
        _note(path, attributes)
        result = Result(StoredContents(path))
        message = f"the result file {path} is complete but could not be compressed: {reason_of(error)}"
        until = float(result.time[-1]) if len(result.time) else 0.0
        raise SolveError(message, time=until, result=result) from error


def _note(path: Path, attributes: Attributes) -> None:
    """Write attributes into the file at `path`, which nobody writes, if they find place."""
    try:
        file = h5py.File(path, "r+", locking="best-effort")
    except OSError:
        return
    space = Space(path, file)
    try:
        space.ensure(INDEX + sum(4 * len(str(value)) for value in attributes.values()))
        file.attrs.update(attributes)
    except OSError:
        pass
    finally:
        file.flush()
        space.close()


def _write_final(source: StoredContents, path: Path, attributes: Attributes) -> None:
    variables = [(variable, shape_of(variable, source.coordinates)) for variable in source.variables.values()]
    count, both = source.frame_count, {**source.attributes, **attributes}
    new = h5py.File(path, "w", libver=("v108", "v108"), locking="best-effort", track_order=True)
    space = Space(path, new)
    try:
        space.ensure(_header_size(both))
        _write_header(new, variables, source.coordinates, both, count, _final_chunks)
        for name in ("time", *source.variables):
            _copy(source, name, new, space)
    finally:
        new.flush()
        space.close()


def _write_header(
    file: Any,
    variables: list[tuple[Variable, tuple[int, ...]]],
    coordinates: dict[str, tuple[str, ...]],
    attributes: Attributes,
    count: int,
    layout: Any,
) -> None:
    """Attributes, coordinates and variables of `count` empty frames; `layout(shape, count)` gives their storage."""
    file.attrs.update(attributes)
    file.attrs["Conventions"] = CONVENTIONS
    time = file.create_dataset("time", (count,), "f8", maxshape=(None,), fillvalue=np.nan, **layout((), count))
    time.attrs.update({"units": "s", "long_name": "time"})
    scales = {"time": time}
    for dim, names in coordinates.items():
        scales[dim] = file.create_dataset(dim, data=np.array(names, dtype=object), dtype=h5py.string_dtype())
    for dim, scale in scales.items():
        scale.make_scale(dim)
    _create_variables(file, scales, variables, count, layout)


def _create_variables(
    file: Any, scales: dict[str, Any], variables: list[tuple[Variable, tuple[int, ...]]], count: int, layout: Any
) -> None:
    """In HDF5's own calls: what variables of one shape share is made once, and so is the list of those that refer to a scale, which h5py's
    `attach_scale` writes anew for each, with an effort that is quadratic in their number."""
    made: dict[tuple[int, ...], tuple[Any, Any, Any]] = {}  # type, space and properties by shape
    users: dict[str, list[tuple[Any, int]]] = {dim: [] for dim in scales}
    text, references = h5py.string_dtype(), h5py.special_dtype(vlen=h5py.ref_dtype)
    of_text, of_lists = (h5py.h5t.py_create(np.dtype(each), logical=True) for each in (text, references))
    scalar = h5py.h5s.create(h5py.h5s.SCALAR)
    for variable, shape in variables:
        name = name_in_file(variable.name)
        if shape in made:
            own = h5py.h5d.create(file.id, name.encode(), *made[shape])
        else:
            stored = {"maxshape": (None, *shape), **layout(shape, count)}
            own = file.create_dataset(name, (count, *shape), "f8", fillvalue=np.nan, **stored).id
            made[shape] = (own.get_type(), own.get_space(), own.get_create_plist())
        for key, value in (("units", variable.units), ("long_name", variable.long_name)):
            h5py.h5a.create(own, key.encode(), of_text, scalar).write(np.array(value, dtype=text))
        lists = np.empty(len(variable.dims), dtype=references)
        for axis, dim in enumerate(variable.dims):
            lists[axis] = np.array([scales[dim].ref], dtype=h5py.ref_dtype)
            users[dim].append((h5py.h5r.create(own, b".", h5py.h5r.OBJECT), axis))
        h5py.h5a.create(own, b"DIMENSION_LIST", of_lists, h5py.h5s.create_simple(lists.shape)).write(lists)
    kind = np.dtype([("dataset", h5py.ref_dtype), ("dimension", "u4")])
    for dim, each in users.items():
        if each:
            scales[dim].attrs.create("REFERENCE_LIST", np.array(each, dtype=kind))


def _running_chunks(shape: tuple[int, ...], _count: int) -> dict[str, Any]:
    """Chunks of whole frames."""
    return {"chunks": (int(np.clip(RUNNING_CHUNK // (8 * prod(shape)), 1, 1024)), *shape)}


def _final_chunks(shape: tuple[int, ...], count: int) -> dict[str, Any]:
    """Chunks that run along time and hold as many neighbouring columns as fit; compressed."""
    rows = int(np.clip(count, 1, FINAL_ROWS))
    room = max(FINAL_CHUNK // (8 * rows), 1)
    sides: list[int] = []
    for length in reversed(shape):
        side = min(length, room)
        sides.insert(0, side)
        room = max(room // side, 1) if side == length else 1
    return {"chunks": (rows, *sides), "shuffle": True, "compression": "gzip", "compression_opts": COMPRESSION_LEVEL}


def _append(file: Any, name: str, block: NDArray[np.float64]) -> None:
    dataset = h5py.h5d.open(file.id, name_in_file(name).encode())
    start = dataset.shape[0]
    dataset.set_extent((start + len(block), *block.shape[1:]))
    _write_rows(dataset, start, block)


def _write_rows(dataset: Any, start: int, block: NDArray[np.float64]) -> None:
    """Write frames from the number `start` on."""
    place = dataset.get_space()
    place.select_hyperslab((start, *[0] * (block.ndim - 1)), block.shape)
    dataset.write(h5py.h5s.create_simple(block.shape), place, np.ascontiguousarray(block, dtype=np.float64))


def _copy(source: StoredContents, name: str, new: Any, space: Space) -> None:
    """In parts of whole chunks: a long run need not fit in memory."""
    dataset = h5py.h5d.open(new.id, name_in_file(name).encode())
    for start in range(0, source.frame_count, FINAL_ROWS):
        block = source.read(name, (slice(start, start + FINAL_ROWS),))
        space.ensure(block.nbytes + FINAL_CHUNK)
        _write_rows(dataset, start, block)


def _header_size(attributes: Attributes) -> int:
    """Bytes that are enough for the attributes and all that is created before the first frame."""
    return HEADER + sum(4 * len(str(value)) for value in attributes.values())


def save(contents: Contents, path: str | os.PathLike[str], *, force: bool) -> Path:
    """Write a result file, which `nivel.open_result` reads back. Raises ModelError where it exists and `force` is not given."""
    target = Path(path)
    if isinstance(contents, MemoryContents):
        store = Store(target, force)
        store.begin(contents.header)
        store.take(contents.frames)
        store.close(contents.attributes)
        return target
    if isinstance(contents, StoredContents):
        check_target(target, "result file", force=force, sources=[contents.path])
        with written(target, "result file") as draft:
            copyfile(contents.path, draft)
    return target
