"""Cells of soil as kernels have them: heights on a grid, with what is carried of it."""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.core.arrays import F1, F2, F3, I1
from nivel.kernels.core.handle import reader
from nivel.kernels.record.hook import law


class Cells(NamedTuple):
    """Soil in numbers. Node (i, j) stands at (i, j) CELL from the corner of least x and y of the plane."""

    number: F1  # SoilRow of `nivel.elements.contacts.soil`
    sum: F1  # (SUMS,)
    h: F2  # (n, m) [m] heights
    rest: F2  # (n, m) [m] heights from which soil was pressed down: undisturbed, or cut or poured last
    shear: F3  # (n, m, 2) share of the shear strength that acts along x and y
    marked: I1  # (n m,) whether a node is on the ring of those that may slide
    held: I1  # (n m,) sample at which a blade held a node
    ring: I1  # (n m,)
    turn: I1  # first of the ring, how many are on it, number of the sample
    volume: F1  # (forces,) [m³] carried
    moved: F1  # (forces,) [m³] cut, dropped or pressed down so far
    impulse: F2  # (forces, 6) [N s, N m s] that takes along what came in at the last sample
    edge: F2  # (forces, 6) [m] where its ends were then
    mouth: F2  # (forces, 7) into which soil falls: x, y of a corner, the unit vector along it, its sides, both signed, and its height [m]
    fallen: F1  # (forces,) [m³] that fell into it, and is carried from its next sample on
    body: (
        F2  # (forces, 13) of the body without load, where it is known: mass [kg], centre [m], inertia about it [kg m²]
    )


FIRST, COUNT, STAMP = 0, 1, 2  # entries of Cells.turn
# entries of Cells.sum: volume added to the cells [m³], what that has stored [J], volume that fell beyond the border [m³], energy that the
# last sample has lost [J], which goes to the account of losses in the period behind it
ADDED, STORED, BEYOND, LOST, SUMS = 0, 1, 2, 3, 4
cells_at = reader(Cells)


@law
def address_of(row):
    """The address of cells, the first of its arguments."""
    return row[0]
