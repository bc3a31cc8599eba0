"""Forces in numbers: every module of this folder says in KINDS which kinds of forces it makes, of which words and with which kernels.

A new kind of force is its words (`nivel.machine.forces`), its kernel (`nivel.kernels.forces`) and a module here; see `docs/extending.md`.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

from nivel.machine.forces import register as register_words
from nivel.machine.machine_record import MachineRecord
from nivel.system.forces.kind import ForceKind

FORCES: dict[str, ForceKind] = {
    kind.type: kind
    for module in iter_modules(__path__)
    for kind in getattr(import_module(f"{__name__}.{module.name}"), "KINDS", ())
}


def register_force(kind: ForceKind) -> None:
    """Let machines have a kind of force that is not of the package. Raises ValueError where its word is taken."""
    if kind.type in FORCES:
        raise ValueError(f"there is a force of type '{kind.type}' already")
    register_words(kind.words)
    FORCES[kind.type] = kind
    MachineRecord.model_rebuild(force=True)
