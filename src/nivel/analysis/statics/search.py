"""The first equilibrium, from a machine as it was drawn: where it would settle in overdamped motion.

A machine that is stiff as drawn is held there by the forces that it lacks, and let go in steps: these forces are taken away little by
little, along stable equilibria. Where that leads nowhere, and with machines that move freely, it goes on otherwise.

There in every step [K + σ, Cᵀ; C, 0] is solved, σ > 0 so large that no direction is unstable and that the equations are nearly linear over
the step: a step along which the forces do work. σ falls as these allow, and vanishes near an equilibrium, where the iteration is Newton's.
So what is found is stable, unlike what Newton's iteration alone would find from far away. A machine that is in equilibrium as drawn stays
there, stable or not. (Levenberg 1944; pseudo-transient continuation, Kelley, Keyes 1998.)
"""

import numpy as np

from nivel.analysis.assembly.unknown_groups import unknown_name
from nivel.analysis.statics import states
from nivel.analysis.statics.critical import Softest, is_mechanism, limit_ahead, loose_coordinates, softest
from nivel.analysis.statics.equations import Change, Rest, StateError, StaticEquations, Tangent, with_multipliers
from nivel.analysis.statics.linear import PivotError, negative_directions, saddle_factors, solve
from nivel.analysis.statics.newton import EquilibriumError, Found, Iteration, equilibrate, step_to
from nivel.analysis.statics.path import Point, Steps
from nivel.analysis.statics.rigid_motions import is_tied, of_whole, resultant, with_tie
from nivel.lazy import Struct
from nivel.system.system import Array

MOST_STEPS = 600
# Longest step, in lengths of the machine and radians.
LONGEST = 0.3
# What is left of the forces beyond the linear ones, as a share of what the step was made for: more is tried again, less makes σ smaller.
CROOKED, STRAIGHT = 0.6, 0.2
MORE, LESS, FARTHER = 4.0, 0.1, 100.0
LARGEST, SMALLEST = 1e6, 1e-10
# A machine whose unbalanced forces are this share of its loads is in equilibrium as drawn.
IMPLICIT_ACCELERATIONS = 1e-9
# Steps this small are Newton's to end; those of σ = 0 from this on.
STILL, NEAR = 1e-8, 0.05
# Shares of the forces that hold a machine that are taken away at first, and at least.
FIRST, LEAST = 0.5, 1.0 / 64.0
# A machine that went this many lengths or radians is held by nothing.
FAR = 50.0
MOVES_ON = "the machine keeps moving"


def settle(equations: StaticEquations, start: Rest, iteration: Iteration) -> Found:
    """The equilibrium at the time of `start` where the machine settles: next to `start` where states hold it there, as controllers do;
    else with its first-order states held, and then with them.

    Raises EquilibriumError.
    """
    if not equations.state_count:
        return _settle(equations, start, iteration)
    held = _held_by_states(equations, start, iteration)
    # whether motions grow under what is sampled is no question of rates
    if held is not None and (
        states.depends_on_samples(equations, held.state) or states.growing_motions(equations, held.state) == 0
    ):
        return held
    try:
        return _settled_with_states(equations, start, iteration)
    except EquilibriumError:
        if held is None:
            raise
        return held


def _held_by_states(equations: StaticEquations, start: Rest, iteration: Iteration) -> Found | None:
    """The equilibrium of positions and states next to `start`, or None."""
    reference = equations.record.coordinates.reference.copy()
    try:
        states.find_moving_states(equations, start)
        if equations.states_move:
            return states.equilibrate_states(equations, start, iteration)
    except (StateError, EquilibriumError):
        pass
    equations.record.coordinates.reference[:] = reference
    return None


def _settled_with_states(equations: StaticEquations, start: Rest, iteration: Iteration) -> Found:
    """The equilibrium of positions alone, then with the states. Raises EquilibriumError."""
    found, error = None, None
    try:
        found = _settle(equations, start, iteration)
    except EquilibriumError as problem:
        error = problem
    begin = start if found is None else found.state
    try:
        states.find_moving_states(equations, begin)
    except StateError:
        raise EquilibriumError("a force, or the state, is not a number", begin) from None
    if equations.states_move:
        try:
            return states.equilibrate_states(equations, begin, iteration)
        except EquilibriumError as problem:
            return _settled_or(problem, equations, start, iteration)
    if error is not None:
        raise error
    assert found is not None
    return found


def _settled_or(problem: EquilibriumError, equations: StaticEquations, start: Rest, iteration: Iteration) -> Found:
    """Where positions and states settle together, from `start` on. Raises the problem where they do not."""
    try:
        return states.settle_states(equations, start, iteration)
    except EquilibriumError:
        raise problem from None


def _settle(equations: StaticEquations, state: Rest, iteration: Iteration) -> Found:
    """The equilibrium of the positions alone. Raises EquilibriumError."""
    try:
        state, r = _balanced(equations, state)
        tangent = equations.tangent(state)
        if _is_balanced(equations, state, r, tangent):
            return Found(state, tangent, 0, np.zeros(len(r)), ())
        tangent = with_tie(equations, state, tangent, r)
        found = _let_go(equations, Found(state, tangent, 0, np.zeros(len(r)), ()), r, iteration)
        if found is not None:
            return found
        state = _descend(equations, state)
    except StateError:
        raise EquilibriumError("a force, or the state, is not a number", state) from None
    except PivotError:
        raise EquilibriumError("its equations are singular to round-off", state) from None
    return equilibrate(equations, state, iteration)


