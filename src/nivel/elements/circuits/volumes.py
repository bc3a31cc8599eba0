"""Pressures of the nodes of a circuit: volumes, given pressures, and pressures that are signals.

The state of a volume is the mass m of its fluid; its pressure is the root of m v(p)/ρ₀ = V + V_e(p). V is what pistons leave open and a
constant part, V_e what elastic walls, (p - pa) C or a curve, and the gas of an accumulator make room for. Energy stored:

    E = m h - (p - pa) (V + V_e) + ∫ (p - pa) dV_e

The gas of an accumulator fills V₀ at its precharge p₀, and above it follows p (V₀ - V_oil)ⁿ = p₀ V₀ⁿ. Below, it presses up to half of the
oil out of the dead volume V_d and then rests on its inlet; R is a ramp of the width w:

    V_oil = V₀ (R(y + w) - w/2), y = 1 - (p₀/p)^(1/n), w = min(2 %, V_d/V₀)        V_oil = V₀ y for p ≥ p₀
    ∫ p dV_oil = p₀ V₀ ((1 - y)^(1 - n) - 1)/(n - 1), or -p₀ V₀ ln(1 - y) for n = 1, from p₀ on

Nitrogen follows an adiabat of its own equation there. Outside of runs, masses follow from pressures.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from nivel.elements.circuits.density import DENSITY, EXACT, MOST, density_and_modulus, specific_volume
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.elements.circuits.kind import Phase, called
from nivel.elements.circuits.nitrogen import KILO, R, gas_state, newton_step, on_adiabat
from nivel.elements.circuits.smooth import ramp, step
from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import NO_VOLUME, OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.native.function import leaf, stage

# columns of `columns`; STATE: of the mass, or of the pressure of a signal; FUNCTION: of a given pressure; output: pressure
OUTPUT, NODE, KIND, STATE, FUNCTION = 0, 1, 2, 3, 4
VOLUME, GIVEN, SIGNAL = 0, 1, 2
# columns of `Circuit.room`: constant volume [m³], room that elastic walls make [m³/Pa]; gas of an accumulator: volume [m³], precharge [Pa],
# exponent
FIXED, COMPLIANCE, GAS, PRECHARGE, EXPONENT = 0, 1, 2, 3, 4
# and of a hose with a curve the number of its points, then MOST_POINTS pairs: pressure [Pa], room that it makes [m³] from pa on
POINTS, FIRST_POINT, MOST_POINTS = 5, 6, 6
# and of nitrogen (`nivel.elements.circuits.nitrogen`) its density ρ₀ [kmol/m³] at the precharge, 0 of other gas; θ of its adiabat [K]; the
# density and temperature last found
NITROGEN, THETA, LAST_DENSITY, LAST_TEMPERATURE = 18, 19, 20, 21
# columns of `Circuit.known`: mass [kg] and volume [m³] without V_e, pressure, v and its derivative, ρ₀ h, V_e and its derivative
MASS, OPEN, PRESSURE, VALUE, RATE, ENERGY, EXTRA, GIVE = 0, 1, 2, 3, 4, 5, 6, 7
# Gas comes to rest on its inlet within this share of its volume, or that of the dead volume where it is less.
GAS_WIDTH = 0.02
# points and weights of Gauss's rule on [0, 1], for the energy within that width
NODES = (0.5 - 0.5 * np.sqrt(0.6), 0.5, 0.5 + 0.5 * np.sqrt(0.6))
WEIGHTS = (5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0)


@leaf
def rest_width(n):
    """w: share of the volume of the gas within which it comes to rest on its inlet."""
    return min(GAS_WIDTH, n[FIXED] / n[GAS])


@leaf
def hose_room(n, p):
    """(V [m³], dV/dp, ∫ (p - pa) dV [J]) of the curve of a hose: straight lines from none at pa through its points, and on beyond."""
    pressure, volume, stored, slope = ATMOSPHERE, 0.0, 0.0, 0.0
    for k in range(int(n[POINTS])):
        end, grown = n[FIRST_POINT + 2 * k], n[FIRST_POINT + 2 * k + 1]
        slope = (grown - volume) / (end - pressure)
        if p <= end or k + 1 == int(n[POINTS]):
            break
        stored += 0.5 * slope * ((end - ATMOSPHERE) ** 2 - (pressure - ATMOSPHERE) ** 2)
        pressure, volume = end, grown
    stored += 0.5 * slope * ((p - ATMOSPHERE) ** 2 - (pressure - ATMOSPHERE) ** 2)
    return volume + slope * (p - pressure), slope, stored


@leaf
def nitrogen_left(n, p):
    """(V/V₀ of the gas, -d(V/V₀)/dp, u - u(ρ₀, θ) [J/kmol]) of nitrogen on its adiabat at the real pressure p."""
    _, _, _, entropy, _, energy = gas_state(n[NITROGEN], n[THETA])
    rho, T = on_adiabat(real(p), real(entropy), real(n[LAST_DENSITY]), real(n[LAST_TEMPERATURE]))
    n[LAST_DENSITY], n[LAST_TEMPERATURE] = rho, T
    rho, T = newton_step(p, entropy, rho, T)
    _, by_density, by_heat, _, heat, pressed = gas_state(rho, T)
    isentropic = by_density + by_heat * by_heat * T / (rho * rho * heat)
    return n[NITROGEN] / rho, n[NITROGEN] / (rho * rho * isentropic), pressed - energy


@leaf
def room(n, p):
    """(V_e [m³], dV_e/dp) at the real pressure p."""
    volume, slope = n[COMPLIANCE] * (p - ATMOSPHERE), n[COMPLIANCE]
    if n[POINTS] > 0.0:
        grown, more, _ = hose_room(n, p)
        volume += grown
        slope += more
    if n[GAS] > 0.0:
        left, width = (n[PRECHARGE] / p) ** (1.0 / n[EXPONENT]), rest_width(n)
        if p >= n[PRECHARGE] and n[NITROGEN] > 0.0:
            left, falling, _ = nitrogen_left(n, p)
            volume += n[GAS] * (1.0 - left)
            slope += n[GAS] * falling
        elif p >= n[PRECHARGE]:
            volume += n[GAS] * (1.0 - left)
            slope += n[GAS] * left / (n[EXPONENT] * p)
        else:
            volume += n[GAS] * (ramp(1.0 - left + width, width) - 0.5 * width)
            slope += n[GAS] * step((1.0 - left) / width + 1.0) * left / (n[EXPONENT] * p)
    return volume, slope


@leaf
def energy_of_room(n, p):
    """∫ (p - pa) dV_e [J]: of walls from atmospheric pressure to p, of gas from its precharge."""
    stored = 0.5 * n[COMPLIANCE] * (p - ATMOSPHERE) ** 2
    if n[POINTS] > 0.0:
        stored += hose_room(n, p)[2]
    if n[GAS] > 0.0:
        pressed = np.log(p / n[PRECHARGE]) / n[EXPONENT]  # -ln(1 - y)
        if p >= n[PRECHARGE] and n[NITROGEN] > 0.0:
            left, _, pressed = nitrogen_left(n, p)
            stored += n[GAS] * (n[NITROGEN] * pressed + ATMOSPHERE * (left - 1.0))
        elif p >= n[PRECHARGE]:
            over = n[EXPONENT] - 1.0
            work = np.expm1(over * pressed) / over if over != 0.0 else pressed
            stored += n[GAS] * (n[PRECHARGE] * work + ATMOSPHERE * np.expm1(-pressed))
        else:
            width = rest_width(n)
            y = max(-np.expm1(-pressed), -width)
            for k in range(3):
                x = y * NODES[k]
                over = n[PRECHARGE] * (1.0 - x) ** (-n[EXPONENT]) - ATMOSPHERE
                stored += y * WEIGHTS[k] * n[GAS] * step(x / width + 1.0) * over
    return stored


@leaf
def pressure_in(f, n, mass, volume, guess):
    """The pressure p > 0 with mass v(p)/ρ₀ = volume + V_e(p), real numbers; the left side falls and the right side rises with p."""
    low, high = 0.0, np.inf
    p = guess if guess > 0.0 else ATMOSPHERE
    for _ in range(MOST):
        v, slope, _ = specific_volume(f, p)
        extra, give = room(n, p)
        excess = mass * v / f[DENSITY] - volume - extra
        if excess > 0.0:
            low = p
        else:
            high = p
        following = p - excess / (mass * slope / f[DENSITY] - give)
        if following != p and not low < following < high:
            following = 0.5 * (low + high) if high < np.inf else 2.0 * p
        change, p = np.abs(following - p), following
        if change <= EXACT * p:
            break
    return p


@leaf
def solve_volume(f, n, known, mass, volume):
    """Fill `known` for the real mass and volume, unless it is that of these already. The search starts where the tangent of the last
    solution leads."""
    if known[MASS] == mass and known[OPEN] == volume:
        return
    guess = known[PRESSURE]
    if guess > 0.0:
        v, rate = known[VALUE], known[RATE]
        change = (mass - known[MASS]) * v / f[DENSITY] - (volume - known[OPEN])
        guess = max(guess + change / (known[GIVE] - known[MASS] * rate / f[DENSITY]), 0.1 * guess)
    p = pressure_in(f, n, mass, volume, guess)
    known[MASS], known[OPEN], known[PRESSURE] = mass, volume, p
    known[VALUE], known[RATE], known[ENERGY] = specific_volume(f, p)
    known[EXTRA], known[GIVE] = room(n, p)


@stage
def find_pressure(machine, node, mass):
    """Fill pressure, density and enthalpy of a volume, and add its energy. Returns a status."""
    record = record_at(machine)
    circuit = record.circuit
    f, n, known = circuit.fluid[circuit.node[node, 0]], circuit.room[node], circuit.known[node]
    volume = n[FIXED] + circuit.volume[node]
    if not (real(mass) > 0.0 and real(volume) > 0.0):
        record.control.failure[0] = node
        return NO_VOLUME
    solve_volume(f, n, known, real(mass), real(volume))
    p, v, slope, energy = known[PRESSURE], known[VALUE], known[RATE], known[ENERGY]
    # one step of Newton's method, which on dual numbers gives the exact derivative
    softness = 1.0 / (known[GIVE] - known[MASS] * slope / f[DENSITY])
    change = (mass * (v / f[DENSITY]) - volume - known[EXTRA]) * softness
    circuit.pressure[node] = p + change
    circuit.density[node] = f[DENSITY] / v * (1.0 - slope / v * change)
    circuit.enthalpy[node] = (energy + v * change) / f[DENSITY]
    stored = known[MASS] * (energy - (p - ATMOSPHERE) * v) / f[DENSITY] + energy_of_room(n, p)
    circuit.stored[0] += stored
    record.control.stored[0] += stored
    return OK


@stage
def give_pressure(machine, node, p):
    """Fill pressure, density and enthalpy of a node whose pressure p is known."""
    circuit = record_at(machine).circuit
    f = circuit.fluid[circuit.node[node, 0]]
    v, slope, energy = specific_volume(f, real(p))
    change = p - real(p)
    circuit.pressure[node] = p
    circuit.density[node] = f[DENSITY] / v * (1.0 - slope / v * change)
    circuit.enthalpy[node] = (energy + v * change) / f[DENSITY]


@called(Phase.PRESSURES, 1)
@family
def find_pressures(machine, number, t):
    """The state of every node."""
    record = record_at(machine)
    elements, circuit = record.elements, record.circuit
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        node = index[NODE]
        if index[KIND] == VOLUME:
            status = find_pressure(machine, node, elements.state[index[STATE]])
            if status != OK:
                return status
        elif index[KIND] == GIVEN:
            give_pressure(machine, node, evaluate_function(machine, index[FUNCTION], t))
        else:
            circuit.pressure[node] = elements.state[index[STATE]]
        record.outputs.value[index[OUTPUT]] = circuit.pressure[node]
    return OK


ROOM_COLUMNS = LAST_TEMPERATURE + 1  # columns of `Circuit.room`


def filled_room(room: Sequence[float]) -> list[float]:
    """A row of `Circuit.room` of these numbers, behind which there are none."""
    return [*room, *[0.0] * (ROOM_COLUMNS - len(room))]


_ROOM: Any = getattr(room, "py_func", room)


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
MOST_STEPS, SETTLED = 100, 1e-13


def density_at(p: float, temperature: float) -> float:
    """[kmol/m³] at a pressure [Pa] and a temperature [K]."""
    rho = p / (KILO * R * temperature)
    for _ in range(MOST_STEPS):
        found, slope, *_ = _STATE(rho, temperature)
        change = (p - found) / slope
        rho += max(-0.5 * rho, min(change, rho))
        if abs(change) <= SETTLED * rho:
            break
    return float(rho)


def theta_of(p: float, temperature: float, rho: float) -> float:
    """[K] at the density rho on the adiabat through a pressure and a temperature."""
    entropy, theta = _STATE(density_at(p, temperature), temperature)[3], temperature
    for _ in range(MOST_STEPS):
        found = _STATE(rho, theta)
        change = (entropy - found[3]) * theta / found[4]
        theta += max(-0.3 * theta, min(change, 0.3 * theta))
        if abs(change) <= SETTLED * theta:
            break
    return float(theta)


def room_at(room: Sequence[float], p: float) -> float:
    """[m³] that nitrogen gives way to oil at a pressure of at least that of its precharge's density."""
    rho, temperature = room[LAST_DENSITY], room[LAST_TEMPERATURE]
    entropy = _STATE(room[NITROGEN], room[THETA])[3]
    for _ in range(MOST_STEPS):
        found, by_density, by_heat, known, heat, _ = _STATE(rho, temperature)
        falling, rising = -by_heat / (rho * rho), heat / temperature
        scale = by_density * rising - by_heat * falling
        change = ((p - found) * rising - by_heat * (entropy - known)) / scale
        temperature += (by_density * (entropy - known) - falling * (p - found)) / scale
        rho += change
        if abs(change) <= SETTLED * rho:
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
    row = [dead, 0.0, volume, least, BELOW_PRECHARGE, *[0.0] * (NITROGEN - GAS - 3), rho, theta, begin, temperature]
    assert row[PRECHARGE] == least
    return tuple(row)


BELOW_PRECHARGE = 1.4  # exponent of the gas below its precharge
