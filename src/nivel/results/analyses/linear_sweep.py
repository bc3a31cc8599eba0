"""Linear models over the values of a parameter: how eigenvalues move, and where vibrations meet multiples of a speed."""

import json
from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.errors import Fault, ModelError
from nivel.files.target import write_page
from nivel.lazy import Struct, field, provided, scipy, xarray
from nivel.machine.core.vectors import Array, Complex
from nivel.machine.units.quantity import read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.results.analyses.linear_model import LinearModel
from nivel.results.frames.tabulated import write_dataset
from nivel.results.trust import Trust

TURN = 2.0 * np.pi
# a vibration meets a multiple of the speed to this share
MET = 1e-12


class Crossing(Struct):
    """Where a vibration has `order` times the speed: between two values of the parameter, by interpolation.

    value : of the parameter, in its unit; speed [rad/s]; frequency [Hz].
    """

    mode: int
    order: float
    value: float
    speed: float
    frequency: float

    def words(self, unit: str) -> str:
        """In a sentence; unit : of the parameter."""
        plain = f"{self.speed:.6g} rad/s"
        at = plain if unit in ("", "rad/s") else f"{self.value:.6g} {unit} ({plain})"
        return f"mode {self.mode} has {self.order:g} times the speed at {at}, {self.frequency:.6g} Hz"


class LinearSweep(Struct):
    """Models at ascending `values` of a parameter, all with the same states.

    Modes are followed from value to value by their eigenvectors, |wᴴ x|, and their eigenvalues. trust : the trust report of all models.
    Raises ModelError where the states differ or values do not ascend.
    """

    parameter: str
    unit: str
    values: Array
    models: tuple[LinearModel, ...]
    trust: Trust = field(default_factory=lambda: Trust("green", "done"))

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
        out = np.full((len(self.models), len(self.models[0].states)), np.nan, dtype=np.complex128)
        order, before = np.arange(out.shape[1]), None
        for k, model in enumerate(self.models):
            if not model.steady:
                continue
            if before is not None:
                place = np.array([model.states.index(name) for name in before.states])
                order = scipy.optimize.linear_sum_assignment(_distance(before, model, place)[order])[1]
            before = model
            out[k] = model.eigenvalues[order]
        return out

    def to_xarray(self) -> "xarray.Dataset":
        """Eigenvalues, natural frequencies and damping ratios over the parameter."""
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
            "verdict": (dims[:1], [each.trust.light for each in self.models], {}),
        }
        facts = {"parameter": self.parameter, "unit": self.unit, **self.trust.attributes()}
        coordinates = {"value": self.values, "mode": np.arange(1, found.shape[1] + 1)}
        return xarray.Dataset(values, coords=coordinates, attrs=facts)

    def stability_changes(self) -> list[tuple[float, float]]:
        """Pairs of values between which the machine becomes stable or unstable."""
        steady = [(value, model) for value, model in zip(self.values, self.models, strict=True) if model.steady]
        known = [(value, not model.growing.any()) for value, model in steady]
        return [(a, b) for (a, stable), (b, other) in pairwise(known) if stable != other]

    @cached_property
    def speeds(self) -> Array:
        """(values,) [rad/s] of the parameter as a speed of rotation. Raises ModelError where its unit is none of such a speed."""
        return self.values * speed_of(self.unit, self.parameter)

    def crossings(self, orders: Sequence[float]) -> list[Crossing]:
        """Where vibrations meet multiples of the parameter as a speed of rotation: Campbell's diagram."""
        found, out = self.eigenvalues, []
        if not orders:
            return out
        with np.errstate(invalid="ignore"):
            waves = np.flatnonzero(np.nanmax(np.where(np.isfinite(found.imag), found.imag, 0.0), axis=0) > 0.0)
        for mode in waves:
            frequency = found[:, mode].imag
            for order in orders:
                gap = frequency - order * np.abs(self.speeds)
                gap = np.where(np.abs(gap) <= MET * frequency, 0.0, gap)
                for k, share in _changes_of_sign(gap, frequency > 0.0):
                    steps = ((each[k], each[k + 1] - each[k]) for each in (self.speeds, self.values))
                    speed, value = (float(begin + share * step) for begin, step in steps)
                    out.append(Crossing(int(mode) + 1, order, value, speed, order * abs(speed) / TURN))
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
            "headline": self.trust.headline,
            "trust": json.loads(self.trust.to_json()),
        }

    def report(self, path: str | PathLike[str], orders: Sequence[float] = ()) -> Path:
        """Write a page: frequencies, damping and the paths of the eigenvalues."""
        return write_page(provided("linear sweep")(self, orders), path)

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


def _changes_of_sign(gap: Array, vibrates: NDArray[np.bool_]) -> list[tuple[int, float]]:
    """(k, share) of the interval behind k at which `gap` passes zero, while there is a vibration at both ends."""
    out = []
    for k in range(len(gap) - 1):
        a, b = gap[k], gap[k + 1]
        if not (vibrates[k] and vibrates[k + 1] and np.isfinite(a) and np.isfinite(b)):
            continue
        # a value that meets the speed itself belongs to the interval that it begins, or to the last
        if a * b < 0.0 or (a == 0.0 and b != 0.0) or (b == 0.0 and a != 0.0 and k == len(gap) - 2):
            out.append((k, float(a / (a - b))))
    return out


def speed_of(unit: str, parameter: str) -> float:
    """[rad/s] of one of this unit; without a unit numbers are rad/s. Raises ModelError where it is none of a speed of rotation."""
    if not unit:
        return 1.0
    try:
        return read_quantity(f"1 {unit}", "angular velocity", {})
    except ExpressionError:
        pass
    try:
        return TURN * read_quantity(f"1 {unit}", "frequency", {})
    except ExpressionError:
        message = f"orders are multiples of a speed of rotation, e.g. in rpm or rad/s, and {parameter} is in {unit}"
        raise ModelError(Fault.at("linearise.orders", message)) from None
