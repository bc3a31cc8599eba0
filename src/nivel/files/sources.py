"""The files that a machine is read from: the main one, and those that it names."""

from collections.abc import Callable
from difflib import get_close_matches
from pathlib import Path as FilePath
from stat import S_ISDIR, S_ISREG
from typing import Final, TypeVar

from nivel.errors import Fault, ModelError
from nivel.files.tree import Path, Tree
from nivel.lazy import Struct, field, replace
from nivel.machine.units.quantity import shown

_COLUMN: Final = ", not a machine file; a machine reads a {}: `{{{{csv: {{file}}, column: {}}}}}`"
_BEGINNINGS: Final[dict[tuple[bytes, ...], str]] = {
    (
        b"\x89HDF\r\n",
    ): "this is a result, not a machine file: `nivel view {file}` plays it, `nivel explain {file}` says how far it can be "
    "trusted; the machine that made it is the file that was run",
    (b"CDF\x01", b"CDF\x02"): "this is a NetCDF-3 file, not a machine file",
    (b"<!doctype html", b"<html"): "this is a page for a browser, such as a report of nivel, not a machine file",
    (b"par1",): f"this is a table (Parquet){_COLUMN.format('column', 'NAME')}",
    (b"matlab 5.0",): f"this is a table (MAT){_COLUMN.format('column', 'NAME')}",
    (b"mdf     ",): f"this is a recording (MDF){_COLUMN.format('signal', 'NAME')}",
    (b"\x89MCAP0\r\n",): f"this is a recording (MCAP){_COLUMN.format('signal', '/TOPIC.FIELD')}",
    (b"PK\x03\x04",): "this is a zip file, not a machine file",
    (
        b"solid ",
    ): "this is a mesh (STL), not a machine file; a body refers to it: `shape: {{type: mesh, file: {file}}}`",
    (
        b"iso-10303-21",
    ): "this is a CAD file (STEP), not a machine file; `nivel import {file} --out machine.yaml` makes bodies of its solids",
}
_ROOTS: Final[tuple[tuple[bytes, str], ...]] = (
    (b"<robot", "URDF"),
    (b"<mujoco", "MuJoCo"),
    (b"<sdf", "SDF"),
    (b"<?xml", "XML"),
)
_LOOKED_AT: Final = 4000  # bytes


def foreign_content(content: bytes) -> str:
    """What the file with this `content` is, and what to do, with `{file}` for its name; empty where it may be a machine file."""
    start = content[:_LOOKED_AT]
    text = start.removeprefix(b"\xef\xbb\xbf").lstrip().lower()
    for beginnings, answer in _BEGINNINGS.items():
        if start.startswith(beginnings) or text.startswith(beginnings):
            return answer
    if text.startswith(b"<"):
        for root, name in _ROOTS:
            if root in text:
                if name == "XML":
                    return "this is XML, not a machine file"
                return f"this is a model in {name}, not a machine file; `nivel import {{file}} --out machine.yaml` translates it"
    return ""


Content = TypeVar("Content", str, bytes)

DEEPEST: Final = 20  # files that name files
LARGEST: Final = 500 * 10**6  # bytes of a file
MOST: Final = 2000  # files read for one machine, each as often as it is used


class Sources(Struct):
    """How the files of a machine are read.

    allow_code : laws may run Python code. open : the files that led to the present one, outermost first. read : every
    file read so far. again : parts are read once more, to tell faults of their own from those of given parameters.
    """

    allow_code: bool = False
    open: tuple[FilePath, ...] = ()
    read: list[str] = field(default_factory=list)
    again: bool = False

    def inside(self, file: str) -> "Sources":
        """The same while `file` is read."""
        return replace(self, open=(*self.open, resolved(file)))

    def text(self, tree: Tree, path: Path, name: object, breaks: Path | None = None) -> tuple[str, str] | None:
        """Text and name of the file `name`, which `path` of `tree` mentions; None where there is a fault, which has
        been reported, so that nothing under `breaks` is.
        """
        return self._found(tree, path, name, read_text, breaks)

    def content(self, tree: Tree, path: Path, name: object, breaks: Path | None = None) -> tuple[bytes, str] | None:
        """As `text`, of a file that holds no text."""
        return self._found(tree, path, name, read_bytes, breaks)

    def _found(
        self, tree: Tree, path: Path, name: object, read: Callable[[str], Content], breaks: Path | None
    ) -> tuple[Content, str] | None:
        file = self._file(tree, path, name)
        found = None if file is None else self._read(tree, path, file, read)
        if found is None and breaks is not None:
            tree.broken.add(breaks)
        return found

    def _file(self, tree: Tree, path: Path, name: object) -> str | None:
        if not isinstance(name, str) or not name.strip():
            tree.report(path, f"the name of a file was expected, got {shown(name)}")
            return None
        file = beside(tree.file_of(path), name)
        ring = self.ring(file)
        if ring:
            tree.report(path, f"the file leads back to itself: {ring}")
        elif len(self.open) > DEEPEST:
            tree.report(path, f"more than {DEEPEST} files lead from one to the next")
        elif len(self.read) >= MOST:
            tree.report(path, f"the machine is made of more than {MOST} files")
        elif not is_file(file):
            tree.report(path, f"there is no file `{file}`{_nearest(file)}")
        else:
            self.read.append(file)
            return file
        return None

    def ring(self, file: str) -> str:
        """The files from `file` back to itself, or an empty text."""
        target = resolved(file)
        if target not in self.open:
            return ""
        return " → ".join(each.name for each in (*self.open[self.open.index(target) :], target))

    def _read(self, tree: Tree, path: Path, file: str, read: Callable[[str], Content]) -> tuple[Content, str] | None:
        try:
            return read(file), file
        except ModelError as error:
            for fault in error.faults:
                if fault.line:
                    tree.faults.append(fault)
                else:
                    tree.faults.append(tree.fault(path, f"`{file}`: {fault.message}"))
            tree.broken.add(path)
            return None


