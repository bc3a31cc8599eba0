"""The orientation of a driven marker over time: turns one after the other, a turn about an axis, or Euler parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Final

import numpy as np
from pydantic import BeforeValidator

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.core.orientation import AxisSequence
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.table import Table
from nivel.machine.laws.time_function import FourFunctions, OneFunction, ThreeFunctions, TimeFunction, varying
from nivel.machine.units.expression import Expression
from nivel.machine.units.quantity import Direction, fault, listed
from nivel.machine.units.tree import ExpressionError

AngleMotion = Annotated[OneFunction, varying("angle", smooth=True)]
ShareMotion = Annotated[OneFunction, varying("number", smooth=True)]
FORMS: Final = ("euler", "axis", "euler_parameters")
# Euler parameters between the points of a table are made of unit length; shorter than this they are of points too far apart.
SHORTEST: Final = 0.9
# times at which the length of Euler parameters is looked at
LOOKS: Final = 400


def _columns(value: Any) -> Any:
    """Four functions; of a table with four values a row its columns, with signs of rows (q and -q are one turn) that follow smoothly."""
    if not isinstance(value, Mapping) or "values" not in value:
        return listed(value)
    try:
        table = np.array([listed(row) for row in value["values"]], dtype=float)
    except (TypeError, ValueError):
        table = np.zeros(0)
    if table.ndim != 2 or len(table[0]) != 4:
        raise fault("`values` has four numbers a row, scalar first: `values: [[1, 0, 0, 0], [0.8, 0.6, 0, 0], …]`")
    flips = np.cumprod([1.0, *np.where(np.einsum("ki,ki->k", table[1:], table[:-1]) < 0.0, -1.0, 1.0)])
    rest = {"interpolation": "cubic", **{key: each for key, each in value.items() if key != "values"}}
    return tuple({**rest, "values": column.tolist()} for column in (table * flips[:, None]).T)


class DrivenOrientation(Checked):
    """One of: `euler` with `sequence`, `axis` with `angle`, `euler_parameters`; all functions of time."""

    euler: Annotated[Maybe[ThreeFunctions[AngleMotion]], BeforeValidator(listed)] = Field(
        default=None, description="three angles, each about an axis of the frame as turned so far"
    )
    sequence: AxisSequence | None = Field(default=None, description="axes of the three turns, e.g. zyx")
    axis: Maybe[Direction] = Field(default=None, description="axis of the turn, of any length")
    angle: Maybe[AngleMotion] = Field(default=None, description="turn about `axis`, right-handed")
    euler_parameters: Annotated[Maybe[FourFunctions[ShareMotion]], BeforeValidator(_columns)] = Field(
        default=None,
        description="four functions, scalar first, or one table whose `values` have four numbers a row; made of unit length",
    )

    @property
    def turns(self) -> tuple[str, tuple[TimeFunction, ...]]:
        """Axes of the turns in order, each of the frame as turned so far, and their angles [rad]; no axes for Euler parameters, of which
        there are four."""
        if self.euler is not None and self.sequence is not None:
            return self.sequence, self.euler
        if self.axis is not None and self.angle is not None:
            x, y, z = self.axis
            first, second = float(np.arctan2(y, x)), float(np.arctan2(np.hypot(x, y), z))
            # z is turned into the axis, and back behind the turn
            return "zyzyz", (first, second, self.angle, -second, -first)
        assert self.euler_parameters is not None  # the record was checked
        return "", self.euler_parameters

    def problems(self) -> Iterator[Problem]:
        given = [name for name in FORMS if getattr(self, name) is not None]
        if len(given) != 1:
            got = " and ".join(given) or "none of them"
            yield Problem((), f"one of {', '.join(FORMS)} was expected, got {got}")
        if (self.euler is None) != (self.sequence is None):
            yield Problem((), "`euler` and `sequence` belong together, e.g. `{euler: [time, 0, 0], sequence: zyx}`")
        if (self.axis is None) != (self.angle is None):
            yield Problem((), "`axis` and `angle` belong together, e.g. `{axis: [0, 0, 1], angle: 2*time}`")
        if self.axis is not None and not np.any(self.axis):
            yield Problem(("axis",), "the axis has no direction: it is zero")
        if self.euler_parameters is not None:
            yield from _problems_of_length(self.euler_parameters)


def _problems_of_length(parameters: tuple[TimeFunction, ...]) -> Iterator[Problem]:
    """Tables whose Euler parameters are far from unit length between their points: these are too far apart, or no unit quaternions."""
    tables = [each for each in parameters if isinstance(each, Table)]
    if not tables and any(not isinstance(each, float | int) for each in parameters):
        return  # functions of any length
    spans = [np.linspace(each.times[0], each.times[-1], LOOKS) for each in tables]
    times = np.unique(np.concatenate([[0.0], *spans]))
    for time in times:
        try:
            length = float(np.linalg.norm([_value(each, float(time)) for each in parameters]))
        except (ExpressionError, TypeError):
            return
        if not SHORTEST <= length <= 1.0 / SHORTEST:
            yield Problem(
                ("euler_parameters",),
                f"their length at {time:.6g} s is {length:.4g}, not 1: give unit quaternions, scalar first, "
                f"of a table at times less than a quarter turn apart",
            )
            return


def _value(function: TimeFunction, time: float) -> float:
    return function(time) if isinstance(function, Table | Expression) else float(function)  # type: ignore[arg-type]
