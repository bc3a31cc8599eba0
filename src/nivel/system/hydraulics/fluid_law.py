"""The law of density of a fluid outside of runs: masses from pressures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from nivel.kernels.hydraulics.fluid import ATMOSPHERE, DENSITY, specific_volume
from nivel.kernels.hydraulics.volume import COMPLIANCE, EXPONENT, FIXED, GAS, GAS_WIDTH, PRECHARGE

# as it is written: kernels call it compiled
_LAW: Any = getattr(specific_volume, "py_func", specific_volume)


def density_and_modulus(fluid: Sequence[float], p: float) -> tuple[float, float]:
    """(ρ [kg/m³], β = ρ dp/dρ [Pa]) at the absolute pressure p; `fluid` is a row of `Circuit.fluid`."""
    v, slope, _ = _LAW(fluid, p)
    return float(fluid[DENSITY] / v), float(-v / slope)


def mass_at(fluid: Sequence[float], room: Sequence[float], swept: float, p: float) -> float:
    """[kg] in a volume at the pressure p, of which pistons leave `swept` [m³] open; `room` is a row of `Circuit.room`."""
    density, _ = density_and_modulus(fluid, p)
    volume = room[FIXED] + swept + room[COMPLIANCE] * (p - ATMOSPHERE)
    if room[GAS] > 0.0:
        y = 1.0 - (room[PRECHARGE] / p) ** (1.0 / room[EXPONENT])
        t = min(max(y / GAS_WIDTH, 0.0), 1.0)
        volume += room[GAS] * (GAS_WIDTH * t**3 * (1.0 - 0.5 * t) if t < 1.0 else y - 0.5 * GAS_WIDTH)
    return density * volume
