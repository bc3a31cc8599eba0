"""Facts of an integrator, which stand beside its step as `FACTS`, a tuple with one for each word that the step has.

Machine code does not depend on this module (`nivel.native.sources`).
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Literal

from nivel.lazy import Struct
from nivel.methods import CHOSEN, EITHER
from nivel.native.entry import Entry

Kind = Literal["explicit", "implicit", "corrector"]
Needs = Literal["evaluations", "accelerations", "directions", "complex shifts", "whole steps", "circuits"]
Ends = Literal["anywhere", "corners", "jumps"]
Machines = Literal["all", "modes", "circuits", "flexible circuits"]


class IntegratorFacts(Struct):
    """An integrator of the word `name`, of which `step` is the compiled function. Who chooses its steps is said with the word, in
    `nivel.methods`.

    order : of convergence. stages, numbers : vectors of the length of the state, and numbers, for work and history.

    kind : explicit; implicit, with equations that it solves by itself; or with a corrector, which iterates as the settings say.

    needs : what it takes of the equations of motion.
        evaluations : ẏ = f(t, y) alone
        accelerations : the residual with exact tangents, solved for accelerations and multipliers at the end of a step
        directions : the same for the rates of the state, by derivatives along directions (`nivel.kernels.residual.shifted_along`)
        complex shifts : the same with complex shares of a step (`nivel.kernels.residual.shifted_matrix`)
        whole steps : residuals over a step in absolute coordinates, of the module `over_step`
        circuits : evaluations, and derivatives of circuits by hand

    ends : where steps end by themselves (`nivel.integrate.loop.corners`): at corners of functions of time; or there and at jumps of speeds
    of drivers, which no other method lets happen.

    multistep : rates or states of earlier steps are in its formula.

    machines : all; or a step in place of that for all, in the same folder, for machines in relative coordinates whose only stiffness is
    that of modes, of circuits, or of circuits and modes.

    held : the largest |rate| times step on the negative real axis with which an explicit method is stable.

    guarded : over circuits the difference of two results is guarded, with secants of restrictions in place of their tangents.
    """

    name: str
    step: Entry
    order: int
    stages: int = 0
    numbers: int = 0
    kind: Kind = "explicit"
    needs: Needs = "evaluations"
    ends: Ends = "anywhere"
    multistep: bool = False
    machines: Machines = "all"
    held: float = 1.0
    guarded: bool = False
    over_step: str = ""

    def __reduce__(self) -> tuple[Callable[[str, str, Machines], IntegratorFacts], tuple[str, str, Machines]]:
        """Another process finds them beside the step: a compiled function does not travel."""
        return _beside_the_step, (self.module, self.name, self.machines)

    @property
    def module(self) -> str:
        """The module of its step."""
        return self.step.name.partition(":")[0]

    @property
    def chooses_steps(self) -> bool:
        """Whether it always controls its error."""
        return self.name in CHOSEN

    @property
    def optional_control(self) -> bool:
        """Whether it controls its error on request, and tells slow errors from vibrations (`nivel.integrate.newmark.alpha_step`)."""
        return self.name in EITHER

    @property
    def residual(self) -> bool:
        """Whether it needs the equations of motion as a residual, with exact tangents."""
        return self.needs not in ("evaluations", "circuits")

    @property
    def first_order(self) -> bool:
        """Whether it solves the residual for the rates of the state."""
        return self.needs in ("directions", "complex shifts")

    @property
    def knows_corners(self) -> bool:
        """Whether it ends its steps itself where functions of time have corners."""
        return self.ends != "anywhere"


def _beside_the_step(module: str, name: str, machines: Machines) -> IntegratorFacts:
    found: tuple[IntegratorFacts, ...] = import_module(module).FACTS
    return next(facts for facts in found if (facts.name, facts.machines) == (name, machines))
