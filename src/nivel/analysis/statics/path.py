"""The path of equilibria: how the state of rest changes as time, on which loads and drivers depend, goes on.

By load steps time is given and the state is found. By arc length both are found: every step is as long in (positions, time), and
corrections are perpendicular to the tangent of the path (Riks 1979, Wempner 1971), so limit points, where loads have to fall for
equilibrium to go on, are passed. Positions count as much as time does at the start, whatever the stiffness: the scale is the first tangent.
"""

from collections.abc import Iterator

import numpy as np

from nivel.analysis.statics.equations import Change, Rest, StaticEquations, Tangent
from nivel.analysis.statics.linear import PivotError, bordered, solve, solve_bordered
from nivel.analysis.statics.newton import EquilibriumError, Found, Iteration, equilibrate, step_to
from nivel.analysis.statics.states import equilibrate_states
from nivel.lazy import Struct, replace

# Steps are halved so often, at most.
HALVINGS = 12
# Iterations that a step along the path should need: with more the next one is shorter, with fewer longer, by no more than this factor.
WANTED, LONGER = 6.0, 2.0
# Steps along the path move no part by more than this, in lengths of the machine and radians, unless the first step did.
REACH = 0.1
# The tangent turns by no more than this in a step along the path, as a cosine.
BEND = 0.9
# Below this change of positions over the whole time (lengths, radians), their scale is theirs as they are.
LEAST_MOTION = 1e-6
# A path that is this many times as long as the way of time has lost its way.
MOST_STEPS = 20_000
NEAR = 1e-12


class Point(Struct):
    """An equilibrium of the path, and how far along the path it is [s]."""

    found: Found
    along: float

    @property
    def state(self) -> Rest:
        return self.found.state


class Steps(Struct):
    """How a path is followed: to the time `duration` [s], in steps [s], at most `most` of them, with this iteration."""

    duration: float
    step: float
    iteration: Iteration
    most: int = MOST_STEPS


def by_loads(equations: StaticEquations, first: Point, steps: Steps) -> Iterator[Point]:
    """Equilibria at multiples of the step after `first`, and between them where a step had to be halved.

    Raises EquilibriumError where no step goes on.
    """
    count = max(1, round(steps.duration / steps.step + 0.5 - 1e-9))
    point, share = first, 1.0
    for number in range(1, count + 1):
        goal = min(number * steps.step, steps.duration)
        while point.state.t < goal - NEAR * steps.duration:
            rest = goal - point.state.t
            until = goal if share * steps.step >= rest * (1.0 - 1e-9) else point.state.t + share * steps.step
            try:
                found = _load_step(equations, point.found, until, steps.iteration)
            except EquilibriumError:
                share = 0.5 * min(share, rest / steps.step)
                if share < 0.5**HALVINGS:
                    raise
                continue
            equations.follow(found.state)
            point = Point(found, until)
            yield point
            share = min(1.0, 2.0 * share)


def _load_step(equations: StaticEquations, before: Found, until: float, iteration: Iteration) -> Found:
    """The equilibrium at the time `until`, next to where the tangent leads. Raises EquilibriumError, also where it is on another path."""
    if equations.states_move:
        return equilibrate_states(equations, replace(before.state, t=until), iteration)
    tangent, dt = before.tangent, (until - before.state.t) / equations.duration
    try:
        ahead = solve(tangent, -dt * tangent.slope, -dt * tangent.opening)
    except PivotError:
        raise EquilibriumError("nothing resists a motion", before.state) from None
    return step_to(equations, replace(before.state, t=until), ahead, iteration)


