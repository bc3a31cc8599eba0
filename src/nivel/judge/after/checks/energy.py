"""Energy: the balance of a run, the force that it may be wrong by, and what the method takes from the motion.

A force that is too fast for steps of fixed size works so much in a step that its effect decays, or vibrates, within the step. A damper
takes from what it stops with a rate r = c/m the share 2 r h of its kinetic energy in a step h, as far as its power at the begin of the
step says; a spring with the frequency ω takes up to ω h. Where that is of the order of one no formula on steps h has its work right.
"""

import json
import math

import numpy as np

from nivel.elements.forces import FORCES
from nivel.judge.after.report import SECOND_RUN, Check, Need
from nivel.judge.after.subject import Motion, Run
from nivel.lazy import Struct
from nivel.results import scales as sizes
from nivel.results.motion import common_frames, peak
from nivel.results.trust import Item, Threshold, number, quantity

# Work in a step as a share of the largest energy from which on it is not followed, and of the energy error that it can explain.
FOLLOWED, EXPLAINS = 0.5, 0.01
BALANCE = Threshold(
    1e-4,
    1e-2,
    "Friction and inertia of real machines are rarely known to 1 %. A larger energy error cannot be explained by uncertain data. "
    "1e-4 is two decades below: the error is not visible in any curve.",
)


class Unresolved(Struct):
    """A force, the work [J] that its power at this time [s] does in a step [s], and the largest energy of the run [J]: kinetic, change of
    potential energy, or work of external forces. A slow machine under loads has far more of the latter than a force does in one step."""

    force: str
    work: float
    time: float
    step: float
    energy: float


class Energy(Struct):
    """The largest energy error [J] and its time [s], the energy [J] that it is compared with and what that is.

    force : that does the work `force_work` [J] in the step [s] from `force_time` [s], and so may be what is wrong; `others` : all other
    energy of the run [J]. Empty where there is none, or the balance is green.
    """

    error: float
    time: float
    scale: float
    scale_kind: str
    force: str = ""
    force_work: float = 0.0
    force_time: float = 0.0
    step: float = 0.0
    others: float = 0.0


def look_at_balance(run: Motion) -> Energy:
    """The balance over all frames."""
    result, scales = run.result, run.scales
    error, (violation, units) = peak(result, "energy_error"), run.opening
    opening = violation.value / scales.size if units == "m" else violation.value
    scale, kind = sizes.largest_energy(result, scales.size, opening, scales.at_rest)
    slowest = sizes.speed_of_rest(result, scales.size)
    if run.kinetic_energy > max(scale, sizes.kinetic_energy_of_rest(result, slowest)):
        scale, kind = run.kinetic_energy, "largest kinetic energy"
    if isinstance(run, Run) and run.second is not None and scale < (passed := sizes.work_to_and_fro(result)) < math.inf:
        scale, kind = passed, "work of external forces to and fro"
    found = None if error.value < BALANCE.green * scale else unresolved_force(result, error.value)
    if found is None:
        return Energy(error.value, error.time, scale, kind)
    return Energy(error.value, error.time, scale, kind, found.force, found.work, found.time, found.step, found.energy)


def say_balance(found: Energy) -> Item:
    """The error as a fraction of the energy that it is compared with."""
    error, scale = found.error, found.scale
    fraction = error / scale if scale > 0.0 else 0.0 if error == 0.0 else math.nan if math.isnan(error) else math.inf
    if not math.isfinite(error):
        said = f"the energy is not a number from t = {found.time:.6g} s on"
    elif scale > 0.0:
        said = f"error {BALANCE.shown(fraction)} of the {found.scale_kind} {quantity(scale, 'J')}"
    elif not found.scale_kind:
        said = "nothing was computed"
    elif error == 0.0:
        said = "no energy anywhere, and no error"
    else:
        said = f"error {quantity(error, 'J')} where there is no energy"
    return BALANCE.item("energy", f"Energy: {said}{_cause(found)}", fraction, found.time, found.force)


