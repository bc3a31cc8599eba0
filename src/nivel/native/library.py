"""Addresses of entries: in the library that a wheel brought along, or in object files of the user's cache, compiled first where there is
none."""

import atexit
import sys
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from typing import Any, Final

from nivel.native import store, workers
from nivel.native.entry import Entry
from nivel.native.processor import target
from nivel.native.shipped import address_in_library, fits
from nivel.native.signature import Signature
from nivel.native.sources import fingerprint, keep

# addresses of what machine code reads besides its arguments, by name
VARIABLES: Final[dict[str, int]] = {}


def address_of(entry: Entry) -> int:
    """Address of an entry; compiled first where there is no object file, which is said."""
    if (found := _loaded.get(entry.name)) is not None:
        return found
    if (shipped := address_in_library(entry)) is not None:
        return _loaded.setdefault(entry.name, shipped)
    if not _path(entry).exists():
        print(f"compiling {entry.name} (only the first run does this)", file=sys.stderr)
    return _loaded.setdefault(entry.name, _link(entry.symbol, object_code(entry)))


def missing(entries: Iterable[Entry]) -> list[Entry]:
    """Those without machine code."""
    asked = dict.fromkeys(entry for entry in entries if entry.name not in _loaded)
    left = [entry for entry in asked if not fits(entry) and not _path(entry).exists()]
    keep(entry.name for entry in asked)
    return left


def object_code(entry: Entry) -> bytes:
    """The object file of an entry, for this processor or the level asked for. Raises CompilationError."""
    path = _path(entry)
    code = store.read(path)
    if code is None:
        workers.compile_all([_job(entry)])
        code = store.read(path)
    assert code is not None, f"{path} cannot be read"
    return code


def object_codes_for(entries: Sequence[Entry], target: tuple[str, str, str]) -> dict[str, bytes]:
    """Object files by symbol, for another processor or system: what LLVM compiles for. Raises CompilationError."""
    paths = {
        entry: store.path_of(entry.symbol, str(entry.signature), fingerprint(entry.name), *target) for entry in entries
    }
    codes = {entry.symbol: store.read(path) for entry, path in paths.items()}
    missing = [entry for entry in entries if codes[entry.symbol] is None]
    workers.compile_all([job_of(entry, [(str(paths[entry]), target)]) for entry in missing])
    for entry in missing:
        codes[entry.symbol] = store.read(paths[entry])
    return {symbol: code for symbol, code in codes.items() if code is not None}


def build(entries: Iterable[Entry], done: Callable[[str], None] = lambda name: None) -> None:
    """Compile those that have no machine code, in parallel; done(name) is called as each is finished."""
    jobs = [_job(entry) for entry in missing(entries)]
    workers.compile_all(jobs, lambda job: done(job["entry"]))


def address_of_law(text: str, signature: Signature) -> int:
    """Address of the function `nivel_law` of the text of a module, for `LAW` or that on dual numbers. Raises CompilationError."""
    made_by = fingerprint("nivel.kernels.algebra.analytic"), fingerprint("nivel.native.with_numba.laws")
    path = store.path_of("nivel_law", text, str(signature), *made_by)
    if (found := _loaded.get(path.name)) is not None:
        return found
    code = store.read(path)
    if code is None:
        job = {"text": text, "file": f"<{path.stem}>", "symbol": "nivel_law", "path": str(path), "target": target()}
        try:
            workers.compile_all([{**job, "result": signature.result, "arguments": signature.arguments}])
        except workers.CompilationError as problem:
            if problem.kind != workers.NEEDS_NUMBA:
                raise
            from nivel.native.with_numba.laws import address_here

            return _loaded.setdefault(path.name, address_here(text, f"<{path.stem}>", signature))
        code = store.read(path)
    assert code is not None, f"{path} cannot be read"
    return _loaded.setdefault(path.name, _link("nivel_law", code))


def _path(entry: Entry) -> Any:
    if entry.name.startswith("__main__:"):
        message = (
            f"`{entry.name}` stands in the program that runs; put it into a module beside it, which the program imports"
        )
        raise workers.CompilationError(message, "InProgramError")
    return store.path_of(entry.symbol, str(entry.signature), fingerprint(entry.name))


def _job(entry: Entry) -> dict[str, Any]:
    return job_of(entry, [(str(_path(entry)), target())])


def job_of(entry: Entry, targets: list[tuple[str, tuple[str, str, str] | None]]) -> dict[str, Any]:
    """What a worker is told: the files to write, each with what LLVM compiles for (processor, features, system), or for this one."""
    sources = fingerprint(entry.name)
    return {"entry": entry.name, "symbol": entry.symbol, "sources": sources, "targets": targets}


# addresses of what is in memory
_loaded: dict[str, int] = {}


@cache
def _linker() -> Any:
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    linker = binding.create_lljit_compiler()
    # the end of the process takes it away, not the interpreter, which may do so too early
    atexit.register(linker.detach)
    return linker


def _link(symbol: str, code: bytes) -> int:
    """Load an object file; returns the address of its symbol."""
    from llvmlite import binding

    linker = _linker()
    name = f"{symbol}-{len(_loaded)}"
    builder = binding.JITLibraryBuilder().add_object_img(code).add_current_process().export_symbol(symbol)
    for each, address in VARIABLES.items():
        builder.import_symbol(each, address)
    library = builder.link(linker, name)
    address = int(library[symbol])
    library.detach()  # it stays in memory as long as the process does
    return address
