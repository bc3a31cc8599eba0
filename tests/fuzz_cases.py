"""Cases of wrong input: each function writes one into a folder, and gives what reads it."""

from __future__ import annotations

import copy
import json
import random
import re
import warnings
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import yaml

import nivel
from nivel.errors import ModelError
from nivel.files.input_table import read_input_table
from nivel.files.mesh_file import read_mesh
from nivel.flexible.foreign.matrix import FormatError
from nivel.flexible.foreign.nastran import read_dmig, read_op4
from nivel.flexible.foreign.read_mesh import read_mesh as read_element_mesh
from nivel.native import store
from nivel.results import Result

ROOT = Path(__file__).parent.parent
PIECES = (
    *(
        "0",
        "-1",
        "1e308",
        "1e-320",
        "nan",
        ".inf",
        "null",
        "true",
        "[]",
        "{}",
        "''",
        "~",
        "=1+1",
        "../..",
        "/dev/zero",
        "\x1b[31m",
    ),
    *(
        "m",
        "kg",
        "m⁰",
        "m^0",
        "m**-0",
        "µ",
        "°",
        "N*m/rad",
        "1/0",
        "time",
        "hinge.angle",
        "a" * 5000,
        "((((",
        "]" * 50,
        "&a",
        "*a",
    ),
    *(
        "2**9999",
        "10**10**10",
        "sqrt(-1)",
        "- " * 500,
        "🜲",
        "\u202e",
        "\x00",
        "9" * 400,
        "0x10",
        "1_000",
        "1e",
        "e",
        "min(1)",
    ),
)

# what is put in place of a value of a machine
VALUES: tuple[Any, ...] = (
    *(0, -1, 2, 1e-300, 1e12, 1e99, 1e101, 10**30, float("nan"), float("inf"), None, True, False, "", "x", "ground"),
    *([], {}, [0, 0, 0], [None], [[1]], ["ground"], ["ground", "ground"], {"a": 1}, {"file": "/dev/zero"}),
    *({"points": [0, 0], "values": [0, 1]}, "1 m", "1 kg", "-5 mm", "1 Pa", "time", "1/time", "sqrt(-time)"),
    *("if(time > 0, 1, 0)", "python:os.system", "=1", "relative", "revolute", "spring"),
)
FACTORS = (0, -1, 2, 0.1, 10, 1e3, 1e-3, 1e6, 1e-6, 1e9, 1e-9, 1e15)
NUMBER = re.compile(r"\d+\.?\d*(e[-+]?\d+)?")


def machine_files(rng: random.Random, folder: Path) -> Callable[[], object]:
    """An example with some of its tokens, lines or letters changed, loaded and checked."""
    source = rng.choice(sorted((ROOT / "examples").rglob("*.yaml")))
    lines = source.read_text(encoding="utf-8").splitlines()
    for _ in range(rng.randint(1, 4)):
        k = rng.randrange(len(lines))
        words = lines[k].split(" ")
        match rng.randrange(5):
            case 0:
                words[rng.randrange(len(words))] = rng.choice(PIECES)
                lines[k] = " ".join(words)
            case 1:
                lines[k] = lines[rng.randrange(len(lines))]
            case 2:
                del lines[k]
                lines = lines or [""]
            case 3:
                at = rng.randrange(len(lines[k]) + 1)
                lines[k] = lines[k][:at] + rng.choice(PIECES) + lines[k][at:]
            case _:
                lines[k] = "".join(rng.sample(lines[k], len(lines[k])))
    path = folder / "machine.yaml"
    path.write_bytes("\n".join(lines).encode("utf-8", "surrogatepass"))
    return lambda: nivel.load(path).check()


def _spoilt_numbers(rng: random.Random, text: str) -> str:
    """Some numbers, words and lines of a text changed, with its marks as they are."""
    for _ in range(rng.randint(1, 4)):
        found = list(re.finditer(r"[-+]?\d+\.?\d*|[A-Za-z_]{3,}", text))
        if not found:
            return text
        at = rng.choice(found)
        put = rng.choice((*PIECES, found[rng.randrange(len(found))].group(), ""))
        text = text[: at.start()] + put + text[at.end() :]
    return text


