"""Numbers of prepared machines as functions of parameters: found once, from machines prepared with a few values of each.

A number y follows a *law* where z = y, 1/y, 1/y² or y² is a sum of functions of one parameter each, z = c + Σ P_k(t_k)/Q_k(t_k), with
t = (x - centre)/width: polynomials P of degree 3 at most where Q = 1, or a fraction of two of degree 1. So 1/√m follows a mass that is the
sum of several parameters, and the share T/(T + h) of a filter its time constant. P goes through the first values, and Q follows from the
others as the weights that their Loewner matrix makes least (Nakatsukasa, Sète, Trefethen 2018). A law meets more points than it has
coefficients, to round-off, so that it holds beyond them.
"""

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.preparation.memory import Array, MachineMemory, UnlikeError
from nivel.errors import ModelError
from nivel.lazy import Struct, replace

NODES: Final = 4  # most points of a function
# y = ± z^power, and whether z are fractions: last, as what is the inverse of a sum follows each parameter alone as a fraction, too
FORMS: Final = ((1.0, False), (-1.0, False), (-0.5, False), (0.5, False), (1.0, True))
FITS: Final = 1e-11  # share of the largest value of a number by which a law misses points
OF_CHANGE: Final = 1e-9  # share of the change of a number by which one does where slopes are asked for
EQUAL: Final = 1e-12  # share of its scale by which a number changes by round-off alone
LAST_PLACES: Final = 4e-15  # the same before numbers are taken as constant without a further turn
ROUND_OFF: Final = 1e-13  # constants of this share of the number are those of finding its functions


class Unfit(NamedTuple):
    """Why a parameter has no numbers. parameter : its place. reason : another structure, the name of an array of which a number follows no
    law, or why the machine cannot be prepared."""

    parameter: int
    reason: UnlikeError | str | ModelError


class UnfitError(Exception):
    """Parameters of which numbers follow no laws. args : an `Unfit` each."""


class Numbers(Struct):
    """n numbers that follow from m parameters, y = sign z^power with z = constant + Σ_k P_k(t_k)/Q_k(t_k), t = (x - centre)/width.

    places : (n,) among those of the memory. constants, powers, signs : (n,). factors, divisors : (n, m, NODES) of the powers of t in P and
    Q; factors are zero where a number does not follow the parameter. centres, widths : (m,).
    """

    places: NDArray[np.intp]
    constants: Array
    powers: Array
    signs: Array
    factors: Array
    divisors: Array
    centres: Array
    widths: Array

    def at(self, x: Array) -> Array:
        """(n,) for parameters x (m,)."""
        z = self.constants + self.sums(x)
        return np.where(self.powers == 1.0, z, self.signs * np.abs(z) ** self.powers)

    def sums(self, x: Array) -> Array:
        """(n,) Σ P/Q."""
        t = _powers_of((x - self.centres) / self.widths)
        return ((self.factors * t).sum(axis=-1) / (self.divisors * t).sum(axis=-1)).sum(axis=-1)

    def slopes(self, x: Array) -> Array:
        """(n, m) derivatives with respect to each parameter."""
        t = _powers_of((x - self.centres) / self.widths)
        rate = np.zeros_like(t)
        rate[..., 1:] = t[..., :-1] * np.arange(1, NODES)
        above, below = ((part * t).sum(axis=-1) for part in (self.factors, self.divisors))
        of_above, of_below = ((part * rate).sum(axis=-1) for part in (self.factors, self.divisors))
        z = self.constants + (above / below).sum(axis=-1)
        outer = np.where(self.powers == 1.0, 1.0, self.signs * self.powers * np.abs(z) ** (self.powers - 1.0))
        return outer[:, None] * (of_above - above / below * of_below) / below / self.widths

    def among(self, chosen: NDArray[np.bool_]) -> "Numbers":
        """Some of them."""
        names = ("places", "constants", "powers", "signs", "factors", "divisors")
        return replace(self, **{name: getattr(self, name)[chosen] for name in names})


def _powers_of(t: Array) -> Array:
    """(…, NODES) powers 0, 1, … of t (…)."""
    return t[..., None] ** np.arange(NODES)


class Sample(NamedTuple):
    """A parameter at several values x (N,), the nominal one last, and the numbers (N, n) of the machine there. is_lawful : all that
    have a part in what follows from parameters follow laws. is_for_slopes : laws meet changes of numbers, not only the numbers."""

    x: Array
    numbers: Array
    is_lawful: bool = False
    is_for_slopes: bool = False

    @property
    def nodes(self) -> int:
        """Points that functions go through, the first ones."""
        return min(NODES, len(self.x) - 1)

    @property
    def frame(self) -> tuple[float, float]:
        """Centre and width. What covers more than an octave has its centre at zero: so numbers in proportion to it are exact to their own
        size."""
        low, high = self.x.min(), self.x.max()
        if 0.0 < 2.0 * low < high or low < 2.0 * high < 0.0:
            return 0.0, float(max(abs(low), abs(high)))
        return float(0.5 * (low + high)), float(0.5 * (high - low))

    @property
    def t(self) -> Array:
        centre, width = self.frame
        return (self.x - centre) / width


