"""A process that compiles: it answers jobs when their object files are written (`nivel.native.workers`).

A job is the name of an entry and files to write, each for this processor or a named one; or the text of a module whose function `nivel_law`
is one, and the file to write.
"""

import gc
import hashlib
import sys
from functools import cache
from pathlib import Path
from typing import Any

from nivel.native.signature import Signature
from nivel.native.workers import serve

# objects after a job from which on garbage is collected: some hundred megabytes
MOST_LEFT = 3_000_000


def main() -> None:
    """Compile until the input ends."""
    gc.disable()  # what compilers leave lives long: looking through it takes a sixth of the time
    serve(_answer)


def _answer(job: dict[str, Any]) -> tuple[str, str] | None:
    """What went wrong, and the kind of error; None: the files are written."""
    if gc.get_count()[0] > MOST_LEFT:
        gc.collect()
    sys.path[:] = job["places"]
    try:
        _compile(job)
    except OSError:  # no room: it is raised where the job came from
        raise
    except Exception as problem:  # whatever it is, the process that asked has to say it
        return str(problem), type(problem).__name__
    return None


class SourcesChangedError(Exception):
    """Sources were edited while this process compiles."""


class Seen:
    """The files that this process has imported, as they were then: modules in memory do not follow edits."""

    def __init__(self) -> None:
        self._digests: dict[Path, bytes] = {}

    def check(self, entry: str, expected: str) -> None:
        """Raise SourcesChangedError where the sources of an entry are not those that were asked for, or not those in memory."""
        from nivel.native import sources

        sources.look_again()
        changed = sources.fingerprint(entry) != expected
        for path in sources.modules(entry).values():
            changed |= self._digest(path) != hashlib.sha256(path.read_bytes()).digest()
        for name in [name for name in sys.modules if name.startswith("nivel.")]:
            if path := sources.file_of(name):
                self._digest(path)  # a later job may need what stands in it
        if changed:
            raise SourcesChangedError(
                f"sources of {entry.partition(':')[0]} were edited while it was compiled; start the program again"
            )

    def _digest(self, path: Path) -> bytes:
        """Digest of a file as it was when it was first looked at."""
        if path not in self._digests:
            self._digests[path] = hashlib.sha256(path.read_bytes()).digest()
        return self._digests[path]


seen = Seen()


def _compile(job: dict[str, Any]) -> None:
    from nivel.native import store
    from nivel.native.entry import entry_of
    from nivel.native.with_numba import translate
    from nivel.native.with_numba.laws import object_code_of_law

    if "text" in job:
        signature = Signature(job["result"], tuple(job["arguments"]))
        machine = translate.target_machine(*(job["target"] or translate.host()))
        store.write(Path(job["path"]), object_code_of_law(job["text"], job["file"], signature, machine))
        return
    seen.check(job["entry"], job["sources"])
    entry = entry_of(job["entry"])
    module = translate.linked(entry.py_func, entry.signature, job["symbol"])
    if any(processor for _, processor in job["targets"]):
        _all_targets()
    codes = [
        (path, translate.optimised(module, _target_machine(processor or translate.host())))
        for path, processor in job["targets"]
    ]
    seen.check(job["entry"], job["sources"])
    for path, code in codes:
        store.write(Path(path), code)


def _target_machine(processor: tuple[str, ...]) -> Any:
    """LLVM's target. A module of WebAssembly has a memory of its own, in which its code knows all places."""
    from llvmlite import binding

    from nivel.native.with_numba import translate

    cpu, features, triple = (*processor, "")[:3]
    if not triple.startswith("wasm"):
        return translate.target_machine(*processor)
    target = binding.Target.from_triple(triple)
    return target.create_target_machine(cpu=cpu, features=features, opt=3, reloc="static", codemodel="default")


@cache
def _all_targets() -> None:
    """Let LLVM make code for other systems than this one."""
    from llvmlite import binding

    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
