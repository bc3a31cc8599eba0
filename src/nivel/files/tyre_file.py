"""Tyres of files: `file: front.tir` of a tyre, a Magic Formula of version 5.2 or 6.1 in sections of `KEY = number` (TYDEX, MF-Tyre).

Sizes, loads and stiffness of the file stand where the tyre has none of its own, and all its numbers under `magic`, in SI units. `$`, `!`
and `#` begin comments, a key without a value is absent, rows of tables are counted and not used.
"""

import re
from typing import Any, Final

from nivel.elements.forces.magic_formula import POSITIVE, SCALES, MagicFormula, faults_of
from nivel.files.outline import section_of
from nivel.files.sources import Sources
from nivel.files.tree import Path, Tree
from nivel.lazy import Struct, field

VERSIONS: Final = {5: "5.2", 6: "5.2", 51: "5.2", 52: "5.2", 60: "6.1", 61: "6.1", 62: "6.1"}  # by FITTYP
FORMATS: Final = {
    "PAC2002": "5.2",
    "MF_05": "5.2",
    "MF-TYRE": "5.2",
}  # by PROPERTY_FILE_FORMAT, where there is no FITTYP
UNITS: Final = {
    "LENGTH": {"meter": 1.0, "metre": 1.0, "m": 1.0, "cm": 0.01, "mm": 1e-3, "millimeter": 1e-3, "inch": 0.0254, "foot": 0.3048},
    "FORCE": {"newton": 1.0, "n": 1.0, "knewton": 1e3, "kn": 1e3, "kilonewton": 1e3, "lbf": 4.4482216152605},
    "PRESSURE": {"pascal": 1.0, "pa": 1.0, "kpa": 1e3, "bar": 1e5, "mpa": 1e6, "psi": 6894.757293168361},
    "TIME": {"second": 1.0, "seconds": 1.0, "sec": 1.0, "s": 1.0},
    "ANGLE": {"radian": 1.0, "radians": 1.0, "rad": 1.0},
}  # fmt: skip
MEASURED: Final = {
    "UNLOADED_RADIUS": ("LENGTH", 1), "WIDTH": ("LENGTH", 1), "LONGVL": ("LENGTH", 1), "FNOMIN": ("FORCE", 1),
    "INFLPRES": ("PRESSURE", 1), "NOMPRES": ("PRESSURE", 1),
    **dict.fromkeys(("VERTICAL_STIFFNESS", "VERTICAL_DAMPING", "LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS"), ("FORCE", -1)),
}  # fmt: skip
RENAMED: Final = {"IP": "INFLPRES", "IP_NOM": "NOMPRES"}
LINE: Final = re.compile(r"([A-Za-z_][\w .-]*?)\s*=\s*(?:'([^']*)'|\"([^\"]*)\"|([^$!#]*))")


class TyreFile(Struct, frozen=False):
    """Numbers and texts of a file by their keys, the line of each key, and what is wrong, by line."""

    numbers: dict[str, float] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    lines: dict[str, int] = field(default_factory=dict)
    faults: list[tuple[int, str]] = field(default_factory=list)


def read_tyres(tree: Tree, sources: Sources) -> None:
    """Put the numbers of the file of each tyre into it. Faults go to `tree.faults`, once for each file."""
    told: set[str] = set()
    for name, force in section_of(tree, "forces").items():
        if not isinstance(force, dict) or force.get("type") != "tyre" or "file" not in force or "magic" in force:
            continue
        path: Path = ("forces", name, "file")
        found = sources.text(tree, path, force["file"], breaks=path[:2])
        if found is None:
            continue
        read = parsed(found[0])
        if read.faults:
            message = "; ".join(f"line {line}: {text}" if line else text for line, text in sorted(read.faults))
            if found[1] not in told:
                tree.report(path, f"`{force['file']}`: {message}", breaks=path[:2])
            tree.broken.add(path[:2])
            told.add(found[1])
            continue
        formula = formula_of(read)
        force["magic"] = formula.model_dump()
        along, across = formula.carcass()
        sizes = {
            "radius": formula.get("UNLOADED_RADIUS"), "width": read.numbers.get("WIDTH"), "nominal_load": formula.get("FNOMIN"),
            "stiffness": read.numbers.get("VERTICAL_STIFFNESS"), "damping": read.numbers.get("VERTICAL_DAMPING"),
            "rolling_share": formula.rolling_share(), "along": along and {"stiffness": along}, "across": across and {"stiffness": across},
        }  # fmt: skip
        for key, value in sizes.items():
            if value is not None:
                force.setdefault(key, value)


