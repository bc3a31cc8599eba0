"""Copies of results as files, whether they are in memory or in files already."""

from __future__ import annotations

import os
from pathlib import Path
from shutil import copyfile

from nivel.files.target import check_target, written
from nivel.results.frames.contents import Contents
from nivel.results.frames.stored import StoredContents
from nivel.results.memory import MemoryContents
from nivel.results.store import Store


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