def robots(rng: random.Random, folder: Path) -> Callable[[], object]:
    """Models of robots with changed bytes, numbers and words, imported and checked."""
    source = rng.choice([ROOT / "examples" / "robots" / name for name in ("arm.urdf", "linkage.sdf", "leg.xml")])
    path, content = folder / source.name, source.read_bytes()
    text = _spoilt_numbers(rng, content.decode()).encode("utf-8", "ignore")
    path.write_bytes(text if rng.random() < 0.8 else _changed(rng, content))
    return lambda: nivel.import_model(path).check()


def studies(rng: random.Random, folder: Path) -> Callable[[], object]:
    """Studies and what they are of with changed numbers and words, read and compared with their machine."""
    source = rng.choice(sorted((ROOT / "examples" / "studies").glob("*.yaml")))
    path = folder / source.name
    path.write_text(_spoilt_numbers(rng, source.read_text(encoding="utf-8")), encoding="utf-8", errors="ignore")
    return lambda: nivel.load_study(path)


def decks(rng: random.Random, folder: Path) -> Callable[[], object]:
    """Decks of CalculiX with changed numbers and words: mesh, materials, orientations."""
    source = rng.choice(sorted((ROOT / "tests" / "faults").glob("*.inp")))
    lines = source.read_text(encoding="utf-8").splitlines()
    cards = [k for k, line in enumerate(lines) if line.startswith("*") or k > len(lines) - 40]
    for _ in range(rng.randint(1, 4)):
        k = rng.choice(cards)
        lines[k] = _spoilt_numbers(rng, lines[k])
    path = folder / "deck.inp"
    path.write_text("\n".join(lines), encoding="utf-8", errors="ignore")

    def read() -> object:
        try:
            return read_element_mesh(path)
        except FormatError as error:
            raise ModelError(str(error)) from None

    return read


