"""Integrators by name: the module and the function, the work vectors, the order. Imports no kernel.

One compiled function serves all orders of a family; it finds the order in counter[ORDER].
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class IntegratorFacts:
    """`function` of `module` is the compiled step; `stages` vectors and `numbers` of work and history; `order` of convergence.

    chooses_steps : controls its error; optional_control : does so on request, and tells slow errors from vibrations
    (`nivel.integrate.newmark.alpha_error`). implicit : iterates a corrector, by Newton's method on request. residual : needs the
    equations of
    motion as a residual, with exact tangents, and iterates by Newton's method alone; it solves them for accelerations and multipliers, or
    with `first_order` for the rates of the state; complex_shift : it also solves systems with complex shares of a step. step_residual :
    module of its residual, one over a whole step in absolute coordinates; empty: that at a time; step_residual_flexible : the same for
    machines with flexible bodies. velocity_jumps : it ends its steps where speeds of drivers jump, and lets them.
    circuit_tangent : it takes the derivatives of circuits by hand.
    """

    module: str
    function: str
    stages: int
    order: int
    numbers: int = 0
    chooses_steps: bool = False
    implicit: bool = False
    residual: bool = False
    optional_control: bool = False
    first_order: bool = False
    complex_shift: bool = False
    step_residual: str = ""
    step_residual_flexible: str = ""
    velocity_jumps: bool = False
    circuit_tangent: bool = False

    def over_step(self, flexible: bool) -> str:
        """Module of its residual over a whole step for machines with or without flexible bodies; empty: none."""
        return self.step_residual_flexible if flexible else self.step_residual

    @property
    def knows_corners(self) -> bool:
        """Whether it ends its steps itself where functions of time have corners: by `nivel.integrate.loop.corners`."""
        return self.velocity_jumps or self.complex_shift

    @property
    def multistep(self) -> bool:
        """Whether it has a fixed order and needs other steps to begin with."""
        return self.module.startswith("nivel.integrate.multistep.")

    @property
    def accelerations(self) -> bool:
        """Whether it solves the residual at the end of a step for accelerations and multipliers."""
        return self.residual and not self.first_order and not self.step_residual

    @property
    def directional_tangent(self) -> bool:
        """Whether it asks for derivatives along directions, all of them on complex numbers: see `nivel.kernels.residual.shifted_along`."""
        return self.first_order and not self.complex_shift


_ADAMS, _MOULTON, _GEAR = (
    "nivel.integrate.multistep.adams",
    "nivel.integrate.multistep.moulton",
    "nivel.integrate.multistep.gear",
)
# the rows and numbers of `nivel.integrate.loop.workspace`
_ROWS, _NUMBERS = 17, 3

INTEGRATORS: dict[str, IntegratorFacts] = {
    "euler": IntegratorFacts("nivel.integrate.explicit.runge_kutta", "step", 4, 1),
    "heun": IntegratorFacts("nivel.integrate.explicit.runge_kutta", "step", 4, 2),
    "rk4": IntegratorFacts("nivel.integrate.explicit.runge_kutta", "step", 4, 4),
    "rkn4": IntegratorFacts("nivel.integrate.explicit.nystrom", "rkn4", 5, 4),
    **{f"ab{k}": IntegratorFacts(_ADAMS, "bashforth", _ROWS, k, _NUMBERS) for k in range(1, 6)},
    **{f"am{k}": IntegratorFacts(_MOULTON, "moulton", _ROWS, k, _NUMBERS, implicit=True) for k in range(1, 6)},
    **{f"abm{k}": IntegratorFacts(_ADAMS, "predict_correct", _ROWS, k, _NUMBERS) for k in range(1, 6)},
    **{f"gear{k}": IntegratorFacts(_GEAR, "gear", _ROWS, k, _NUMBERS, implicit=True) for k in range(1, 5)},
    "dopri5": IntegratorFacts("nivel.integrate.explicit.dormand_prince", "dopri5", 7, 5, numbers=2, chooses_steps=True),
    "dop853": IntegratorFacts("nivel.integrate.explicit.dop853", "dop853", 16, 8, numbers=2, chooses_steps=True),
    "adams": IntegratorFacts(
        "nivel.integrate.variable_order.variable_adams", "adams", 32, 12, 66, chooses_steps=True, implicit=True
    ),
    **{
        name: IntegratorFacts(
            "nivel.integrate.newmark.alpha",
            "alpha",
            12,
            2,
            14,
            implicit=True,
            residual=True,
            optional_control=True,
            velocity_jumps=True,
        )
        for name in ("newmark", "hht", "generalised-alpha")
    },
    "energy-momentum": IntegratorFacts(
        "nivel.integrate.newmark.energy_momentum",
        "energy_momentum",
        0,
        2,
        implicit=True,
        residual=True,
        step_residual="nivel.motion.energy_momentum_residual",
        step_residual_flexible="nivel.motion.floating_energy_momentum_residual",
    ),
    "gear": IntegratorFacts(
        "nivel.integrate.variable_order.variable_gear", "gear", 32, 5, 66, chooses_steps=True, implicit=True
    ),
    "bdf": IntegratorFacts(
        "nivel.integrate.variable_order.variable_bdf",
        "bdf",
        32,
        5,
        66,
        chooses_steps=True,
        implicit=True,
        residual=True,
        first_order=True,
    ),
    "ros2": IntegratorFacts("nivel.integrate.rosenbrock.rosenbrock", "ros2", 2, 2, residual=True, first_order=True),
    "extrapolated-euler": IntegratorFacts(
        "nivel.integrate.rosenbrock.extrapolated_euler",
        "extrapolated_euler",
        4,
        2,
        residual=True,
        first_order=True,
        complex_shift=True,
    ),
    "radau": IntegratorFacts(
        "nivel.integrate.radau.radau",
        "radau",
        14,
        5,
        11,
        chooses_steps=True,
        residual=True,
        first_order=True,
        complex_shift=True,
    ),
}


# in place of those of the same name for machines whose only stiffness is that of modes, in relative coordinates: without tangents
BY_MODES: dict[str, IntegratorFacts] = {
    "ros2": IntegratorFacts("nivel.integrate.rosenbrock.modal_rosenbrock", "ros2", 2, 2)
}
# the same for machines whose only stiffness is that of circuits, with rigid bodies and with flexible ones: with tangents by hand
BY_CIRCUITS: dict[str, IntegratorFacts] = {
    "extrapolated-euler": IntegratorFacts(
        "nivel.integrate.rosenbrock.circuit_euler", "circuit_euler", 5, 2, implicit=True, circuit_tangent=True
    )
}
BY_FLEXIBLE_CIRCUITS: dict[str, IntegratorFacts] = {
    "extrapolated-euler": IntegratorFacts(
        "nivel.integrate.rosenbrock.flexible_circuit_euler",
        "flexible_circuit_euler",
        5,
        2,
        implicit=True,
        circuit_tangent=True,
    )
}


def chooses(integrator: str, step_control: str) -> bool:
    """Whether the integrator controls its error in a run with this `step_control`; one that is not known does not."""
    facts = INTEGRATORS.get(integrator)
    return facts is not None and (facts.chooses_steps or (facts.optional_control and step_control == "error"))