def by_arc_length(equations: StaticEquations, first: Point, steps: Steps) -> Iterator[Point]:
    """Equilibria along the path until its time is the duration, or as long before the start; the last one at the duration itself.

    Raises EquilibriumError where no step goes on.
    """
    zero = np.zeros(len(equations.free))
    scale = _scale(equations, first.found.tangent)
    direction = path_tangent(first.found.tangent, Change(zero, np.zeros(equations.rows), 1.0), scale)
    full = steps.step / steps.duration
    reach = max(REACH, full * _largest(direction))
    length, point, count = full, first, 0
    while point.state.t < steps.duration * (1.0 - NEAR):
        try:
            found, after = _along(equations, point.found, direction, length, scale, steps.iteration)
        except EquilibriumError:
            length *= 0.5
            if length < full * 0.5**HALVINGS:
                raise
            continue
        if found.state.t >= steps.duration:
            found = _land(equations, point.found, found, steps)
        equations.follow(found.state)
        point = Point(found, point.along + length * steps.duration)
        yield point
        if found.state.t < -steps.duration:
            return
        count += 1
        if count > steps.most:
            raise EquilibriumError(f"the path has not come to its end after {steps.most} steps", point.state)
        direction = after
        longer = length * min(max(float(np.sqrt(WANTED / found.iterations)), 1.0 / LONGER), LONGER)
        # time goes on by `full` at most, and every part by `reach`
        length = min(longer, 1.0 / max(abs(direction.t) / full, _largest(direction) / reach))


def _largest(direction: Change) -> float:
    return float(np.max(np.abs(direction.q), initial=0.0))


def _land(equations: StaticEquations, before: Found, after: Found, steps: Steps) -> Found:
    """The equilibrium at the duration, between two on the path."""
    beyond = (after.state.t - steps.duration) / (after.state.t - before.state.t)
    tangent = after.tangent
    try:
        back = solve(tangent, tangent.slope, tangent.opening)
        dt = (after.state.t - steps.duration) / equations.duration
        begin = equations.moved(after.state, Change(back.q * dt, back.lam * dt))
        return equilibrate(equations, replace(begin, t=steps.duration), steps.iteration)
    except (PivotError, EquilibriumError):
        # the end is next to a limit point: from the side before it
        if beyond > 1.0 - 1e-9:
            raise
        return _load_step(equations, before, steps.duration, steps.iteration)


def _along(
    equations: StaticEquations, before: Found, direction: Change, length: float, scale: float, iteration: Iteration
) -> tuple[Found, Change]:
    """The equilibrium a step of this length along `direction` of the path, of length one, and the direction there.

    Raises EquilibriumError.
    """
    begin = equations.moved(before.state, direction * length)
    found = equilibrate(equations, begin, iteration, border_of(direction, scale))
    after = path_tangent(found.tangent, direction, scale)
    if path_product(direction, after, scale) < BEND:
        raise EquilibriumError("the path turns sharply", before.state, found.sizes)
    return found, after


def border_of(direction: Change, scale: float) -> Change:
    """What is perpendicular to it is perpendicular to the direction."""
    return Change(scale**2 * direction.q, direction.lam, direction.t)


def path_product(a: Change, b: Change, scale: float) -> float:
    """Inner product of directions of the path."""
    return float(scale**2 * (a.q @ b.q) + a.t * b.t)


def path_tangent(tangent: Tangent, before: Change, scale: float) -> Change:
    """The tangent of the path, of length one, onwards from the direction `before`. Raises EquilibriumError at a bifurcation itself."""
    zero = np.zeros(len(before.q))
    try:
        found = bordered(tangent, border_of(before, scale))
    except PivotError:
        raise EquilibriumError("two paths cross here", Rest(zero, zero, 0.0)) from None
    ahead = solve_bordered(found, zero, np.zeros(tangent.C.shape[0]), 1.0)
    return ahead * (1.0 / float(np.sqrt(path_product(ahead, ahead, scale))))


def _scale(equations: StaticEquations, tangent: Tangent) -> float:
    """What positions count, so that at the start they change as much as time."""
    try:
        ahead = solve(tangent, -tangent.slope, -tangent.opening)
    except PivotError:
        raise EquilibriumError("nothing resists a motion", Rest(np.zeros(0), np.zeros(0), 0.0)) from None
    motion = float(np.linalg.norm(ahead.q))
    return 1.0 / motion if motion > LEAST_MOTION else 1.0
