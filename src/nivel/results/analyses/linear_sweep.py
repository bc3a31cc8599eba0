"""Linear models over the values of a parameter: how eigenvalues move, and where vibrations meet multiples of a speed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.results.analyses.linear_model import ROUND_OFF, LinearModel
from nivel.results.comparison.comparison_files import write_text
from nivel.results.frames.dataset_file import write_dataset
from nivel.results.pages import page_maker

if TYPE_CHECKING:
    import xarray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
TURN = 2.0 * np.pi


@dataclass(frozen=True)
class Crossing:
    """Where a vibration has `order` times the speed: between two values of the parameter, by interpolation."""

    mode: int
    order: float
    value: float
    frequency: float


@dataclass(frozen=True)
class LinearSweep:
    """Models at ascending `values` of a parameter, all with the same states.

    Modes are followed from value to value by their eigenvectors, |wᴴ x|, and their eigenvalues.
    Raises ModelError where the states differ or values do not ascend.
    """

    parameter: str
    unit: str
    values: Array
    models: tuple[LinearModel, ...]

    def __post_init__(self) -> None:
        if len(self.values) < 2 or len(self.values) != len(self.models) or np.any(np.diff(self.values) <= 0.0):
            raise ModelError(f"two or more ascending values of {self.parameter} were expected, with a model for each")
        first = self.models[0]
        for value, model in zip(self.values, self.models, strict=True):
            if sorted(model.states) != sorted(first.states):
                raise ModelError(
                    f"at {self.parameter} = {value:g} the states are {', '.join(model.states)}, at first they are "
                    f"{', '.join(first.states)}: choose `coordinates`, or a smaller range"
                )

    @cached_property
    def eigenvalues(self) -> Complex:
        """(values, n) [1/s], a column each mode; not a number where the machine does not move steadily."""
        from scipy.optimize import linear_sum_assignment

        first = self.models[0]
        order = np.arange(len(first.states))
        out = np.full((len(self.models), len(order)), np.nan, dtype=np.complex128)
        for k, model in enumerate(self.models):
            if k:
                before, place = self.models[k - 1], [model.states.index(name) for name in self.models[k - 1].states]
                cost = _distance(before, model, np.array(place))[order]
                order = linear_sum_assignment(cost)[1]
            if model.steady:
                out[k] = model.eigenvalues[order]
        return out

    def to_xarray(self) -> xarray.Dataset:
        """Eigenvalues, natural frequencies and damping ratios over the parameter."""
        import xarray

        found = self.eigenvalues
        size = np.abs(found)
        with np.errstate(invalid="ignore", divide="ignore"):
            ratio = np.where(size > 0.0, -found.real / size, np.nan)
        dims = ("value", "mode")
        values = {
            "eigenvalue_real": (dims, found.real, {"units": "1/s"}),
            "eigenvalue_imag": (dims, found.imag, {"units": "1/s"}),
            "natural_frequency": (dims, size / TURN, {"units": "Hz"}),
            "damping_ratio": (dims, ratio, {"units": "1"}),
        }
        coordinates = {"value": self.values, "mode": np.arange(1, found.shape[1] + 1)}
        return xarray.Dataset(values, coords=coordinates, attrs={"parameter": self.parameter, "unit": self.unit})

    def stability_changes(self) -> list[tuple[float, float]]:
        """Pairs of values between which the machine becomes stable or unstable."""
        known = [
            (value, bool(np.all(model.eigenvalues.real <= ROUND_OFF * np.abs(model.eigenvalues))))
            for value, model in zip(self.values, self.models, strict=True)
            if model.steady
        ]
        return [(a, b) for (a, stable), (b, other) in pairwise(known) if stable != other]

    def crossings(self, orders: Sequence[float]) -> list[Crossing]:
        """Where vibrations meet multiples of the parameter as a speed [rad/s]: Campbell's diagram."""
        found, out = self.eigenvalues, []
        for mode in np.flatnonzero(np.nanmax(found.imag, axis=0) > 0.0):
            frequency = found[:, mode].imag / TURN
            for order in orders:
                gap = frequency - order * self.values / TURN
                for k in np.flatnonzero(np.isfinite(gap[:-1] * gap[1:]) & (gap[:-1] * gap[1:] < 0.0)):
                    share = gap[k] / (gap[k] - gap[k + 1])
                    value = float(self.values[k] + share * (self.values[k + 1] - self.values[k]))
                    out.append(Crossing(int(mode) + 1, order, value, order * value / TURN))
        return out

    def statements(self) -> list[str]:
        """What a reader has to know."""
        out = [
            f"stability changes between {self.parameter} = {a:.6g} and {b:.6g} {self.unit}".rstrip()
            for a, b in self.stability_changes()
        ]
        lost = [value for value, model in zip(self.values, self.models, strict=True) if not model.steady]
        if lost:
            why = next(note for model in self.models if not model.steady for note in model.notes)
            out.append(f"at {len(lost)} values the machine has no eigenvalues: {why}")
        return out

    def summary(self) -> dict[str, Any]:
        """Numbers and words for programs."""
        found = self.eigenvalues
        return {
            "parameter": self.parameter,
            "unit": self.unit,
            "values": self.values.tolist(),
            "eigenvalues": [[[z.real, z.imag] for z in row] for row in found] if np.isfinite(found).all() else None,
            "stability_changes": self.stability_changes(),
        }

    def report(self, path: str | PathLike[str], orders: Sequence[float] = ()) -> Path:
        """Write a page: frequencies, damping and the paths of the eigenvalues."""
        write_text(page_maker("linear sweep")(self, orders), path, "report", force=True)
        return Path(path)

    def save(self, path: str | PathLike[str], *, force: bool = False) -> Path:
        """Write the numbers as NetCDF. Raises ModelError where the file exists and `force` is not given."""
        return write_dataset(self.to_xarray(), path, force=force)


def _distance(before: LinearModel, after: LinearModel, place: NDArray[np.intp]) -> Array:
    """(n, n) how far each mode of `after` is from each of `before`: by eigenvectors and by eigenvalues."""
    left, right = before.left, after.right[place]
    norms = np.linalg.norm(left, axis=0)[:, None] * np.linalg.norm(right, axis=0)
    alike = np.abs(left.conj().T @ right) / np.maximum(norms, 1e-300)
    own = np.linalg.norm(left, axis=0) * np.linalg.norm(before.right, axis=0)
    own = np.abs(np.einsum("ij,ij->j", left.conj(), before.right)) / np.maximum(own, 1e-300)
    alike = np.minimum(alike / np.maximum(own, 1e-6)[:, None], 1.0)
    x, y = before.eigenvalues[:, None], after.eigenvalues
    apart = np.abs(x - y) / np.maximum(np.maximum(np.abs(x), np.abs(y)), 1e-300)
    return (1.0 - alike) + apart
