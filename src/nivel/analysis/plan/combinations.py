"""Combinations of methods that have no meaning, each with its reason."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from math import pi

import numpy as np

from nivel.elements.joints.joint import Joint
from nivel.errors import Fault
from nivel.integrate.catalogue import INTEGRATORS
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SimulationSettings
from nivel.methods import chooses
from nivel.motion.catalogue import FORMULATIONS, PATHS, path_of

Problems = Iterator[tuple[str, str]]  # field of the settings, message


def refuse_combinations(settings: SimulationSettings, coordinates: str) -> list[Fault]:
    """Faults of `settings` with these coordinates (`auto` resolved)."""
    return [Fault.at(f"simulation.{field}", message) for field, message in _problems(settings, coordinates)]


def _problems(settings: SimulationSettings, coordinates: str) -> Problems:
    formulation, stabilisation = settings.formulation, settings.stabilisation
    if settings.rotations != "euler-parameters" and (formulation, coordinates) != ("lagrange", "absolute"):
        message = (
            f"'{settings.rotations}' are rotation coordinates of `formulation: lagrange` with `coordinates: absolute`; "
            f"{formulation} in {coordinates} coordinates has no use for them"
        )
        yield "rotations", message
    if path_of(coordinates, formulation, "euler-parameters") is None:
        known = sorted({c for c, f, _ in PATHS if f == ("lagrange" if formulation == "lagrange" else "newton-euler")})
        message = f"'{coordinates}' does not go with `formulation: {formulation}`, which is for {' or '.join(known)}"
        yield "coordinates", message
    if stabilisation == "baumgarte" and FORMULATIONS[formulation].factor > 0.0:
        message = (
            f"'baumgarte' does not go with `formulation: {formulation}`, which feeds violations back itself: "
            f"set `penalty: {{omega: …, mu: …}}` and take none, direct or geometric"
        )
        yield "stabilisation", message
    if coordinates == "independent":
        yield from _beside_independent(formulation, stabilisation)
    yield from _beside_residual(settings, coordinates)
    yield from _of_step_control(settings)
    yield from _of_matrix(settings)
    yield from _of_chosen_steps(settings)


def _beside_independent(formulation: str, stabilisation: str) -> Problems:
    """What feeds violations of constraints back, in coordinates that have none."""
    left = "the constraints are solved for the dependent coordinates after every step, so there is no violation to feed back"
    if stabilisation == "baumgarte":
        message = f"'baumgarte' does not go with `coordinates: independent`: {left}; take none, direct or geometric"
        yield "stabilisation", message
    if FORMULATIONS[formulation].factor > 0.0:
        yield "formulation", f"'{formulation}' does not go with `coordinates: independent`: {left}; take newton-euler"


def _beside_residual(settings: SimulationSettings, coordinates: str) -> Problems:
    """What does not go with an integrator that needs the equations of motion as a residual, with exact tangents."""
    facts = INTEGRATORS[settings.integrator]
    if not facts.residual:
        return
    name = f"`integrator: {settings.integrator}`"
    if coordinates == "independent" and settings.formulation == "lagrange":
        message = (
            f"'lagrange' in independent coordinates does not go with {name}, which needs a residual: use newton-euler, which has the same "
            f"motion, or an explicit or multistep integrator"
        )
        yield "formulation", message
    if facts.needs == "whole steps":
        yield from _beside_whole_steps(settings, coordinates)
        return
    if (
        settings.stabilisation == "baumgarte"
        and not _gives_coefficients(settings)
        and facts.first_order
        and not facts.chooses_steps
    ):
        message = (
            f"'baumgarte' without coefficients takes α = 1/step and β = √2/step, as fast as a step of {name}, which does not iterate and "
            f"has order one there: take direct, or own coefficients `baumgarte: {{alpha: 20/s, beta: 20/s}}`"
        )
        yield "stabilisation", message
    if facts.kind == "corrector" and settings.corrector.iteration == "functional":
        message = f"'functional' does not go with {name}, which takes Newton's method with exact tangents: leave `iteration` out"
        yield "corrector.iteration", message


def _beside_whole_steps(settings: SimulationSettings, coordinates: str) -> Problems:
    """What does not go with an integrator that balances momenta over a whole step."""
    name = f"`integrator: {settings.integrator}`"
    if FORMULATIONS[settings.formulation].factor > 0.0:
        message = (
            f"'{settings.formulation}' does not go with {name}, whose multipliers solve the position constraints: use newton-euler, "
            f"which gives the same motion"
        )
        yield "formulation", message
    if settings.formulation == "lagrange":
        message = (
            f"'lagrange' does not go with {name}, which balances momenta for angular velocities, not for rates of rotation "
            f"coordinates: use newton-euler, which gives the same motion"
        )
        yield "formulation", message
    if coordinates != "absolute":
        message = f"'{coordinates}' does not go with {name}, which balances the momenta of each body: take absolute"
        yield "coordinates", message
    if settings.stabilisation != "none":
        message = (
            f"'{settings.stabilisation}' does not go with {name}: it solves the position constraints itself, and a change of "
            f"velocities after a step would change the energy that it conserves: write `stabilisation: none`"
        )
        yield "stabilisation", message
    if settings.corrector.iteration == "functional":
        message = f"'functional' does not go with {name}, which takes Newton's method with exact tangents: leave `iteration` out"
        yield "corrector.iteration", message


def _of_matrix(settings: SimulationSettings) -> Problems:
    """Newton's matrix made anew for every iteration, where the method has another use for it, or none."""
    facts = INTEGRATORS[settings.integrator]
    if settings.corrector.matrix != "full" or (facts.residual and not facts.first_order):
        return
    if facts.kind == "explicit":
        return  # no corrector at all
    why = "solves with one exact matrix a step and does not iterate"
    if facts.chooses_steps:
        why = "chooses steps and orders by the cost of its matrix so far"
    elif facts.kind == "corrector":
        why = "computes its matrix by differences, again when the iteration converges slowly"
    message = (
        f"'full' does not go with `integrator: {settings.integrator}`, which {why}: take newmark, hht or generalised-alpha, or leave "
        f"`matrix` out"
    )
    yield "corrector.matrix", message


