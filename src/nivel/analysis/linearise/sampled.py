"""Sampled values of a machine and its motion between their samples, in small changes.

Between samples ẋ = A x with constant sampled values s among the states; a time Δ later x is exp(A Δ) x. A sample is s_i := F_i x with the
exact derivatives F of its law, in the order in which the samples of an instant are computed. Over the common period of all samples

    x[k + 1] = exp(A Δ_n) J_n … exp(A Δ_1) J_1 x[k]

A loop is opened where the machine reads a sampled value: a copy that only the machine reads takes an input in place of it.

Gains of a sampled PID controller from the linear model of its loop: the largest integral gain with the margins that are asked.

The loop L = C P is known with the gains that the controller has, so P = L/C is, on all frequencies. With a ratio kd/kp the controller is
kp c₁(z) + ki c₂(z): at each frequency one pair of gains makes L = -exp(iφ) there, with the phase margin φ. Among these pairs, of ratios
up to eight times and down to an eighth of the present one, the one with the largest integral gain is taken that keeps all margins, and as
many poles outside the unit circle as there are now, which the turns of 1 + L tell (Nyquist; Åström & Hägglund, Advanced PID Control,
2006, §6.7).
"""

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import product
from math import lcm
from typing import Any, Final

import numpy as np
from scipy.linalg import eig, expm

from nivel.analysis.assembly.instant import Instant
from nivel.analysis.linearise.validity import BALANCE
from nivel.elements.control.controllers import Pid
from nivel.errors import Fault, ModelError
from nivel.kernels.record.record import NONE
from nivel.lazy import Struct
from nivel.machine.control.order import parts_of
from nivel.machine.machine_record import MachineRecord
from nivel.results.analyses.sampled_model import Array, Complex, Loop, SampledModel, loop_of
from nivel.system.signals.control import ONCE, variable_of

RATIOS: Final = tuple(2.0 ** (0.5 * k) for k in range(-6, 7))  # of kd/kp to the present one
STEP: Final = 5.0  # ° by which the phase margin is raised where the gain margin asks for more
LARGEST_ANGLE: Final = 85.0


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
    for ratio, angle in product(RATIOS if block.kd else (1.0,), np.arange(phase, LARGEST_ANGLE, STEP)):
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


MOST: Final = 5000  # instants in a common period


class Sample(Struct):
    """A sampled value: its state, its time after the start of a period and the period [s] exactly; at_once : others of the instant read
    its new value."""

    state: int
    first: Fraction
    period: Fraction
    at_once: bool


def samples_of(instant: Instant) -> list[Sample]:
    """What is sampled again and again, in the order in which the values of an instant are computed."""
    table, out = instant.record.sampled, []
    for k in range(len(table.state)):
        ticks, rate = Fraction(float(table.ticks[k])), Fraction(float(table.rate[k]))
        if table.state[k] == NONE or not ticks or ticks / rate >= Fraction(ONCE) / 2:
            continue
        out.append(
            Sample(int(table.state[k]), Fraction(float(table.first[k])) / rate, ticks / rate, bool(table.at_once[k]))
        )
    return out


def held_values(machine: MachineRecord, instant: Instant) -> set[int]:
    """Numbers of sampled states that switch and keep their values, as those of state machines: constants of linear equations."""
    names = {variable_of(each) for each in parts_of(machine.control) if each.part.holds}
    return {k for k, fact in enumerate(instant.system.states) if fact.name in names}


def unrest(instant: Instant, samples: Sequence[Sample], held: set[int]) -> list[str]:
    """Sampled values that the next sample would change, in sentences."""
    facts, out = instant.system.states, []
    change = at_rest(instant, lambda: instant.value()[instant.n :][: instant.state_count])
    for k in dict.fromkeys(each.state for each in samples):
        if k not in held and abs(change[k]) > BALANCE * (facts[k].scale or 1.0):
            name = facts[k].name
            out.append(f"the next sample changes {name} by {change[k]:.4g}: linearise about equilibrium")
    return out


def at_rest(instant: Instant, find: Callable[[], Array]) -> Array:
    """What `find` gives where the rates of sampled states are what a sample would change them by; of a matrix A, their rows are derivatives
    of that."""
    flag = instant.record.sampled.at_rest
    flag[0] = 1
    try:
        return find()
    finally:
        flag[0] = 0


