"""Reasons why no equilibrium was found, or no further one, and advice."""

from __future__ import annotations

import numpy as np

from nivel.analysis.assembly.unknown_groups import unknown_name
from nivel.analysis.statics.critical import Softest, is_mechanism, limit_ahead, loose_coordinates, softest
from nivel.analysis.statics.equations import Rest, StateError, StaticEquations
from nivel.analysis.statics.linear import PivotError
from nivel.analysis.statics.newton import EquilibriumError
from nivel.analysis.statics.path import Point, Steps
from nivel.analysis.statics.rigid_motions import is_tied, of_whole, resultant
from nivel.analysis.statics.search import MOVES_ON
from nivel.system.system import Array

# Forces left over that are this share of the loads are no reason to go on.
IMPLICIT_ACCELERATIONS = 1e-6
HOLD = "Hold that motion by a joint, a spring, a driver, or a load that brings it back."


# Parts of a direction that are this share of its largest are named, so many at most.
NAMED, MOST = 0.35, 3


def direction_in_words(equations: StaticEquations, direction: Array) -> str:
    """The bodies and joints that move most in a direction (f,) without units."""
    size = np.abs(direction)
    if not np.any(size > 0.0):
        return "an unknown direction"
    order = np.argsort(-size, kind="stable")
    chosen = [k for k in order[: MOST + 1] if size[k] >= NAMED * size[order[0]]]
    names = list(dict.fromkeys(unknown_name(equations.system, int(equations.free[k])) for k in chosen[:MOST]))
    return "; ".join(names) + ("; and more" if len(chosen) > MOST else "")


def worst_row(equations: StaticEquations, r: Array, C: Array) -> str:
    """The equation with the largest residual: a body or joint and its direction, or a constraint that is open."""
    forces, open_ = float(np.max(np.abs(r), initial=0.0)), float(np.max(np.abs(C), initial=0.0))
    if open_ > 1e-9 and (not forces > 0.0 or open_ > 1e-3 * forces):
        row = int(equations.residual.row[int(np.argmax(np.abs(C)))])
        return f"the constraint {equations.system.rows[row]}, open by {open_:.3g} of its scale"
    if not forces > 0.0:
        return "no row"
    k = int(np.argmax(np.abs(r)))
    number = int(equations.free[k])
    force = r[k] * equations.energy / equations.length[number]
    units = "N" if equations.system.map.units[equations.place[number, 0]] == "m" else "N m"
    return f"{unknown_name(equations.system, number)}, unbalanced by {force:.3g} {units}"


def without_stiffness(equations: StaticEquations, state: Rest, loose: Softest) -> tuple[str, str]:
    """(message, advice) where the machine can move without any resistance from an equilibrium."""
    whole = of_whole(equations, state, equations.tangent(state))
    words = direction_in_words(equations, loose.direction if whole.inner is None else whole.inner)
    message = f"the machine is a mechanism: a motion has no stiffness, in which most moves: {words}"
    coordinates = loose_coordinates(equations, state)
    if not coordinates:
        return message, f"{HOLD} `nivel check` names every freedom, and what removes an idle one."
    return message, f"{HOLD} Or let it stay as placed: `simulation: {{free: [{', '.join(coordinates)}]}}`."


def no_start(equations: StaticEquations, error: EquilibriumError) -> tuple[str, str]:
    """(message, advice) where no equilibrium was found at t = 0."""
    try:
        r, C = equations.evaluate(error.state)
        loose = softest(equations.tangent(error.state))
    except (StateError, PivotError):
        return f"no equilibrium was found at t = 0: {error.reason}", "Look at the laws of the forces at t = 0."
    unbalanced = _free_under_load(equations, error.state)
    if unbalanced is not None:
        return unbalanced
    row = worst_row(equations, r, C)
    message = f"no equilibrium was found at t = 0: {error.reason}; worst is {row}"
    if loose is not None and is_mechanism(loose):
        left = float(np.max(np.abs(r), initial=0.0)) * equations.energy
        if left <= IMPLICIT_ACCELERATIONS * equations.loads(error.state):
            return without_stiffness(equations, error.state, loose)
        words = direction_in_words(equations, loose.direction)
        return f"{message}; a motion has no stiffness, in which most moves: {words}", HOLD
    if error.reason == MOVES_ON:
        return message, "A load moves it without end: restrain the machine by a joint, a spring or a driver."
    return message, (
        "Is the machine held against its loads in every direction? If so draw it nearer to its equilibrium, or let loads grow with "
        "time from t = 0 (an expression of t, or a table)."
    )


def _free_under_load(equations: StaticEquations, state: Rest) -> tuple[str, str] | None:
    """(message, advice) of a machine that nothing holds, whose loads move it as a whole; else None."""
    try:
        if is_tied(equations, equations.tangent(state)):
            return None
        force, moment = resultant(equations, state)
        least = IMPLICIT_ACCELERATIONS * equations.loads(state)
    except StateError:
        return None
    if np.abs(force).max() * equations.system.size > least:
        left = f"({', '.join(f'{value:.4g}' for value in force)}) N"
    elif np.abs(moment).max() > least:
        left = f"a moment of ({', '.join(f'{value:.4g}' for value in moment)}) N m"
    else:
        return None
    return (
        f"nothing holds the machine as a whole, and its loads do not balance each other: their sum is {left}",
        "Hold one of its bodies, by a joint or a driver, or apply the load that is missing.",
    )


def path_ended(
    equations: StaticEquations, last: Point, steps: Steps, error: EquilibriumError, arc_length: bool
) -> tuple[str, str]:
    """(message, advice) where the path could not be followed on."""
    t = last.state.t
    least = steps.step * 0.5**12
    message = f"stopped at t = {t:.9g} s: no equilibrium within {least:.3g} s of it: {error.reason}"
    if not arc_length:
        ahead = limit_ahead(equations, last, steps)
        if ahead is not None and ahead.found is not None:
            words = direction_in_words(equations, ahead.direction)
            what = "the path turns back at a limit point" if ahead.kind == "limit point" else "there is a bifurcation"
            where = f"{what} at t = {ahead.t:.9g} s, where a motion loses its stiffness, in which most moves: {words}"
            return (
                f"stopped at t = {t:.9g} s: {where}",
                "With --arc-length the path is followed on through limit points. With more load than there the machine jumps: a run "
                "in time shows where to.",
            )
    try:
        r, C = equations.evaluate(error.state)
        message += f"; worst is {worst_row(equations, r, C)}"
    except (StateError, ValueError):
        pass
    unbalanced = _free_under_load(equations, error.state)
    if unbalanced is not None:
        return f"stopped at t = {t:.9g} s: {unbalanced[0]}", unbalanced[1]
    loose = softest(last.found.tangent)
    if loose is not None and loose.share < 1e-4:
        message += f"; softest is a motion in which most moves: {direction_in_words(equations, loose.direction)}"
    advice = (
        "Look there for a force that jumps, a joint at the end of its way, or a position that the machine cannot pass. "
        f"Try a smaller --step, for instance {steps.step / 10:.3g}" + ("." if arc_length else ", or --arc-length.")
    )
    return message, advice
