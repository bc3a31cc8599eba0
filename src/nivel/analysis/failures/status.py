"""Statuses of an analysis: those of kernels, in the order of their numbers, and those that are found between steps."""

from __future__ import annotations

from enum import IntEnum

from nivel.kernels.core import status as of_kernels


class Status(IntEnum):
    """How a call of kernels, or a run, ended."""

    OUT_OF_REACH = -2  # steps are so short that there are too many to the end
    CRAWLS = -1  # steps have shrunk to nothing where a function jumps
    OK = of_kernels.OK
    SINGULAR = of_kernels.SINGULAR
    NOT_FINITE = of_kernels.NOT_FINITE
    BUFFER_FULL = of_kernels.BUFFER_FULL
    BUDGET_SPENT = of_kernels.BUDGET_SPENT
    DONE = of_kernels.DONE
    FRICTION_DIVERGES = of_kernels.FRICTION_DIVERGES
    BRISTLE_TOO_FAST = of_kernels.BRISTLE_TOO_FAST
    CONTRADICTION = of_kernels.CONTRADICTION
    ROTATION_SINGULAR = of_kernels.ROTATION_SINGULAR
    NOT_CONVERGED = of_kernels.NOT_CONVERGED
    STEP_TOO_SMALL = of_kernels.STEP_TOO_SMALL
    EVENT_NOT_FINITE = of_kernels.EVENT_NOT_FINITE
    MULTIPLIERS_NOT_FOUND = of_kernels.MULTIPLIERS_NOT_FOUND
    NO_MASS_LEFT = of_kernels.NO_MASS_LEFT
    NOT_ON_RAIL = of_kernels.NOT_ON_RAIL
    NOT_CLOSED = of_kernels.NOT_CLOSED
    OPEN = of_kernels.OPEN
    NO_VOLUME = of_kernels.NO_VOLUME
