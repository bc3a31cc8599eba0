"""The damped oscillator m ẍ + c ẋ + k x = 0 in closed form, whatever its damping.

With δ = c/2m, ω0² = k/m and ω² = ω0² - δ², and the start (x0, v0),

    x = exp(-δt) (x0 C(t) + (v0 + δ x0) S(t)),   ẋ = exp(-δt) (v0 C(t) - (ω0² x0 + δ v0) S(t)),

C = cos ωt, S = sin(ωt)/ω below critical damping; C = 1, S = t at it; C = cosh κt, S = sinh(κt)/κ, κ² = -ω², above.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Oscillator:
    """mass [kg, kg m²], stiffness [N/m, N m/rad], damping [N s/m, N m s/rad]."""

    mass: float
    stiffness: float
    damping: float = 0.0

    @property
    def frequency(self) -> float:
        """ω0 [rad/s], undamped."""
        return float(np.sqrt(self.stiffness / self.mass))

    @property
    def critical_damping(self) -> float:
        return 2 * float(np.sqrt(self.stiffness * self.mass))

    def motion(self, times: Array, displacement: float, rate: float = 0.0) -> tuple[Array, Array]:
        """x and ẋ (n,) at `times` (n,) from (displacement, rate) at 0; x counts from the position of rest."""
        decay = self.damping / (2 * self.mass)
        square = self.frequency**2 - decay**2
        if abs(square) < 1e-12 * self.frequency**2:
            C, S = np.ones_like(times), times
        elif square > 0:
            C, S = np.cos(np.sqrt(square) * times), np.sin(np.sqrt(square) * times) / np.sqrt(square)
        else:
            C, S = np.cosh(np.sqrt(-square) * times), np.sinh(np.sqrt(-square) * times) / np.sqrt(-square)
        fading = np.exp(-decay * times)
        x = fading * (displacement * C + (rate + decay * displacement) * S)
        v = fading * (rate * C - (self.frequency**2 * displacement + decay * rate) * S)
        return x, v