def _cause(found: Energy) -> str:
    """Which force is too fast for the step, by what that is seen, and what to do."""
    if not found.force:
        return ""
    others = f"{number(found.force_work / found.others)} times all other energy of the run" if found.others else ""
    return (
        f"; {found.force} does {quantity(found.force_work, 'J')} in one step of {number(found.step)} s at t = {found.force_time:.6g} s, "
        f"{others or 'and there is no energy'}: its effect decays or vibrates within a step, so its work is not known. "
        f"Use a shorter step, or an integrator that chooses its steps (radau)"
    )


def unresolved_force(result: sizes.Readable, error: float) -> Unresolved | None:
    """The force whose work in a step is largest, where it is too much for the step and of a size with the energy error [J]; None where
    there is none, and where steps are chosen."""
    settings = json.loads(str(result.attributes.get("settings", "{}")))
    if "step" not in settings or "tolerance" in settings or not len(result.time):
        return None
    step, energy = float(settings["step"]), sizes.largest_mechanical_energy(result)
    found = [Unresolved(name, work, time, step, energy) for name, work, time in _works(result, step)]
    worst = max(found, key=lambda each: each.work, default=None)
    if worst is None or worst.work < max(FOLLOWED * energy, EXPLAINS * error if np.isfinite(error) else 0.0):
        return None
    return worst


def _works(result: sizes.Readable, step: float) -> list[tuple[str, float, float]]:
    """(name, largest work in a step [J], its time [s]) of the forces that can be stiff and do any."""
    record = json.loads(str(result.attributes.get("machine_record", "{}")))
    # a load that is given, or dry friction, changes no faster than what makes it
    out = []
    for force in record.get("forces", ()):
        variable = f"force.{force['name']}.power"
        if not FORCES[force["type"]].record.stiff or variable not in result.variables:
            continue
        work = step * np.abs(result.array(variable))
        work[~np.isfinite(work)] = 0.0
        k = int(np.argmax(work)) if len(work) else 0
        if len(work) and work[k] > 0.0:
            out.append((force["name"], float(work[k]), float(result.time[k])))
    return out


# A loss of energy counts above this share of the largest energy; it does not get less where this share of it is left.
LOSS, STAYS = 1e-8, 0.7
DAMPS = "their method damps vibrations"
IMPLICIT = Need("an implicit method", lambda run: run.prepared.integrator.needs != "evaluations")


class Damped(Struct):
    """Energy [J] that the run lost, and what the second run did. method : the integrator. longer : the steps of the second run are."""

    lost: float
    lost_other: float
    method: str
    longer: bool


def _look_at_damping(run: Run) -> Damped | None:
    """Energy that the method takes from the motion whatever the step: None where it takes none that counts, or less with finer steps."""
    result, other, longer = run.result, run.finer.result, run.finer.refinement.left > 1.0
    if "energy_error" not in result.variables:
        return None
    first, second = common_frames(result.time, other.time)
    if not len(first):
        return None
    errors, others = result.array("energy_error")[first], other.array("energy_error")[second]
    k = int(np.argmin(errors))
    lost, lost_other = -float(errors[k]), -float(others[k])
    finer, coarser = (lost, lost_other) if longer else (lost_other, lost)
    scale = sizes.largest_energy(result, run.scales.size, at_rest=run.scales.at_rest)[0]
    if not (lost > LOSS * scale and finer > STAYS * coarser):
        return None
    return Damped(lost, lost_other, run.plan.settings.integrator, longer)


def _say_damping(found: Damped) -> Item:
    steps = "longer" if found.longer else "finer"
    text = (
        f"Damped: {found.method} takes {quantity(found.lost, 'J')} from the motion, and {quantity(found.lost_other, 'J')} with {steps} "
        f"steps: vibrations faster than the steps are damped numerically; use steps of a tenth of their period, or add damping to the "
        f"model if these vibrations do not matter "
        f"(green if finer steps lose less, amber otherwise)"
    )
    return Item("damped", "amber", text, found.lost)


CHECKS = (
    Check("energy", Motion, look_at_balance, say_balance, 10, (), "Energy", BALANCE),
    Check("damped", Run, _look_at_damping, _say_damping, 330, (SECOND_RUN, IMPLICIT), "Damped", blind=DAMPS),
)
