"""Expressions of a place: what an assumed mode does at x, y, z."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from nivel.flexible.model import Array
from nivel.machine.units.arithmetic import ExpressionError, FaultyParameterError, Parameters, bind, evaluate
from nivel.machine.units.grammar import parse

PLACES: Final = ("x", "y", "z")

PlaceFunction = Callable[[Array, Array, Array], Array]


class PlaceError(ValueError):
    """The expression cannot be used; the message says why."""


def place_function(given: str | float, parameters: Parameters) -> PlaceFunction:
    """The function of x, y, z [m], arrays (n,), that `given` says: a number or an expression such as ``(x/2)^2``.

    Raises PlaceError.
    """
    if isinstance(given, int | float):
        return lambda x, _y, _z: np.full(len(x), float(given))
    try:
        tree = bind(parse(given), parameters, PLACES)
    except FaultyParameterError:
        raise PlaceError("a parameter in it is at fault") from None
    except ExpressionError as error:
        raise PlaceError(f"`{given}`: {error}") from None

    def function(x: Array, y: Array, z: Array) -> Array:
        try:
            return np.array([evaluate(tree, values={"x": a, "y": b, "z": c}) for a, b, c in zip(x, y, z, strict=True)])
        except ExpressionError as error:
            raise PlaceError(f"`{given}`: {error}") from None

    return function
