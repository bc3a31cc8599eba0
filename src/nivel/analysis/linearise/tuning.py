"""Gains of a sampled PID controller from the linear model of its loop: the largest integral gain with the margins that are asked.

The loop L = C P is known with the gains that the controller has, so P = L/C is, on all frequencies. With a ratio kd/kp the controller is
kp c₁(z) + ki c₂(z): at each frequency one pair of gains makes L = -exp(iφ) there, with the phase margin φ. Among these pairs, of ratios
up to eight times and down to an eighth of the present one, the one with the largest integral gain is taken that keeps all margins, and as
many poles outside the unit circle as there are now, which the turns of 1 + L tell (Nyquist; Åström & Hägglund, Advanced PID Control,
2006, §6.7).
"""

from collections.abc import Iterator
from itertools import product
from typing import Final

import numpy as np

from nivel.elements.control.controllers import Pid
from nivel.errors import Fault, ModelError
from nivel.lazy import Struct
from nivel.machine.machine_record import MachineRecord
from nivel.results.analyses.sampled_model import Array, Complex, Loop, SampledModel

RATIOS: Final = tuple(2.0 ** (0.5 * k) for k in range(-6, 7))  # of kd/kp to the present one
STEP: Final = 5.0  # ° by which the phase margin is raised where the gain margin asks for more
MOST: Final = 85.0


class Tuning(Struct):
    """Gains of the block of this `name` in place of the `old` ones (kp, ki, kd), with the phase margin [°] at `frequency` [Hz]."""

    name: str
    kp: float
    ki: float
    kd: float
    phase_margin: float
    gain_margin: float
    frequency: float
    old: tuple[float, float, float]

    @property
    def words(self) -> str:
        """What to write, and what it gives."""
        kd = f", kd: {self.kd:.4g}" if self.kd else ""
        now = ", ".join(f"{each:.4g}" for each in self.old)
        margins = (
            f"phase margin {self.phase_margin:.4g}° at {self.frequency:.4g} Hz, gain margin {self.gain_margin:.4g}"
        )
        return f"tuned {self.name}: `kp: {self.kp:.4g}, ki: {self.ki:.4g}{kd}` gives {margins}; now {now}"


def tuned(
    machine: MachineRecord, model: SampledModel | None, name: str, phase: float = 60.0, gain: float = 2.0
) -> Tuning:
    """The gains of the sampled controller `name` with the largest ki of the asked phase margin [°] and gain margin at least.

    Raises ModelError where there is no such controller, or its loop is not known, or no gains have these margins.
    """
    block = next((each for each in machine.control if each.name == name), None)
    if not isinstance(block, Pid) or not block.is_sampled or not block.kp or not block.ki:
        raise ModelError(
            Fault.at(f"control.{name}", "a sampled `pid` with `kp` and `ki` was expected, whose gains are to be tuned")
        )
    loop = next((each for each in model.loops if each.name.endswith(f"control.{name}")), None) if model else None
    if (
        model is None
        or loop is None
        or abs(model.period - block.period) > 1e-9 * block.period
        or not np.any(loop.response)
    ):
        known = ", ".join(each.name for each in model.loops) if model else "none"
        message = f"its loop is not known by itself, where the machine reads its value in each period; loops: {known}"
        raise ModelError(Fault.at(f"control.{name}", message))
    found = max(_every(block, loop, phase, gain), key=lambda each: abs(each.ki), default=None)
    if found is None:
        message = f"no gains were found with a phase margin of {phase:g}° and a gain margin of {gain:g}; ask for less"
        raise ModelError(Fault.at(f"control.{name}", message))
    return found


def _every(block: Pid, loop: Loop, phase: float, gain: float) -> Iterator[Tuning]:
    """All gains that have the margins."""
    f, turns = loop.frequency, _turns(loop.response)
    first, second = _parts(block, f, block.kd / block.kp)
    plant = loop.response / (block.kp * first + block.ki * second)
    for ratio, angle in product(RATIOS if block.kd else (1.0,), np.arange(phase, MOST, STEP)):
        first, second = _parts(block, f, ratio * block.kd / block.kp)
        wanted = -np.exp(1j * np.radians(angle)) / plant
        lines = np.array([[first.real, second.real], [first.imag, second.imag]]).transpose(2, 0, 1)
        kp, ki = np.linalg.solve(lines, np.array([wanted.real, wanted.imag]).T[:, :, None])[:, :, 0].T
        for k in np.flatnonzero((kp * block.kp > 0.0) & (ki * block.ki > 0.0)):
            L = plant * (kp[k] * first + ki[k] * second)
            if abs(_turns(L) - turns) < 0.5 and _phase_margin(L) > phase - 0.5 and (most := _gain_margin(L)) >= gain:
                gains = float(kp[k]), float(ki[k]), float(kp[k] * ratio * block.kd / block.kp)
                yield Tuning(block.name, *gains, float(angle), most, float(f[k]), (block.kp, block.ki, block.kd))


def _parts(block: Pid, frequency: Array, ratio: float) -> tuple[Complex, Complex]:
    """c₁ and c₂ at frequencies [Hz], with kd/kp = `ratio` [s]."""
    T = block.period
    z = np.exp(2j * np.pi * frequency * T)
    late = block.filter_time if block.filter_time is not None else 0.1 * abs(ratio)
    share = late / (late + T)
    first = 1.0 + ratio * (1.0 - share) / T * (z - 1.0) / (z - share)
    return np.asarray(first, dtype=np.complex128), np.asarray(T / (z - 1.0), dtype=np.complex128)


def _turns(L: Complex) -> float:
    """Turns of 1 + L about zero, over all frequencies."""
    return float(np.sum(np.angle((1.0 + L[1:]) / (1.0 + L[:-1])))) / (2.0 * np.pi)


def _phase_margin(L: Complex) -> float:
    """[°] The least one where |L| passes one; infinite where it does not."""
    size = np.log(np.abs(L))
    k = np.flatnonzero(size[:-1] * size[1:] <= 0.0)
    share = size[k] / (size[k] - size[k + 1])
    return float(np.min(np.abs(np.degrees(np.angle(-(L[k] + share * (L[k + 1] - L[k]))))), initial=np.inf))


def _gain_margin(L: Complex) -> float:
    """By what the gain may grow or fall, whichever is less, until L passes -1; infinite where it never does."""
    k = np.flatnonzero(L.imag[:-1] * L.imag[1:] <= 0.0)
    real = L.real[k] - L.imag[k] * (L.real[k + 1] - L.real[k]) / (L.imag[k + 1] - L.imag[k])
    sizes = np.abs(real[real < 0.0])
    return float(np.min(np.maximum(sizes, 1.0 / sizes), initial=np.inf))