def _of_step_control(settings: SimulationSettings) -> Problems:
    """Steps that the integrator cannot choose, or cannot but choose."""
    facts, wanted = INTEGRATORS[settings.integrator], settings.step_control
    if wanted == "own" or facts.optional_control or facts.chooses_steps == (wanted == "error"):
        return
    name = f"`integrator: {settings.integrator}`"
    if wanted == "fixed":
        message = f"{name} always chooses its steps: take an integrator of fixed step, e.g. rk4 or generalised-alpha"
    else:
        message = f"{name} has no estimate of its error: take dopri5, or radau for stiff machines"
    yield "step_control", message


def _of_chosen_steps(settings: SimulationSettings) -> Problems:
    """What needs a step of fixed size and gets an integrator that chooses its steps."""
    if not chooses(settings.integrator, settings.step_control):
        return
    reason = f"which depend on the step, and `integrator: {settings.integrator}` chooses its steps"
    if settings.stabilisation == "baumgarte" and not _gives_coefficients(settings):
        message = (
            f"'baumgarte' without coefficients takes α = 1/step and β = √2/step, {reason}: take direct, or own coefficients "
            f"`baumgarte: {{alpha: 20/s, beta: 20/s}}`"
        )
        yield "stabilisation", message
    penalised = FORMULATIONS[settings.formulation].factor > 0.0
    if penalised and settings.stabilisation == "none" and settings.penalty.omega is None:
        message = (
            f"`formulation: {settings.formulation}` without `omega` takes Ω = 0.1/step, {reason}: set `penalty: {{omega: 10/s}}`, "
            f"or take `stabilisation: direct`, which needs no Ω"
        )
        yield "penalty", message


def _gives_coefficients(settings: SimulationSettings) -> bool:
    """Whether the settings have coefficients of Baumgarte's feedback of their own, for all rows."""
    return settings.baumgarte is not None and settings.baumgarte.is_whole


def screws_as_couplings(machine: MachineRecord, names: Collection[str]) -> Iterator[tuple[str, str]]:
    """Name of each of these screw joints that can be written as a coupling, and the lines of the machine file for it."""
    for joint in machine.joints:
        if joint.type == "screw" and joint.name in names:
            line = _coupling(machine, joint)
            if line:
                yield joint.name, line


def _coupling(machine: MachineRecord, screw: Joint) -> str:
    """a·r d + (p/2π) a·v φ = 0 of the screw's axis a, the rail's r and the bearing's v, each of which carries its second body."""
    if screw.bodies is None or screw.axis is None:
        return ""
    for shaft, moved in (screw.bodies, screw.bodies[::-1]):
        bearing, rail = _carrying(machine, shaft, "revolute"), _carrying(machine, moved, "translational")
        if bearing is None or rail is None:
            continue
        a, v, r = (np.array(joint.axis, dtype=float) for joint in (screw, bearing, rail))
        a, v, r = a / np.linalg.norm(a), v / np.linalg.norm(v), r / np.linalg.norm(r)
        sides = [1.0 if joint.bodies[1] == body else -1.0 for joint, body in ((bearing, shaft), (rail, moved))]  # type: ignore[index]
        factor = (screw.pitch or 0.0) / (2.0 * pi) * round(float(a @ v)) * round(float(a @ r)) * sides[0] * sides[1]
        coordinates = f"[{rail.name}.displacement, {bearing.name}.angle]"
        return f"{screw.name}: {{type: linear, coordinates: {coordinates}, factors: [1, {factor:.12g}]}}"
    return ""


def _carrying(machine: MachineRecord, body: str, kind: str) -> Joint | None:
    """The joint of a type on a body, if it is placed by an axis."""
    found = [each for each in machine.joints if each.type == kind and each.axis and body in (each.bodies or ())]
    return found[0] if len(found) == 1 else None
