"""Settings that were asked for and would have no effect, each with the reason.

A machine file may hold settings of several methods: those of its other methods rest. What is given for one run is meant for it.
"""

from __future__ import annotations

from collections.abc import Collection

from nivel.errors import Fault
from nivel.integrate.catalogue import INTEGRATORS, chooses
from nivel.machine.settings import SimulationSettings
from nivel.motion.catalogue import FORMULATIONS

# settings that hold constants of one integrator each
CONSTANTS = {"newmark": "newmark", "hht": "hht", "generalised_alpha": "generalised-alpha"}


def unused_settings(given: Collection[str], settings: SimulationSettings, coordinates: str) -> list[Fault]:
    """Faults for those of the settings `given` that the methods of `settings` have no use for.

    coordinates : of the run, `auto` resolved. Methods that are not known are left to others.
    """
    return [
        Fault("", 0, 0, f"simulation.{name}", f"`{name}` has no effect here: {reason}")
        for name in given
        if (reason := _unused(name, settings, coordinates))
    ]


def _unused(name: str, settings: SimulationSettings, coordinates: str) -> str:
    """Why the setting `name` has no effect; empty where it has one."""
    integrator, formulation = INTEGRATORS.get(settings.integrator), FORMULATIONS.get(settings.formulation)
    if name in ("tolerance", "largest_step") and integrator and not chooses(settings.integrator, settings.step_control):
        fitting = [each for each, facts in INTEGRATORS.items() if facts.chooses_steps]
        more = "; `step_control: error` lets it choose its steps" if integrator.optional_control else ""
        return f"the step of `integrator: {settings.integrator}` is fixed; {_choice('it', fitting)}{more}"
    if name == "corrector" and integrator and not integrator.implicit:
        fitting = [each for each, facts in INTEGRATORS.items() if facts.implicit]
        return f"`integrator: {settings.integrator}` solves no equations; {_choice('it', fitting)}"
    if name in CONSTANTS and settings.integrator != CONSTANTS[name]:
        return f"it is for `integrator: {CONSTANTS[name]}`, and this run has `integrator: {settings.integrator}`"
    if name == "penalty" and formulation and formulation.factor == 0.0:
        fitting = [each for each, facts in FORMULATIONS.items() if facts.factor > 0.0]
        return f"`formulation: {settings.formulation}` has multipliers of its own; {_choice('it', fitting)}"
    if name == "cut" and settings.cut and coordinates != "relative":
        return f"all joints stay constraints in {coordinates} coordinates; it is for `coordinates: relative`"
    return ""


def _choice(what: str, fitting: list[str]) -> str:
    return f"{what} is for {', '.join(fitting)}" if fitting else f"nothing uses {what}"
