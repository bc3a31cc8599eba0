"""Stabilisation methods by name: what they set in `control.stabilise`, and whether states are corrected after a step."""

from collections.abc import Callable

from nivel.lazy import dataclass

Coefficients = tuple[float, float, float, float]

# Violations below this share of the machine's length or of a cosine's 1 (per second, for rates) are round-off, and left alone.
TOLERANCE = 1e-13


@dataclass(frozen=True)
class Stabilisation:
    """A stabilisation method.

    coefficients : of (step [s], α [1/s] or None, β [1/s] or None): (2α, β², tolerance of |C|, tolerance of |Ċ|), shares of the scales of
    the rows. corrects : states are put back onto the constraints after every step. conserves : then the energy as well.
    """

    coefficients: Callable[[float, float | None, float | None], Coefficients]
    corrects: bool = False
    conserves: bool = False


def _feed_nothing_back(step: float, alpha: float | None, beta: float | None) -> Coefficients:
    """Constraints hold at the acceleration level only, and drift."""
    del step, alpha, beta
    return 0.0, 0.0, 0.0, 0.0


def baumgarte(step: float, alpha: float | None, beta: float | None) -> Coefficients:
    """Coefficients of Baumgarte (1972): C̈ + 2 α Ċ + β² C = 0 in place of C̈ = 0 (report 44, eq. 110); without own α, β [1/s] those of
    eq. 111, α = 1/Δt and β = √2/Δt.

    The feedback steers the motion; recorded accelerations and reactions are evaluated without it (`nivel.integrate.loop.loop`).
    """
    if alpha is None or beta is None:
        return 2.0 / step, 2.0 / step**2, 0.0, 0.0
    return 2.0 * alpha, beta**2, 0.0, 0.0


def _correct(step: float, alpha: float | None, beta: float | None) -> Coefficients:
    """Direct correction (report 44, §5.5): after every step positions, then velocities, are put back onto the constraints."""
    del step, alpha, beta
    return 0.0, 0.0, TOLERANCE, TOLERANCE


STABILISATIONS: dict[str, Stabilisation] = {
    "none": Stabilisation(_feed_nothing_back),
    "baumgarte": Stabilisation(baumgarte),
    "direct": Stabilisation(_correct, corrects=True),
    # Geometric elimination with the energy constraint (report 44, eqs. 121-136): positions and velocities are put back onto the constraints
    # as by direct correction, then the velocities are scaled to the energy that the machine must have (`nivel.integrate.loop.loop`).
    # Eq. 136 as printed leaves Ċ free and diverges; in this order every level holds.
    "geometric": Stabilisation(_correct, corrects=True, conserves=True),
}
