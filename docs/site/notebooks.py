"""Notebooks as pages: each is executed when the site is built, so that what it shows is what the program said."""

from __future__ import annotations

from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbconvert import MarkdownExporter

LONGEST = 600  # [s] for one cell


def notebook_page(path: Path, *, executed: bool = True) -> tuple[str, dict[str, bytes]]:
    """A notebook as Markdown, and the pictures that it shows, by name; with `executed` as it is after a run of all its cells."""
    notebook = nbformat.read(path, as_version=4)
    if executed:
        NotebookClient(notebook, timeout=LONGEST, kernel_name="python3").execute(cwd=str(path.parent))
    text, found = MarkdownExporter().from_notebook_node(notebook, {"unique_key": path.stem})
    return text, dict(found["outputs"])
