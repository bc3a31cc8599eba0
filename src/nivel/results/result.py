"""The result of a simulation."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nivel.known import TerrainHistory
from nivel.lazy import nivel, provided, xarray
from nivel.results.estimate import ATTRIBUTE, Estimate
from nivel.results.frames.contents import Contents, Selection, own_units, selections, unknown_name
from nivel.results.frames.stored import StoredContents, understood
from nivel.results.frames.summary import ATTRIBUTE as ITERATIONS
from nivel.results.frames.summary import Iterations, Occurrence, from_json
from nivel.results.frames.tabulated import Column, Rows, Tabulated
from nivel.results.trust import Trust
from nivel.system.layout import Variable
from nivel.words.arguments import checked_methods
from nivel.words.wording import in_results

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from nivel.results.stress import RecoveredBody
    from nivel.view.page import Inline


@checked_methods
class Result(Tabulated):
    """What a run computed, read from its file or memory when asked for.

    `result["crank.position"]` is an xarray array with units; `result.array("crank.position")` the plain numpy array of
    it; `result.dataset` the whole as an xarray dataset. `result.names` lists everything that can be asked for.
    """

    def __init__(self, contents: Contents) -> None:
        self._contents = contents

    @classmethod
    def open(cls, path: str | os.PathLike[str]) -> Result:
        """Read a result file, also one that is still being written or whose writer was killed."""
        return cls(StoredContents(Path(path)))

    # --- the run ---

    @property
    def name(self) -> str:
        """Name of the machine."""
        return str(self.attributes.get("machine", "machine"))

    @property
    def outcome(self) -> str:
        """done, interrupted, failed, or running: the file was never closed because the run goes on or was killed."""
        return str(self.attributes.get("outcome", "running"))

    @property
    def failure(self) -> str:
        """What stopped the run, in a sentence; empty where nothing did."""
        return str(self.attributes.get("failure", ""))

    @property
    def advice(self) -> str:
        """What to try after a failure."""
        return str(self.attributes.get("advice", ""))

    @cached_property
    def events(self) -> tuple[Occurrence, ...]:
        """The events that came, in the order of time, each with `name`, `time` [s] and `direction`. Known when the run is over."""
        with understood(self._contents, "events"):
            return from_json(str(self.attributes.get("events", "[]")))

    @property
    def stopped_by(self) -> str:
        """Name of the event that ended the run; empty where none did."""
        return str(self.attributes.get("stopped_by", ""))

    @property
    def attributes(self) -> Mapping[str, str | float | int]:
        """Everything known about the run besides its numbers; nested data are JSON text."""
        return self._contents.attributes

    @cached_property
    def settings(self) -> dict[str, Any]:
        """All settings that were used."""
        return self._json("settings")

    @cached_property
    def timing(self) -> dict[str, Any]:
        """Steps, evaluations and seconds that the run took; empty while it goes on."""
        return self._json("timing")

    @cached_property
    def iterations(self) -> Iterations | None:
        """How often implicit methods and the augmented Lagrangian iterated in their steps; None where nothing was iterated."""
        with understood(self._contents, ITERATIONS):
            return Iterations.from_json(str(self.attributes.get(ITERATIONS, "")))

    @cached_property
    def scene(self) -> dict[str, Any]:
        """Bodies and joints as the viewer and the report draw them."""
        return self._json("scene")

    @cached_property
    def trust(self) -> Trust:
        """How far to trust the result. A run that was killed is assessed from what it left behind."""
        if "trust" in self.attributes:
            with understood(self._contents, "trust"):
                return Trust.from_json(str(self.attributes["trust"]))
        return provided("trust of remains")(self)

    def sections(self, beam: str) -> xarray.Dataset:
        """Strains, forces and moments along a beam at all times; see `nivel.results.beams`."""
        return nivel.results.beams.beam_sections(self, beam)

    @cached_property
    def terrains(self) -> dict[str, TerrainHistory]:
        """Soils by name; `at(time)` of one is its heights [m] at a time [s], rows along y and columns along x of its plane."""
        with understood(self._contents, "terrain"):
            return nivel.results.terrain.terrains(self.attributes) if "terrain" in self.attributes else {}

    def _json(self, attribute: str) -> dict[str, Any]:
        return json.loads(str(self.attributes.get(attribute, "{}")))

    # --- the numbers ---

    @property
    def path(self) -> Path | None:
        """The file, or None for a result in memory."""
        return self._contents.path if isinstance(self._contents, StoredContents) else None

    @property
    def time(self) -> NDArray[np.float64]:
        """(n,) [s]"""
        return self._time

    @cached_property
    def _time(self) -> NDArray[np.float64]:
        return self._contents.read("time")

    @property
    def is_statics(self) -> bool:
        """Whether these are states of equilibrium, and time no more than what their loads depend on."""
        return self.attributes.get("analysis") == "statics"

    @property
    def abscissa(self) -> NDArray[np.float64]:
        """(n,) [s] what ascends from frame to frame: time; of equilibria, whose time may turn back, the place along their path."""
        return self.array("path") if "path" in self.variables else self.time

    @property
    def marks(self) -> list[tuple[str, float]]:
        """Names of the events, and where each stands on the abscissa [s]."""
        if self.is_statics:
            with understood(self._contents, "critical_points"):
                found = json.loads(str(self.attributes.get("critical_points", "[]")))
                return [(each["kind"], float(each["path"])) for each in found]
        return [(event.name, event.time) for event in self.events]

    @property
    def variables(self) -> Mapping[str, Variable]:
        """Name → dimensions, units and meaning of every variable but the time."""
        return self._contents.variables

    @property
    def coordinates(self) -> Mapping[str, tuple[str, ...]]:
        """Dimension → the names along it."""
        return self._contents.coordinates

    @cached_property
    def _selections(self) -> Mapping[str, Selection]:
        return selections(self.variables, self.coordinates)

    @property
    def names(self) -> tuple[str, ...]:
        """Everything that can be asked for."""
        return tuple(self._selections)

    def selection(self, name: str) -> Selection:
        """Where `name` stands, as results or expressions write it; ModelError with the nearest names when there is none."""
        written = self._written(name)
        if written is None:
            raise unknown_name(name, self._selections)
        return self._selections[written]

    def _written(self, name: str) -> str | None:
        """`name` as results write it; None where there is no such quantity."""
        return next((each for each in (name, *in_results(name)) if each in self._selections), None)

    def array(self, name: str, frames: slice = slice(None)) -> NDArray[np.float64]:
        """The numbers of `name`, time first, as a numpy array; `frames` takes a part of the run."""
        if name == "time":
            return self.time[frames]
        if name in self.variables:
            return self._contents.read(name, (frames,))
        found = self.selection(name)
        return self._contents.read(found.variable, (frames, *found.where[1:]))

    @cached_property
    def _estimate(self) -> Estimate | None:
        text = self.attributes.get(ATTRIBUTE)
        if text is None:
            return None
        with understood(self._contents, ATTRIBUTE):
            return Estimate.from_json(str(text))

    def estimated_error(self, name: str) -> NDArray[np.float64]:
        """Estimated errors of `array(name)`, of the same shape and units: at each frame the largest up to then, by a second run.

        They are not a number where the run was not verified, and after the time up to which it was.
        """
        values = self.array(name)
        if self._estimate is None or name == "time":
            return np.full_like(values, np.nan if name != "time" else 0.0)
        found = self.selection(name)
        if found.variable not in self._estimate.values:
            return np.full_like(values, np.nan)
        return self._estimate.at(found.variable, self.time)[(slice(None), *found.where[1:])]

    def units(self, name: str) -> str:
        """SI units of `name`; nothing for all joint coordinates or constraint rows together: each has its own."""
        if name == "time":
            return "s"
        found = self.selection(name)
        variable = self.variables[found.variable]
        row = found.where[1] if len(found.where) > 1 else None
        if variable.units or not isinstance(row, int):
            return variable.units
        return own_units(self.attributes, variable.name, self.coordinates[variable.dims[1]][row])

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and (name == "time" or self._written(name) is not None)

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __getitem__(self, name: str) -> xarray.DataArray:
        return nivel.results.frames.tabulated.data_array(self, name)

    def keys(self) -> tuple[str, ...]:
        """The names that ``result[…]`` takes, as `names`."""
        return self.names

    def to_xarray(self) -> xarray.Dataset:
        """Everything as one xarray dataset: `dataset`."""
        return self.dataset

    def _rows(self, select: list[str]) -> Rows:
        its = {
            name: Column(self.array(name), self.units(name))
            for name in nivel.results.frames.csv_table.columns(self, select)
        }
        return Rows("time", Column(self.time, "s"), its)

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write the result file, which `nivel.open_result` and `nivel report` read. Raises ModelError where it exists and `force` is
        not given."""
        return provided("result file")(self._contents, path, force=force)

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """Everything as one xarray dataset; read from the file when used where the run is over."""
        return nivel.results.frames.tabulated.dataset(self)

    def recover(self, body: str | None = None, *, file: str | os.PathLike[str] | None = None) -> RecoveredBody:
        """Displacement and stress of a flexible body over the run; without a name, of the only one.

        file : where the file of the body is now, if it was moved. Raises ModelError where the body is not flexible, or its file is gone
        or was changed since the run.
        """
        return nivel.results.stress.RecoveredBody(self, body, file)

    # --- for people ---

    def plot(self, *names: str, band: bool = False) -> Figure:
        """Curves of `names` over time, one below the other where units differ; without names the joint coordinates.

        band : the estimated error of each curve around it, where the run was verified.
        """
        return nivel.results.plots.plot(self, names, band)

    def mode(self, number: int, frame: int = -1) -> Result:
        """Vibration `number` (from 1) about an equilibrium of a statics run as a motion of its own, slow and large enough to be seen."""
        return Result(nivel.results.analyses.mode_motion.mode_motion(self, number, frame))

    def report(self, path: str | os.PathLike[str], operated: str = "") -> Path:
        """Write the report as one HTML file that needs no network; an existing file is replaced.

        operated : text of a page by `nivel.export_page`, in which the machine is run again.
        """
        return provided("report")(self, path, operated)

    def animate(self, *others: Result, height: int = 520) -> Inline:
        """Animation of the motion in a notebook, in the viewer; `others` are drawn transparently over it. height : in pixels."""
        return provided("notebook")([self, *others], height)

    def view(self, *others: Result, height: int = 520) -> Inline:
        """As `animate`."""
        return self.animate(*others, height=height)

    def export_scene(self, path: str | os.PathLike[str], *others: Result) -> Path:
        """Write the motion as one HTML page that opens anywhere and needs no network; an existing file is replaced."""
        return provided("scene")([self, *others], path)

    def reactions(self) -> xarray.Dataset:
        """Peak and RMS force and torque of every joint, and when."""
        return nivel.results.frames.loads.reactions(self)

    def powers(self, *, period: float | str | None = None) -> xarray.Dataset:
        """Peak power, work done and work taken back of every driver, coupling and force that reports its power; with the period of a cycle
        [s] the work in the last whole one, and its mean power."""
        return nivel.results.frames.loads.powers(self, period)

    def cycles(self, name: str, *, repeating: bool = False, fatigue: Mapping[str, Any] | None = None) -> xarray.Dataset:
        """Rainflow cycles of a signal, e.g. `hinge.force.x`: range, mean and count. repeating : the history goes on as it began.
        fatigue : `strength`, `knee`, `slope`, `slope_below` and `ultimate` of an S–N curve: then also the damage."""
        return nivel.results.frames.loads.cycles(self, name, repeating=repeating, fatigue=fatigue)

    def shock_response_spectrum(
        self, name: str, frequencies: Sequence[float], *, damping: float = 0.05
    ) -> xarray.DataArray:
        """Largest absolute acceleration of oscillators of these natural frequencies [Hz] and this damping ratio, whose base has the
        acceleration `name`; during the history and one period after it, in which the base has none."""
        return nivel.results.analyses.vibration.shock_response_spectrum(self, name, frequencies, damping)

    def waterfall(self, name: str, *, resolution: float) -> xarray.DataArray:
        """Amplitudes of a signal over time [s] and frequency [Hz], `resolution` [Hz] apart, by Hann's windows of 1/resolution. A vibration
        of one frequency and amplitude a has a. Frequencies go up to half of that of the frames."""
        return nivel.results.analyses.vibration.waterfall(self, name, resolution)

    def orders(self, name: str, angle: str, *, resolution: float = 0.1, most: float = 10.0) -> xarray.DataArray:
        """Order analysis: amplitudes of a signal over revolutions of `angle` and orders up to `most`, multiples of its speed, `resolution`
        apart, by Hann's windows of 1/resolution revolutions at equal angles; `speed` [rad/s] is a coordinate.

        Raises ModelError for an angle that turns back."""
        return nivel.results.analyses.vibration.orders(self, name, angle, resolution, most)

    def coupler_curve(self, body: str, position: Sequence[float] = (0.0, 0.0, 0.0)) -> xarray.Dataset:
        """The path of a point of a body, given in the body's frame [m]: its motion, curvature and cusps."""
        return nivel.results.analyses.mechanism.coupler_curve(self, body, position)

    def transmission_angle(self, first: str, at: str, last: str) -> xarray.DataArray:
        """[rad] angle at the joint `at` between the lines to the joints `first` and `last`; π/2 transmits best."""
        return nivel.results.analyses.mechanism.transmission_angle(self, first, at, last)

    def export_csv(self, path: str | os.PathLike[str], select: tuple[str, ...] | list[str] = ()) -> Path:
        """Write a table, one row per frame; `select` takes names, elements (`crank`), or patterns (`*.angle`).

        An existing file is replaced.
        """
        return nivel.results.frames.csv_table.write_csv(self, path, select)

    def summary(self) -> dict[str, Any]:
        """The run in a few words and numbers, as `nivel run --json` prints it."""
        return nivel.results.frames.summary.summary(self)

    def __repr__(self) -> str:
        return nivel.results.frames.summary.summary_text(self)

    def _repr_html_(self) -> str:
        return nivel.results.frames.summary.summary_html(self)
