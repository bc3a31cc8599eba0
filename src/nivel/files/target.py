"""Targets of output: what may not be written over, even where the user asks to replace files; files are written whole or not at all."""

import os
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any
from weakref import finalize

from nivel.errors import ModelError
from nivel.native.store import whole


def check_target(path: Path, what: str, *, force: bool, sources: Iterable[Path] = ()) -> None:
    """Refuse to write `what` ("result file", "report", …) to `path` where that cannot be done or would destroy something.

    The folder has to be there and to take files. An existing file is replaced with `force` only; what is not a regular file, and what is
    one of the files `sources` under any name, never is. Raises ModelError.
    """
    found = status(path, what)
    if found is None:
        _check_folder(path, what)
        return
    if stat.S_ISDIR(found.st_mode):
        raise ModelError(f"{path} is a folder; the name of a {what} was expected")
    if not stat.S_ISREG(found.st_mode):
        raise ModelError(f"{path} is {_kind(found.st_mode)}, not a file; the name of a {what} was expected")
    keep_sources(path, what, sources)
    if not force:
        raise ModelError(f"the {what} {path} exists already; use --force to overwrite it (in Python: force=True)")
    _check_folder(path, what)


def _check_folder(path: Path, what: str) -> None:
    """Refuse to write `what` to `path` where its folder is none, or may not be written into. Raises ModelError."""
    folder = path.parent
    if not os.path.exists(folder):  # Path.exists raises where the name is too long
        raise ModelError(f"there is no folder {folder} for the {what} {path.name}")
    if not os.path.isdir(folder):
        raise ModelError(f"{folder} is not a folder, so the {what} {path.name} cannot be written there")
    if not os.access(folder, os.W_OK):
        raise ModelError(f"nothing may be written into the folder {folder}: permission denied")


def check_text_target(path: Path, what: str, *, force: bool, sources: Iterable[Path] = ()) -> None:
    """As `check_target`, for a text that is written into the file that stands at `path`. Raises ModelError."""
    check_target(path, what, force=force, sources=sources)
    if path.exists() and not os.access(path, os.W_OK):
        raise ModelError(f"the {what} {path} cannot be written: permission denied")


def keep_sources(path: Path, what: str, sources: Iterable[Path]) -> None:
    """Refuse to write `what` to `path` where that is one of the files `sources`, which are read. Raises ModelError."""
    found = status(path, what)
    for source in sources:
        read = status(source, what)
        if found is not None and read is not None and os.path.samestat(found, read):
            raise ModelError(
                f"the {what} {path} would be written over {source}, which it is made from; give it another name"
            )


def status(path: Path, what: str) -> os.stat_result | None:
    """What stands at `path`, or None where nothing does. Raises ModelError where the path cannot be one."""
    try:
        return path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return None
    except (OSError, ValueError) as error:
        reason = reason_of(error) if isinstance(error, OSError) else str(error).lower()
        raise ModelError(f"the {what} {path} cannot be written: {reason}") from None


def _kind(mode: int) -> str:
    if stat.S_ISFIFO(mode):
        return "a pipe"
    return "a socket" if stat.S_ISSOCK(mode) else "a device"


@contextmanager
def written(path: str | os.PathLike[str], what: str) -> Iterator[Path]:
    """A file beside `path` that takes its place when the block ends (`nivel.native.store.whole`). Raises ModelError where it cannot."""
    target = Path(path)
    status(target, what)
    try:
        with whole(target) as draft:
            yield draft
    except OSError as error:
        raise ModelError(f"the {what} {target} cannot be written: {reason_of(error)}") from error


def write_file(path: str | os.PathLike[str], what: str, content: str | bytes | memoryview) -> Path:
    """Write a file as a whole; an existing one is replaced. Raises ModelError where it cannot be written."""
    with written(path, what) as draft:
        draft.write_bytes(content.encode() if isinstance(content, str) else content)
    return Path(path)


def reason_of(error: OSError) -> str:
    """Why a file cannot be read or written: the system's own words, without those of the HDF5 library around them."""
    return os.strerror(error.errno).lower() if error.errno else str(error).lower()


def write_text(text: str, path: str | os.PathLike[str] | None, what: str, *, force: bool) -> str:
    """Write `text` to `path`, if there is one; returns it. `what` it is, for the message where it cannot be written.

    An existing file is replaced with `force` only.
    """
    if path is not None:
        check_target(Path(path), what, force=force)
        write_file(path, what, text)
    return text


def write_page(text: str, path: str | os.PathLike[str], *, force: bool = True) -> Path:
    """Write the page `text` to `path`, and return that. An existing file is replaced with `force` only."""
    write_text(text, path, "report", force=force)
    return Path(path)


class Growing:
    """A file at whose end pieces are written, each whole or not at all, by one process at a time; `end` : of the last [bytes].

    Raises OSError where it cannot be written, BlockingIOError where another process writes it.
    """

    def __init__(self, path: Path) -> None:
        # not truncated by the opening: another process may write it
        self.stream: IO[bytes] = os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "r+b", buffering=0)
        self.end = 0
        finalize(self, self.stream.close)

    def claim(self) -> None:
        """Keep other processes away."""
        with suppress(ImportError):  # Windows
            import fcntl

            fcntl.flock(self.stream, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def add(self, content: bytes) -> None:
        """One more piece. Where that fails, as on a full disk, the file is as it was before."""
        done = 0
        try:
            self.stream.seek(self.end)
            while done < len(content):
                done += self.stream.write(content[done:])
        except OSError:
            self.stream.truncate(self.end)
            raise
        self.end += done


AHEAD = 1024 * 1024  # bytes taken beyond what is needed now, so that small blocks do not take space each time
PIECE = bytes(256 * 1024)


class Space:
    """Room behind the end of an HDF5 file that is open for writing."""

    def __init__(self, path: Path, file: Any) -> None:
        self._path = path
        self._file = file

    def ensure(self, size: int) -> None:
        """Make sure that the file can grow by `size` bytes. Raises OSError where it cannot."""
        end, needed = self._path.stat().st_size, self._file.id.get_filesize() + size
        if end >= needed:
            return
        with self._path.open("r+b", buffering=0) as raw:
            raw.seek(end)
            try:
                while end < needed + AHEAD:
                    end += raw.write(PIECE)
            except OSError:
                if end < needed:
                    raise

    def close(self) -> None:
        """Close the file, which must be flushed, and give back what HDF5 did not use."""
        size = self._file.id.get_filesize()
        self._file.close()
        with self._path.open("r+b", buffering=0) as raw:
            raw.truncate(size)
            os.fsync(raw.fileno())