def _is_balanced(equations: StaticEquations, state: Rest, r: Array, tangent: Tangent) -> bool:
    """Whether nothing is left over, or, where a motion that nothing resists could not balance it, no more than round-off makes."""
    if float(np.max(np.abs(r), initial=0.0)) * equations.energy <= IMPLICIT_ACCELERATIONS * equations.loads(state):
        return True
    return bool(np.all(np.abs(r) <= equations.rounded(tangent, state))) and is_mechanism(softest(tangent))


def _balanced(equations: StaticEquations, state: Rest) -> tuple[Rest, Array]:
    """The state with the multipliers that leave the least residual, and that residual."""
    tangent = equations.tangent(state)
    applied, _ = equations.evaluate(state, np.zeros(equations.rows))
    if equations.rows:
        lam = solve(tangent.rigid(), -applied, np.zeros(equations.rows), 1.0).lam
        state = with_multipliers(state, equations.force_of(lam))
    return state, equations.evaluate(state)[0]


def _let_go(equations: StaticEquations, found: Found, whole: Array, iteration: Iteration) -> Found | None:
    """The equilibrium along stable ones, under ever less of the forces that hold the state found first; None where there is no such way.

    whole : residual (f,) of that state, which the forces that hold it take up.
    """
    if negative_directions(found.tangent) > 0:
        return None
    still, held, step = np.zeros(equations.rows), 1.0, FIRST
    reference = equations.record.coordinates.reference.copy()
    try:
        while held > 0.0:
            less = max(held - step, 0.0)
            try:
                ahead = solve(found.tangent, (less - held) * whole, still)
                equations.held = less * whole
                after = step_to(equations, found.state, ahead, iteration)
                stable = negative_directions(after.tangent) == 0
            except (EquilibriumError, PivotError):
                after, stable = found, False
            if not stable:
                step *= 0.5
                if step < LEAST:
                    equations.record.coordinates.reference[:] = reference
                    return None
                continue
            equations.follow(after.state)
            held, found, step = less, after, min(2.0 * step, 1.0)
    finally:
        equations.held = 0.0
    return found


def _descend(equations: StaticEquations, state: Rest) -> Rest:
    """Steps until Newton's iteration is at home: σ is zero and the step small."""
    sigma, way, tangent = 1.0, 0.0, equations.tangent(state)
    for _ in range(MOST_STEPS):
        if sigma > LARGEST:
            break
        more = max(MORE * sigma, SMALLEST * MORE)
        if negative_directions(tangent, sigma) > 0:
            sigma = more
            continue
        try:
            tried = _try(equations, state, tangent, sigma)
        except PivotError:
            sigma = more
            continue
        if tried.size > LONGEST:
            # a step far too long says that K + σ is as good as singular, and little of the σ that is wanted
            sigma = max(sigma * min(max(1.5, tried.size / LONGEST), FARTHER), SMALLEST * MORE)
            continue
        if tried.size <= STILL:
            return tried.state
        if tried.crooked > CROOKED:
            sigma = more
            continue
        state = tried.state
        equations.follow(state)
        tangent = equations.tangent(state)
        way += tried.size
        if sigma == 0.0 and tried.size < NEAR and tried.crooked < STRAIGHT:
            return state
        if way > FAR:
            raise EquilibriumError(MOVES_ON, state)
        if tried.crooked < STRAIGHT and tried.size < 0.5 * LONGEST:
            less = sigma * (LESS if tried.size < NEAR else 0.5)
            sigma = less if less > SMALLEST else 0.0
    raise EquilibriumError(f"the machine has not settled after {MOST_STEPS} steps", state)


class _Tried(Struct):
    """The state after a step of this size, and the step that is asked for by what is not linear in it, over the step itself."""

    state: Rest
    size: float
    crooked: float


def _try(equations: StaticEquations, state: Rest, tangent: Tangent, sigma: float) -> _Tried:
    """A step, in which multipliers are found as well. Raises PivotError."""
    applied, C = equations.evaluate(state, np.zeros(equations.rows))
    f = len(applied)
    if not f:
        return _Tried(state, 0.0, 0.0)
    found = saddle_factors(with_tie(equations, state, tangent, applied), sigma)
    x = found.solve(-np.concatenate([applied, C]))
    q, lam = x[:f], equations.force_of(x[f:])
    size = float(np.max(np.abs(q), initial=0.0))
    if size > LONGEST:
        return _Tried(state, size, np.inf)
    after = equations.moved(with_multipliers(state, lam), Change(q, np.zeros(len(lam))))
    try:
        r, opened = equations.evaluate(after)
    except StateError:
        return _Tried(state, size, np.inf)
    # of linear equations K x + σ x + r₀ + Cᵀ λ = 0 that much would be left: -σ x
    beyond = found.solve(np.concatenate([r + sigma * q, opened]))[:f]
    length = float(np.linalg.norm(q))
    return _Tried(after, size, float(np.linalg.norm(beyond)) / length if length > 0.0 else 0.0)


# Reasons why no equilibrium was found, or no further one, and advice.

# Forces left over that are this share of the loads are no reason to go on.
LEFT_OVER = 1e-6
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
        if left <= LEFT_OVER * equations.loads(error.state):
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
        least = LEFT_OVER * equations.loads(state)
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
