"""Sampled controllers with the machine between their samples: discrete poles, and margins of the loops."""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from nivel.lazy import Struct, scipy
from nivel.machine.core.vectors import Array, Complex

ROUND_OFF: Final = 1e-7  # by which a pole on the unit circle may be outside
SHOWN: Final = 3  # states that are named with a pole or a mode
SHARE: Final = 0.1  # least participation of these
MARGINS: Final = ("gain_margin", "gain_frequency", "phase_margin", "phase_frequency", "delay_margin")


def participation(left: Complex, right: Complex) -> Array:
    """(n, n) |w_ki x_ki| of state k in eigenvalue i of these eigenvectors, the sum over states made one."""
    share = np.abs(left * right)
    total = share.sum(axis=0)
    return share / np.where(total > 0.0, total, 1.0)


def taking_part(states: tuple[str, ...], share: Array) -> tuple[tuple[str, float], ...]:
    """(name, share) of the states that take part most, of the participations (n,) of all."""
    order = np.argsort(-share, kind="stable")[:SHOWN]
    return tuple((states[k], float(share[k])) for k in order if share[k] >= SHARE)


class Pole(Struct):
    """A pole z, or a pair of complex ones by that with the positive imaginary part.

    natural_frequency [Hz], damping_ratio : of s = ln(z)/T, not numbers for z = 0 and z = 1. participation : (name, share) of the states
    that take part most.
    """

    number: int
    z: complex
    natural_frequency: float
    damping_ratio: float
    participation: tuple[tuple[str, float], ...]

    @property
    def number_in_words(self) -> str:
        """The pole for people."""
        return f"{self.z.real:.6g} ± {self.z.imag:.6g}i" if self.z.imag else f"{self.z.real:.6g}"

    @property
    def words(self) -> str:
        """The pole in a line."""
        taking = ", ".join(name for name, _ in self.participation)
        continuous = f", {self.natural_frequency:.6g} Hz, damping ratio {self.damping_ratio:.4g}"
        return f"z = {self.number_in_words}{'' if np.isnan(self.natural_frequency) else continuous}; {taking}"


class Loop(Struct):
    """The loop that is opened at a sampled value which acts on the machine, all others closed. L(z) is the loop with the sign of a negative
    feedback: the closed loop has its poles where L = -1.

    frequency (k,) [Hz] up to half of the sampling rate, response (k,) L there. gain_margin : by what the gain may grow, infinite where no
    gain makes the loop unstable; at gain_frequency [Hz]. phase_margin [°], at phase_frequency [Hz]; delay_margin [s] : the additional delay
    that it is. Not numbers where |L| is nowhere one.
    """

    name: str
    frequency: Array
    response: Complex
    gain_margin: float
    gain_frequency: float
    phase_margin: float
    phase_frequency: float
    delay_margin: float

    @property
    def words(self) -> str:
        """The margins in a sentence."""
        if not np.any(self.response):
            return f"loop {self.name}: open here, as at a valve that is closed"
        if np.isinf(self.gain_margin):
            gain = "gain margin infinite"
        else:
            decibels = 20.0 * np.log10(self.gain_margin)
            gain = f"gain margin {self.gain_margin:.4g} ({decibels:.1f} dB) at {self.gain_frequency:.4g} Hz"
        if np.isnan(self.phase_margin):
            return f"loop {self.name}: {gain}, |L| is nowhere one"
        delay = f", delay margin {1e3 * self.delay_margin:.4g} ms" if self.delay_margin > 0.0 else ""
        phase = f"phase margin {self.phase_margin:.4g}° at {self.phase_frequency:.4g} Hz"
        return f"loop {self.name}: {gain}, {phase}{delay}"


