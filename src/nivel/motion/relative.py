"""Relative coordinates: joint coordinates of a spanning tree, loops closed by the constraints of the joints that are cut.

q = joint coordinates (Euler parameters of spherical and free joints), v = joint velocities. The mass matrix is factorised by the
articulated-body recursion, which gives W and z; multipliers of the cut joints follow as in all other coordinates.
"""

from __future__ import annotations

from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces
from nivel.kernels.record.record import CORRECT, EVALUATE, record_at
from nivel.kernels.solve.saddle import factorise_rows
from nivel.kernels.tree.articulated import accelerate, factorise_tree, whiten_efforts, whiten_tree_rows
from nivel.kernels.tree.tree import move_tree
from nivel.kernels.tree.tree_markers import read_markers
from nivel.motion.tree_motion import WIDTH, evaluate_tree, normalise
from nivel.native.entry import entry
from nivel.native.function import stage


@stage
def read_state(machine, t, y):
    """Poses and velocities of bodies and of the markers in use, and the rows that are left. Returns a status."""
    move_tree(machine, y)
    return read_markers(machine, t)


@stage
def load_tree(machine, t, y):
    """All applied forces on bodies. Returns a status."""
    load_weight(record_at(machine).bodies)
    return apply_forces(machine, t, y)


@stage
def factorise(machine):
    """Factors of the mass matrix and of S = W Wᵀ in the state last read. Returns a status."""
    record = record_at(machine)
    factorise_tree(record.bodies, record.tree)
    if record.saddle.block.shape[0] == 0:
        return OK
    whiten_tree_rows(machine)
    return factorise_rows(machine, WIDTH)


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ. Leaves everything else in the record but what `nivel.kernels.tree.tree_outputs` adds for frames."""
    return evaluate_tree(machine, t, y, ydot, read_state, load_tree, factorise, whiten_efforts, accelerate)


@entry(CORRECT)
def normalise_state(machine, t, y):
    """No correction; |θ| is brought back to one, which moves nothing."""
    normalise(machine, y)
    return OK
