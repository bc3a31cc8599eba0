"""Files of bodies that a machine names: flexible bodies, and mass properties that another program wrote."""

from pathlib import Path
from typing import Any, Final

from nivel.errors import ModelError
from nivel.files.outline import section_of
from nivel.files.sources import Sources, beside, is_file
from nivel.files.tree import Tree, read_tree
from nivel.machine.core.record import unknown_word
from nivel.machine.units.quantity import shown

KEY: Final = "mass_properties"
WORDS: Final = ("mass", "centre_of_mass", "inertia", "inertia_about")


def read_mass_properties(tree: Tree, sources: Sources) -> None:
    """Put what the files under `mass_properties` say into the bodies that name them. Faults go to `tree.faults`."""
    for name, body in section_of(tree, "bodies").items():
        if isinstance(body, dict) and KEY in body:
            _read(tree, sources, name, body)


def _read(tree: Tree, sources: Sources, name: str, body: dict[str, Any]) -> None:
    path = ("bodies", name, KEY)
    found = sources.text(tree, path, body.pop(KEY), breaks=path[:2])
    if found is None:
        return
    text, file = found
    if file.endswith(".json"):
        text = text.replace("\t", " ")  # a tab between the words of JSON is none in YAML
    try:
        part = read_tree(text, file)
    except ModelError as error:
        tree.faults += error.faults
        tree.broken.add(path[:2])
        return
    if not isinstance(part.data, dict) or not part.data:
        part.report((), f"a mapping with {', '.join(WORDS)} was expected, got {shown(part.data)}")
        tree.broken.add(path[:2])
    else:
        _merge(tree, part, name, body)
    tree.faults += part.faults


def _merge(tree: Tree, part: Tree, name: str, body: dict[str, Any]) -> None:
    moves = {}
    for key, value in part.data.items():
        here = ("bodies", name, key)
        if key not in WORDS:
            part.report((key,), unknown_word(key, WORDS, "key"), at_key=True)
            tree.broken.add(here[:2])
        elif key not in body:
            body[key] = value
            moves[(key,)] = here
        else:
            tree.report(here, f"`{key}` stands in `{part.file}` as well", at_key=True)
    tree.graft(part, moves)


FLEXIBLE: Final = "flexible"


def place_body_files(tree: Tree) -> None:
    """Give the files of flexible bodies their whole names. Faults go to `tree.faults`."""
    for name, body in section_of(tree, "bodies").items():
        if isinstance(body, dict) and FLEXIBLE in body:
            given, path = body[FLEXIBLE], ("bodies", name, FLEXIBLE)
            if isinstance(given, str):
                body[FLEXIBLE] = _placed(tree, path, given)
            elif isinstance(given, dict) and isinstance(given.get("file"), str):
                given["file"] = _placed(tree, (*path, "file"), given["file"])


def _placed(tree: Tree, path: tuple[Any, ...], given: str) -> str:
    file = beside(tree.file_of(path), given)
    if not is_file(file):
        model = Path(file).with_suffix(".yaml")
        named = model if model.is_file() else "MODEL"
        tree.report(path, f"there is no file `{file}`; `nivel reduce {named} -o {file}` makes it", breaks=path[:2])
    return file
