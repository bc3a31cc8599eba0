"""Results of inverse analyses: efforts of actuators over a motion, with peaks, work and what is missing; and the path of joints that a
point leads."""

import csv
import json
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.files.target import write_page, written
from nivel.lazy import Struct, field, provided, xarray
from nivel.machine.core.vectors import Array
from nivel.results.curve import TOLD, curve, extreme, integral, integral_of_magnitude, peak, rms
from nivel.results.frames.tabulated import Tabulated
from nivel.results.trust import Trust

# generalised forces missing below this share are round-off
NONE_MISSING = 1e-6
# lines of the trust report that are said where they are green too
SAID = ("replaced", "unique")


class Efforts(Struct, Tabulated):
    """effort (T, m) [N, N m] on the coordinates of the actuators, positive where it drives them up; rate (T, m) of these coordinates.

    missing (T,) : effort on the joint coordinate `missing_at` that would do most of what no actuator gives; missing_share (T,) of the
    generalised forces. limits (m,) : greatest magnitudes; limited : whether they hold efforts back. freedoms : of the machine without the
    efforts. rank : independent ones of the actuators. violation : by how much the motion has joints open, as a share of their scales.
    held : first-order states that the motion does not have, which keep their values of the start. trust : the trust report.
    """

    name: str
    time: Array
    actuators: tuple[str, ...]
    coordinates: tuple[str, ...]
    units: tuple[str, ...]
    effort: Array
    rate: Array
    missing: Array
    missing_share: Array
    missing_at: str
    limits: Array
    limited: bool
    freedoms: int
    rank: int
    violation: float = 0.0
    held: tuple[str, ...] = ()
    trust: Trust = field(default_factory=lambda: Trust("green", "done"))

    @property
    def power(self) -> Array:
        """(T, m) [W]"""
        return self.effort * self.rate

    @property
    def complete(self) -> bool:
        """Whether the efforts make the whole motion."""
        return bool(np.all(self.missing_share <= NONE_MISSING))

    @property
    def unique(self) -> bool:
        """Whether no other efforts make the same motion."""
        return self.rank == len(self.actuators)

    def facts(self) -> list[dict[str, Any]]:
        """Peak, RMS, largest power, and the work done and taken back, of every actuator, between the times of the efforts too."""
        effort, power = (curve(self.time, each) for each in (self.effort, self.power))
        highest, root, largest_power = extreme(effort), rms(effort), peak(power)
        net, both = integral(power), integral_of_magnitude(power)
        return [
            {
                "actuator": name,
                "unit": self.units[k],
                "peak": float(highest.value[k]),
                "peak_time": float(highest.time[k]),
                "rms": float(root.value[k]),
                "peak_power": float(largest_power.value[k]),
                "work_done": float(0.5 * (both.value[k] + net.value[k])),
                "work_taken": float(0.5 * (net.value[k] - both.value[k])),
            }
            for k, name in enumerate(self.actuators)
        ]

    @property
    def open_between(self) -> tuple[str, float, str, float]:
        """The actuator whose peak effort the times of the efforts leave most open, what that may be off by, its unit, and the share of the
        peak; empty where all are little."""
        of = curve(self.time, self.effort)
        found = extreme(of)
        share = found.doubt / np.maximum(np.abs(found.value), 1e-300)
        told = of.is_told(found.doubt) & (share > TOLD)
        if not told.any():
            return "", 0.0, "", 0.0
        k = int(np.argmax(np.where(told, share, 0.0)))
        return self.actuators[k], float(found.doubt[k]), self.units[k], float(share[k])

    def statements(self) -> list[str]:
        """What a reader has to know: lines of the trust report that are not green, or are said in any case."""
        told = [item for item in self.trust.items if item.verdict != "green" or item.name in SAID]
        return [item.text for item in told]

    def to_xarray(self) -> "xarray.Dataset":
        """Histories with names and units."""
        dims = ("time", "actuator")
        values = {
            "effort": (dims, self.effort, {"units": ", ".join(self.units)}),
            "rate": (dims, self.rate, {}),
            "power": (dims, self.power, {"units": "W"}),
            "missing_share": (("time",), self.missing_share, {"units": "1"}),
        }
        facts = {"machine": self.name, **self.trust.attributes()}
        return xarray.Dataset(values, coords={"time": self.time, "actuator": list(self.actuators)}, attrs=facts)

    def summary(self) -> dict[str, Any]:
        """Numbers and words for programs."""
        return {
            "machine": self.name,
            "actuators": self.facts(),
            "complete": self.complete,
            "unique": self.unique,
            "largest_missing_share": float(np.max(self.missing_share, initial=0.0)),
            "missing_at": self.missing_at,
            "statements": self.statements(),
            "headline": self.trust.headline,
            "trust": json.loads(self.trust.to_json()),
        }

    def report(self, path: str | PathLike[str], *, force: bool = True) -> Path:
        """Write the page: efforts, power, peaks and work."""
        return write_page(provided("efforts")(self), path, force=force)

    def __str__(self) -> str:
        lines = [
            f"  {each['actuator']}: peak {each['peak']:.6g} {each['unit']} at {each['peak_time']:.6g} s, rms {each['rms']:.6g}, "
            f"work {each['work_done']:.6g} J done, {0.0 - each['work_taken']:.6g} J taken back"
            for each in self.facts()
        ]
        head = f"{self.name}: efforts at {len(self.time)} times"
        return "\n".join([head, *lines, *self.statements(), f"trust: {self.trust.told}"])


class JointPath(Struct, Tabulated):
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

    def to_xarray(self) -> "xarray.Dataset":
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
