"""The state inside a step, θ = (t - t₀)/h from 0 to 1, from the rows d₀, d₁, … of `run.dense`.

Either alternating, y₀ + θ (d₀ + (1 - θ) (d₁ + θ (d₂ + (1 - θ) (d₃ + …)))) (Hairer, Nørsett, Wanner 1993, §II.6), or powers,
y₀ + d₀ θ + d₁ θ² + … . An integrator fills the rows that it has where `wanted` says so; for all others a cubic through states and
rates at both ends is taken, whose error falls with h⁴.
"""

from nivel.integrate.loop.run import DENSE, END, INTERVAL, LAST_FRAME, POWERS, REACHED, START
from nivel.native.function import leaf


@leaf
def frame_time(run, k):
    """Time of frame k of a run that chooses its steps; the last one is at the end."""
    t = run.clock[START] + k * run.clock[INTERVAL]
    # an interval that ends at the end except for round-off is that frame
    return run.clock[END] if t > run.clock[END] - 1e-9 * run.clock[INTERVAL] else t


@leaf
def wanted(run):
    """Whether states inside the step from TIME to REACHED are needed: for frames or events."""
    if run.event_values.shape[1] > 0:
        return True
    return frame_time(run, run.counter[LAST_FRAME] + 1) < run.clock[REACHED]


@leaf
def cubic(run, h, rate_before, rate_after):
    """Fill the rows of the cubic through `previous` and y, h later, with these rates."""
    for i in range(run.y.shape[0]):
        change = run.y[i] - run.previous[i]
        run.dense[0, i] = change
        run.dense[1, i] = h * rate_before[i] - change
        run.dense[2, i] = change - h * rate_after[i] - run.dense[1, i]
    run.counter[DENSE], run.counter[POWERS] = 3, 0


@leaf
def inside(run, theta, y):
    """y := the state at the share θ of the last step."""
    rows = run.counter[DENSE]
    for i in range(y.shape[0]):
        value = 0.0
        for n in range(rows):
            k = rows - 1 - n
            if run.counter[POWERS] == 1 or k % 2 == 0:
                value = theta * (run.dense[k, i] + value)
            else:
                value = (1.0 - theta) * (run.dense[k, i] + value)
        y[i] = run.previous[i] + value