class SampledModel(Struct):
    """x[k + 1] = transition x[k]: the states of the machine, then sampled values, one `period` T [s] later, small changes.

    The machine moves between samples by its exact linear equations with constant commands (zero-order hold). poles (n,) : eigenvalues of
    the transition, the largest first; right, left (n, n) eigenvectors, a column each. loops : those whose margins are known. remarks : on
    what was left out.
    """

    period: float
    states: tuple[str, ...]
    transition: Array
    poles: Complex
    right: Complex
    left: Complex
    loops: tuple[Loop, ...]
    remarks: tuple[str, ...] = ()

    @property
    def stable(self) -> bool:
        """Whether no pole is outside of the unit circle, to round-off."""
        return bool(np.all(np.abs(self.poles) <= 1.0 + ROUND_OFF))

    @property
    def modes(self) -> tuple[Pole, ...]:
        """The poles, the largest first, complex pairs once."""
        share = participation(self.left, self.right)
        out: list[Pole] = []
        for k, z in enumerate(self.poles):
            if z.imag < 0.0:
                continue
            frequency = ratio = float("nan")
            if abs(z) > ROUND_OFF and abs(z - 1.0) > ROUND_OFF:
                s = np.log(complex(z)) / self.period
                frequency, ratio = abs(s) / (2.0 * np.pi), float(-s.real / abs(s))
            out.append(Pole(len(out) + 1, complex(z), frequency, ratio, taking_part(self.states, share[:, k])))
        return tuple(out)

    def summary(self) -> dict[str, Any]:
        """Numbers for programs."""
        return {
            "period": self.period,
            "stable": self.stable,
            "poles": [[each.z.real, each.z.imag] for each in self.modes],
            "loops": [
                {"name": loop.name} | {margin: _number(getattr(loop, margin)) for margin in MARGINS}
                for loop in self.loops
            ],
            "remarks": list(self.remarks),
        }

    @property
    def words(self) -> list[str]:
        """What a reader of a few lines has to know."""
        largest = float(np.max(np.abs(self.poles), initial=0.0))
        judged = "stable" if self.stable else "unstable"
        head = f"sampled every {1e3 * self.period:.6g} ms: {judged}, largest |z| {largest:.6g}"
        return [head, *(loop.words for loop in self.loops), *self.remarks]


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def loop_of(name: str, period: float, transition: Array, entering: Array, leaving: Array) -> Loop:
    """The margins of L(z) = -leaving (z - transition)⁻¹ entering. transition (n, n), entering (n,), leaving (n,)."""
    frequency = _frequencies(period, transition)
    response = _response(period, transition, entering, leaving, frequency)

    def at(f: float) -> complex:
        return complex(_response(period, transition, entering, leaving, np.array([f]))[0])

    real = _crossings(frequency, response.imag, lambda f: at(f).imag)
    gains = [(1.0 / abs(at(f)), f) for f in real if at(f).real < 0.0]
    last = response[-1]
    if last.real < 0.0:  # at half of the sampling rate L is real
        gains.append((1.0 / abs(last.real), float(frequency[-1])))
    gain, gain_at = min(((g, f) for g, f in gains if g > 1.0), default=(float("inf"), float("nan")))
    unity = _crossings(frequency, np.abs(response) - 1.0, lambda f: abs(at(f)) - 1.0)
    phases = [(float(np.degrees(np.angle(-at(f)))), f) for f in unity]
    if not phases:
        return Loop(name, frequency, response, gain, gain_at, *[float("nan")] * 3)
    phase, phase_at = min(phases, key=lambda each: abs(each[0]))
    delay = np.radians(phase) / (2.0 * np.pi * phase_at)
    return Loop(name, frequency, response, gain, gain_at, phase, phase_at, float(delay))


def _frequencies(period: float, transition: Array) -> Array:
    """[Hz] Up to half of the sampling rate, finer about lightly damped poles."""
    half = 0.5 / period
    out = [np.geomspace(1e-5 * half, half, 1200)]
    for z in np.linalg.eigvals(transition):
        f, wide = abs(np.angle(z)) / (2.0 * np.pi * period), abs(np.log(max(abs(z), 1e-12))) / (2.0 * np.pi * period)
        if 0.0 < f < half:
            out.append(f + max(wide, 1e-9 * half) * np.tan(np.linspace(-1.5, 1.5, 61)))
    every = np.unique(np.concatenate(out))
    return every[(every >= 1e-5 * half) & (every <= half)]


def _response(period: float, transition: Array, entering: Array, leaving: Array, frequency: Array) -> Complex:
    z = np.exp(2j * np.pi * period * frequency)[:, None, None]
    inner = np.linalg.solve(z * np.eye(len(transition)) - transition, np.tile(entering[:, None], (len(z), 1, 1)))
    return np.asarray(-(inner[:, :, 0] @ leaving), dtype=np.complex128)


def _crossings(frequency: Array, values: Array, find: Callable[[float], float]) -> list[float]:
    """Where what has these values at the frequencies is zero."""
    found = np.flatnonzero(values[:-1] * values[1:] < 0.0)
    solve: Any = scipy.optimize.brentq
    return [float(solve(find, frequency[k], frequency[k + 1], xtol=1e-14, rtol=1e-14)) for k in found]
