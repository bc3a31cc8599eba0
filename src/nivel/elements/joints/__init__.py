"""Joints: the record, kinds in a file for each group of them, couplings and drivers."""

from typing import Annotated, Final

from nivel.elements.joints.kind import Composition, JointKind
from nivel.elements.kind import Kinds, WordOf

# a new kind of joint is a `JointKind` in a module of this folder; see `docs/extending.md`
JOINTS: Final = Kinds[JointKind](__name__, noun="joint", mark=r'(?:JointKind|_sliding)\(\s*"([\w-]+)"')
JointType = Annotated[str, WordOf(JOINTS)]
UNKNOWN: Final = JointKind("", Composition(()))


def drawn(word: str) -> JointKind:
    """A kind of joint for pictures, also of one that is not known, as in results of others: a thin circle."""
    return JOINTS.get(word, UNKNOWN)