def sampled_model(
    A: Array,
    laws: Array,
    scale: Array,
    names: Sequence[str],
    samples: Sequence[Sample],
    T: Array,
    acting: Sequence[int],
) -> SampledModel:
    """The model of states that are in order: continuous ones, then sampled ones, whose numbers `samples` have.

    A (n, n) : with zero rows of sampled states. laws (n, n) : rows F of sampled states. scale (n,) : sizes. T (n, n) : what the states are
    transformed by for participation. acting : sampled states at which loops are opened.
    """
    period, instants = _instants(samples)
    small = A * scale / scale[:, None]
    F = laws * scale / scale[:, None]
    Z = _over_a_period(small, F, period, instants)
    # a sampled value that is set anew before anything reads it is no state
    kept = np.flatnonzero(np.any(Z, axis=0) | (np.arange(len(A)) < len(A) - len({each.state for each in samples})))
    Z, turned = Z[np.ix_(kept, kept)], (T * scale)[np.ix_(kept, kept)]
    transition = turned @ Z @ np.linalg.inv(turned)
    found: Any = eig(Z, left=True, right=True)
    values, left, right = found
    order = np.lexsort((-values.imag, -np.round(np.abs(values), 12)))
    values, left, right = values[order], left[:, order], right[:, order]
    loops, remarks = [], []
    for place in acting:
        loop = _loop(small, F, period, instants, place, names[place])
        if loop is None:
            remarks.append(f"{names[place]} is sampled more than once in the common period: its loop has no margins")
        else:
            loops.append(loop)
    back = np.linalg.inv(turned)
    return SampledModel(
        period=float(period),
        states=tuple(names[int(k)] for k in kept),
        transition=transition,
        poles=values,
        right=turned @ right,
        left=back.T @ left,
        loops=tuple(loops),
        remarks=tuple(remarks),
    )


def _instants(samples: Sequence[Sample]) -> tuple[Fraction, list[tuple[Fraction, list[Sample]]]]:
    """The common period of all samples, and what is due at each instant of it."""
    periods = {each.period for each in samples}
    denominator = lcm(*(each.denominator for each in periods))
    period = Fraction(lcm(*(int(each * denominator) for each in periods)), denominator)
    if sum(period / each.period for each in samples) > MOST:
        message = f"the samples have a common period of {float(period):.6g} s only: choose sample times that are multiples of each other"
        raise ModelError(Fault.at("control", message))
    due: dict[Fraction, list[Sample]] = {}
    for each in samples:
        for j in range(int(period / each.period)):
            due.setdefault((each.first + j * each.period) % period, []).append(each)
    order = {id(each): k for k, each in enumerate(samples)}
    return period, [(t, sorted(due[t], key=lambda each: order[id(each)])) for t in sorted(due)]


def _over_a_period(A: Array, F: Array, period: Fraction, instants: list[tuple[Fraction, list[Sample]]]) -> Array:
    """The change of all states from before the first instant to before it a period later."""
    Z = np.eye(len(A))
    ends = [*(t for t, _ in instants[1:]), period + instants[0][0]]
    for (t, due), after in zip(instants, ends, strict=True):
        Z = expm(A * float(after - t)) @ _jump(Z, F, due)
    return Z


def _jump(Z: Array, F: Array, due: Sequence[Sample]) -> Array:
    """Z after the samples of an instant: those at once one after the other, the others together."""
    Z, later = Z.copy(), {}
    for each in due:
        value = F[each.state] @ Z
        if each.at_once:
            Z[each.state] = value
        else:
            later[each.state] = value
    for state, value in later.items():
        Z[state] = value
    return Z


def _loop(
    A: Array, F: Array, period: Fraction, instants: list[tuple[Fraction, list[Sample]]], place: int, name: str
) -> Loop | None:
    """The loop opened where the machine reads the sampled state `place`; None where it is sampled more than once in the period."""
    when = [k for k, (_, due) in enumerate(instants) if any(each.state == place for each in due)]
    if len(when) != 1:
        return None
    begin = instants[when[0]][0]
    turned = sorted((((t - begin) % period, due) for t, due in instants), key=lambda each: each[0])
    n = len(A)
    # one more state, the copy that the machine reads, and the input as another one
    opened, laws = np.zeros((n + 2, n + 2)), np.zeros((n + 2, n + 2))
    opened[:n, :n], laws[:n, :n] = A, F
    opened[:n, n], opened[:n, place] = A[:, place], 0.0
    Z = _jump(np.eye(n + 2), laws, turned[0][1])
    leaving = Z[place, : n + 1].copy()
    Z[n] = 0.0
    Z[n, n + 1] = 1.0
    for k, (t, due) in enumerate(turned):
        Z = _jump(Z, laws, due) if k else Z
        after = turned[k + 1][0] if k + 1 < len(turned) else period
        Z = expm(opened * float(after - t)) @ Z
    # the copy is set anew before anything reads it
    return loop_of(name, float(period), Z[: n + 1, : n + 1], Z[: n + 1, n + 1], leaving)