@cache
def machines() -> tuple[dict[str, Any], ...]:
    """Examples and machines of the documentation."""
    texts = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "examples").rglob("*.yaml"))]
    for page in sorted((ROOT / "docs").glob("*.md")):
        blocks = re.findall(r"```yaml\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
        texts += [block for block in blocks if block.startswith("format: 1")]
    found = []
    for text in texts:
        try:
            machine = yaml.load(text, Loader=yaml.CSafeLoader)
        except yaml.YAMLError:
            continue
        if "bodies" in machine or "beams" in machine:
            found.append(machine)
    return tuple(found)


def machine_values(rng: random.Random, folder: Path) -> Callable[[], object]:
    """A machine whose values, names, lists or elements are changed, or come from another machine."""
    machine = copy.deepcopy(rng.choice(machines()))
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        if places := list(_places(machine)):
            _change(rng, machine, rng.choice(places))
    path = folder / "machine.yaml"
    path.write_text(yaml.dump(machine, allow_unicode=True, sort_keys=False), encoding="utf-8")
    return lambda: nivel.load(path).check()


def _places(tree: Any) -> Iterator[tuple[Any, ...]]:
    """The keys that lead to every value of a tree."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in items:
        yield (key,)
        yield from ((key, *rest) for rest in _places(value))


def _at(tree: Any, place: tuple[Any, ...]) -> Any:
    for key in place:
        tree = tree[key]
    return tree


def _change(rng: random.Random, machine: dict[str, Any], place: tuple[Any, ...]) -> None:
    parent, key = _at(machine, place[:-1]), place[-1]
    other = rng.choice(machines())
    there = rng.choice(list(_places(other)))
    match rng.randrange(9):
        case 0 | 1:
            parent[key] = copy.deepcopy(rng.choice(VALUES))
        case 2:
            del parent[key]
        case 3:
            parent[key] = copy.deepcopy(_at(other, there))
        case 4:
            parent[key] = copy.deepcopy(_at(machine, rng.choice(list(_places(machine)))))
        case 5 if isinstance(parent, dict):
            parent[str(there[-1])] = copy.deepcopy(_at(other, there))
        case 6:
            same = [each for each in _places(machine) if each[-1] == key]
            parent[key] = copy.deepcopy(_at(machine, rng.choice(same)))
        case _:
            parent[key] = _scaled(rng, parent[key])


def _scaled(rng: random.Random, value: Any) -> Any:
    """Another size or order of a value."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value * rng.choice(FACTORS)
    if isinstance(value, str):
        return NUMBER.sub(lambda found: repr(float(found[0]) * rng.choice(FACTORS)), value, count=1)
    return rng.sample(value, len(value)) if isinstance(value, list) else value


def expressions(rng: random.Random, folder: Path) -> Callable[[], object]:
    """Pieces of quantities in a row."""
    pieces = (
        *PIECES,
        "+",
        "-",
        "*",
        "/",
        "**",
        "^",
        "(",
        ")",
        ",",
        " ",
        "sin(",
        "2",
        "3.5",
        "rpm",
        "deg",
        "⁻¹",
        "·",
        "²",
    )
    text = "".join(rng.choice(pieces) for _ in range(rng.randint(1, 12)))
    (folder / "expression.txt").write_text(text, encoding="utf-8")
    return lambda: nivel.Body(name="b", mass=text, inertia=(1, 1, 1), position=(text, 0, 0))


def meshes(rng: random.Random, folder: Path) -> Callable[[], object]:
    """Meshes with changed bytes, and scenes of parts that are none."""
    kind = rng.choice(("stl", "obj", "gltf", "glb"))
    path = folder / f"mesh.{kind}"
    if kind == "gltf":
        part = lambda: rng.choice((None, 0, -1, 1e9, "x", [], {}, [None], [0], {"mesh": 0}, {"children": [0]}, True))  # noqa: E731
        scene = {
            "asset": {"version": "2.0"},
            "scenes": [{"nodes": part()}],
            "nodes": [{"mesh": part(), "children": part(), "matrix": part()}, part()],
            "meshes": [{"primitives": rng.choice(([None], [{}], [{"attributes": part(), "indices": part()}], part()))}],
            "accessors": part(),
            "bufferViews": part(),
            "buffers": part(),
        }
        for key in rng.sample(sorted(scene), rng.randint(0, 3)):
            scene[key] = part()
        path.write_text(json.dumps(scene), encoding="utf-8")
    else:
        text = {
            "stl": b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
        }
        text |= {
            "obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "glb": b"glTF\x02\x00\x00\x00\x40\x00\x00\x00" + b"\x10\x00\x00\x00JSON{}",
        }
        path.write_bytes(_changed(rng, text[kind]))
    return lambda: read_mesh(path)


def input_tables(rng: random.Random, folder: Path) -> Callable[[], object]:
    """A table of an input with changed bytes."""
    path = folder / "lever.csv"
    path.write_bytes(_changed(rng, b"time,lever [deg],other\n0,1,2\n0.5,2,3\n1.5,-1e3,4\n"))
    return lambda: read_input_table(path, "lever")


MODELS: dict[str, tuple[bytes, Callable[[Path], object]]] = {
    "mesh.inp": (
        b"*HEADING\n*NODE, NSET=ALL\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*NSET, NSET=E, GENERATE\n1, 3, 1\n"
        b"*ELEMENT, TYPE=C3D4, ELSET=V\n1, 1, 2, 3, 4\n",
        read_element_mesh,
    ),
    "mesh.bdf": (
        b"BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\nENDDATA\n",
        read_element_mesh,
    ),
    "matrix.pch": (
        b"DMIG    KAAX           0       6       1       0\nDMIG*   KAAX                           1               1\n"
        b"*                      1               1 1.000000000D+00\n",
        read_dmig,
    ),
    "matrix.op4": (
        b"       2       2       6       2KAA     1P,3E23.16\n       1       1       2\n 1.0000000000000000E+00 2.0000000000000000E+00\n"
        b"       3       1       1\n 1.0000000000000000E+00\n",
        read_op4,
    ),
}


def models(rng: random.Random, folder: Path) -> Callable[[], object]:
    """Meshes and matrices of other programs with changed bytes."""
    name = rng.choice(sorted(MODELS))
    content, read = MODELS[name]
    path = folder / name
    path.write_bytes(_changed(rng, content))

    def refused() -> object:
        try:
            return read(path)
        except FormatError as error:  # who asked for the file says the rest
            raise ModelError(str(error)) from None

    return refused


def result_files(rng: random.Random, folder: Path) -> Callable[[], object]:
    """A result with changed bytes, opened and read."""
    original = folder.parent / "original.nc"
    if not original.exists():
        nivel.load(ROOT / "examples" / "mechanisms" / "simple-pendulum.yaml").simulate(duration=0.05, out=original)
    path = folder / "result.nc"
    content = bytearray(original.read_bytes())
    for _ in range(rng.randint(1, 30)):
        content[rng.randrange(len(content))] = rng.randrange(256)
    if rng.random() < 0.2:
        del content[rng.randrange(len(content)) :]
    path.write_bytes(content)

    def read() -> object:
        result = Result.open(path)
        return result.trust, result.names, result.settings, result.summary(), result.array("position")

    return read


JSON_VALUES = (
    None,
    0,
    -1,
    1.5,
    "x",
    [],
    {},
    [None],
    [1, 2],
    {"name": 3},
    True,
    "\x1b[31m",
    "ground",
    [[1, 2, 3]],
    [0, 0, 0],
)


def result_attributes(rng: random.Random, folder: Path) -> Callable[[], object]:
    """A result whose JSON texts have other values, opened, reported and drawn."""
    import h5py

    original = folder.parent / "boom.nc"
    if not original.exists():
        nivel.load(ROOT / "examples" / "hydraulics" / "cylinder-boom.yaml").simulate(duration=0.01, out=original)
    path = folder / "result.nc"
    path.write_bytes(original.read_bytes())
    with h5py.File(path, "r+") as file:
        key = rng.choice(
            ["scene", "machine_record", "trust", "settings", "timing", "events", "assembly", "estimated_errors"]
        )
        value = json.loads(file.attrs.get(key, "{}"))
        for place, last in rng.sample(found := list(_entries(value)), min(len(found), rng.randint(1, 2))):
            place[last] = rng.choice(JSON_VALUES)
        file.attrs[key] = json.dumps(value)

    def read() -> object:
        result = Result.open(path)
        return result.trust, result.summary(), result.report(folder / "a.html"), result.export_scene(folder / "b.html")

    return read


def cache_files(rng: random.Random, folder: Path) -> Callable[[], object]:
    """An object file of the cache, damaged: what is read is what was written, or nothing."""
    code = rng.randbytes(rng.randint(1, 300))
    path = folder / "entry.o"
    store.write(path, code)
    path.write_bytes(rng.choice((_changed(rng, path.read_bytes()), path.read_bytes()[: rng.randrange(340)])))

    def case() -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that it is damaged
            assert store.read(path) in (None, code)
        assert store.read(path) in (None, code)

    return case


def _entries(value: Any) -> Iterator[tuple[Any, Any]]:
    """Every container in a JSON value with each of its keys or numbers."""
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, each in inside:
        yield value, key
        yield from _entries(each)


def _changed(rng: random.Random, content: bytes) -> bytes:
    out = bytearray(content)
    for _ in range(rng.randint(1, 6)):
        at = rng.randrange(len(out) + 1)
        out[at : at + rng.randint(0, 3)] = rng.choice(PIECES).encode("utf-8", "ignore")[:40]
    return bytes(out) or b"\x00"


KINDS = {
    each.__name__: each
    for each in (
        machine_files,
        machine_values,
        expressions,
        input_tables,
        meshes,
        models,
        robots,
        studies,
        decks,
        result_files,
        result_attributes,
        cache_files,
    )
}
