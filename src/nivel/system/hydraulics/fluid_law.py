"""The law of density of a fluid outside of runs: masses from pressures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nivel.kernels.hydraulics.fluid import DENSITY, specific_volume
from nivel.kernels.hydraulics.volume import FIXED, NITROGEN, PRECHARGE
from nivel.kernels.hydraulics.volume import room as room_of_walls_and_gas
from nivel.system.hydraulics.circuit import filled_room
from nivel.system.hydraulics.nitrogen_gas import room_at

# as it is written: kernels call it compiled
_LAW: Any = getattr(specific_volume, "py_func", specific_volume)
_ROOM: Any = getattr(room_of_walls_and_gas, "py_func", room_of_walls_and_gas)


def density_and_modulus(fluid: Sequence[float], p: float) -> tuple[float, float]:
    """(ρ [kg/m³], β = ρ dp/dρ [Pa]) at the absolute pressure p; `fluid` is a row of `Circuit.fluid`."""
    v, slope, _ = _LAW(fluid, p)
    return float(fluid[DENSITY] / v), float(-v / slope)


def mass_at(fluid: Sequence[float], room: Sequence[float], swept: float, p: float) -> float:
    """[kg] in a volume at the pressure p, of which pistons leave `swept` [m³] open; `room` is a row of `Circuit.room`."""
    density, _ = density_and_modulus(fluid, p)
    if len(room) > NITROGEN and room[NITROGEN] > 0.0 and p >= room[PRECHARGE]:
        extra = room_at(room, p)
    else:
        extra, _ = _ROOM(np.asarray(filled_room(room)), p)
    volume = room[FIXED] + swept + extra
    return density * volume
