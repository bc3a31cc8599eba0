"""Object files that were compiled once: the user's cache of machine code.

A file is named by its entry and by a digest of everything the machine code depends on, so a changed source, compiler or processor
finds no file and nothing is ever stale. It is written beside its place and moved there, so it is whole or absent; its first bytes are
a digest of the rest, so a damaged file is found out and compiled again. Where a folder or a device has its name, it gets another one.
Files stand in a folder that only the user can write; where there is none, in a new folder for this process.
"""

import errno
import hashlib
import os
import platform
import shutil
import stat
import sys
import tempfile
import threading
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from glob import escape
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from nivel.native.processor import described

DIGEST = 32  # bytes
FORSAKEN = 600  # [s] a draft that nobody has written for so long, by a process that has ended, is left behind
MOST_BESIDE = 10  # names that are tried where folders or devices stand in the place of files


@cache
def folder() -> Path:
    """``<user cache>/nivel/objects``, or a new temporary folder where that cannot be used. ``NIVEL_CACHE_DIR`` names another place for the
    user cache."""
    path = Path(os.environ.get("NIVEL_CACHE_DIR") or _user_cache()) / "objects"
    try:
        path.mkdir(parents=True, exist_ok=True, mode=0o700)
        if open_to_others(path):
            warnings.warn(f"{path} can be written by others; machine code is kept for this process only", stacklevel=2)
        else:
            with tempfile.TemporaryFile(dir=path):
                return path
    except OSError:
        pass
    return Path(tempfile.mkdtemp(prefix="nivel-objects-"))


def open_to_others(path: Path) -> bool:
    """Whether somebody else owns or may write this folder."""
    if os.name != "posix":
        return False
    facts = path.stat()
    return facts.st_uid != os.getuid() or bool(facts.st_mode & (stat.S_IWGRP | stat.S_IWOTH))


def path_of(symbol: str, *depends_on: str) -> Path:
    """Where the object file with this symbol is kept, for the text it is made of."""
    digest = hashlib.sha256("\0".join((symbol, *depends_on, *compiler())).encode()).hexdigest()
    path = folder() / f"{symbol[-80:]}-{digest[:24]}.o"
    for number in range(1, MOST_BESIDE):
        if not _is_occupied(path):
            break
        path = path.with_name(f"{symbol[-80:]}-{digest[:24]}-{number}.o")
    return path


def _is_occupied(path: Path) -> bool:
    """Whether something stands there that is no file and cannot be replaced by one, such as a folder, or must not be read, as a device."""
    try:
        return not stat.S_ISREG(path.stat().st_mode)
    except OSError:  # nothing, or a link that leads nowhere, which is replaced
        return False


def read(path: Path) -> bytes | None:
    """The object file; None where there is none, or a damaged one, which is removed with a warning."""
    if _is_occupied(path):
        return None
    try:
        content = path.read_bytes()
    except OSError:
        return None
    code = content[DIGEST:]
    if code and hashlib.sha256(code).digest() == content[:DIGEST]:
        return code
    warnings.warn(f"{path} is damaged; it is compiled again", stacklevel=2)
    with suppress(OSError):
        path.unlink()
    return None


def write(path: Path, code: bytes) -> None:
    """Keep an object file. Raises OSError, which names it."""
    try:
        with whole(path) as draft:
            draft.write_bytes(hashlib.sha256(code).digest() + code)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A file beside `path` to be written, which takes the place of `path` when the block ends and its bytes have reached the disk.

    So `path` is whole, or as it was. Where it is a link, what it leads to is replaced, with the permissions that this has; a device or a
    pipe is written into. Drafts of processes that were killed are removed. Raises OSError.
    """
    if _is_occupied(path):
        yield path
        return
    target = Path(os.path.realpath(path))
    if target.exists() and not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
    start = target.name.encode()[:100].decode(errors="ignore")  # the name of a file has 255 bytes at most
    _remove_left_behind(target.parent, start)
    draft = target.with_name(f".{start}.{threading.get_ident()}.{os.getpid()}.part")
    try:
        draft.open("xb").close()
        if target.exists():
            shutil.copymode(target, draft)
        yield draft
        with draft.open("r+b") as file:
            os.fsync(file.fileno())
        draft.replace(target)
    except BaseException:
        with suppress(OSError):
            draft.unlink()
        raise


def _remove_left_behind(folder: Path, start: str) -> None:
    """Remove drafts of this file that were never finished, as their writers were killed some time ago."""
    for left in folder.glob(f".{escape(start)}.*.part"):
        writer = left.name.split(".")[-2]
        try:
            if time.time() - left.stat().st_mtime > FORSAKEN and not (writer.isdecimal() and _runs(int(writer))):
                left.unlink()
        except OSError:  # another one removes it, or it is not ours
            continue


def _runs(process: int) -> bool:
    try:
        os.kill(process, 0)
    except OSError as error:
        return isinstance(error, PermissionError)
    return True


@cache
def compiler() -> tuple[str, ...]:
    """What makes machine code, and for which processor or level of processors."""
    versions = []
    for package in ("numba", "llvmlite", "numpy"):
        try:
            versions.append(version(package))
        except PackageNotFoundError:
            versions.append("none")
    return (*versions, f"{sys.version_info[:2]}", platform.machine(), described())


def _user_cache() -> Path:
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or str(Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = str(Path.home() / "Library" / "Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "nivel"
