"""Masses of fluids from pressures, outside of runs; and nitrogen of accumulators."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nivel.elements.circuits.density import density_and_modulus
from nivel.elements.circuits.nitrogen import KILO, R, gas_state
from nivel.elements.circuits.volumes import (
    FIXED,
    GAS,
    LAST_DENSITY,
    LAST_TEMPERATURE,
    NITROGEN,
    PRECHARGE,
    THETA,
    filled_room,
)
from nivel.elements.circuits.volumes import room as room_of_walls_and_gas

_ROOM: Any = getattr(room_of_walls_and_gas, "py_func", room_of_walls_and_gas)


def mass_at(fluid: Sequence[float], room: Sequence[float], swept: float, p: float) -> float:
    """[kg] in a volume at the pressure p, of which pistons leave `swept` [m³] open; `room` is a row of `Circuit.room`."""
    density, _ = density_and_modulus(fluid, p)
    if len(room) > NITROGEN and room[NITROGEN] > 0.0 and p >= room[PRECHARGE]:
        extra = room_at(room, p)
    else:
        extra, _ = _ROOM(np.asarray(filled_room(room)), p)
    volume = room[FIXED] + swept + extra
    return density * volume


# as it is written: kernels call it compiled
_STATE: Any = getattr(gas_state, "py_func", gas_state)
MOST, EXACT = 100, 1e-13


def density_at(p: float, temperature: float) -> float:
    """[kmol/m³] at a pressure [Pa] and a temperature [K]."""
    rho = p / (KILO * R * temperature)
    for _ in range(MOST):
        found, slope, *_ = _STATE(rho, temperature)
        change = (p - found) / slope
        rho += max(-0.5 * rho, min(change, rho))
        if abs(change) <= EXACT * rho:
            break
    return float(rho)


def theta_of(p: float, temperature: float, rho: float) -> float:
    """[K] at the density rho on the adiabat through a pressure and a temperature."""
    entropy, theta = _STATE(density_at(p, temperature), temperature)[3], temperature
    for _ in range(MOST):
        found = _STATE(rho, theta)
        change = (entropy - found[3]) * theta / found[4]
        theta += max(-0.3 * theta, min(change, 0.3 * theta))
        if abs(change) <= EXACT * theta:
            break
    return float(theta)


def room_at(room: Sequence[float], p: float) -> float:
    """[m³] that nitrogen gives way to oil at a pressure of at least that of its precharge's density."""
    rho, temperature = room[LAST_DENSITY], room[LAST_TEMPERATURE]
    entropy = _STATE(room[NITROGEN], room[THETA])[3]
    for _ in range(MOST):
        found, by_density, by_heat, known, heat, _ = _STATE(rho, temperature)
        falling, rising = -by_heat / (rho * rho), heat / temperature
        scale = by_density * rising - by_heat * falling
        change = ((p - found) * rising - by_heat * (entropy - known)) / scale
        temperature += (by_density * (entropy - known) - falling * (p - found)) / scale
        rho += change
        if abs(change) <= EXACT * rho:
            break
    return float(room[GAS] * (1.0 - room[NITROGEN] / rho))


def nitrogen_room(
    dead: float, volume: float, precharge: float, temperature: float, start: float | None
) -> tuple[float, ...]:
    """A row of `Circuit.room`. start : pressure [Pa] at which the gas has the temperature at t = 0; None: it is at its precharge."""
    rho = density_at(precharge, temperature)
    pressed = start is not None and start > precharge
    theta = theta_of(start, temperature, rho) if start is not None and pressed else temperature
    begin = density_at(start, temperature) if start is not None and pressed else rho
    least = _STATE(rho, theta)[0]
    row = [dead, 0.0, volume, least, EXPONENT, *[0.0] * (NITROGEN - GAS - 3), rho, theta, begin, temperature]
    assert row[PRECHARGE] == least
    return tuple(row)


EXPONENT = 1.4  # of the gas below its precharge
