"""Integrators by name: the module and the function, the work vectors, the order. Imports no kernel."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class IntegratorFacts:
    """`function` of `module` is the compiled step; `stages` vectors and `numbers` of work and history; `order` of convergence.

    chooses_steps : controls its error. implicit : iterates a corrector, by Newton's method on request.
    """

    module: str
    function: str
    stages: int
    order: int
    numbers: int = 0
    chooses_steps: bool = False
    implicit: bool = False


INTEGRATORS: dict[str, IntegratorFacts] = {
    "rk4": IntegratorFacts("nivel.march.runge_kutta", "rk4", 4, 4),
}
