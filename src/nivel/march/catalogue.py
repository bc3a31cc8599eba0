"""Integrators by name: the module and the function, the work vectors, the order. Imports no kernel."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class IntegratorFacts:
    """`function` of `module` is the compiled step; `stages` vectors of work; `order` of convergence."""

    module: str
    function: str
    stages: int
    order: int


INTEGRATORS: dict[str, IntegratorFacts] = {
    "rk4": IntegratorFacts("nivel.march.runge_kutta", "rk4", 4, 4),
}
