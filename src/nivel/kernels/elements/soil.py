"""Cells of soil as kernels have them: heights on a grid."""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.core.arrays import F1, F2, F3
from nivel.kernels.core.handle import reader
from nivel.kernels.record.hook import law


class Cells(NamedTuple):
    """Soil in numbers. Node (i, j) stands at (i, j) CELL from the corner of least x and y of the plane."""

    number: F1  # SoilRow of `nivel.elements.contacts.on_soil`
    h: F2  # (n, m) [m] heights
    rest: F2  # (n, m) [m] heights from which soil was pressed down: undisturbed
    shear: F3  # (n, m, 2) share of the shear strength that acts along x and y


cells_at = reader(Cells)


@law
def address_of(row):
    """The address of cells, the first of its arguments."""
    return row[0]
