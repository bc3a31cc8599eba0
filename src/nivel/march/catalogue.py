"""Integrators by name: the module and the function, the work vectors, the order. Imports no kernel.

One compiled function serves all orders of a family; it finds the order in counter[ORDER].
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class IntegratorFacts:
    """`function` of `module` is the compiled step; `stages` vectors and `numbers` of work and history; `order` of convergence.

    chooses_steps : controls its error; either : does so on request, and tells slow errors from vibrations (`nivel.march.error_filter`).
    implicit : iterates a corrector, by Newton's method on request. residual : needs the equations of motion as a residual, with exact
    tangents, and iterates by Newton's method alone; it solves them for accelerations and multipliers, or with `rates` for the rates of the
    state; shifted : it also solves systems with complex shares of a step. whole : module of its residual, one over a whole step in absolute
    coordinates; empty: that at a time; whole_flexible : the same for machines with flexible bodies. jumps : it ends its steps where speeds
    of drivers jump, and lets them.
    """

    module: str
    function: str
    stages: int
    order: int
    numbers: int = 0
    chooses_steps: bool = False
    implicit: bool = False
    residual: bool = False
    either: bool = False
    rates: bool = False
    shifted: bool = False
    whole: str = ""
    whole_flexible: str = ""
    jumps: bool = False

    def over_step(self, flexible: bool) -> str:
        """Module of its residual over a whole step for machines with or without flexible bodies; empty: none."""
        return self.whole_flexible if flexible else self.whole

    @property
    def accelerations(self) -> bool:
        """Whether it solves the residual at the end of a step for accelerations and multipliers."""
        return self.residual and not self.rates and not self.whole

    @property
    def along(self) -> bool:
        """Whether it asks for derivatives along directions, see `nivel.kernels.shifted`: all of them have to be on complex numbers."""
        return self.rates and not self.shifted


_ADAMS, _MOULTON, _GEAR = "nivel.march.adams", "nivel.march.moulton", "nivel.march.gear"
# the rows and numbers of `nivel.march.workspace`
_ROWS, _NUMBERS = 17, 3

INTEGRATORS: dict[str, IntegratorFacts] = {
    "euler": IntegratorFacts("nivel.march.runge_kutta", "step", 4, 1),
    "heun": IntegratorFacts("nivel.march.runge_kutta", "step", 4, 2),
    "rk4": IntegratorFacts("nivel.march.runge_kutta", "step", 4, 4),
    "rkn4": IntegratorFacts("nivel.march.nystrom", "rkn4", 5, 4),
    **{f"ab{k}": IntegratorFacts(_ADAMS, "bashforth", _ROWS, k, _NUMBERS) for k in range(1, 6)},
    **{f"am{k}": IntegratorFacts(_MOULTON, "moulton", _ROWS, k, _NUMBERS, implicit=True) for k in range(1, 6)},
    **{f"abm{k}": IntegratorFacts(_ADAMS, "predict_correct", _ROWS, k, _NUMBERS) for k in range(1, 6)},
    **{f"gear{k}": IntegratorFacts(_GEAR, "gear", _ROWS, k, _NUMBERS, implicit=True) for k in range(1, 5)},
    "dopri5": IntegratorFacts("nivel.march.dormand_prince", "dopri5", 7, 5, numbers=2, chooses_steps=True),
    "dop853": IntegratorFacts("nivel.march.dop853", "dop853", 16, 8, numbers=2, chooses_steps=True),
    "adams": IntegratorFacts("nivel.march.variable_adams", "adams", 32, 12, 66, chooses_steps=True, implicit=True),
    **{
        name: IntegratorFacts(
            "nivel.march.alpha", "alpha", 12, 2, 14, implicit=True, residual=True, either=True, jumps=True
        )
        for name in ("newmark", "hht", "generalised-alpha")
    },
    "energy-momentum": IntegratorFacts(
        "nivel.march.energy_momentum",
        "energy_momentum",
        0,
        2,
        implicit=True,
        residual=True,
        whole="nivel.motion.energy_momentum_residual",
        whole_flexible="nivel.motion.floating_energy_momentum_residual",
    ),
    "gear": IntegratorFacts("nivel.march.variable_gear", "gear", 32, 5, 66, chooses_steps=True, implicit=True),
    "bdf": IntegratorFacts(
        "nivel.march.variable_bdf",
        "bdf",
        32,
        5,
        66,
        chooses_steps=True,
        implicit=True,
        residual=True,
        rates=True,
    ),
    "ros2": IntegratorFacts("nivel.march.rosenbrock", "ros2", 2, 2, residual=True, rates=True),
    "radau": IntegratorFacts(
        "nivel.march.radau", "radau", 14, 5, 11, chooses_steps=True, residual=True, rates=True, shifted=True
    ),
}


# in place of those of the same name for machines whose only stiffness is that of modes, in relative coordinates: without tangents
BY_MODES: dict[str, IntegratorFacts] = {"ros2": IntegratorFacts("nivel.march.modal_rosenbrock", "ros2", 2, 2)}


def chooses(integrator: str, step_control: str) -> bool:
    """Whether the integrator controls its error in a run with this `step_control`; one that is not known does not."""
    facts = INTEGRATORS.get(integrator)
    return facts is not None and (facts.chooses_steps or (facts.either and step_control == "error"))
