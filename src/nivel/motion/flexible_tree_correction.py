"""The direct correction of `nivel.motion.tree_correction` for trees with flexible bodies."""

from __future__ import annotations

from nivel.kernels.compile import entry
from nivel.kernels.flexible_whitening import accelerate_flexible
from nivel.kernels.record import correct_signature
from nivel.motion.flexible_tree import factorise_flexible, read_flexible_tree
from nivel.motion.tree_correction import correct_tree


@entry(correct_signature)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints."""
    return correct_tree(machine, t, y, read_flexible_tree, factorise_flexible, accelerate_flexible)
