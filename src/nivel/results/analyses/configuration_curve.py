"""Positions one after the other: all that a machine with one free motion comes through, and the path of joints that a point leads."""

from __future__ import annotations

import csv
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.files.target import written
from nivel.lazy import dataclass, field, xarray
from nivel.machine.core.vectors import Array
from nivel.results.frames.tabulated import Tabulated
from nivel.results.trust import Trust


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
        whole, part = "comes back to where it began", "does not come back within the positions that were looked at"
        lines = [f"{self.machine}: {len(self.arc)} positions; the motion {whole if self.closed else part}"]
        for each in self.turning:
            turned = f" ({np.degrees(each.value):.6g}°)" if unit == "rad" else ""
            held = f"held there by {', '.join(each.joints)}"
            lines.append(f"  {self.coordinate} turns back at {each.value:.9g} {unit}{turned}, {held}")
        if not self.turning:
            lines.append(f"  {self.coordinate} never turns back")
        if self.crossed:
            some = ", ".join(f"{each:.6g}" for each in self.crossed)
            said = f"another curve of positions crosses at {some} of the way {self.arc[-1]:.6g}"
            lines.append(f"  {said}: the positions behind are one of several")
        lines += self.trust.told_lines("curve")
        return "\n".join(lines)


@dataclass(frozen=True)
class JointPath(Tabulated):
    """values (T, n) of the tree's `coordinates` at times (T,) [s]; independent : those that were searched for.

    error (T, 2) : of position [m] and orientation [rad]; reached (T,) : whether both are round-off. manipulability : √det(J Jᵀ) and
    smallest_singular_value of the path's Jacobian, lengths in m and turns times the machine's length. limits : coordinates at their
    limits, at each time. starts (T,) : postures from which a search began. trust : the trust report.
    """

    name: str
    time: Array
    coordinates: tuple[str, ...]
    independent: tuple[str, ...]
    values: Array
    error: Array
    reached: NDArray[np.bool_]
    manipulability: Array
    smallest_singular_value: Array
    limits: tuple[tuple[str, ...], ...]
    starts: NDArray[np.int64]
    trust: Trust = field(default_factory=lambda: Trust("green", "done"))

    def keys(self) -> tuple[str, ...]:
        """Names of the joint coordinates."""
        return self.coordinates

    def __getitem__(self, name: str) -> Array:
        """(T,) of a joint coordinate. Raises ModelError for one that is not known."""
        if name not in self.coordinates:
            raise ModelError(f"there is no coordinate `{name}`; there are {', '.join(self.coordinates)}")
        return self.values[:, self.coordinates.index(name)]

    def statements(self) -> list[str]:
        """What a reader has to know."""
        missed = np.flatnonzero(~self.reached)
        if not len(missed):
            return []
        k = int(missed[np.argmax(self.error[missed, 0] + self.error[missed, 1])])
        held = f"; at their limits: {', '.join(self.limits[k])}" if self.limits[k] else ""
        return [
            f"{len(missed)} of {len(self.time)} places are not reached, none found from {int(self.starts[k])} starts: at t = "
            f"{self.time[k]:.6g} s the nearest found is {self.error[k, 0]:.4g} m and {self.error[k, 1]:.4g} rad away{held}"
        ]

    def to_xarray(self) -> xarray.Dataset:
        """Coordinates, errors and measures over time."""
        measures = ("reached", "manipulability", "smallest_singular_value")
        values = {
            "value": (("time", "coordinate"), self.values),
            "position_error": (("time",), self.error[:, 0], {"units": "m"}),
            "orientation_error": (("time",), self.error[:, 1], {"units": "rad"}),
            **{name: (("time",), getattr(self, name)) for name in measures},
        }
        coordinates = {"time": self.time, "coordinate": list(self.coordinates)}
        return xarray.Dataset(values, coords=coordinates, attrs=self.trust.attributes())

    def save_csv(self, path: str | PathLike[str], coordinates: tuple[str, ...] = ()) -> Path:
        """Write `time` and coordinates (default: the independent ones) as a table that `inverse(trajectory=…)` reads."""
        names = coordinates or self.independent
        columns = [self.time, *(self[name] for name in names)]
        with written(path, "table") as draft, draft.open("w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([["time", *names], *np.column_stack(columns).tolist()])
        return Path(path)

    def summary(self) -> dict[str, Any]:
        """Numbers and words for programs."""
        return {
            "point": self.name,
            "reached": int(self.reached.sum()),
            "places": len(self.time),
            "largest_position_error": float(self.error[:, 0].max(initial=0.0)),
            "largest_orientation_error": float(self.error[:, 1].max(initial=0.0)),
            "statements": self.statements(),
            **self.trust.summary(),
        }

    def __str__(self) -> str:
        said = f"{self.name}: {int(self.reached.sum())} of {len(self.time)} places reached"
        return "\n".join([said, *self.statements(), *self.trust.told_lines("places")])
