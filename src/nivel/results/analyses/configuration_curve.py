"""All positions that a machine with one free motion comes through, one after the other: beyond the turning points of any driver."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nivel.results.frames.tabulated import Tabulated
from nivel.results.trust import Trust

if TYPE_CHECKING:
    import xarray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Turning:
    """A place `arc` of the curve at which the coordinate turns back, its value [rad or m] there, and the joints that hold it there."""

    arc: float
    value: float
    joints: tuple[str, ...]


@dataclass(frozen=True)
class ConfigurationCurve(Tabulated):
    """values (T, m) [rad, m] of the joint coordinates `names` at the places `arc` (T,), the way of all bodies in machine lengths and rad.

    closed : it comes back to where it began. coordinate : whose turning points are given. crossed : places at which another curve of
    positions crosses, so that the positions behind them are one of several. trust : the trust report.
    """

    machine: str
    coordinate: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    arc: Array
    values: Array
    closed: bool
    turning: tuple[Turning, ...]
    crossed: tuple[float, ...]
    trust: Trust = field(default_factory=lambda: Trust("green", "done"))

    def to_xarray(self) -> xarray.Dataset:
        """The joint coordinates over the curve."""
        import xarray

        values = {
            name: (("arc",), self.values[:, k], {"units": unit})
            for k, (name, unit) in enumerate(zip(self.names, self.units, strict=True))
        }
        facts = {"machine": self.machine, "closed": int(self.closed), **self.trust.attributes()}
        return xarray.Dataset(values, coords={"arc": self.arc}, attrs=facts)

    def summary(self) -> dict[str, Any]:
        """For programs."""
        return {
            "machine": self.machine,
            "coordinate": self.coordinate,
            "closed": self.closed,
            "positions": len(self.arc),
            "turning_points": [
                {"arc": each.arc, "value": each.value, "joints": list(each.joints)} for each in self.turning
            ],
            "crossed": list(self.crossed),
            **self.trust.summary(),
        }

    def __str__(self) -> str:
        unit = self.units[self.names.index(self.coordinate)]
        end = (
            "comes back to where it began"
            if self.closed
            else "does not come back within the positions that were looked at"
        )
        lines = [f"{self.machine}: {len(self.arc)} positions; the motion {end}"]
        for each in self.turning:
            turned = f" ({np.degrees(each.value):.6g}°)" if unit == "rad" else ""
            lines.append(
                f"  {self.coordinate} turns back at {each.value:.9g} {unit}{turned}, held there by {', '.join(each.joints)}"
            )
        if not self.turning:
            lines.append(f"  {self.coordinate} never turns back")
        if self.crossed:
            some = ", ".join(f"{each:.6g}" for each in self.crossed)
            said = f"another curve of positions crosses at {some} of the way {self.arc[-1]:.6g}"
            lines.append(f"  {said}: the positions behind are one of several")
        lines += self.trust.told_lines("curve")
        return "\n".join(lines)
