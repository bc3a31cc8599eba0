"""Make `src/nivel/native/libm.a`, the mathematical functions of machines in web pages, from the C library of Debian's `wasi-libc` (musl).

    python packaging/libm.py /usr/lib/wasm32-wasi/libc.a

Objects are taken as they are, without what is for debuggers. The licence and the version stand in `src/nivel/native/libm.txt`.
"""

import sys
from pathlib import Path

from nivel.native.wasm import MAGIC, Reader, members, needed, number, read_object

TARGET = Path(__file__).parent.parent / "src" / "nivel" / "native" / "libm.a"
WANTED = [
    *("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "sincos"),
    *("exp", "exp2", "expm1", "log", "log1p", "log10", "log2", "pow", "cbrt", "hypot", "fmod"),
    *("memset", "memcpy", "memmove"),
]


def without_debugging(content: bytes) -> bytes:
    """An object file without the parts that no linker reads; these stand behind all that relocations count."""
    out, reader = bytearray(MAGIC), Reader(content, len(MAGIC))
    while reader.at < len(content):
        kind = reader.byte()
        part = reader.take(reader.number())
        name = Reader(part).name() if kind == 0 else ""
        if kind != 0 or name in ("linking", "reloc.CODE", "reloc.DATA"):
            out += bytes([kind]) + number(len(part)) + part
    return bytes(out)


def main(archive: str) -> None:
    """Write the archive."""
    contents = [without_debugging(each) for each in members(Path(archive).read_bytes())]
    objects = [read_object(each) for each in contents]
    first = [each for each in objects if {*each.exported} & {*WANTED}]
    places = sorted(objects.index(each) for each in needed(first, objects))
    out = b"!<arch>\n"
    for k in places:
        content = contents[k]
        head = f"{f'{k}.o/':<16}{0:<12}{0:<6}{0:<6}{'644':<8}{len(content):<10}`\n"
        out += head.encode() + content + b"\n" * (len(content) % 2)
    TARGET.write_bytes(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
