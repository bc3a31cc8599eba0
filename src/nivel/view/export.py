"""Export of a view as one HTML file with everything inside."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from nivel.files.target import keep_sources, write_file
from nivel.results.result import Result
from nivel.view.page import page_alone
from nivel.view.playback import ALONE, Budget, playback
from nivel.view.sources import Source


def scene_html(results: Sequence[Result], budget: Budget = ALONE) -> str:
    """The page of a result, with further ones as ghosts: it needs no network and nothing beside it."""
    return page_alone(playback(results, budget), results[0].name)


def page_of(source: Source) -> str:
    """The page of a source, without what would come later."""
    return page_alone(source.package(), "nivel")


def write_scene(results: Sequence[Result], path: str | os.PathLike[str]) -> Path:
    """Write the page of results to `path`; an existing file is replaced."""
    target = Path(path)
    keep_sources(target, "page", [result.path for result in results if result.path])
    return write_file(target, "page", scene_html(results))


def write_page(source: Source, path: Path) -> Path:
    """Write the page of a source to `path`; an existing file is replaced."""
    return write_file(path, "page", page_of(source))
