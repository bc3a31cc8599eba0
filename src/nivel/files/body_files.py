"""Files of flexible bodies that a machine names: found beside the file that names them."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

from nivel.files.outline import section_of
from nivel.files.sources import beside, is_file
from nivel.files.tree import Tree

KEY: Final = "flexible"


def place_body_files(tree: Tree) -> None:
    """Give the files of flexible bodies their whole names. Faults go to `tree.faults`."""
    for name, body in section_of(tree, "bodies").items():
        if isinstance(body, dict) and KEY in body:
            given, path = body[KEY], ("bodies", name, KEY)
            if isinstance(given, str):
                body[KEY] = _placed(tree, path, given)
            elif isinstance(given, dict) and isinstance(given.get("file"), str):
                given["file"] = _placed(tree, (*path, "file"), given["file"])


def _placed(tree: Tree, path: tuple[Any, ...], given: str) -> str:
    file = beside(tree.file_of(path), given)
    if not is_file(file):
        model = Path(file).with_suffix(".yaml")
        named = model if model.is_file() else "MODEL"
        tree.report(path, f"there is no file `{file}`; `nivel reduce {named} -o {file}` makes it")
        tree.broken.add(path[:2])
    return file
