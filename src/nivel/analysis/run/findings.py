"""Findings after a run beside the balance of energy: loads that its steps have missed, and what a second run tells of its parts."""

from __future__ import annotations

import numpy as np

from nivel.analysis.curves.corners import corners
from nivel.analysis.curves.missed_impulse import unseen_loads
from nivel.analysis.curves.path import steps_of
from nivel.analysis.curves.sampled import between_samples
from nivel.analysis.plan.plan import Plan
from nivel.analysis.preparation.preparation import Prepared
from nivel.analysis.run.dynamics import RunOutcome
from nivel.analysis.run.flexible_facts import modal_bases, modal_bodies
from nivel.analysis.run.second_run import Verified
from nivel.analysis.run.separate_parts import separate_parts
from nivel.analysis.run.singular_passages import passages
from nivel.analysis.trust.checks.beam_mesh import coarsest, meshes, say
from nivel.integrate.loop.run import TURNED
from nivel.machine.bodies.shape import Sphere
from nivel.machine.forces import Contact
from nivel.results.result import Result
from nivel.results.scales import machine_size, speed_of_rest
from nivel.results.trust.accuracy import error_from_finer, extent
from nivel.results.trust.basis import most_coarse, most_lacking
from nivel.results.trust.bending import fastest_unstiffened, most_bent
from nivel.results.trust.estimate import Estimate
from nivel.results.trust.findings import Findings
from nivel.results.trust.missed_impulse import Unseen
from nivel.results.trust.motion import Motion
from nivel.results.trust.part_energy import PartError, worst_part
from nivel.results.trust.passed_contacts import Pair, passed_contacts
from nivel.results.trust.passed_hulls import HullPair, passed_hulls
from nivel.results.trust.second_look import damped, growth, own_error
from nivel.results.trust.steps_seen import largest_turn, rounding
from nivel.system.forces.hulls import hull_of


@np.errstate(over="ignore", invalid="ignore")  # a run that grew beyond all bounds is red, not a warning
def find(
    plan: Plan,
    prepared: Prepared,
    finished: RunOutcome,
    result: Result,
    verified: Verified | None,
    estimate: Estimate | None,
) -> Findings:
    """Everything that was found of a run, whether it came to its end or not."""
    if finished.pace is None or not len(result.time):
        return Findings()
    settings, fixed = plan.settings, plan.settings.steps > 0
    turned, bending = finished.pace[TURNED], modal_bodies(plan)
    bases = modal_bases(plan, prepared)
    coarse = coarsest(result, meshes(plan))
    implicit = prepared.integrator.needs != "evaluations"
    return Findings(
        unseen=_unseen(plan, prepared, finished, result),
        between=tuple(between_samples(plan.machine, float(result.time[-1]))),
        # where steps are chosen no body turns too far
        turn=largest_turn(result, turned, settings.duration, counted=settings.coordinates == "relative")
        if fixed
        else None,
        rounding=rounding(result, int(finished.timing["steps"])),
        own=own_error(result, estimate) if estimate is not None else None,
        damped=damped(result, verified.result) if verified is not None and implicit else None,
        growth=growth(result, verified.result, verified.refinement.left) if verified is not None else None,
        passed=(*passed_contacts(result, _pairs(plan)), *passed_hulls(result, _hulls(plan))),
        passages=tuple(passages(prepared, result)) if verified is not None else (),
        unstiffened=fastest_unstiffened(result, bending),
        bent=most_bent(result, bending),
        lacking=most_lacking(result, bases),
        meshed=most_coarse(result, bases),
        coarse=say(coarse) if coarse is not None else None,
        part=_part(plan, result),
        method=settings.integrator,
        agreed=_agreed(result, verified) if verified is not None else None,
    )


def _agreed(result: Result, verified: Verified) -> float:
    """By what two runs are apart, as a share of the longest path of a body, or of the machine's size where that is more."""
    apart = error_from_finer(result, verified.result, verified.refinement.left).value
    return apart / extent(Motion.of(result), machine_size(result)[0])


def _part(plan: Plan, result: Result) -> PartError | None:
    """The separate part with the worst balance of energy."""
    slowest = speed_of_rest(result, machine_size(result)[0])
    return worst_part(result, separate_parts(plan.machine), slowest)


def _pairs(plan: Plan) -> list[Pair]:
    """The contacts of two spheres."""
    out, bodies = [], {each.name: each for each in plan.machine.bodies}
    for force in plan.machine.forces:
        if isinstance(force, Contact) and force.bodies is not None:
            spheres = [bodies[name].shape for name in force.bodies]
            if not all(isinstance(each, Sphere) for each in spheres):
                continue
            first, second = [np.array(each.centre or (0.0, 0.0, 0.0)) for each in spheres if isinstance(each, Sphere)]
            reach = sum(each.radius for each in spheres if isinstance(each, Sphere))
            out.append(Pair(force.name, force.bodies, (first, second), reach))
    return out


def _hulls(plan: Plan) -> list[HullPair]:
    """The contacts of two convex hulls."""
    out, bodies = [], {each.name: each for each in plan.machine.bodies}
    for force in plan.machine.forces:
        if isinstance(force, Contact) and force.bodies is not None and force.foundation_modulus is not None:
            first, second = (hull_of(bodies[name]) for name in force.bodies)
            middles, corners = (first.middle, second.middle), (first.corners, second.corners)
            out.append(HullPair(force.name, force.bodies, middles, corners, (first.faces, second.faces)))
    return out


def _unseen(plan: Plan, prepared: Prepared, finished: RunOutcome, result: Result) -> list[Unseen]:
    end = float(result.time[-1])
    if finished.pace is None or not end > 0.0:
        return []
    settings = plan.settings
    step = settings.step if settings.steps else None
    ends = corners(plan.machine) if step is None or prepared.integrator.knows_corners else ()
    steps = steps_of(finished.pace, settings.duration, step, ends)
    return list(unseen_loads(plan.machine, result, steps.until(end), prepared.integrator, chosen=step is None))