class _Fit(NamedTuple):
    """Functions through a sample: factors and divisors (n, NODES), and whether they are laws (n,)."""

    factors: Array
    divisors: Array
    fits: NDArray[np.bool_]


Prepare = Callable[[int, float], MachineMemory]
# values of a parameter by turns
Turns = Sequence[Sequence[float]]


def numbers_of(
    nominal: MachineMemory,
    x: Array,
    alternatives: Sequence[Sequence[Turns]],
    prepare: Prepare,
    accept: Callable[[Sample], bool] | None = None,
) -> Numbers:
    """Numbers of the machine `nominal`, with parameters x (m,), as functions of these.

    alternatives : values of each parameter. The first with which the machine can be prepared count; of those the ones of the second turn
    only where numbers follow no law after the first. prepare(k, value) : the machine with another value of parameter k. accept : whether
    numbers that follow no law may be interpolated by polynomials of degree 3 between the values of a sample, workspace too; where not, and
    where the structure changes, the next alternative counts.

    Raises UnfitError with every parameter for which there are none.
    """
    faults: list[Unfit] = []
    samples: list[Sample] = []
    for k in range(len(x)):
        try:
            samples.append(_sampled(nominal, k, float(x[k]), alternatives[k], prepare, accept))
        except (UnlikeError, ModelError) as error:
            faults.append(Unfit(k, error))
    if faults:
        raise UnfitError(*faults)
    return _fitted(nominal, x, samples, laws=accept is None)


def _sampled(
    nominal: MachineMemory,
    k: int,
    x: float,
    alternatives: Sequence[Turns],
    prepare: Prepare,
    accept: Callable[[Sample], bool] | None,
) -> Sample:
    """Raises UnlikeError, and ModelError where the machine can be prepared with no alternative."""
    *others, last = alternatives
    for turns in others:
        try:
            sample = _turned(nominal, k, x, turns, prepare, for_slopes=accept is not None)
        except (ModelError, UnlikeError) as error:
            if accept is None and isinstance(error, UnlikeError):
                raise
            continue
        if accept is None or sample.is_lawful or accept(sample):
            return sample
    return _turned(nominal, k, x, last, prepare, for_slopes=accept is not None)


def _turned(nominal: MachineMemory, k: int, x: float, turns: Turns, prepare: Prepare, *, for_slopes: bool) -> Sample:
    """The parameter at the values of as many turns as it needs for laws."""
    base, xs, rows = nominal.numbers, list[float](), list[Array]()
    sample = Sample(np.array([x]), base[None])
    for turn in turns:
        for value in turn:
            other = prepare(k, value)
            nominal.refuse_unlike(other)
            rows.append(other.numbers)
            xs.append(value)
        sample = Sample(np.array([*xs, x]), np.array([*rows, base]), is_for_slopes=for_slopes)
        places = np.flatnonzero(_changed(sample) & ~nominal.left & ~_noise(nominal, sample, LAST_PLACES))
        if np.any([_fit(sample, places, *form).fits for form in FORMS], axis=0).all():
            return sample._replace(is_lawful=True)
    return sample


def _changed(sample: Sample) -> NDArray[np.bool_]:
    """(n,) which numbers are not the same at all points."""
    return ((sample.numbers != sample.numbers[-1]) & ~np.isnan(sample.numbers)).any(axis=0)


def _noise(nominal: MachineMemory, sample: Sample, share: float = EQUAL) -> NDArray[np.bool_]:
    """(n,) which numbers change by round-off alone."""
    with np.errstate(invalid="ignore"):
        return np.ptp(sample.numbers, axis=0) <= share * nominal.scales


def _fitted(nominal: MachineMemory, x: Array, samples: Sequence[Sample], *, laws: bool) -> Numbers:
    changed = np.array([_changed(sample) for sample in samples], dtype=bool).reshape(len(samples), len(nominal.numbers))
    if laws:
        changed &= ~nominal.left
    places = np.flatnonzero(changed.any(axis=0))
    depends, powers = changed[:, places].T, np.zeros(len(places))
    factors, divisors = (np.zeros((len(places), len(x), NODES)) for _ in range(2))
    divisors[..., 0] = 1.0

    def take(new: NDArray[np.bool_], fits: Sequence[_Fit]) -> None:
        for k, fit in enumerate(fits):
            mine = new & depends[:, k]
            factors[mine, k], divisors[mine, k] = fit.factors[mine], fit.divisors[mine]

    for power, fractions in FORMS:
        fits = [_fit(sample, places, power, fractions) for sample in samples]
        new = np.all([~depends[:, k] | fit.fits for k, fit in enumerate(fits)], axis=0) & (powers == 0.0)
        take(new, fits)
        powers[new] = power
    chosen = powers != 0.0
    if laws:
        _refuse_unfit(nominal, samples, places[~chosen])
    else:
        take(np.logical_not(chosen), [_interpolated(sample, places) for sample in samples])
        powers[~chosen], chosen = 1.0, np.ones_like(chosen)
    base, frames = nominal.numbers[places], np.array([sample.frame for sample in samples]).reshape(-1, 2)
    signs = np.where(base < 0.0, -1.0, 1.0)
    out = Numbers(places, np.zeros(len(places)), powers, signs, factors, divisors, *frames.T).among(chosen)
    z = _power_of(base[chosen], out.powers)
    constants = z - out.sums(x)
    # numbers that follow one parameter alone are exact to their own size at both ends of wide ranges
    constants[(depends[chosen].sum(axis=1) == 1) | (np.abs(constants) <= ROUND_OFF * np.abs(z))] = 0.0
    return replace(out, constants=constants)


