"""The direct correction of `nivel.motion.tree_correction` for trees with flexible bodies."""

from __future__ import annotations

from nivel.kernels.record.record import CORRECT
from nivel.kernels.tree.flexible_whitening import accelerate_flexible
from nivel.motion.flexible_tree import factorise_flexible, read_flexible_tree
from nivel.motion.tree_correction import correct_tree
from nivel.native.entry import entry


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints."""
    return correct_tree(machine, t, y, read_flexible_tree, factorise_flexible, accelerate_flexible)
