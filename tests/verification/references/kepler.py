"""Two particles that attract each other with k/r²: Kepler's orbit in closed form.

The vector from the first to the second obeys μ r̈ = -k r/r³ with μ = m1 m2/(m1 + m2). From the pericentre of an orbit
with semi-axis a and eccentricity e: mean motion n = √(k/(μ a³)), E - e sin E = n t,
r = a (cos E - e, √(1 - e²) sin E), period 2π/n. At the pericentre r = a (1 - e) and v = √(k/(μ a)·(1 + e)/(1 - e)).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Orbit:
    """strength k [N m²]; reduced_mass μ [kg]; semi_axis a [m]; eccentricity e < 1."""

    strength: float
    reduced_mass: float
    semi_axis: float
    eccentricity: float

    @property
    def mean_motion(self) -> float:
        return float(np.sqrt(self.strength / (self.reduced_mass * self.semi_axis**3)))

    @property
    def period(self) -> float:
        return 2 * np.pi / self.mean_motion

    @property
    def pericentre(self) -> float:
        return self.semi_axis * (1 - self.eccentricity)

    @property
    def speed_at_pericentre(self) -> float:
        e = self.eccentricity
        return float(np.sqrt(self.strength / (self.reduced_mass * self.semi_axis) * (1 + e) / (1 - e)))

    def position(self, times: Array) -> Array:
        """(n, 2) from the first particle to the second, pericentre on +x at time 0, moving towards +y."""
        e, mean = self.eccentricity, self.mean_motion * np.asarray(times)
        E = mean.copy()
        for _ in range(60):  # Newton on Kepler's equation
            E = E - (E - e * np.sin(E) - mean) / (1 - e * np.cos(E))
        return self.semi_axis * np.stack([np.cos(E) - e, np.sqrt(1 - e**2) * np.sin(E)], axis=1)
