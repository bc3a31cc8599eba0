"""Elasticity of a deck: the stress of a strain at every point of every element.

`*ELASTIC` of all types, by temperatures, in the axes of an `*ORIENTATION`, for the elements of each section.
Sources: Dhondt, CalculiX CrunchiX User's Manual 2.20, keywords *ELASTIC, *ORIENTATION and *INITIAL CONDITIONS; Ting 1996, Anisotropic
Elasticity, chapter 2.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from nivel.flexible.foreign.deck import Card, Line
from nivel.flexible.foreign.matrix import FormatError, fortran_number
from nivel.flexible.model.model import Array
from nivel.flexible.model.solid_elements import SHEARS, isotropic
from nivel.lazy import dataclass, field

LINES: Final = {"ISO": (3,), "ORTHO": (8, 2), "ENGINEERING CONSTANTS": (8, 2), "ANISO": (8, 8, 6)}
# numbers in each line of a row of constants; the last one is the temperature
WORDS: Final = {
    "ISOTROPIC": "ISO",
    "ORTHOTROPIC": "ORTHO",
    "ANISOTROPIC": "ANISO",
    "ENGINEERINGCONSTANTS": "ENGINEERING CONSTANTS",
}
# cosine of the angle to its normal, below which an axis cannot be projected onto a shell
NORMAL: Final = 0.999999999536
PACKED: Final = (0, 1, 2, 3, 5, 4)  # xx, yy, zz, xy, zx, yz of a deck among xx, yy, zz, xy, yz, zx


@dataclass
class Law:
    """The elasticity of a *MATERIAL.

    kind : of its *ELASTIC, a key of LINES; empty where it has none. rows : numbers of each row of constants; the last one is its
    temperature. problem : why its stress is not known, or empty.
    """

    name: str
    line: Line
    kind: str = ""
    rows: list[list[float]] = field(default_factory=list)
    problem: str = ""

    def begin(self, card: Card) -> None:
        """A *ELASTIC begins."""
        given = "".join(card.name("TYPE").split()) or "ISO"
        self.kind, self.line, self.rows = WORDS.get(given, given), card.line, []
        more = sorted(card.options.keys() - {"TYPE", "MODULI"})
        if self.kind not in LINES:
            self.problem = f"*ELASTIC, TYPE={given} (line {card.line}) is not one of {', '.join(LINES)}"
        elif more:
            self.problem = f"*ELASTIC with {more[0]} (line {card.line}) cannot be followed"

    def read(self, parts: list[str]) -> None:
        """A line of the data of *ELASTIC; what is not given is zero. Raises ValueError."""
        if self.kind not in LINES:
            return
        sizes = LINES[self.kind]
        filled = 0 if not self.rows else len(self.rows[-1])
        if filled in (0, sum(sizes)):
            self.rows.append([])
            filled = 0
        size = next(size for k, size in enumerate(sizes) if sum(sizes[:k]) == filled)
        numbers = [fortran_number(part) if part else 0.0 for part in parts]
        if any(numbers[size:]):
            raise ValueError
        self.rows[-1] += (numbers + size * [0.0])[:size]

    def stiffness(self, temperature: Array | None) -> Array:
        """(…, 6, 6) stress xx, yy, zz, xy, yz, zx from strain with γ, in the unit and the axes of the deck, at temperatures (…).

        Constants are interpolated linearly, and those of the first or last temperature hold beyond it; None : those of the first row.
        Raises FormatError where the constants are those of no material.
        """
        if not self.rows or len(self.rows[-1]) != sum(LINES[self.kind]):
            raise FormatError(f"the constants of *ELASTIC, TYPE={self.kind} are not complete", self.line)
        at = np.array([row[-1] for row in self.rows])
        if np.any(np.diff(at) <= 0.0):
            raise FormatError("the temperatures of *ELASTIC must ascend", self.line)
        constants = np.array([row[:-1] for row in self.rows])
        if self.kind != "ISO":
            constants = np.array([_packed(self.kind, row, self.line) for row in constants])
        if temperature is None:
            interpolated = constants[0]
        else:
            place = np.interp(temperature, at, np.arange(len(at)))
            first = np.minimum(place.astype(np.int64), max(len(at) - 2, 0))
            share = (place - first)[(...,) + (None,) * (constants.ndim - 1)]
            interpolated = (1.0 - share) * constants[first] + share * constants[np.minimum(first + 1, len(at) - 1)]
        D = isotropic(interpolated[..., 0], interpolated[..., 1]) if self.kind == "ISO" else interpolated
        if not np.all(np.isfinite(D)) or np.any(np.linalg.eigvalsh(D)[..., 0] <= 0.0):
            raise FormatError(
                f"with these constants of *ELASTIC, TYPE={self.kind}, a strain has no positive energy; look for a wrong sign or order, "
                "or ν too large",
                self.line,
            )
        return D


def _packed(kind: str, numbers: Array, line: Line) -> Array:
    """(6, 6) from the constants of an orthotropic or anisotropic row. Columns of the upper triangle follow each other.

    Engineering constants: E₁, E₂, E₃, ν₁₂, ν₁₃, ν₂₃, G₁₂, G₁₃, G₂₃ with ν₁₂/E₁ = ν₂₁/E₂.
    """
    D = np.zeros((6, 6))
    if kind == "ENGINEERING CONSTANTS":
        E, nu, G = numbers[:3], numbers[3:6], numbers[6:]
        if np.any(E <= 0.0) or np.any(G <= 0.0):
            raise FormatError("each modulus of *ELASTIC, TYPE=ENGINEERING CONSTANTS must be positive", line)
        compliance = np.diag(1.0 / E)
        for (i, j), value in zip(((0, 1), (0, 2), (1, 2)), nu, strict=True):
            compliance[i, j] = compliance[j, i] = -value / E[i]
        if np.linalg.det(compliance * np.sqrt(np.outer(E, E))) <= 0.0:
            raise FormatError(
                "with these ν of *ELASTIC, TYPE=ENGINEERING CONSTANTS, a strain has no positive energy", line
            )
        D[:3, :3], D[range(3, 6), range(3, 6)] = np.linalg.inv(compliance), G
    elif kind == "ORTHO":
        D[:3, :3], D[range(3, 6), range(3, 6)] = _triangle(numbers[:6]), numbers[6:]
    else:
        D = _triangle(numbers)
    return D[np.ix_(PACKED, PACKED)]


def _triangle(numbers: Array) -> Array:
    """The symmetric matrix of the columns of its upper triangle."""
    size = int(np.sqrt(2 * len(numbers)))
    out = np.zeros((size, size))
    columns, rows = np.tril_indices(size)
    out[rows, columns] = out[columns, rows] = numbers
    return out


class Orientation(NamedTuple):
    """Axes of a *ORIENTATION: of a rectangular system through points a on x and b in the xy plane, seen from the origin, then turned by
    `angle` [°] about the axis `about` (1 … 3); of a cylindrical one, radial, tangential and axial, with points a and b on its axis.

    problem : why it cannot be followed, or empty.
    """

    cylindrical: bool
    points: Array
    line: Line
    about: int = 0
    angle: float = 0.0
    problem: str = ""

    def axes(self, at: Array) -> Array:
        """(…, 3, 3) unit vectors of x, y, z in rows, at points (…, 3) in the unit of the deck; not finite where there are none."""
        a, b = self.points
        if self.cylindrical:
            z = _unit(b - a)
            out = at - a
            x = _unit(out - (out @ z)[..., None] * z)
            return np.stack([x, np.cross(z, x), np.broadcast_to(z, x.shape)], axis=-2)
        x = _unit(a)
        y = _unit(b - (b @ x) * x)
        axes = np.array([x, y, np.cross(x, y)])
        if self.about:
            c, s = np.cos(np.radians(self.angle)), np.sin(np.radians(self.angle))
            i, j = self.about % 3, (self.about + 1) % 3
            axes[i], axes[j] = c * axes[i] + s * axes[j], c * axes[j] - s * axes[i]
        return np.broadcast_to(axes, (*at.shape[:-1], 3, 3))


def orientation(card: Card, lines: Sequence[list[str]]) -> Orientation:
    """The axes of a *ORIENTATION with the lines of its data. Raises ValueError."""
    cylindrical = card.name("SYSTEM").startswith("C")
    odd = [key for key in card.options if key not in ("NAME", "SYSTEM", "DEFINITION")]
    other = card.name("SYSTEM") not in ("", "RECTANGULAR", "CYLINDRICAL") or card.name("DEFINITION") not in (
        "",
        "COORDINATES",
    )
    points = np.zeros((2, 3))
    if odd or other or not lines or len([part for part in lines[0] if part]) < 2 or any(lines[0][6:]):
        what = f"with {odd[0]}" if odd else "by a system, a definition or a distribution of another kind"
        return Orientation(
            cylindrical, points, card.line, problem=f"*ORIENTATION {what} (line {card.line}) cannot be followed"
        )
    points[:] = np.array([fortran_number(part) if part else 0.0 for part in [*lines[0], *6 * [""]][:6]]).reshape(2, 3)
    about, angle = 0, 0.0
    if len(lines) > 1:
        about, angle = int(lines[1][0]), fortran_number([*lines[1], "0"][1] or "0")
        if about not in (1, 2, 3) or cylindrical:
            raise ValueError
    return Orientation(cylindrical, points, card.line, about, angle)


def _unit(vectors: Array) -> Array:
    with np.errstate(divide="ignore", invalid="ignore"):
        return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def in_plane(axes: Array, normal: Array) -> Array:
    """(…, 3, 3) axes of shells with unit normals (…, 3): x projected, or z where x is normal to the shell; z along the normal."""
    across = np.abs(np.sum(axes[..., 0, :] * normal, axis=-1, keepdims=True)) > NORMAL
    first = np.where(across, axes[..., 2, :], axes[..., 0, :])
    x = _unit(first - np.sum(first * normal, axis=-1, keepdims=True) * normal)
    return np.stack([x, np.cross(normal, x), normal], axis=-2)


def turned(D: Array, axes: Array) -> Array:
    """(…, 6, 6) a stiffness in the global axes, from that in axes (…, 3, 3): Tᵀ D T with the strain T ε in these axes."""
    p, q = np.array([(0, 0), (1, 1), (2, 2), *SHEARS]).T
    first = axes[..., p[:, None], p] * axes[..., q[:, None], q]
    T = 0.5 * (first + axes[..., p[:, None], q] * axes[..., q[:, None], p])
    T[..., 3:, :] *= 2.0
    return np.swapaxes(T, -1, -2) @ D @ T
