"""Forces in numbers: for every kind, the family of kernels that computes it and the columns that it fills there.

A new kind of force is its words (`nivel.machine.forces`), its kernel (`nivel.kernels.forces`), its columns and its entry of FORCES.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Final

from nivel.system.draft import Draft
from nivel.system.forces.actuators import add_motor, add_stop
from nivel.system.forces.contacts import add_bushing, add_contact
from nivel.system.forces.frictions import add_friction
from nivel.system.forces.loads import add_load, add_pair
from nivel.system.forces.springs import add_joint_spring_damper, add_spring_damper, add_torsional_spring_damper


@dataclass(frozen=True)
class ForceKind:
    """How a kind of force becomes numbers, and the families of kernels (`nivel.kernels.forces`) that it may need."""

    add: Callable[[Draft, Any], None]
    families: tuple[str, ...]


FORCES: Final[dict[str, ForceKind]] = {
    "force": ForceKind(add_load, ("load",)),
    "torque": ForceKind(add_load, ("load",)),
    "pair-force": ForceKind(add_pair, ("load", "motor")),
    "spring-damper": ForceKind(add_spring_damper, ("spring",)),
    "torsional-spring-damper": ForceKind(add_torsional_spring_damper, ("spring",)),
    "joint-spring-damper": ForceKind(add_joint_spring_damper, ("spring",)),
    "stop": ForceKind(add_stop, ("stop",)),
    "motor": ForceKind(add_motor, ("motor",)),
    "bushing": ForceKind(add_bushing, ("bushing",)),
    "contact": ForceKind(add_contact, ("contact",)),
    "friction": ForceKind(add_friction, ()),
}


def family_addresses(families: list[str]) -> dict[str, int]:
    """Address of the compiled function of every family."""
    return {name: int(import_module(f"nivel.kernels.forces.{name}").apply.address) for name in families}
