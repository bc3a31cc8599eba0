"""Units and their values in SI. Common units stand in a table; pint, slow to load, is asked only about the others."""

import math
from difflib import get_close_matches
from functools import cache
from typing import Any, NamedTuple

from nivel.lazy import pint
from nivel.machine.units.dimension import BASES, Dimension, dimension


class Unit(NamedTuple):
    """One `name` is `factor` SI units of `dimension`."""

    factor: float
    dimension: Dimension


class UnknownUnitError(ValueError):
    """Neither the table nor pint knows this name."""


_LENGTH = dimension(m=1)
_MASS = dimension(kg=1)
_TIME = dimension(s=1)
_ANGLE = dimension(rad=1)
_TURN_RATE = dimension(rad=1, s=-1)
_FREQUENCY = dimension(cycle=1, s=-1)
_FORCE = dimension(kg=1, m=1, s=-2)
_ENERGY = dimension(kg=1, m=2, s=-2)
_POWER = dimension(kg=1, m=2, s=-3)
_PRESSURE = dimension(kg=1, m=-1, s=-2)

UNITS: dict[str, Unit] = {
    "m": Unit(1.0, _LENGTH),
    "km": Unit(1e3, _LENGTH),
    "dm": Unit(1e-1, _LENGTH),
    "cm": Unit(1e-2, _LENGTH),
    "mm": Unit(1e-3, _LENGTH),
    "um": Unit(1e-6, _LENGTH),
    "in": Unit(0.0254, _LENGTH),
    "ft": Unit(0.3048, _LENGTH),
    "kg": Unit(1.0, _MASS),
    "g": Unit(1e-3, _MASS),
    "t": Unit(1e3, _MASS),
    "lb": Unit(0.45359237, _MASS),
    "s": Unit(1.0, _TIME),
    "ms": Unit(1e-3, _TIME),
    "us": Unit(1e-6, _TIME),
    "min": Unit(60.0, _TIME),
    "h": Unit(3600.0, _TIME),
    "rad": Unit(1.0, _ANGLE),
    "mrad": Unit(1e-3, _ANGLE),
    "deg": Unit(math.pi / 180, _ANGLE),
    "°": Unit(math.pi / 180, _ANGLE),
    "rev": Unit(2 * math.pi, _ANGLE),
    "rpm": Unit(2 * math.pi / 60, _TURN_RATE),
    "Hz": Unit(1.0, _FREQUENCY),
    "kHz": Unit(1e3, _FREQUENCY),
    "N": Unit(1.0, _FORCE),
    "mN": Unit(1e-3, _FORCE),
    "kN": Unit(1e3, _FORCE),
    "MN": Unit(1e6, _FORCE),
    "kgf": Unit(9.80665, _FORCE),
    "lbf": Unit(4.4482216152605, _FORCE),
    "Nm": Unit(1.0, _ENERGY),
    "kNm": Unit(1e3, _ENERGY),
    "J": Unit(1.0, _ENERGY),
    "kJ": Unit(1e3, _ENERGY),
    "W": Unit(1.0, _POWER),
    "kW": Unit(1e3, _POWER),
    "MW": Unit(1e6, _POWER),
    "Pa": Unit(1.0, _PRESSURE),
    "kPa": Unit(1e3, _PRESSURE),
    "MPa": Unit(1e6, _PRESSURE),
    "GPa": Unit(1e9, _PRESSURE),
    "bar": Unit(1e5, _PRESSURE),
}
# known without pint, but free as names of parameters
_FREE: dict[str, Unit] = {**dict.fromkeys(("L", "l"), Unit(1e-3, dimension(m=3))), "K": Unit(1.0, dimension(K=1))}

LONGEST = 40  # letters of a unit


@cache
def unit(name: str) -> Unit:
    """The unit called `name`.

    Raises UnknownUnitError, with the nearest known name in its message.
    """
    found = UNITS.get(name) or _FREE.get(name) or (_ask_pint(name) if _may_be_unit(name) else None)
    if found is None and len(name) > LONGEST:
        raise UnknownUnitError(f"the unit `{name[:LONGEST]}…` is not known")
    if found is None:
        near = get_close_matches(name, UNITS, n=1, cutoff=0.5)
        hint = f"; did you mean `{near[0]}`?" if near else ""
        raise UnknownUnitError(f"the unit `{name}` is not known{hint}")
    return found


def _may_be_unit(name: str) -> bool:
    """Whether this is worth asking for: short, of letters and plain digits. Pint stumbles over others."""
    return len(name) <= LONGEST and all(each.isalpha() or each in "_0123456789" for each in name)


@cache
def _registry() -> Any:
    return pint.UnitRegistry(cache_folder=None)


_PINT_BASES = {
    "kilogram": "kg",
    "gram": "kg",
    "meter": "m",
    "second": "s",
    "radian": "rad",
    "ampere": "A",
    "kelvin": "K",
    "mole": "mol",
    "candela": "cd",
}


def _ask_pint(name: str) -> Unit | None:
    """The unit `name` by pint; None where pint does not know it, or where it is no plain multiple of SI units (degC,
    dB).
    """
    registry = _registry()
    try:
        parsed = registry.parse_units(name)
        factor, base = registry.get_base_units(parsed)
        multiplicative = registry.Quantity(0, parsed).to(base).magnitude == 0
    except (pint.errors.PintError, ValueError, TypeError, AttributeError, ArithmeticError, RecursionError):
        return None
    exponents: dict[str, float] = dict.fromkeys(BASES, 0.0)
    for part, exponent in base._units.items():
        if part not in _PINT_BASES:
            return None
        exponents[_PINT_BASES[part]] += float(exponent)
    if any(part.endswith("hertz") for part in parsed._units):
        exponents["cycle"] += 1
    if not multiplicative or not isinstance(factor, float | int):
        return None
    return Unit(float(factor), tuple(exponents[base] for base in BASES))