def beside(file: str, name: str) -> str:
    """The file `name` seen from the folder of `file`."""
    return str(FilePath(file).parent / name)


def resolved(file: str) -> FilePath:
    """One path for all names of a file."""
    try:
        return FilePath(file).resolve()
    except (OSError, ValueError, RuntimeError):
        return FilePath(file)


def is_file(file: str) -> bool:
    """Whether there is such a regular file."""
    try:
        return FilePath(file).is_file()
    except (OSError, ValueError):
        return False


def _nearest(file: str) -> str:
    """A hint at a file with a similar name in the same folder."""
    path = FilePath(file)
    try:
        names = [each.name for each in path.parent.iterdir() if each.is_file()]
    except (OSError, ValueError):
        return ""
    near = get_close_matches(path.name, names, n=1, cutoff=0.6)
    return f"; did you mean `{path.parent / near[0]}`?" if near else ""


def read_text(path: str | FilePath) -> str:
    """The text of the file at `path`.

    Raises ModelError where it cannot be read, or is not UTF-8.
    """
    content, file = read_bytes(path), str(path)
    if what := foreign_content(content):
        raise ModelError(Fault(file, 1, 1, "", what.format(file=file)))
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = content[: error.start]
        line, column = before.count(b"\n") + 1, error.start - (before.rfind(b"\n") + 1) + 1
        message = f"the file is not UTF-8 text: the byte 0x{content[error.start]:02x} stands here; save it as UTF-8"
        raise ModelError(Fault(file, line, column, "", message)) from None


def _near_file(file: str) -> str:
    """The file that may be meant: with an ending, or of a similar name beside it; empty where there is none."""
    found = next((each for end in (".yaml", ".yml") if FilePath(each := f"{file}{end}").is_file()), "")
    path = FilePath(file)
    if found or not path.suffix:
        return found
    try:
        beside = sorted(each.name for each in path.parent.iterdir() if each.suffix in (path.suffix, ".yaml", ".yml"))
    except OSError:
        return ""
    near = get_close_matches(path.name, beside, n=1, cutoff=0.8)
    return str(path.parent / near[0]) if near else ""


def read_bytes(path: str | FilePath) -> bytes:
    """The content of the file at `path`.

    Raises ModelError where it cannot be read, is no plain file (a device, a pipe), or is larger than LARGEST.
    """
    file = str(path)
    try:
        facts = FilePath(path).stat()
        if not (S_ISREG(facts.st_mode) or S_ISDIR(facts.st_mode)):
            raise ModelError(Fault(file, 0, 0, file, "this is a device or a pipe; a file was expected"))
        if facts.st_size > LARGEST:
            size = f"{facts.st_size / 1e6:.0f} MB"
            raise ModelError(Fault(file, 0, 0, file, f"the file has {size}; up to {LARGEST // 10**6} MB are read"))
        return FilePath(path).read_bytes()
    except FileNotFoundError:
        near = _near_file(file)
        meant = f"; did you mean `{near}`?" if near else ""
        raise ModelError(Fault(file, 0, 0, file, f"there is no such file{meant}")) from None
    except IsADirectoryError:
        raise ModelError(Fault(file, 0, 0, file, "this is a directory; a machine file was expected")) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ModelError(Fault(file, 0, 0, file, f"the file cannot be read: {reason}")) from None
