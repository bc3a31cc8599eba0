"""One screen with all keys of a machine file, made from the records that read it."""

from __future__ import annotations

import re
from html import escape
from typing import Any

from nivel.elements.forces.drives import Drive
from nivel.elements.joints import JOINTS
from nivel.files.joint_parts import DESCRIBED
from reference import kind_of, parts_of, read_before, sections

ENDS = ("markers", "bodies", "points")
SHORT = 34  # characters of choices that are listed
UNIT = re.compile(r"\bin ([^|()]+?)(?= \||\)|$)")
CHOICE = re.compile(r"^(?:'[\w-]+'(?: \| )?)+$")
TOP = """<p class="key"><b>format</b> <u>1</u> · name · description · gravity <i>m/s²</i> · parameters · functions · include · assemblies ·
surroundings: [solids], left_out: [texts]. A number can have a unit and arithmetic: <code>2*length + 5 cm</code>. <b>Bold</b>: must be
given. <em>ends</em>: markers, or bodies and points. Joint coordinates (→) are read as <code>hinge.angle</code>, their rates as
<code>hinge.angle_rate</code>.</p>"""


def cheat_sheet() -> str:
    """The page: sections, kinds of elements with their keys, units."""
    from nivel.files.assembly import Assembly
    from nivel.files.include import Include

    records = sections()
    used = parts_of(record for found in records.values() for record in found)
    blocks = [_block(section, found) for section, found in records.items() if section != "joints"]
    blocks.insert(3, _joints(records["joints"][0]))
    blocks.append(f"<h4>files</h4>{_line('include', Include, ())}{_line('assemblies', Assembly, ())}")
    blocks.append(
        '<h4>tyres, ground, catalogue</h4><p class="key">sets of keys, named by <b>tyre</b>, <b>ground</b>, <b>part</b></p>'
    )
    blocks.append(f"<h4>parts of elements</h4>{''.join(_line(_title(part), part, ()) for part in used)}")
    return "\n".join(
        [
            "---",
            "hide: [navigation, toc]",
            "---",
            "# All keys on one screen",
            "",
            f'<div class="sheet">{TOP}{"".join(f"<section>{each}</section>" for each in blocks)}</div>',
            "",
            "Defaults and meanings: [every key](keys.md). Explanations: [machine files](machine-files.md).",
            "",
        ]
    )


def _block(section: str, records: list[type]) -> str:
    """A section of the file with its kinds; what all kinds have stands once."""
    fields = [set(_fields(record)) for record in records]
    common = set.intersection(*fields) if len(records) > 2 else set()
    shared = [name for name in _fields(records[0]) if name in common]
    head = f'<p class="key"><em>all</em> {_keys(records[0], shared)}</p>' if shared else ""
    drives = [record for record in records if issubclass(record, Drive)]
    of_drives = [name for name in _fields(drives[0]) if name in Drive.model_fields] if drives else []
    if drives:
        head += f'<p class="key"><em>{", ".join(map(kind_of, drives))}</em> {_keys(drives[0], of_drives)}</p>'
    known = {record: of_drives if record in drives else shared for record in records}
    lines = [_line(kind_of(record) or "", record, known[record]) for record in records]
    return f"<h4>{section}</h4>{head}{''.join(lines)}"


def _joints(record: Any) -> str:
    """Joints by type: what places them, what size they need, and their coordinates."""

    lines = []
    for name, kind in JOINTS.items():
        given = " ".join(f"<b>{key}</b>" for key in (*kind.place, *kind.size))
        more = " ".join(kind.may_size)
        found = f" → {' '.join(kind.coordinates)}" if kind.coordinates else ""
        lines.append(f'<p class="key"><code>{name}</code> {given} {more}{found}</p>')
    keys = f"{_keys(record, _fields(record))} · {' · '.join(DESCRIBED)}"
    return f'<h4>joints</h4><p class="key"><em>all</em> {keys}</p>{"".join(lines)}'


def _line(title: str, record: Any, without: Any) -> str:
    names = [name for name in _fields(record) if name not in without]
    head = f"<code>{title}</code> " if title else ""
    more = "".join(f" · {key}" for key in read_before(record))
    return f'<p class="key">{head}{_keys(record, names)}{more}</p>'


def _title(record: Any) -> str:
    kind = kind_of(record)
    if kind and record.__module__.startswith("nivel.elements.beams"):
        return f"{kind} section"
    return kind or re.sub(r"(?<=[a-z])(?=[A-Z])", " ", record.__name__).lower()


def _fields(record: Any) -> list[str]:
    """Fields of a record besides its name and type, those of two ends as one."""
    names = [name for name in record.model_fields if name not in ("name", "type")]
    if set(ENDS) <= set(names) and not any(record.model_fields[name].is_required() for name in ENDS):
        names = ["ends", *(name for name in names if name not in ENDS)]
    return names


def _keys(record: Any, names: list[str]) -> str:
    return " · ".join("<em>ends</em>" if name == "ends" else _key(name, record.model_fields[name]) for name in names)


def _key(name: str, field: Any) -> str:
    """A key with its unit, or with its few words."""
    from nivel.machine.core.record import words_of

    key = escape(field.alias or name)
    words = words_of(field)
    units = [unit for unit in dict.fromkeys(UNIT.findall(words)) if not unit.startswith("SI ")]
    said = ""
    if units:
        said = f" <i>{escape(', '.join(_in_short(unit) for unit in units[:2]))}</i>"
    elif CHOICE.match(words) and len(words) <= SHORT:
        said = f" <u>{escape(words.replace(chr(39), '').replace(' | ', ' or '))}</u>"
    return f"<b>{key}</b>{said}" if field.is_required() else f"{key}{said}"


def _in_short(unit: str) -> str:
    return unit.replace("^4", "⁴").replace("^3", "³").replace("^2", "²").replace("*", " ")


SHEET_STYLE = """
.md-main__inner:has(.sheet){margin-top:4px}
.md-content__inner:has(.sheet){padding-top:0}
.md-content__inner:has(.sheet)::before{display:none}
.md-content__inner:has(.sheet) h1{margin:0 0 2px;font-size:15px}
.sheet{columns:6;column-gap:8px;column-rule:1px solid var(--md-default-fg-color--lightest);font-size:8px;line-height:1.02}
.md-typeset .sheet h4{margin:2px 0 0;font-size:8.8px;line-height:1.2;font-weight:700;color:var(--md-accent-fg-color);break-after:avoid}
.md-typeset .sheet p.key{margin:0;padding-left:7px;text-indent:-7px}
.md-typeset .sheet code{font-size:8px;padding:0;background:none;font-weight:700;color:var(--md-primary-fg-color)}
.sheet i{color:var(--md-default-fg-color--light);font-size:7px}
.sheet u{text-decoration:none;color:var(--md-default-fg-color--light)}
.sheet em{color:var(--md-accent-fg-color)}
@media (max-width:1000px){.sheet{columns:2;font-size:10px}}
@media (max-width:600px){.sheet{columns:1;font-size:12px}}
"""