def formula_of(read: TyreFile) -> MagicFormula:
    """The record of a file without faults."""
    side: Any = read.texts.get("TYRESIDE", "LEFT").lower()
    version: Any = _version(read)
    return MagicFormula(version=version, side=side if side in ("left", "right") else "left", coefficients=read.numbers)


def parsed(text: str) -> TyreFile:
    """What stands in the text of a `.tir` file."""
    read, section, units = TyreFile(), "", dict[str, tuple[int, str]]()
    scaling: set[str] = set()
    for number, line in enumerate(map(str.strip, text.splitlines()), 1):
        if not line or line[0] in "$!#":
            continue
        if line[0] == "[" and "]" in line:
            section = line[1:].partition("]")[0].strip().upper()
            continue
        if not section:
            read.faults.append((number, f"a section such as `[UNITS]` was expected, got `{line[:40]}`"))
            return read
        match = LINE.match(line)
        if match is None:
            if line[0] != "{" and not re.match(r"[-+.\d]", line):
                read.faults.append((number, f"`KEY = number` was expected, got `{line[:40]}`"))
            elif line[0] != "{":
                read.numbers[section] = read.numbers.get(section, 0.0) + 1.0  # of rows
            continue
        key = match[1].strip().upper()
        value = next((each for each in match.groups()[1:] if each is not None), "").strip()
        if section == "UNITS":
            units[key] = number, value.lower()
            continue
        if section == "MDI_HEADER":
            continue
        _take(read, number, RENAMED.get(key, key), value, quoted=match[4] is None)
        if section == "SCALING_COEFFICIENTS":
            scaling.add(key)
    _check(read, units, scaling)
    return read


def _take(read: TyreFile, line: int, key: str, value: str, *, quoted: bool) -> None:
    """A value of a line into what was read."""
    if key in read.lines and (key in read.numbers or key in read.texts):
        read.faults.append((line, f"`{key}` stands here a second time; the first is in line {read.lines[key]}"))
        return
    read.lines[key] = line
    if quoted:
        read.texts[key] = value
    elif value:
        try:
            read.numbers[key] = float(value.replace("D", "E").replace("d", "e"))
        except ValueError:
            read.texts[key] = value


def _version(read: TyreFile) -> str | None:
    if "FITTYP" in read.numbers:
        return VERSIONS.get(int(read.numbers["FITTYP"])) if read.numbers["FITTYP"] < 100 else None
    return FORMATS.get(read.texts.get("PROPERTY_FILE_FORMAT", "").upper())


def _check(read: TyreFile, units: dict[str, tuple[int, str]], scaling: set[str]) -> None:
    """Convert to SI units, and collect what is wrong."""
    if _version(read) is None:
        line = read.lines.get("FITTYP", read.lines.get("PROPERTY_FILE_FORMAT", 0))
        known = f"`FITTYP` {', '.join(map(str, VERSIONS))} or `PROPERTY_FILE_FORMAT` {', '.join(FORMATS)} was expected"
        read.faults.append((line, f"{known}: Magic Formula 5.2 or 6.1"))
        return
    factors = dict.fromkeys(UNITS, 1.0)
    for kind, known in UNITS.items():
        line, unit = units.get(kind, (0, next(iter(known))))
        if unit not in known:
            read.faults.append((line, f"`{kind}`: one of {', '.join(known)} was expected, got `{unit}`"))
        factors[kind] = known.get(unit, 1.0)
    for key, text in read.texts.items():
        if key in MEASURED or re.fullmatch(r"[PQRS][A-Z]{2}\d+", key):
            read.faults.append((read.lines[key], f"`{key}`: a number was expected, got `{text[:40]}`"))
    unknown = [key for key in scaling if key not in SCALES and read.numbers.get(key, 1.0) != 1.0]
    for key in unknown:
        read.faults.append((read.lines[key], f"`{key}`: this scaling factor is not known here but as 1"))
    for key, (kind, power) in MEASURED.items():
        value = read.numbers.pop(key, 0.0) * factors[kind] / (1.0 if power > 0 else factors["LENGTH"])
        if value < 0.0:
            read.faults.append((read.lines[key], f"`{key}`: a positive number was expected, got {value:g}"))
        if value or (key in read.lines and key in POSITIVE):  # zero of what may be missing is not told
            read.numbers[key] = value
    told = {line for line, _ in read.faults}
    for key, text in faults_of(read.numbers):
        if read.lines.get(key, 0) not in told:
            read.faults.append((read.lines.get(key, 0), f"`{key}`: {text}"))
