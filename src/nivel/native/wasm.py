"""A linker of object files for WebAssembly with 32-bit addresses, as LLVM writes them: one module from the objects of entries.

The module imports its memory, its table and the functions that no object has. It exports all global functions, and `__heap_base`, the first
byte behind its own data and its stack. Format of objects: WebAssembly tool conventions, `Linking.md`; of modules: WebAssembly Core
Specification 1.0, chapter 5.
"""

import struct
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from importlib.resources import files
from typing import Final, NamedTuple

# what LLVM compiles for (processor, features, system)
TARGET: Final = ("generic", "+bulk-memory,+nontrapping-fptoint,+sign-ext", "wasm32-unknown-unknown")
MAGIC: Final = b"\0asm\1\0\0\0"
STACK, FIRST, LINE = 1 << 16, 1024, 64  # bytes of the stack, below the first datum, of a line of the cache
# kinds of relocations
FUNCTION, TABLE_SLEB, TABLE_I32, MEMORY_LEB, MEMORY_SLEB, MEMORY_I32, TYPE, GLOBAL = range(8)
TABLE_NUMBER = 20
WITH_ADDEND: Final = (MEMORY_LEB, MEMORY_SLEB, MEMORY_I32, 8, 9)
# flags of symbols; kinds of symbols and of imports
LOCAL, UNDEFINED, NAMED = 0x02, 0x10, 0x40
A_FUNCTION, A_DATUM, A_SECTION = 0, 1, 3
CODE, DATA = 10, 11  # numbers of sections


class Reader:
    """Bytes that are read one after the other."""

    def __init__(self, content: bytes, at: int = 0) -> None:
        self.content, self.at = content, at

    def take(self, count: int) -> bytes:
        """The next bytes."""
        self.at += count
        return self.content[self.at - count : self.at]

    def byte(self) -> int:
        """The next byte as a number."""
        return self.take(1)[0]

    def number(self, *, signed: bool = False) -> int:
        """A number in LEB128."""
        value = shift = 0
        while True:
            byte = self.byte()
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value - (1 << shift) if signed and byte & 0x40 else value

    def name(self) -> str:
        """A text with its length before it."""
        return self.take(self.number()).decode()

    def limits(self) -> None:
        """Bounds of a memory or table, which are passed over."""
        for _ in range(1 + (self.byte() & 1)):
            self.number()


def number(value: int, *, signed: bool = False) -> bytes:
    """A number in LEB128."""
    out = b""
    while not (-0x40 <= value < 0x40 if signed else value <= 0x7F):
        out, value = out + bytes([value & 0x7F | 0x80]), value >> 7
    return out + bytes([value & 0x7F])


def padded(value: int) -> bytes:
    """A number in the five bytes that LLVM leaves for it; unsigned and signed ones of 32 bits look alike here."""
    return bytes([value >> 7 * k & 0x7F | 0x80 for k in range(4)]) + bytes([value >> 28 & 0x7F])


def vector(parts: Sequence[bytes]) -> bytes:
    """Parts with their number before them."""
    return number(len(parts)) + b"".join(parts)


def text(name: str) -> bytes:
    """A name with its length before it."""
    return number(len(name.encode())) + name.encode()


class Symbol(NamedTuple):
    """A name of an object. item : number of a function, or of a part of the data, in which it stands at `offset`."""

    kind: int
    flags: int
    name: str
    item: int
    offset: int


class Relocation(NamedTuple):
    """A place in a section whose bytes depend on where things are put."""

    kind: int
    offset: int
    item: int
    addend: int


@dataclass(eq=False)
class Object:
    """An object file. imported : name and type of each function that it calls and does not have. declared : types of its own functions.
    bodies, data : (place in their section, bytes). alignment : of each part of the data."""

    types: list[bytes] = field(default_factory=list)
    imported: list[tuple[str, int]] = field(default_factory=list)
    declared: list[int] = field(default_factory=list)
    bodies: list[tuple[int, bytes]] = field(default_factory=list)
    data: list[tuple[int, bytes]] = field(default_factory=list)
    alignment: list[int] = field(default_factory=list)
    symbols: list[Symbol] = field(default_factory=list)
    relocations: dict[int, list[Relocation]] = field(default_factory=dict)

    @property
    def exported(self) -> dict[str, int]:
        """Name of each global function that it has → its number."""
        hidden = UNDEFINED | LOCAL
        return {each.name: each.item for each in self.symbols if each.kind == A_FUNCTION and not each.flags & hidden}


