"""Ground and tyres of a file: sets of keys that several forces share, and `file:` of heights, rows of a CSV file or a PNG picture.

    tyres: {front: {radius: 31.5 cm, width: 20 cm, nominal_load: 4 kN}}
    ground: {yard: {plane: road, heights: {size: [80, 80], file: yard.csv}, grip: "if(y > 0, 0.3, 0.9)"}}
    forces: {left: {type: tyre, wheel: hub, tyre: front, ground: yard}}

What a force says itself goes before. A fault in a set is told once, where the set stands.
"""

import re
import struct
import zlib
from copy import deepcopy
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.elements.contacts.height_field import MOST
from nivel.files.outline import NAMING, SETS, SHARING, section_of
from nivel.files.sources import Sources
from nivel.files.tree import Path, Tree
from nivel.machine.core.record import unknown_word
from nivel.machine.units.quantity import shown

HEIGHTS: Final = "heights"
PNG: Final = b"\x89PNG\r\n\x1a\n"
CHANNELS: Final = {0: 1, 2: 3, 4: 2, 6: 4}  # by the type of colour


def spread_sets(tree: Tree) -> None:
    """Take the sets out of the file, and put their keys where they are named. Faults go to `tree.faults`."""
    for section, key in SETS.items():
        sets = section_of(tree, section)
        tree.data.pop(section, None)
        known: set[str] = set()
        sharing = [(of, name, each) for of in SHARING[section] for name, each in section_of(tree, of).items()]
        for of, name, element in sharing:
            if key not in element or (section != "catalogue" and element.get("type") not in NAMING):
                continue
            named = element.pop(key)
            if not isinstance(named, str) or named not in sets:
                given = named if isinstance(named, str) else shown(named)
                message = unknown_word(given, list(sets), f"entry of `{section}`")
                tree.report((of, name, key), message, breaks=(of, name))
                continue
            spread = _spread(tree, sets[named], (section, named), (of, name), element)
            if named in known:  # the same fault of a second force says nothing new
                tree.broken |= spread
            known.add(named)


def _spread(
    tree: Tree, keys: dict[str, Any], place: tuple[str, str], at: tuple[str, str], element: dict[str, Any]
) -> set[Path]:
    """Put the keys of the set at `place` into the element `at` a place, with where they stand. Returns their paths there."""
    spread: set[Path] = set()
    for word, value in keys.items():
        if word in element or word in NAMING.get(element.get("type", ""), ()):
            continue
        element[word] = deepcopy(value)
        tree.copy_places((*place, word), (*at, word))
        tree.files[(*at, word)] = tree.file_of((*place, word))
        spread.add((*at, word))
    return spread


class NotReadError(Exception):
    """Why a file has no heights, in words."""


def read_heights(tree: Tree, sources: Sources) -> None:
    """Put the heights of the file of each contact into it, as `values`. Faults go to `tree.faults`."""
    for name, force in section_of(tree, "forces").items():
        field = force.get(HEIGHTS) if isinstance(force, dict) else None
        if not isinstance(field, dict) or "file" not in field or "values" in field:
            continue
        path: Path = ("forces", name, HEIGHTS, "file")
        found = sources.content(tree, path, field["file"], breaks=path[:2])
        if found is None:
            continue
        content, _ = found
        try:
            heights = _picture(content) if content.startswith(PNG) else _rows(content)
        except NotReadError as problem:
            tree.report(path, f"`{field['file']}`: {problem}", breaks=path[:2])
            continue
        field["values"] = [[_scaled(float(each), field.get("unit", 1.0)) for each in row] for row in heights]


def _scaled(height: float, unit: Any) -> float | str:
    """A number of a file times the length of a unit, as it is written."""
    return height * unit if isinstance(unit, int | float) else f"{height!r}*({unit})"


def _rows(content: bytes) -> NDArray[np.float64]:
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise NotReadError("a CSV file of numbers or a PNG picture was expected") from None
    rows: list[list[float]] = []
    for number, line in enumerate(text.splitlines(), 1):
        words = [word for word in re.split(r"[,;\s]+", line.strip()) if word]
        if not words or line.lstrip().startswith("#"):
            continue
        try:
            row = [float(word) for word in words]
        except ValueError:
            raise NotReadError(f"line {number}: numbers were expected, got `{line.strip()[:40]}`") from None
        if not np.all(np.isfinite(row)):
            raise NotReadError(f"line {number}: finite numbers were expected, got `{line.strip()[:40]}`")
        if rows and len(row) != len(rows[0]):
            raise NotReadError(
                f"line {number}: {len(rows[0])} numbers were expected as in the lines above, got {len(row)}"
            )
        rows.append(row)
    if not rows:
        raise NotReadError("there are no numbers in it")
    return np.array(rows)


def _picture(content: bytes) -> NDArray[np.float64]:
    """Shares of white, from the lowest row on; of a picture in colours the mean of red, green and blue (PNG, third edition)."""
    place, packed, head = len(PNG), b"", b""
    while place + 8 <= len(content):
        (size,) = struct.unpack_from(">I", content, place)
        kind, part = content[place + 4 : place + 8], content[place + 8 : place + 8 + size]
        if kind == b"IHDR":
            head = part
        elif kind == b"IDAT":
            packed += part
        place += 12 + size
    if len(head) != 13:
        raise NotReadError("the picture is damaged")
    width, height, bits, colours, _, _, interlaced = struct.unpack(">IIBBBBB", head)
    if bits not in (8, 16) or colours not in CHANNELS or interlaced:
        raise NotReadError("a picture in grey of 8 or 16 bits was expected, not interlaced and without a palette")
    if not 0 < width * height <= MOST:
        raise NotReadError(f"the picture has {'more than ' + str(MOST) if width * height else 'no'} points")
    step = CHANNELS[colours] * bits // 8
    line = 1 + width * step
    try:
        rows = zlib.decompressobj().decompress(packed, height * line + 1)  # what is packed may be without end
    except zlib.error:
        raise NotReadError("the picture is damaged") from None
    if len(rows) != height * line:
        raise NotReadError("the picture is damaged")
    raw = np.frombuffer(rows, np.uint8).reshape(height, line)
    out = np.zeros((height, width * step), np.uint8)
    for k in range(height):
        above = out[k - 1] if k else np.zeros(width * step, np.uint8)
        out[k] = _unfiltered(int(raw[k, 0]), raw[k, 1:], above, step)
    values = out.view(">u2" if bits == 16 else np.uint8).reshape(height, width, -1).astype(float)
    grey = values[..., :3].mean(axis=2) if colours in (2, 6) else values[..., 0]
    return grey[::-1] / (2.0**bits - 1.0)


def _unfiltered(kind: int, row: NDArray[np.uint8], above: NDArray[np.uint8], step: int) -> NDArray[np.uint8]:
    """A row of bytes from its differences to those before it (`step` bytes) and above it."""
    if kind == 0:
        return row
    if kind == 2:
        return row + above
    out = [0] * len(row)
    for i, byte in enumerate(row.tolist()):
        before = out[i - step] if i >= step else 0
        up, corner = int(above[i]), int(above[i - step]) if i >= step else 0
        if kind == 1:
            guess = before
        elif kind == 3:
            guess = (before + up) // 2
        elif kind == 4:
            sides = [abs(up - corner), abs(before - corner), abs(before + up - 2 * corner)]
            guess = (before, up, corner)[sides.index(min(sides))]
        else:
            raise NotReadError("the picture is damaged")
        out[i] = (byte + guess) & 255
    return np.array(out, np.uint8)
