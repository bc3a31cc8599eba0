"""Heights of ground that is not flat, on a grid over a plane: the record, and its triangles."""

from collections.abc import Iterator
from functools import lru_cache
from random import Random
from typing import Annotated, Any, Final, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, ValidationInfo

from nivel.machine.bodies.surface import Triangles
from nivel.machine.core.record import Checked, Problem, superfluous
from nivel.machine.given import Field, ManyRows, Maybe, TwoNumbers
from nivel.machine.laws.time_function import check_varying
from nivel.machine.units import quantity, tree
from nivel.machine.units.arithmetic import PLACE, evaluate, render
from nivel.machine.units.measure import measure

FEWEST, MOST = 3, 250_000  # heights along a side, and in all
POINTS: Final = (101, 101)
LONGEST_WAVE: Final = 0.011  # cycles/m
NAMES: Final = "the place on the plane has the names `x` and `y` [m], as in `0.1*(x^2 + y^2)`"


def _of_place(value: Any, info: ValidationInfo) -> str | None:
    """An expression of x and y, with parameters put in."""
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise quantity.fault(f"an expression of `x` and `y` was expected, as in `0.1*x^2`, got {quantity.shown(value)}")
    text, parameters = str(value).strip(), quantity.parameters_of(info)
    try:
        return render(_height(text, parameters))
    except tree.ExpressionError as problem:
        raise quantity.expression_fault(problem, value, parameters) from None
    except tree.FaultyParameterError:
        raise quantity.reported() from None


def _height(text: str, parameters: tree.Parameters) -> tree.Node:
    """`text` as a length that varies with x and y only. Raises ExpressionError, of another name or a unit in their place with them."""
    try:
        root = quantity.bound_tree(text, parameters, PLACE)
    except tree.UnknownNameError as problem:
        raise tree.ExpressionError(f"{problem}; {NAMES}") from None
    if any(isinstance(each, tree.Time) for each in tree.leaves(root)):
        raise tree.ExpressionError(f"ground does not change with the time; {NAMES}")
    if tree.varies(root):
        check_varying(root, text, "length", parameters, PLACE)
        return root
    try:
        quantity.check_kind(text, measure(root), "length")
    except tree.ExpressionError as problem:
        raise tree.ExpressionError(f"{problem}; {NAMES}") from None
    return root


class HeightField(Checked):
    """Heights over a rectangle of a plane, whose marker is in its middle: `values`, numbers of a `file`, or a `function` of x and y.

    The first row of `values` and of a CSV file is at the least y, the top row of a picture at the greatest. Each row goes along x.
    """

    size: TwoNumbers[quantity.PositiveLength] = Field(
        "lengths of the rectangle along the x and y axes of the plane's marker"
    )
    values: Maybe[ManyRows[Annotated[tuple[quantity.Length, ...], BeforeValidator(quantity.listed)]]] = Field(
        "rows of heights along z, from the least y on; along each row x grows", default=None
    )
    file: str | None = Field(
        "CSV file of rows of heights, or PNG picture in grey, relative to the machine file", default=None
    )
    unit: quantity.PositiveLength = Field(
        "length of one unit of the `file`; of a picture the height of white above black", default=1.0
    )
    function: Annotated[str | None, BeforeValidator(_of_place)] = Field(
        "height [m] as an expression of `x` and `y` [m]", default=None
    )
    points: TwoNumbers[quantity.Whole] = Field(
        "of a `function` or of `roughness` alone: numbers of heights along x and along y", default=POINTS
    )
    roughness: Literal["A", "B", "C", "D", "E", "F", "G", "H"] | None = Field(
        "class of ISO 8608 of what is added to the heights along every line", default=None
    )
    seed: quantity.Whole = Field("of the `roughness`: another number is another road of the same class", default=1)

    def problems(self) -> Iterator[Problem]:
        if self.file is None and self.unit != 1.0:
            yield superfluous(
                "unit", "is the length of one unit of a `file`; write lengths of heights with their units"
            )
        if self.roughness is None and self.seed != 1:
            yield superfluous("seed", "belongs to a `roughness`, and none is given")
        if self.function is not None or (self.roughness is not None and self.values is None and self.file is None):
            yield from self._problems_of_function()
            return
        if self.points != POINTS:
            yield superfluous("points", "belongs to a `function`; rows of heights have their own number")
        if self.values is None:
            if self.file is None:
                yield Problem(
                    (), "`values`, a `file`, a `function` or a `roughness` must be given: `function: 0.1*x^2`"
                )
            else:
                yield Problem(("file",), f"the file `{self.file}` was not read; in Python give `values`")
            return
        if len({len(row) for row in self.values}) > 1:
            yield Problem(("values",), "all rows need as many heights")
        elif min(len(self.values), len(self.values[0])) < FEWEST:
            yield Problem(("values",), f"at least {FEWEST} rows of {FEWEST} heights are needed")
        elif len(self.values) * len(self.values[0]) > MOST:
            yield Problem(("values",), f"there are more than {MOST} heights")

    def _problems_of_function(self) -> Iterator[Problem]:
        for name in ("values", "file"):
            if getattr(self, name) is not None:
                yield superfluous(name, "stands in place of `function`; give one of them")
        if min(self.points) < FEWEST or self.points[0] * self.points[1] > MOST:
            yield Problem(("points",), f"at least {FEWEST} are needed along each side, and at most {MOST} in all")
            return
        if self.function is None:
            return
        try:
            self.heights  # noqa: B018 : whether the function has a value everywhere
        except tree.ExpressionError as problem:
            yield Problem(("function",), f"`{self.function}` has no value everywhere on the rectangle: {problem}")

    @property
    def heights(self) -> NDArray[np.float64]:
        """(rows along y, heights along x) [m]. Raises ExpressionError where a function has no value."""
        if self.function is not None:
            out = _values_of(self.function, self.size, (int(self.points[0]), int(self.points[1])))
        elif self.values is not None:
            out = np.array(self.values, dtype=float)
        else:
            out = np.zeros((int(self.points[1]), int(self.points[0])))
        return out if self.roughness is None else out + _rough(self.roughness, int(self.seed), self.size, out.shape)

    @property
    def greatest_curvature(self) -> float:
        """Of the valleys [1/m], by second differences along x and along y; 0 where there are none."""
        heights = self.heights
        found = 0.0
        for axis in (0, 1):
            side = self.size[1 - axis] / (heights.shape[axis] - 1)
            slope, bend = np.gradient(heights, side, axis=axis), np.diff(heights, 2, axis=axis) / side**2
            inner = slope[1:-1] if axis == 0 else slope[:, 1:-1]
            found = max(found, float(np.max(bend / (1.0 + inner**2) ** 1.5)))
        return found