def read_object(content: bytes) -> Object:
    """The parts of an object file."""
    if content[: len(MAGIC)] != MAGIC:
        raise ValueError("not an object file for WebAssembly")
    out, kinds, reader = Object(), list[int](), Reader(content, len(MAGIC))
    readers = {1: _read_types, 2: _read_imports, 3: _read_functions, CODE: _read_code, DATA: _read_data}
    while reader.at < len(content):
        kind, part = reader.byte(), Reader(reader.take(reader.number()))
        kinds.append(kind)
        if kind == 0:
            _read_custom(out, part, kinds)
        elif kind in readers:
            readers[kind](out, part)
    return out


def _read_types(out: Object, reader: Reader) -> None:
    for _ in range(reader.number()):
        begin = reader.at
        reader.byte()
        for _ in range(2):  # arguments, results
            reader.take(reader.number())
        out.types.append(reader.content[begin : reader.at])


def _read_imports(out: Object, reader: Reader) -> None:
    for _ in range(reader.number()):
        reader.name()
        name, kind = reader.name(), reader.byte()
        if kind == 0:
            out.imported.append((name, reader.number()))
        elif kind == 1:
            reader.byte()
            reader.limits()
        elif kind == 2:
            reader.limits()
        else:
            reader.take(2)


def _read_functions(out: Object, reader: Reader) -> None:
    out.declared = [reader.number() for _ in range(reader.number())]


def _read_code(out: Object, reader: Reader) -> None:
    for _ in range(reader.number()):
        size = reader.number()
        out.bodies.append((reader.at, reader.take(size)))


def _read_data(out: Object, reader: Reader) -> None:
    for _ in range(reader.number()):
        reader.take(2)  # into the memory 0, from a constant on
        reader.number(signed=True)
        reader.byte()
        size = reader.number()
        out.data.append((reader.at, reader.take(size)))


def _read_custom(out: Object, reader: Reader, kinds: Sequence[int]) -> None:
    name = reader.name()
    if name.startswith("reloc."):
        section, count = reader.number(), reader.number()
        out.relocations[kinds[section]] = [_relocation(reader) for _ in range(count)]
    elif name == "linking":
        reader.number()  # the version
        while reader.at < len(reader.content):
            kind, part = reader.byte(), Reader(reader.take(reader.number()))
            if kind == 8:
                out.symbols = [_symbol(out, part) for _ in range(part.number())]
            elif kind == 5:
                out.alignment = [_alignment(part) for _ in range(part.number())]


def _relocation(reader: Reader) -> Relocation:
    kind, offset, index = reader.byte(), reader.number(), reader.number()
    return Relocation(kind, offset, index, reader.number(signed=True) if kind in WITH_ADDEND else 0)


def _alignment(reader: Reader) -> int:
    reader.name()
    power = reader.number()
    reader.number()
    return 1 << power


def _symbol(out: Object, reader: Reader) -> Symbol:
    kind, flags, name, index, offset = reader.byte(), reader.number(), "", 0, 0
    if kind == A_DATUM:
        name = reader.name()
        if not flags & UNDEFINED:
            index, offset = reader.number(), reader.number()
            reader.number()
    else:
        index = reader.number()
        if kind != A_SECTION and (not flags & UNDEFINED or flags & NAMED):
            name = reader.name()
        elif kind == A_FUNCTION:
            name = out.imported[index][0]
    return Symbol(kind, flags, name, index, offset)


def members(archive: bytes) -> Iterator[bytes]:
    """The object files of an archive (`ar`)."""
    at = len(b"!<arch>\n")
    while at < len(archive):
        size = int(archive[at + 48 : at + 58])
        content = archive[at + 60 : at + 60 + size]
        if content[: len(MAGIC)] == MAGIC:
            yield content
        at += 60 + size + size % 2


def library() -> list[Object]:
    """The mathematical functions of C and what moves memory, the same on every system: of musl, see `libm.txt`."""
    return [read_object(each) for each in members(files("nivel.native").joinpath("libm.a").read_bytes())]


def needed(objects: Sequence[Object], others: Iterable[Object]) -> list[Object]:
    """These objects, and those of others that have what these call or read."""
    out, found = list(objects), {name: each for each in others for name in _names(each)}
    have = {name for each in out for name in _names(each)}
    for each in out:  # grows while it is gone through
        for symbol in each.symbols:
            if symbol.flags & UNDEFINED and symbol.name in found and symbol.name not in have:
                out.append(found[symbol.name])
                have.update(_names(found[symbol.name]))
    return out


def _names(each: Object) -> list[str]:
    hidden = UNDEFINED | LOCAL
    return [one.name for one in each.symbols if one.kind in (A_FUNCTION, A_DATUM) and not one.flags & hidden]


