"""Slopes of dual numbers, for kernels that seed and read them.

unit(k, size) is the dual number 0 with this slope along direction k, slope(x, k) the slope of x along it. is_whole(machine): whether all
numbers of the record at this address are dual, for gradients of runs; where it is false nothing is compiled of what it asks about.
"""

from nivel.native.duals import LANES
from nivel.native.function import leaf, written

unit, slope, is_whole = written("duals:unit"), written("duals:slope"), written("views:is_whole")


@leaf
def steepest(x):
    """The largest slope of x, whatever its sign and direction."""
    largest = 0.0
    for k in range(LANES):
        size = abs(slope(x, k))
        if not size <= largest:
            largest = size
    return largest
