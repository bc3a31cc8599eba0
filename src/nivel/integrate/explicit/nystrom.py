"""Nyström's method of order 4 for ÿ = f(t, y, ẏ), with a fixed step (Nyström 1925; in the form of Kreyszig, Advanced Engineering
Mathematics, "Runge–Kutta–Nyström methods"): positions advance by the accelerations of the stages, not by their velocities.

    a₁ = f(t, q, q̇)                                                q_{n+1} = q + h q̇ + h²/6 (a₁ + a₂ + a₃)
    a₂ = f(t + h/2, q + h/2 q̇ + h²/8 a₁, q̇ + h/2 a₁)              q̇_{n+1} = q̇ + h/6 (a₁ + 2 a₂ + 2 a₃ + a₄)
    a₃ = f(t + h/2, q + h/2 q̇ + h²/8 a₁, q̇ + h/2 a₂)
    a₄ = f(t + h,   q + h q̇ + h²/2 a₃,   q̇ + h a₃)

Rotations are second-order in their Euler parameters: θ̇ = ½ Ēᵀ ω̄ gives θ̈ = ½ Ēᵀ ᾱ - ¼ |ω̄|² θ, and ω̄ = 2 Ē θ̇/|θ|² leads back.
This θ̈ keeps |θ| = 1 and θᵀθ̇ = 0, so the error of a step along θ is as small as any other and the normalisation removes it.
The rest of the state (forces, energies) enters as q̇ does, so it advances by Simpson's rule with the rates of the stages; with
X a second integral of it, (q, X) is one system ÿ = f(t, y, ẏ), and the order is 4 for it too.
"""

from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.loop.run import STEP, STEP_SIGNATURE, TIME, evaluate_at, run_at
from nivel.kernels.algebra.rotation import angular_velocity, rates_of_parameters
from nivel.kernels.algebra.rows import advance
from nivel.kernels.core.status import OK
from nivel.native.entry import entry
from nivel.native.function import leaf

# Rows of run.stages: four for the stages, each with q̈ where q stands and the rates of all else; then q̇ at the start of the step.
VELOCITY = 4


@leaf
def place(history, y, h, curvature, slope):
    """y := the state after h: velocities and the rest with `slope`, positions with half of `curvature`, from run.previous."""
    run = run_at(history)
    start, velocity = run.previous, run.stages[VELOCITY]
    advance(start, h, slope, y)
    for k in range(run.plain.shape[0]):
        q = run.plain[k, 0]
        y[q] = start[q] + h * (velocity[q] + 0.5 * h * curvature[q])
    for k in range(run.turns.shape[0]):
        q, v = run.turns[k, 0], run.turns[k, 1]
        for i in range(q, q + 4):
            y[i] = start[i] + h * (velocity[i] + 0.5 * h * curvature[i])
            run.scratch[i] = velocity[i] + h * slope[i]
        angular_velocity(y[q : q + 4], run.scratch[q : q + 4], y[v : v + 3])


@leaf
def second_derivatives(history, y, slope):
    """Turn the rates of positions in `slope`, ẏ of y, into q̈."""
    run = run_at(history)
    for k in range(run.plain.shape[0]):
        slope[run.plain[k, 0]] = slope[run.plain[k, 1]]
    for k in range(run.turns.shape[0]):
        q, v = run.turns[k, 0], run.turns[k, 1]
        rates_of_parameters(y[q : q + 4], slope[v : v + 3], slope[q : q + 4])
        square = y[v] * y[v] + y[v + 1] * y[v + 1] + y[v + 2] * y[v + 2]
        for i in range(q, q + 4):
            slope[i] -= 0.25 * square * y[i]


@entry(STEP_SIGNATURE)
def rkn4(evaluate, machine, history):
    """Nyström's method of order 4."""
    run = run_at(history)
    t, h, y, trial = run.clock[TIME], run.clock[STEP], run.y, run.trial
    first, second, third, last = run.stages[0], run.stages[1], run.stages[2], run.stages[3]
    for i in range(y.shape[0]):
        first[i] = run.rate[i]
        run.stages[VELOCITY, i] = run.rate[i]
    second_derivatives(history, y, first)
    for stage in range(1, 4):
        before = run.stages[stage - 1]
        share = 1.0 if stage == 3 else 0.5
        curvature = before if stage == 3 else first
        place(history, trial, share * h, curvature, before)
        status = evaluate_at(evaluate, machine, run, t + share * h, trial, run.stages[stage])
        if status != OK:
            return status
        second_derivatives(history, trial, run.stages[stage])
    # the means of the slopes over the step, for positions and for all else
    for i in range(y.shape[0]):
        middle = second[i] + third[i]
        curvature_mean = (first[i] + middle) / 3.0
        last[i] = (first[i] + 2.0 * middle + last[i]) / 6.0
        first[i] = curvature_mean
    place(history, y, h, first, last)
    return OK


FACTS = (IntegratorFacts("rkn4", rkn4, order=4, stages=VELOCITY + 1),)
