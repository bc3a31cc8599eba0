# Written by `python packaging/write_settings.py` from the records. Do not edit.
# fmt: off
# ruff: noqa
# pyright: reportOptionalMemberAccess=false
"""Joints: the record, kinds in a file for each group of them, couplings and drivers."""

from typing import Final, Literal

from nivel.elements.joints.kind import Composition, JointKind
from nivel.elements.kind import Kinds, WordOf

# a new kind of joint is a `JointKind` in a module of this folder; see `docs/extending.md`
JOINTS: Final = Kinds[JointKind](__name__, noun="joint", mark=r'(?:JointKind|_sliding)\(\s*"([\w-]+)"')
JointType = Literal['cylindrical', 'cylindrical-on-beam', 'distance', 'fixed', 'generic', 'keyed-on-beam', 'planar', 'point-on-beam', 'point-on-line', 'point-on-plane', 'revolute', 'revolute-cylindrical', 'revolute-spherical', 'revolute-translational', 'rolling', 'screw', 'skew-universal', 'spherical', 'spherical-spherical', 'translational', 'translational-on-beam', 'translational-universal', 'universal', 'variable-distance']
UNKNOWN: Final = JointKind("", Composition(()))


def drawn(word: str) -> JointKind:
    """A kind of joint for pictures, also of one that is not known, as in results of others: a thin circle."""
    return JOINTS.get(word, UNKNOWN)
