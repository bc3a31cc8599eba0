"""Units and their values in SI. Common units stand in a table; pint, slow to load, is asked only about the others."""

import math
from difflib import get_close_matches
from functools import cache
from typing import Any, Final, NamedTuple

from nivel.lazy import pint

# Physical dimensions: what a unit measures, so that a mass cannot be given in metres.
#
# A dimension is a tuple of exponents over BASES. Angles (rad) and turns (cycle, the unit Hz counts them) are kept as
# bases of their own although SI calls them pure numbers: `30 deg` must not pass for a length, nor `3 Hz` for an angular
# velocity of 3 rad/s. A quantity without a dimension (`None`) is a bare number: it takes the SI unit of whatever field
# it stands in.

BASES: Final = ("kg", "m", "s", "rad", "cycle", "A", "K", "mol", "cd")
_RAD, _CYCLE = BASES.index("rad"), BASES.index("cycle")

Dimension = tuple[float, ...]
NONE: Final[Dimension] = (0.0,) * len(BASES)


def dimension(**exponents: float) -> Dimension:
    """``dimension(kg=1, m=-3)`` is that of a density."""
    return tuple(float(exponents.get(base, 0.0)) for base in BASES)


def product(first: Dimension | None, second: Dimension | None) -> Dimension | None:
    """Dimension of a product; a bare number leaves the other factor's as it is."""
    if first is None or second is None:
        return first if second is None else second
    return known(tuple(a + b for a, b in zip(first, second, strict=True)))


def power(base: Dimension | None, exponent: float) -> Dimension | None:
    """Dimension of base ** exponent."""
    return None if base is None else known(tuple(a * exponent for a in base))


def known(exponents: Dimension) -> Dimension | None:
    """A ratio of equal units is a bare number."""
    return None if exponents == NONE else exponents


def without_angle(exponents: Dimension | None) -> Dimension:
    """The SI view, in which radians and turns are pure numbers."""
    if exponents is None:
        return NONE
    return tuple(0.0 if i in (_RAD, _CYCLE) else value for i, value in enumerate(exponents))


def is_angular(exponents: Dimension) -> bool:
    return exponents[_RAD] != 0


def counts_turns(exponents: Dimension | None) -> bool:
    return exponents is not None and exponents[_CYCLE] != 0


def symbol(exponents: Dimension) -> str:
    """The SI unit in writing: ``kg*m^2/s^2``, ``1/s``."""
    above = [powered(base, e) for base, e in zip(BASES, exponents, strict=True) if e > 0]
    below = [powered(base, -e) for base, e in zip(BASES, exponents, strict=True) if e < 0]
    text = "*".join(above) or "1"
    if not below:
        return text
    return f"{text}/{below[0]}" if len(below) == 1 else f"{text}/({'*'.join(below)})"


def powered(base: str, exponent: float) -> str:
    """The text of a power of a unit."""
    return base if exponent == 1 else f"{base}^{exponent:g}"


