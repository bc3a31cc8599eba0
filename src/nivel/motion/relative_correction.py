"""The direct correction of `nivel.motion.tree_correction` for trees of rigid bodies."""

from __future__ import annotations

from nivel.kernels.record.record import CORRECT
from nivel.kernels.tree.articulated import accelerate
from nivel.motion.relative import factorise, read_state
from nivel.motion.tree_correction import correct_tree
from nivel.native.entry import entry


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints."""
    return correct_tree(machine, t, y, read_state, factorise, accelerate)
