"""Stubs of the rooms of records, so that editors and type checkers know every record: `nivel.hydraulics.Pump`."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any, Final

import nivel
from nivel.elements.circuits import COMPONENTS
from nivel.elements.control import BLOCKS
from nivel.elements.forces import FORCES
from nivel.elements.joints import JOINTS

ROOMS: Final = {"forces": FORCES, "circuits": COMPONENTS, "control": BLOCKS}
OTHERS: Final = {"circuits": ("Fluid", "Gas")}  # records of rooms that are no kinds of an element
HEAD: Final = """# Written by `python packaging/write_settings.py` from the records. Do not edit.
# fmt: off
# ruff: noqa
# pyright: reportOptionalMemberAccess=false
"""


def records_of(room: str) -> list[type[Any]]:
    """The records of a room, without those that another package registered."""
    return [record for record in ROOMS[room].records if record.__module__.startswith("nivel.")]


def stub(room: str) -> str:
    """The text of `nivel/elements/ROOM/__init__.pyi`: what its module says, and its records."""
    module = import_module(f"nivel.elements.{room}")
    source = Path(str(module.__file__)).read_text(encoding="utf-8").partition("\n\ndef __getattr__")[0]
    records = [*records_of(room), *(getattr(module, name) for name in OTHERS.get(room, ()))]
    lines = sorted(f"from {record.__module__} import {record.__name__} as {record.__name__}" for record in records)
    return "\n".join((HEAD + source.rstrip(), "", *lines, ""))


def stub_of_joints() -> str:
    """The text of `nivel/elements/joints/__init__.pyi`: a joint is one record, whose types are words."""
    module = import_module("nivel.elements.joints")
    source = Path(str(module.__file__)).read_text(encoding="utf-8")
    words = f"Literal[{', '.join(map(repr, sorted(JOINTS.homes)))}]"
    return HEAD + source.replace("Annotated[str, WordOf(JOINTS)]", words).replace("Annotated, Final", "Final, Literal")


def stub_of_package() -> str:
    """The text of `nivel/__init__.pyi`."""
    rooms = [(*module.rsplit(".", 1), name) for name, module in nivel._ROOMS.items()]
    names = [(module, name, name) for name, module in nivel._HOME.items()]
    lines = sorted(f"from {module} import {inside} as {name}" for module, inside, name in (*rooms, *names))
    return "\n".join((HEAD, *lines, "", "__version__: str", f"__all__ = {nivel.__all__!r}", ""))


def write_stubs() -> None:
    """Write the stubs of the package and of all rooms."""
    Path(str(nivel.__file__)).with_suffix(".pyi").write_text(stub_of_package(), encoding="utf-8")
    (Path(str(import_module("nivel.elements.joints").__file__)).with_suffix(".pyi")).write_text(
        stub_of_joints(), encoding="utf-8"
    )
    for room in ROOMS:
        module = import_module(f"nivel.elements.{room}")
        Path(str(module.__file__)).with_suffix(".pyi").write_text(stub(room), encoding="utf-8")