class _Linker:
    """Where the functions and data of objects stand in the module."""

    def __init__(self, objects: Sequence[Object]) -> None:
        self.objects = objects
        self.types: dict[bytes, int] = {}
        self.own: dict[
            tuple[int, int], int
        ] = {}  # (object, number there) of each function that an object has → its place among these
        self.functions: dict[str, tuple[int, int]] = {}
        self.data: dict[str, tuple[int, int, int]] = {}  # (object, part of its data, offset)
        for k, each in enumerate(objects):
            for kind in each.types:
                self.types.setdefault(kind, len(self.types))
            for j in range(len(each.bodies)):
                self.own[k, len(each.imported) + j] = len(self.own)
            self.functions |= {name: (k, index) for name, index in each.exported.items()}
            self.data |= {
                one.name: (k, one.item, one.offset)
                for one in each.symbols
                if one.kind == A_DATUM and not one.flags & UNDEFINED
            }
        lacking = {
            name: each.types[kind] for each in objects for name, kind in each.imported if name not in self.functions
        }
        self.lacking = dict(sorted(lacking.items()))
        self.imports = {name: k for k, name in enumerate(self.lacking)}
        self.slots: dict[int, int] = {}  # function → place in the table, of those whose address the code takes
        self.places: dict[tuple[int, int], int] = {}
        at = FIRST
        for k, each in enumerate(objects):
            for j, (_, content) in enumerate(each.data):
                alignment = each.alignment[j] if j < len(each.alignment) else 16
                at = -(-at // alignment) * alignment
                self.places[k, j] = at
                at += len(content)
        self.stack = -(-(at + STACK) // LINE) * LINE

    def function(self, k: int, index: int) -> int:
        """Number in the module of a function of object k."""
        imported = self.objects[k].imported
        if index < len(imported):
            name = imported[index][0]
            if name in self.imports:
                return self.imports[name]
            k, index = self.functions[name]
        return len(self.imports) + self.own[k, index]

    def value(self, k: int, relocation: Relocation) -> int:
        """What belongs to the place of a relocation of object k."""
        kind, each = relocation.kind, self.objects[k]
        if kind == TYPE:
            return self.types[each.types[relocation.item]]
        if kind in (GLOBAL, TABLE_NUMBER):
            return 0  # the pointer of the stack and the table are the only ones
        symbol = each.symbols[relocation.item]
        if kind == FUNCTION:
            return self.function(k, symbol.item)
        if kind in (TABLE_SLEB, TABLE_I32):
            return self.slots.setdefault(self.function(k, symbol.item), len(self.slots) + 1)
        if kind in (MEMORY_LEB, MEMORY_SLEB, MEMORY_I32):
            owner, part, offset = (
                self.data[symbol.name] if symbol.flags & UNDEFINED else (k, symbol.item, symbol.offset)
            )
            return self.places[owner, part] + offset + relocation.addend
        raise NotImplementedError(f"relocation {kind}")

    def moved(self, k: int, section: int, start: int, content: bytes) -> bytes:
        """The bytes of a section of object k from `start` on, with what belongs to its places."""
        out = bytearray(content)
        for relocation in self.objects[k].relocations.get(section, []):
            at = relocation.offset - start
            if 0 <= at < len(content):
                value = self.value(k, relocation)
                code = struct.pack("<I", value) if relocation.kind in (TABLE_I32, MEMORY_I32) else padded(value)
                out[at : at + len(code)] = code
        return bytes(out)


def linked(objects: Sequence[Object]) -> bytes:
    """The module of these objects."""
    link = _Linker(objects)
    bodies = [
        number(len(body)) + link.moved(k, CODE, at, body) for k, each in enumerate(objects) for at, body in each.bodies
    ]
    declared = [number(link.types[each.types[kind]]) for each in objects for kind in each.declared]
    data = [
        b"\0\x41"
        + number(link.places[k, j], signed=True)
        + b"\x0b"
        + number(len(content))
        + link.moved(k, DATA, at, content)
        for k, each in enumerate(objects)
        for j, (at, content) in enumerate(each.data)
    ]
    outside = text("env")
    imports = [outside + text(name) + b"\0" + number(link.types[kind]) for name, kind in link.lacking.items()]
    imports += [outside + text("memory") + b"\2\0\1", outside + text("__indirect_function_table") + b"\1\x70\0\1"]
    exports = [text(name) + b"\0" + number(link.function(*place)) for name, place in link.functions.items()]
    base = number(link.stack, signed=True)
    sections = {
        1: vector([*link.types]),
        2: vector(imports),
        3: vector(declared),
        6: vector([b"\x7f\1\x41" + base + b"\x0b", b"\x7f\0\x41" + base + b"\x0b"]),
        7: vector([*exports, text("__heap_base") + b"\3\1"]),
        9: vector([b"\0\x41\1\x0b" + vector([number(each) for each in link.slots])] if link.slots else []),
        CODE: vector(bodies),
        DATA: vector(data),
    }
    return MAGIC + b"".join(
        bytes([kind]) + number(len(part)) + part for kind, part in sections.items() if part != b"\0"
    )