def _refuse_unfit(nominal: MachineMemory, samples: Sequence[Sample], places: NDArray[np.intp]) -> None:
    """Raise UnfitError with the parameters of which numbers follow no law, unless these change by round-off alone."""
    faults = []
    for k, sample in enumerate(samples):
        mine = places[_changed(sample)[places] & ~_noise(nominal, sample)[places]]
        alone = mine[~np.any([_fit(sample, mine, *form).fits for form in FORMS], axis=0)]
        if len(mine):
            faults.append(Unfit(k, nominal.name_of(int((alone if len(alone) else mine)[0]))))
    if faults:
        raise UnfitError(*faults)


def _power_of(y: Array, powers: Array) -> Array:
    """z of numbers y (…, n) with powers (n,)."""
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        return np.where(powers == 1.0, y, np.abs(y) ** (1.0 / powers))


def _fit(sample: Sample, places: NDArray[np.intp], power: float, fractions: bool) -> _Fit:
    """Laws of some numbers, the simplest that fit."""
    y, t = sample.numbers[:, places], sample.t
    z = _power_of(y, np.full(len(places), power))
    able: NDArray[np.bool_] = np.asarray(np.isfinite(z).all(axis=0))
    if power != 1.0:
        able &= np.abs(np.sign(y).sum(axis=0)) == len(y)
    z = np.where(able, z, 0.0)
    allowed = FITS * np.abs(z).max(axis=0)
    if sample.is_for_slopes:
        allowed = OF_CHANGE * np.ptp(z, axis=0) + LAST_PLACES * np.abs(z).max(axis=0)
    out = _Fit(np.zeros((len(places), NODES)), np.zeros((len(places), NODES)), ~able)
    for nodes in () if fractions else range(2, min(sample.nodes, len(t) - 1) + 1):
        _take(out, t, z, allowed, np.ones((len(places), nodes)))
    if fractions and len(t) > NODES:
        loewner = (z[2:].T[:, :, None] - z[:2].T[:, None, :]) / (t[2:, None] - t[:2])
        _take(out, t, z, allowed, np.linalg.svd(loewner)[2][:, -1] * [1.0, -1.0])
    out.fits[~able] = False
    return out


def _take(out: _Fit, t: Array, z: Array, allowed: Array, below: Array) -> None:
    """Take functions whose denominators have the values `below` (n, nodes) at the first points, where they meet all points and have no
    pole between them."""
    nodes = below.shape[1]
    to_powers = np.linalg.inv(_powers_of(t[:nodes])[:, :nodes])
    factors, divisors = (
        np.pad(part @ to_powers.T, ((0, 0), (0, NODES - nodes))) for part in (below * z[:nodes].T, below)
    )
    if (t > 0.0).all():  # of what is zero with the parameter, round-off is left at zero
        for part in (factors, divisors):
            part[:, 0][np.abs(part[:, 0]) <= ROUND_OFF * np.abs(part).max(axis=1)] = 0.0
    at = _powers_of(t)
    bottom = divisors @ at.T
    with np.errstate(divide="ignore", invalid="ignore"):
        missed = np.abs((factors @ at.T) / bottom - z.T)
    fits = (missed <= allowed[:, None]).all(axis=1) & ~out.fits
    fits &= np.abs(np.sign(bottom).sum(axis=1)) == len(t)
    out.factors[fits], out.divisors[fits], out.fits[fits] = factors[fits], divisors[fits], True


def _interpolated(sample: Sample, places: NDArray[np.intp]) -> _Fit:
    """Polynomials through the first points."""
    count = sample.nodes
    z = np.where(np.isfinite(sample.numbers).all(axis=0), sample.numbers, 0.0)[:count, places]
    factors, divisors = np.zeros((len(places), NODES)), np.zeros((len(places), NODES))
    factors[:, :count], divisors[:, 0] = np.linalg.solve(_powers_of(sample.t[:count])[:, :count], z).T, 1.0
    return _Fit(factors, divisors, np.zeros(len(places), dtype=bool))