@lru_cache(maxsize=16)
def _rough(grade: str, seed: int, size: tuple[float, float], shape: tuple[int, int]) -> NDArray[np.float64]:
    """Heights [m] with the one-sided spectrum G(n) = G₀ (n/n₀)⁻² of ISO 8608 along x on each line, n₀ = 0.1 cycles/m, G₀ = 16e-6 m³ of
    class A and four times as much of each one below.

    Along and across as of an isotropic surface, whose spectrum falls with the cube of the wave number: of waves with n along x the share
    between two numbers across is n²/2 times the difference of u/(n² √(n² + u²)). Phases are random, amplitudes are not. From 0.011
    cycles/m on.
    """
    rows, columns = 2 * shape[0], shape[1]  # half of what repeats across
    steps = size[1] / (shape[0] - 1), size[0] / (columns - 1)
    across, along = np.fft.fftfreq(rows, steps[0])[:, None], np.fft.rfftfreq(columns, steps[1])[None, 1:]
    half = 0.5 / (rows * steps[0])
    share = [0.5 * u / np.sqrt(along**2 + u**2) for u in (across - half, across + half)]
    share = share[1] - share[0]
    level = 16e-6 * 4.0 ** "ABCDEFGH".index(grade) * (along / 0.1) ** -2.0 * (along >= LONGEST_WAVE)
    power = share / share.sum(axis=0) * level / (columns * steps[1])
    power[:, -1] *= columns % 2  # the shortest wave of an even number has no phase
    phases = Random(seed)
    turns = np.array([[phases.random() for _ in range(along.shape[1])] for _ in range(rows)])
    waves = np.zeros((rows, columns // 2 + 1), dtype=complex)
    waves[:, 1:] = np.sqrt(0.5 * power) * np.exp(2j * np.pi * turns) * (rows * columns)
    out = np.fft.irfft2(waves, s=(rows, columns))[: shape[0]]
    out.setflags(write=False)
    return out


@lru_cache(maxsize=16)
def _values_of(function: str, size: tuple[float, float], points: tuple[int, int]) -> NDArray[np.float64]:
    root = quantity.bound_tree(function, {}, PLACE)
    x, y = (np.linspace(-0.5, 0.5, n) * side for n, side in zip(points, size, strict=True))
    out = np.array([[evaluate(root, values={"x": float(a), "y": float(b)}) for a in x] for b in y])
    out.setflags(write=False)
    return out


def ground_surface(field: HeightField) -> tuple[NDArray[np.float64], Triangles]:
    """vertices (n, 3) [m] in the axes of the plane's marker and triangles (m, 3), seen from above counter-clockwise."""
    heights = field.heights
    rows, columns = heights.shape
    x, y = (np.linspace(-0.5, 0.5, n) * side for n, side in zip((columns, rows), field.size, strict=True))
    vertices = np.stack([*np.meshgrid(x, y), heights], axis=2).reshape(-1, 3)
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    first = np.stack([corner, corner + 1, corner + columns + 1], axis=1)
    second = np.stack([corner, corner + columns + 1, corner + columns], axis=1)
    return vertices, np.concatenate([first, second]).astype(np.uint32)
