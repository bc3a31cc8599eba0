"""Linear blocks with memory: transfer function, state space, integrator, and the filters that are made of them."""

import math
from abc import abstractmethod
from collections.abc import Iterator, Sequence
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.control.blocks import OfInput, refuse_order
from nivel.elements.kind import Kind
from nivel.lazy import scipy
from nivel.machine.control.block import Block, Input, Matrix, Number, Numbers, Pair
from nivel.machine.control.part import VALUE, Part, bounded_rate, limited
from nivel.machine.core.record import Problem, entry
from nivel.machine.core.vectors import Array
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.laws.time_function import ManyFunctions
from nivel.machine.units.formula import linear
from nivel.machine.units.quantity import Duration, Quantity, listed


class LinearSystem(NamedTuple):
    """ẋ = A x + B u, y = C x + D u: A (n, n), B (n, m), C (p, n), D (p, m)."""

    A: Array
    B: Array
    C: Array
    D: Array


def of_transfer_function(numerator: tuple[float, ...], denominator: tuple[float, ...]) -> LinearSystem:
    """States of b(s)/a(s), coefficients of falling powers of s, the numerator of no higher degree; a(s) begins with no zero.

    Controllable canonical form in s/w, w the size of the poles, so that all states are of the size of the input (Kailath 1980, §2.1).
    """
    a = np.array(denominator, dtype=float)
    n = len(a) - 1
    b = np.concatenate([np.zeros(n + 1 - len(numerator)), numerator]) / a[0]
    a = a / a[0]
    w = max((abs(a[i]) ** (1.0 / i) for i in range(1, n + 1)), default=1.0) or 1.0
    powers = w ** np.arange(n + 1)
    a, b = a / powers, b / powers
    A = np.zeros((n, n))
    A[:1] = -a[1:]
    A[1:, :-1] = np.eye(max(n - 1, 0))
    B = np.zeros((n, 1))
    B[:1] = 1.0
    return LinearSystem(w * A, w * B, (b[1:] - b[0] * a[1:]).reshape(1, n), b[:1].reshape(1, 1))


def sampled(system: LinearSystem, period: float) -> LinearSystem:
    """The exact system after a period [s] in which u holds: [A_d B_d; 0 1] = exp([A B; 0 0] T)."""
    n, m = system.B.shape
    block = np.zeros((n + m, n + m))
    block[:n, :n], block[:n, n:] = system.A * period, system.B * period
    exact = np.asarray(scipy.linalg.expm(block), dtype=np.float64)
    return LinearSystem(exact[:n, :n], exact[:n, n:], system.C, system.D)


def steady_state(system: LinearSystem, value: float) -> Array | None:
    """(n,) the smallest steady state, with some constant input, in which the first output has this value; None where there is none."""
    n = len(system.A)
    matrix = np.block([[system.A, system.B], [system.C[:1], system.D[:1]]])
    right = np.append(np.zeros(n), value)
    solution = np.asarray(np.linalg.lstsq(matrix, right, rcond=None)[0], dtype=np.float64)
    if not np.allclose(matrix @ solution, right, rtol=1e-9, atol=1e-9 * abs(value)):
        return None
    return solution[:n]


Frequency = Annotated[OneNumber, Quantity("frequency", positive=True)]
Damping = Annotated[OneNumber, Quantity("number", positive=True)]
MOST_STATES = 40


def linear_parts(
    block: Block, system: LinearSystem, inputs: Sequence[str], outputs: Sequence[str], start: Any
) -> tuple[Part, ...]:
    """States `x1`, … and outputs of a linear system with these inputs (paths); start (n,). Sampled, it holds its inputs between samples."""
    after = sampled(system, block.period) if block.is_sampled else system
    states = [f"x{k + 1}" for k in range(len(system.A))]
    paths = [*(block.path(name) for name in states), *inputs]
    parts = []
    for k, name in enumerate(states):
        row = linear(*zip([*after.A[k], *after.B[k]], paths, strict=True))
        parts.append(block.remembered(name, row, row, float(start[k])))
    for k, name in enumerate(outputs):
        row = linear(*zip([*system.C[k], *system.D[k]], paths, strict=True))
        parts.append(block.present(name, row, start=float(system.C[k] @ start)))
    return tuple(parts)


