"""Laws that several blocks are made of. What is not a number stays none in all of them."""

from __future__ import annotations

from nivel.machine.units.formula import Formula, formula


def limited(value: str, limits: tuple[float, float]) -> Formula:
    """The value, at least the lower and at most the upper limit."""
    return formula("min(max(value, lower), upper)", value=value, lower=limits[0], upper=limits[1])


def beyond(value: str, band: tuple[float, float]) -> Formula:
    """How far the value is outside of a band; zero inside."""
    return formula("value - min(max(value, lower), upper)", value=value, lower=band[0], upper=band[1])


def bounded_rate(rate: str, value: str, limits: tuple[float, float]) -> Formula:
    """The rate, or zero where it would lead a value at a limit beyond it."""
    text = "if(value >= upper and rate > 0 or value <= lower and rate < 0, 0, rate)"
    return formula(text, rate=rate, value=value, lower=limits[0], upper=limits[1])
