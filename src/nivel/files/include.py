"""Files that a machine file names: `include:`, whose sections stand as if in this one; flexible bodies, and mass properties that another
program wrote."""

import pathlib
import re
from typing import Annotated, Any, Final

from pydantic import BeforeValidator, ValidationError

from nivel.errors import Fault, ModelError
from nivel.files.outline import FORMAT, NAMED, VALUES, as_part, check_sections, check_start, section_of
from nivel.files.sources import Sources, beside, is_file
from nivel.files.tree import Path, Tree, read_tree
from nivel.machine.core.record import FileName, Record, unknown_word
from nivel.machine.units.quantity import FAULT, fault, shown

KEY: Final = "mass_properties"
WORDS: Final = ("mass", "centre_of_mass", "inertia", "inertia_about")


def read_mass_properties(tree: Tree, sources: Sources) -> None:
    """Put what the files under `mass_properties` say into the bodies that name them. Faults go to `tree.faults`."""
    for name, body in section_of(tree, "bodies").items():
        if isinstance(body, dict) and KEY in body:
            _read_body(tree, sources, name, body)


def _read_body(tree: Tree, sources: Sources, name: str, body: dict[str, Any]) -> None:
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
        _merge_body(tree, part, name, body)
    tree.faults += part.faults


def _merge_body(tree: Tree, part: Tree, name: str, body: dict[str, Any]) -> None:
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
        model = pathlib.Path(file).with_suffix(".yaml")
        named = model if model.is_file() else "MODEL"
        tree.report(path, f"there is no file `{file}`; `nivel reduce {named} -o {file}` makes it", breaks=path[:2])
    return file


TAKEN: Final = tuple(section for section in NAMED if section not in VALUES)

STARTS: Final = re.compile(r"""^\s*\{?\s*["']?format["']?\s*:""", re.MULTILINE)


def _sections(value: Any) -> Any:
    entries = [value] if isinstance(value, str) else value
    for word in entries if isinstance(entries, list | tuple) else ():
        if word not in TAKEN:
            raise fault(unknown_word(shown(word).strip("`"), TAKEN, "section"))
    return entries


Sections = Annotated[tuple[str, ...], BeforeValidator(_sections)]


class Include(Record):
    """A file whose sections are taken; `only` some of them."""

    file: FileName
    only: Sections | None = None


def include(tree: Tree, sources: Sources) -> None:
    """Merge the files that `tree` includes into it, their elements before its own. Faults go to `tree.faults`."""
    given = tree.data.pop("include", None)
    if given is None:
        return
    merged: dict[str, dict[str, Any]] = {section: {} for section in NAMED}
    entries = list(enumerate(given)) if isinstance(given, list) else [(None, given)]
    for at, entry in entries:
        path: Path = ("include",) if at is None else ("include", at)
        part = _read(tree, path, entry, sources)
        if part is None:
            tree.unread.add("")
            continue
        for section in NAMED:
            _merge(tree, part, section, merged[section])
        tree.faults += part.faults
        tree.unread |= part.unread
    for section, elements in merged.items():
        own = tree.data.get(section)
        if elements and (own is None or isinstance(own, dict)):
            tree.data[section] = {**elements, **(own or {})}


def _read(tree: Tree, path: Path, entry: Any, sources: Sources) -> Tree | None:
    """The included file as a tree, with all that it includes."""
    short = not isinstance(entry, dict)
    try:
        wanted = Include.model_validate({"file": entry} if short else entry)
    except ValidationError as error:
        for line in error.errors(include_url=False):
            if line["type"] == FAULT:
                place = path if short else (*path, *line["loc"])
                tree.report(place, line["msg"], at_key=bool(line.get("ctx", {}).get("at_key")))
        return None
    found = sources.text(tree, path if short else (*path, "file"), wanted.file)
    if found is None:
        return None
    text, file = found
    if STARTS.search(text) is None:  # not read, nor quoted in any message
        tree.faults.append(Fault(file, 1, 1, "", f"`format: {FORMAT}` is missing: this is no machine file"))
        return None
    try:
        part = read_tree(text, file)
        check_start(part)
    except ModelError as error:
        tree.faults += error.faults
        return None
    include(part, sources.inside(file))
    check_sections(part)
    as_part(part, wanted.only, f"`include: {{file: {wanted.file}, only: [bodies, joints]}}`")
    return part


def _merge(tree: Tree, part: Tree, section: str, merged: dict[str, Any]) -> None:
    """Add the elements of a section of `part` to `merged`, with their places."""
    content = tree.data.get(section)
    own = content if isinstance(content, dict) else {}
    moves: dict[Path, Path] = {}
    for name, element in section_of(part, section).items():
        path = (section, name)
        if name in own:
            tree.faults.append(tree.fault(path, _double(name, part.place_of(path))))
        elif name not in merged:
            merged[name] = element
            moves[path] = path
        elif part.place_of(path) != tree.place_of(path):  # else the same file, included twice
            part.faults.append(part.fault(path, _double(name, tree.place_of(path))))
    tree.graft(part, moves)
    if moves and (section,) not in tree.places:
        tree.graft(part, {(section,): (section,)})


def _double(name: str, other: str) -> str:
    return f"`{name}` is defined twice; the other stands in {other}"