class OfOneVariable(OfInput):
    """A linear block with one input and one output, from its transfer function."""

    start: Number = Field("value at the start, in a steady state", default=0.0)

    @abstractmethod
    def coefficients(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Numerator and denominator, coefficients of falling powers of s."""

    def computation(self) -> tuple[Part, ...]:
        system = of_transfer_function(*self.coefficients())
        start = steady_state(system, self.start)
        assert start is not None  # the record was checked
        return self.taken, *linear_parts(self, system, [self.input_path], [self.output], start)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.start and steady_state(of_transfer_function(*self.coefficients()), self.start) is None:
            yield Problem(
                ("start",), f"there is no steady state with the value {self.start:g}: its value at rest is zero"
            )


class TransferFunction(OfOneVariable):
    """numerator(s) / denominator(s) of the input."""

    type: Literal["transfer-function"] = "transfer-function"
    numerator: Numbers = Field("coefficients of falling powers of s")
    denominator: Numbers = Field("coefficients of falling powers of s")

    def coefficients(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        return self.numerator, self.denominator

    def problems(self) -> Iterator[Problem]:
        found = [*self._of_coefficients()]
        yield from found or super().problems()

    def _of_coefficients(self) -> Iterator[Problem]:
        if not self.numerator:
            yield Problem(("numerator",), "a coefficient was expected, got an empty list")
        if not self.denominator or self.denominator[0] == 0.0:
            yield Problem(("denominator",), "the first coefficient, that of the highest power of s, must not be zero")
        elif len(self.numerator) > len(self.denominator):
            message = (
                f"the numerator has a higher power of s ({len(self.numerator) - 1}) than the denominator ({len(self.denominator) - 1}), "
                f"which would need derivatives of the input: add a fast lag to the denominator"
            )
            yield Problem(("numerator",), message)
        elif len(self.denominator) > MOST_STATES:
            yield Problem(("denominator",), f"up to {MOST_STATES} states are taken")


class LowPass(OfOneVariable):
    """What is slow in the input: 1/(τ s + 1), or ω²/(s² + 2 ζ ω s + ω²) with a damping ratio ζ."""

    type: Literal["low-pass"] = "low-pass"
    time_constant: Maybe[Duration] = Field("τ, of the first order", default=None)
    frequency: Maybe[Frequency] = Field("corner frequency", default=None)
    damping: Maybe[Damping] = Field("damping ratio ζ; it makes the filter one of second order", default=None)

    def coefficients(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        omega = corner(self.time_constant, self.frequency)
        if self.damping is None:
            return (omega,), (1.0, omega)
        return (omega**2,), (1.0, 2.0 * self.damping * omega, omega**2)

    def problems(self) -> Iterator[Problem]:
        found = [*one_of_corner(self.time_constant, self.frequency)]
        yield from found or super().problems()


class HighPass(OfOneVariable):
    """What is fast in the input: s/(s + ω)."""

    type: Literal["high-pass"] = "high-pass"
    time_constant: Maybe[Duration] = Field("1/ω", default=None)
    frequency: Maybe[Frequency] = Field("corner frequency", default=None)

    def coefficients(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        return (1.0, 0.0), (1.0, corner(self.time_constant, self.frequency))

    def problems(self) -> Iterator[Problem]:
        found = [*one_of_corner(self.time_constant, self.frequency)]
        yield from found or super().problems()


class Notch(OfOneVariable):
    """The input without a narrow band: (s² + ω²)/(s² + 2 ζ ω s + ω²)."""

    type: Literal["notch"] = "notch"
    frequency: Frequency = Field("middle of the band")
    damping: Damping = Field("half the width of the band as a share of its middle, ζ", default=0.5)

    def coefficients(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        omega = corner(None, self.frequency)
        return (1.0, 0.0, omega**2), (1.0, 2.0 * self.damping * omega, omega**2)


class LeadLag(OfOneVariable):
    """(lead · s + 1)/(lag · s + 1)."""

    type: Literal["lead-lag"] = "lead-lag"
    lead: Duration = Field("time constant of the numerator")
    lag: Duration = Field("time constant of the denominator")

    def coefficients(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        return (self.lead, 1.0), (self.lag, 1.0)


class Derivative(OfOneVariable):
    """The rate of the input, without what is faster than a time constant: s/(τ s + 1)."""

    type: Literal["derivative"] = "derivative"
    time_constant: Duration = Field("τ")

    def coefficients(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        return (1.0, 0.0), (self.time_constant, 1.0)


class StateSpace(Block):
    """ẋ = A x + B u, y = C x + D u of several inputs u; `NAME.value` is the first of y, `NAME.y2` the second, …"""

    type: Literal["state-space"] = "state-space"
    inputs: Annotated[ManyFunctions[Input], BeforeValidator(listed)] = Field("expressions of `time` and symbols")
    A: Matrix = Field("rows; one state each")
    B: Matrix = Field("rows; one for each state, with a column for each input")
    C: Matrix = Field("rows; one for each output, with a column for each state")
    D: Maybe[Matrix] = Field("rows; one for each output, with a column for each input; default zero", default=None)
    start: Maybe[Numbers] = Field("states at the start; default zero", default=None)

    @classmethod
    def symbols(cls, given: Any) -> tuple[str, ...]:
        rows = entry(given, "C")
        return (VALUE, *(f"y{k + 2}" for k in range(len(rows) - 1 if isinstance(rows, list | tuple) else 0)))

    @property
    def system(self) -> LinearSystem:
        shape = len(self.C), len(self.inputs)
        D = np.zeros(shape) if self.D is None else np.array(self.D).reshape(shape)
        A, n = np.array(self.A), len(self.A)
        return LinearSystem(
            A.reshape(n, n), np.array(self.B).reshape(n, shape[1]), np.array(self.C).reshape(shape[0], n), D
        )

    def computation(self) -> tuple[Part, ...]:
        names = [f"input_{k + 1}" for k in range(len(self.inputs))]
        taken = [self.present(name, each, key="inputs") for name, each in zip(names, self.inputs, strict=True)]
        outputs = [self.output, *(f"y{k + 2}" for k in range(len(self.C) - 1))]
        start = self.start or (0.0,) * len(self.A)
        return *taken, *linear_parts(self, self.system, [self.path(name) for name in names], outputs, np.array(start))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        n, m = len(self.A), len(self.inputs)
        if not m:
            yield Problem(("inputs",), "an input was expected, got an empty list")
        if n > MOST_STATES:
            yield Problem(("A",), f"up to {MOST_STATES} states are taken")
        wanted = {"A": (n, n), "B": (n, m), "C": (max(len(self.C), 1), n), "D": (max(len(self.C), 1), m)}
        for key, (rows, columns) in wanted.items():
            matrix = getattr(self, key)
            if matrix is None:
                continue
            sizes = [len(row) for row in matrix]
            if len(sizes) != rows or any(size != columns for size in sizes):
                yield Problem(
                    (key,),
                    f"a matrix of {rows} rows and {columns} columns was expected, got {len(sizes)} rows of {_sizes(sizes)}",
                )
        if self.start is not None and len(self.start) != n:
            yield Problem(("start",), f"{n} values were expected, one for each state, got {len(self.start)}")


class Integrator(OfInput):
    """The integral of gain · input over time; at a limit it stands still until the input turns."""

    type: Literal["integrator"] = "integrator"
    gain: Number = Field(default=1.0)
    limits: Maybe[Pair] = Field("lower and upper limit of the value", default=None)
    start: Number = Field("value at the start", default=0.0)

    def computation(self) -> tuple[Part, ...]:
        own, limits = self.path("integral"), self.limits
        step = linear((1.0, own), (self.gain * self.period, self.input_path))
        parts = [self.taken]
        if limits is None:
            parts.append(self.remembered("integral", linear((self.gain, self.input_path)), step, self.start))
        else:
            parts.append(self.present("slope", linear((self.gain, self.input_path))))
            rate, after = bounded_rate(self.path("slope"), own, limits), limited(self.path("next"), limits)
            if self.is_sampled:
                parts.append(self.present("next", step, start=self.start))
            parts.append(self.remembered("integral", rate, after, self.start))
        value = linear((1.0, own)) if limits is None else limited(own, limits)
        return *parts, self.present(self.output, value, start=self.start)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.limits is not None:
            yield from refuse_order(self.limits)
            if not self.limits[0] <= self.start <= self.limits[1]:
                yield Problem(("start",), f"{self.start:g} is outside of the limits")


def corner(time_constant: float | None, frequency: float | None) -> float:
    """Corner frequency [rad/s] of a time constant [s] or a frequency [Hz]."""
    return 1.0 / time_constant if time_constant is not None else 2.0 * math.pi * (frequency or 1.0)


def one_of_corner(time_constant: float | None, frequency: float | None) -> Iterator[Problem]:
    """Neither or both of what gives a corner frequency."""
    if (time_constant is None) == (frequency is None):
        got = "got both" if frequency is not None else "got neither"
        yield Problem((), f"a filter needs `time_constant` or `frequency`; {got}")


def _sizes(sizes: Sequence[int]) -> str:
    return " and ".join(str(size) for size in dict.fromkeys(sizes)) or "0"


KINDS = tuple(map(Kind, (TransferFunction, LowPass, HighPass, Notch, LeadLag, Derivative, StateSpace, Integrator)))
