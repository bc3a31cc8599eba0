"""Nitrogen by the equation of Benedict, Webb and Rubin (1940), with the constants of Cooper and Goldfrank (1967), as Otis and Pourmovahed
(1985) have it for accumulators:

    p = ρ R T + (B₀ R T - A₀ - C₀/T²) ρ² + (b R T - a) ρ³ + a α ρ⁶ + c ρ³/T² (1 + γ ρ²) exp(-γ ρ²)

Entropy, energy and c_v follow from it, with that of an ideal diatomic gas at no density. Within 1 % of the reference equation of Span et
al. (2000) in pressure up to 300 bar, within 2.5 % up to 600 bar, from -20 to 130 °C. An adiabat is named by the temperature θ that the gas
has on it at the density ρ₀ of its precharge.
"""

import numpy as np

from nivel.native.function import leaf, part

# kPa, m³/kmol, K
R, A, B, C = 8.314, 106.73, 0.04074, 8.164e5
SMALL_A, SMALL_B, SMALL_C, ALPHA, GAMMA = 2.54, 0.002328, 7.379e4, 1.272e-4, 0.0053
HEAT = 2.5 * R  # c_v [kJ/(kmol K)] at no density
KILO = 1e3
MOST, EXACT = 60, 1e-13


@part
def gas_state(rho, T):
    """(p [Pa], ∂p/∂ρ, ∂p/∂T, s [J/(kmol K)], c_v [J/(kmol K)], u [J/kmol]) at a density [kmol/m³] and a temperature [K]."""
    x = GAMMA * rho * rho
    decay, cold, cube = np.exp(-x), 1.0 / (T * T), rho * rho * rho
    second = B * R * T - A - C * cold
    p = rho * R * T + second * rho * rho + (SMALL_B * R * T - SMALL_A) * cube + SMALL_A * ALPHA * cube * cube
    p += SMALL_C * cold * cube * (1.0 + x) * decay
    by_density = R * T + 2.0 * second * rho + 3.0 * (SMALL_B * R * T - SMALL_A) * rho * rho
    by_density += 6.0 * SMALL_A * ALPHA * cube * rho * rho + SMALL_C * cold * rho * rho * decay * (
        3.0 + 3.0 * x - 2.0 * x * x
    )
    by_heat = rho * R + (B * R + 2.0 * C * cold / T) * rho * rho + SMALL_B * R * cube
    by_heat -= 2.0 * SMALL_C * cold / T * cube * (1.0 + x) * decay
    part = (1.0 - (1.0 + 0.5 * x) * decay) / GAMMA  # ∫ ρ (1 + γ ρ²) exp(-γ ρ²) dρ
    s = HEAT * np.log(T) - R * np.log(rho) - (B * R + 2.0 * C * cold / T) * rho - 0.5 * SMALL_B * R * rho * rho
    s += 2.0 * SMALL_C * cold / T * part
    heat = HEAT + 6.0 * cold / T * (C * rho - SMALL_C * part)
    u = HEAT * T - (A + 3.0 * C * cold) * rho - 0.5 * SMALL_A * rho * rho + 0.2 * SMALL_A * ALPHA * cube * rho * rho
    u += 3.0 * SMALL_C * cold * part
    return KILO * p, KILO * by_density, KILO * by_heat, KILO * s, KILO * heat, KILO * u


@leaf
def newton_step(p, s, rho, T):
    """(ρ, T), nearer to where pressure and entropy are p and s; exact derivatives on dual p and s where ρ and T are exact."""
    found, by_density, by_heat, entropy, heat, _ = gas_state(rho, T)
    falling, rising = -by_heat / (rho * rho), heat / T  # of s with ρ and T
    scale = by_density * rising - by_heat * falling
    lacking, missing = p - found, s - entropy
    return rho + (lacking * rising - by_heat * missing) / scale, T + (by_density * missing - falling * lacking) / scale


@leaf
def on_adiabat(p, s, rho, T):
    """(ρ, T) at a real pressure and entropy, from a guess."""
    for _ in range(MOST):
        following, warmth = newton_step(p, s, rho, T)
        following = min(max(following, 0.5 * rho), 1.5 * rho)
        warmth = min(max(warmth, 0.7 * T), 1.4 * T)
        change = np.abs(following - rho) + rho * np.abs(warmth - T) / T
        rho, T = following, warmth
        if change <= EXACT * rho:
            break
    return rho, T