# What the fields of a machine measure: name with article, SI unit as people write it, dimension.
KINDS: Final[dict[str, tuple[str, str, Dimension]]] = {
    "number": ("a number", "1", NONE),
    "length": ("a length", "m", dimension(m=1)),
    "mass": ("a mass", "kg", dimension(kg=1)),
    "time": ("a time", "s", dimension(s=1)),
    "angle": ("an angle", "rad", dimension(rad=1)),
    "velocity": ("a velocity", "m/s", dimension(m=1, s=-1)),
    "angular velocity": ("an angular velocity", "rad/s", dimension(rad=1, s=-1)),
    "rate": ("a rate", "1/s", dimension(s=-1)),
    "frequency": ("a frequency", "Hz", dimension(cycle=1, s=-1)),
    "angular acceleration": ("an angular acceleration", "rad/s^2", dimension(rad=1, s=-2)),
    "acceleration": ("an acceleration", "m/s^2", dimension(m=1, s=-2)),
    "density": ("a density", "kg/m^3", dimension(kg=1, m=-3)),
    "inertia": ("a moment of inertia", "kg*m^2", dimension(kg=1, m=2)),
    "force": ("a force", "N", dimension(kg=1, m=1, s=-2)),
    "torque": ("a torque", "N*m", dimension(kg=1, m=2, s=-2)),
    "area": ("an area", "m^2", dimension(m=2)),
    "volume": ("a volume", "m^3", dimension(m=3)),
    "second moment of area": ("a second moment of area", "m^4", dimension(m=4)),
    "pressure": ("a pressure", "Pa", dimension(kg=1, m=-1, s=-2)),
    "volume flow": ("a volume flow", "m^3/s", dimension(m=3, s=-1)),
    "temperature": ("a temperature", "K", dimension(K=1)),
    "thermal conductance": ("a thermal conductance", "W/K", dimension(kg=1, m=2, s=-3, K=-1)),
    "heat capacity": ("a heat capacity per mass", "J/(kg*K)", dimension(m=2, s=-2, K=-1)),
    "thermal expansion": ("a thermal expansion", "1/K", dimension(K=-1)),
    "heat transfer coefficient": ("a heat transfer coefficient", "W/(m^2*K)", dimension(kg=1, s=-3, K=-1)),
    "displacement": ("a volume per angle", "m^3/rad", dimension(m=3, rad=-1)),
    "leakage": ("a leakage", "m^3/(s*Pa)", dimension(m=4, s=1, kg=-1)),
    "kinematic viscosity": ("a kinematic viscosity", "m^2/s", dimension(m=2, s=-1)),
    "power": ("a power", "W", dimension(kg=1, m=2, s=-3)),
    "stiffness": ("a stiffness", "N/m", dimension(kg=1, s=-2)),
    "foundation modulus": ("a foundation modulus", "N/m^3", dimension(kg=1, m=-2, s=-2)),
    "damping": ("a damping coefficient", "N*s/m", dimension(kg=1, s=-1)),
    "torsional stiffness": ("a torsional stiffness", "N*m/rad", dimension(kg=1, m=2, s=-2, rad=-1)),
    "torsional damping": ("a torsional damping coefficient", "N*m*s/rad", dimension(kg=1, m=2, s=-1, rad=-1)),
    "force per angle": ("a force per angle", "N/rad", dimension(kg=1, m=1, s=-2, rad=-1)),
    "force per angular velocity": ("a force per angular velocity", "N*s/rad", dimension(kg=1, m=1, s=-1, rad=-1)),
    "impulse": ("an impulse", "N*s", dimension(kg=1, m=1, s=-1)),
    "stiffness per load": ("a stiffness per load", "1/m", dimension(m=-1)),
    "mass per length": ("a mass per length", "kg/m", dimension(kg=1, m=-1)),
    "inertia per length": ("a moment of inertia per length", "kg*m", dimension(kg=1, m=1)),
    "bending stiffness": ("a bending stiffness", "N*m^2", dimension(kg=1, m=3, s=-2)),
    "voltage": ("a voltage", "V", dimension(kg=1, m=2, s=-3, A=-1)),
    "current": ("a current", "A", dimension(A=1)),
    "resistance": ("a resistance", "ohm", dimension(kg=1, m=2, s=-3, A=-2)),
    "inductance": ("an inductance", "H", dimension(kg=1, m=2, s=-2, A=-2)),
    "charge": ("an electric charge", "A*s", dimension(A=1, s=1)),
    "capacitance": ("a capacitance", "A*s/V", dimension(kg=-1, m=-2, s=4, A=2)),
    "torque per current": ("a torque per current", "N*m/A", dimension(kg=1, m=2, s=-2, A=-1)),
    "turning per length": ("a turning per length", "rad/m", dimension(rad=1, m=-1)),
    "stiffness per time": ("a stiffness per time", "N/(m*s)", dimension(kg=1, s=-3)),
    "torsional stiffness per time": (
        "a torsional stiffness per time",
        "N*m/(rad*s)",
        dimension(kg=1, m=2, s=-3, rad=-1),
    ),
    "damping per load": ("a damping per load", "s/m", dimension(m=-1, s=1)),
}


def described(exponents: Dimension | None) -> str:
    """``a mass (kg)``, or only the unit where the dimension has no common name."""
    if exponents is None:
        return "a pure number"
    for article, unit, its in KINDS.values():
        if its == exponents:
            return f"{article} ({unit})"
    return f"a quantity in {symbol(exponents)}"


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
