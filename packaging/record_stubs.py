"""Stubs of the rooms of records, so that editors and type checkers know every record: `nivel.hydraulics.Pump`."""

from __future__ import annotations

import ast
import re
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
# packages besides nivel that are imported late, with their modules
LATE: Final = """PIL.Image distributed gymnasium.vector h5py imageio_ffmpeg matplotlib matplotlib.figure matplotlib.pyplot
meshio numpy pint pyarrow rich.box rich.console rich.live rich.progress rich.table rich.text scipy
scipy.integrate scipy.interpolate scipy.io scipy.linalg scipy.optimize scipy.signal scipy.sparse
scipy.sparse.csgraph scipy.sparse.linalg scipy.spatial scipy.spatial.transform scipy.stats skfem
skfem.helpers skfem.io.meshio skfem.models.elasticity skfem.models.poisson websockets.asyncio.server
websockets.exceptions websockets.sync.client xarray"""
OF_LAZY: Final = """from collections.abc import Mapping
from contextlib import _GeneratorContextManager
from dataclasses import asdict, dataclass, field, fields, is_dataclass, replace
from typing import Any, Final, dataclass_transform

PLACES: Final[dict[str, str]]

class Late:
    def __init__(self, name: str) -> None: ...
    def __getattr__(self, name: str) -> Any: ...

def homes(file: str) -> dict[str, tuple[str, str]]: ...
def all_kept() -> _GeneratorContextManager[None]: ...
def provide(places: Mapping[str, str]) -> None: ...
def provided(subject: str) -> Any: ...
@dataclass_transform(frozen_default=True, field_specifiers=(field,))
class Struct:
    def __init_subclass__(
        cls, *, frozen: bool = True, repr: bool = True, eq: bool = True, order: bool = False, kw_only: bool = False
    ) -> None: ...
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


def late_modules() -> set[str]:
    """Modules of nivel whose names are written in full in files that take `nivel` from `nivel.lazy`."""
    package = Path(str(nivel.__file__)).parent
    texts = {path: path.read_text(encoding="utf-8") for path in package.rglob("*.py")}
    places = {
        ".".join(path.relative_to(package.parent).with_suffix("").parts).removesuffix(".__init__") for path in texts
    }
    found = set()
    for text in texts.values():
        if not re.search(r"^from nivel\.lazy import .*\bnivel\b", text, re.MULTILINE):
            continue
        nodes = list(ast.walk(ast.parse(text)))
        # functions, some with the name of their module
        called = [node.func for node in nodes if isinstance(node, ast.Call)]
        for node in nodes:
            name = ast.unparse(node) if isinstance(node, ast.Attribute) and node not in called else ""
            found |= {name} & places if re.fullmatch(r"nivel(\.\w+)+", name) else set()
    return found | {"nivel"}


def stub_of_lazy() -> str:
    """The text of `nivel/lazy.pyi`: packages and modules that are imported late, as they are."""
    modules = sorted({*LATE.split(), *late_modules()})
    public = {
        "PLACES",
        "Late",
        "Struct",
        "homes",
        "provide",
        "provided",
        "asdict",
        "dataclass",
        "field",
        "fields",
        "is_dataclass",
        "replace",
    }
    names = sorted(public | {module.partition(".")[0] for module in modules})
    return "\n".join((HEAD + OF_LAZY, *(f"import {module}" for module in modules), "", f"__all__ = {names!r}", ""))


def write_stubs() -> None:
    """Write the stubs of all rooms and of what is imported late."""
    (Path(str(nivel.__file__)).parent / "lazy.pyi").write_text(stub_of_lazy(), encoding="utf-8")
    (Path(str(import_module("nivel.elements.joints").__file__)).with_suffix(".pyi")).write_text(
        stub_of_joints(), encoding="utf-8"
    )
    for room in ROOMS:
        module = import_module(f"nivel.elements.{room}")
        Path(str(module.__file__)).with_suffix(".pyi").write_text(stub(room), encoding="utf-8")
