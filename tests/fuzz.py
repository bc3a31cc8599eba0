"""Wrong input of every kind: machine files, expressions, meshes, result files, files of machine code. Nothing may end in a traceback, take
more than ten seconds or more than two gigabytes.

    python tests/fuzz.py               # some hundred cases
    python tests/fuzz.py --full        # ten thousand
    python tests/fuzz.py --seed 7 meshes expressions

Each case is written to the folder that is printed before it is tried; what fails stays there.
"""

from __future__ import annotations

import argparse
import json
import random
import resource
import signal
import sys
import tempfile
import traceback
from collections.abc import Callable
from pathlib import Path

import nivel
from nivel.errors import NivelError
from nivel.files.mesh_file import read_mesh
from nivel.results import Result

ROOT = Path(__file__).parent.parent
SECONDS, MEMORY = 10, 2 * 1024**3
FEW, MANY = 1200, 10_000
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


def result_files(rng: random.Random, folder: Path) -> Callable[[], object]:
    """A result with changed bytes, opened and read."""
    original = folder.parent / "original.nc"
    if not original.exists():
        nivel.load(ROOT / "examples" / "simple-pendulum.yaml").simulate(duration=0.05, out=original)
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


def _changed(rng: random.Random, content: bytes) -> bytes:
    out = bytearray(content)
    for _ in range(rng.randint(1, 6)):
        at = rng.randrange(len(out) + 1)
        out[at : at + rng.randint(0, 3)] = rng.choice(PIECES).encode("utf-8", "ignore")[:40]
    return bytes(out) or b"\x00"


KINDS = {each.__name__: each for each in (machine_files, expressions, meshes, result_files)}


class TooLongError(Exception):
    """A case that takes longer than SECONDS."""


def _too_long(_signal: int, _frame: object) -> None:
    raise TooLongError


def tried(case: Callable[[], object]) -> str:
    """What went wrong with a case; empty where it was computed, or refused in words."""
    signal.alarm(SECONDS)
    try:
        case()
    except (NivelError, UnicodeEncodeError):
        return ""
    except TooLongError:
        return f"took more than {SECONDS} s"
    except BaseException:
        return traceback.format_exc(limit=-4)
    finally:
        signal.alarm(0)
    return ""


def main() -> int:
    """Try the cases; how many failed is the exit code."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("kinds", nargs="*", metavar="KIND", help=", ".join(KINDS))
    options.add_argument("--full", action="store_true")
    options.add_argument("--seed", type=int, default=0)
    given = options.parse_args()
    kinds = given.kinds or list(KINDS)
    if unknown := set(kinds) - set(KINDS):
        options.error(f"there are no {', '.join(unknown)}; there are {', '.join(KINDS)}")
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.signal(signal.SIGALRM, _too_long)
    base = Path(tempfile.mkdtemp(prefix="nivel-fuzz-"))
    print(f"cases in {base}")
    failed: dict[str, int] = {}
    for number in range(MANY if given.full else FEW):
        rng = random.Random(f"{given.seed} {number}")
        folder = base / f"{number}"
        folder.mkdir()
        kind = kinds[number % len(kinds)]
        wrong = tried(KINDS[kind](rng, folder))
        if wrong:
            last = wrong.strip().splitlines()[-1]
            failed[last] = failed.get(last, 0) + 1
            if failed[last] == 1:
                print(f"{folder} ({kind}): {wrong}")
        else:
            for path in folder.iterdir():
                path.unlink()
            folder.rmdir()
    print(f"{sum(failed.values())} failed, in {len(failed)} ways")
    return min(sum(failed.values()), 1)


if __name__ == "__main__":
    sys.exit(main())
