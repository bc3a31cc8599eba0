"""The first equilibrium, from a machine as it was drawn: where it would settle in overdamped motion.

A machine that is stiff as drawn is held there by the forces that it lacks, and let go in steps: these forces are taken away little by
little, along stable equilibria. Where that leads nowhere, and with machines that move freely, it goes on otherwise.

There in every step [K + σ, Cᵀ; C, 0] is solved, σ > 0 so large that no direction is unstable and that the equations are nearly linear over
the step: a step along which the forces do work. σ falls as these allow, and vanishes near an equilibrium, where the iteration is Newton's.
So what is found is stable, unlike what Newton's iteration alone would find from far away. A machine that is in equilibrium as drawn stays
there, stable or not. (Levenberg 1944; pseudo-transient continuation, Kelley, Keyes 1998.)
"""

from __future__ import annotations

import numpy as np

from nivel.analysis.statics import states
from nivel.analysis.statics.critical import is_mechanism, softest
from nivel.analysis.statics.equations import Change, Rest, StateError, StaticEquations, Tangent, with_multipliers
from nivel.analysis.statics.linear import PivotError, negative_directions, saddle_factors, solve
from nivel.analysis.statics.newton import EquilibriumError, Found, Iteration, equilibrate, step_to
from nivel.analysis.statics.rigid_motions import with_tie
from nivel.lazy import dataclass
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


@dataclass(frozen=True)
class _Tried:
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
