"""Cost of a gradient by seven parameters, in runs: the compiled loop on dual numbers against that on real ones, in one process.

    python benchmarks/gradients.py

Each pair is measured in turns, by the processor time of the loop; the median of the ratios is shown. Seeds (28 machines built beside) are
shown apart. Central differences would take 14 runs.
"""

import time
from pathlib import Path

import numpy as np

import nivel
from nivel.analysis.gradients.gradient import Varied
from nivel.analysis.gradients.outputs import parameters_of
from nivel.analysis.gradients.slopes import WholeLoop, memory_of, run_whole, seed, seeds_of
from nivel.analysis.plan.compilation import build, run_entries
from nivel.analysis.plan.plan import plan_run
from nivel.analysis.run.dynamics import march, start_loop

EXAMPLES = Path(__file__).parent.parent / "examples"
SLIDER_CRANK = (
    "parameters.crank_radius",
    "parameters.rod_length",
    "parameters.offset",
    "bodies.crank.mass",
    "bodies.rod.mass",
    "bodies.slider.mass",
    "gravity.1",
)
FOUR_BAR = (
    "parameters.crank_length",
    "parameters.bar_length",
    "parameters.ground_length",
    "bodies.crank.mass",
    "bodies.coupler.mass",
    "bodies.rocker.mass",
    "gravity.1",
)
CASES = (
    ("mechanisms/slider-crank.yaml", SLIDER_CRANK, {"integrator": "rk4", "coordinates": "relative"}),
    ("mechanisms/slider-crank.yaml", SLIDER_CRANK, {"integrator": "rk4", "coordinates": "absolute"}),
    ("mechanisms/four-bar.yaml", FOUR_BAR, {"integrator": "dopri5", "tolerance": 1e-8}),
    ("mechanisms/slider-crank.yaml", SLIDER_CRANK, {"integrator": "generalised-alpha", "coordinates": "relative"}),
    ("mechanisms/slider-crank.yaml", SLIDER_CRANK, {"integrator": "generalised-alpha", "coordinates": "absolute"}),
)
DURATION, ROUNDS = 2.0, 5


class Nobody:
    """A sink that keeps nothing."""

    def begin(self, header):
        """Nothing."""

    def take(self, frames):
        """Nothing."""


def cost(path, parameters, settings, duration=DURATION, rounds=ROUNDS):
    """(seconds of a plain loop, ratio of the loop on dual numbers, seconds of the seeds)."""
    machine = nivel.load(EXAMPLES / path).with_settings({"duration": duration, **settings})
    plan = plan_run(machine.record)
    build(run_entries(plan), None)
    varied, chosen = Varied(machine, plan, ""), parameters_of(machine, parameters)
    build(start_loop(varied.prepared, plan.settings).entries_on("whole"), None)
    plain, ratios, seeding = [], [], 0.0
    for _ in range(rounds):
        plain.append(march(varied.prepared, plan.settings, [Nobody()]).timing["loop_seconds"])
        loop = start_loop(varied.prepared, plan.settings)
        whole = WholeLoop(loop)
        begin = time.thread_time()
        seed(seeds_of(memory_of(loop), chosen, varied.beside), whole.machine, whole.run)
        seeding = time.thread_time() - begin
        begin = time.thread_time()
        run_whole(whole)
        ratios.append((time.thread_time() - begin) / plain[-1])
    return float(np.median(plain)), float(np.median(ratios)), seeding


if __name__ == "__main__":
    for path, parameters, settings in CASES:
        seconds, ratio, seeding = cost(path, parameters, settings)
        words = ", ".join(map(str, settings.values()))
        print(
            f"{path:34} {words:30} run {1e3 * seconds:7.1f} ms, gradient {ratio:5.2f} runs, seeds {1e3 * seeding:5.0f} ms"
        )
