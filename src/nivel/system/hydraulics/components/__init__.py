"""Components of circuits in numbers: every module of this folder states in KINDS which kinds of components it makes.

A new kind of component is its words (`nivel.machine.hydraulics`), its kernel (`nivel.kernels.hydraulics`) and a module here; see
`docs/extending.md`.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

from nivel.machine.hydraulics import register as register_words
from nivel.machine.machine_record import MachineRecord
from nivel.system.hydraulics.kind import ComponentKind

COMPONENTS: dict[str, ComponentKind] = {
    kind.type: kind for module in iter_modules(__path__) for kind in import_module(f"{__name__}.{module.name}").KINDS
}


def register_component(kind: ComponentKind) -> None:
    """Let machines have a kind of component that is not of the package. Raises ValueError where its word is taken."""
    if kind.type in COMPONENTS:
        raise ValueError(f"there is a component of type '{kind.type}' already")
    register_words(kind.words)
    COMPONENTS[kind.type] = kind
    MachineRecord.model_rebuild(force=True)
