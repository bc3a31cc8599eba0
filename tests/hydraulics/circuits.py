"""Circuits beside a body at rest, in the words of machine files."""

from __future__ import annotations

from typing import Any

import numpy as np

from simulating import machine

PA = 101325.0
ALPHA, BETA, SLOPE, N, RHO_LIQUID = 0.005, 1.5e9, 10.0, 1.4, 870.0
RHO_0 = (1.0 - ALPHA) * RHO_LIQUID + ALPHA * 1.2
BAR, LITRE_PER_MINUTE = 1e5, 1e-3 / 60.0


def density(p):
    """ρ(p) of the default fluid."""
    liquid = (1.0 + SLOPE * (p - PA) / BETA) ** (-1.0 / SLOPE)
    return RHO_0 / ((1.0 - ALPHA) * liquid + ALPHA * (PA / p) ** (1.0 / N))


def enthalpy(p):
    """h(p) = ∫ dp/ρ of the default fluid."""
    L = 1.0 + SLOPE * (p - PA) / BETA
    liquid = BETA / (SLOPE - 1.0) * (L ** (1.0 - 1.0 / SLOPE) - 1.0)
    air = PA * N / (N - 1.0) * ((p / PA) ** ((N - 1.0) / N) - 1.0)
    return ((1.0 - ALPHA) * liquid + ALPHA * air) / RHO_0


def circuit(hydraulics: dict[str, Any], **more: Any):
    """The machine with a body that nothing moves, and this circuit."""
    block = {"mass": 1.0, "inertia": [1, 1, 1]}
    return machine({"bodies": {"block": block}, "hydraulics": hydraulics, **more})


def between(component: dict[str, Any], **pressures: float) -> dict[str, Any]:
    """The circuit in which the ports of a component are at these pressures [Pa]."""
    tanks = {f"at_{port}": {"type": "tank", "pressure": p} for port, p in pressures.items()}
    return {**tanks, "valve": {**component, "ports": {port: f"at_{port}" for port in pressures}}}


def history(result: Any, name: str) -> np.ndarray:
    """The history of a result variable."""
    return np.ravel(np.asarray(result.array(name), dtype=float))


def steady(hydraulics: dict[str, Any], *names: str, **settings: Any) -> list[float]:
    """What these outputs of the circuit are at the end of a short run."""
    result = circuit(hydraulics).simulate(**{"duration": 1e-3, "step": 1e-3, "integrator": "rk4", **settings})
    return [float(history(result, f"hydraulics.{name}")[-1]) for name in names]
