"""Joints in numbers: every module of `kinds` says in KINDS which kinds of joints it has.

A new kind of joint is its words (`nivel.machine.joints.joint`) and a kind in a module of `kinds`; see `docs/extending.md`.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pkgutil import iter_modules
from typing import Final

from nivel.machine.joints.joint import Joint, JointWords
from nivel.machine.joints.joint import register as register_words
from nivel.machine.machine_record import MachineRecord
from nivel.system.joints import kinds, symbols
from nivel.system.joints.composition import Composition
from nivel.system.joints.kind import JointKind, Looks

JOINTS: Final[dict[str, JointKind]] = {
    kind.type: kind
    for module in iter_modules(kinds.__path__)
    for kind in getattr(import_module(f"{kinds.__name__}.{module.name}"), "KINDS", ())
}
_LOOKS: Final = Looks()


def register_joint(kind: JointKind, words: JointWords) -> None:
    """Let machines have a kind of joint that is not of the package.

    Raises ValueError where its word is taken, and where coordinates of kind and words differ.
    """
    if kind.type in JOINTS:
        raise ValueError(f"there is a joint of type '{kind.type}' already")
    names = tuple(coordinate.name for coordinate in kind.composition.coordinates)
    if names != words.coordinates:
        raise ValueError(f"the composition of '{kind.type}' has the coordinates {names}, its words {words.coordinates}")
    register_words(kind.type, words)
    JOINTS[kind.type] = kind
    MachineRecord.model_rebuild(force=True)


def composition_of(joint: Joint) -> Composition:
    """What a joint is made of, where the directions of its axes are as they should be."""
    kind = JOINTS[joint.type]
    return kind.composition if kind.composed is None else kind.composed(joint)


def looks_of(kind: str) -> Looks:
    """Looks of a kind of joint, also of one that is not known, as in results of others."""
    return JOINTS[kind].looks if kind in JOINTS else _LOOKS


def symbol_of(kind: str) -> Callable[[bool], str]:
    """Its sign; a thin circle where it has none, or is not known."""
    return JOINTS[kind].symbol or symbols.unknown if kind in JOINTS else symbols.unknown
