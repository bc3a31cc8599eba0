"""What a user's law costs beside the built-in force that does the same, and how long it takes to compile.

    python benchmarks/law_cost.py

One body hangs on many springs; the same springs are built-in, expressions, and Python laws. The difference of the times of a step,
over springs and evaluations, is the cost of a call. Runs are interleaved; medians of many.
"""

from __future__ import annotations

import statistics
import time

import numpy as np

import nivel
from nivel import Body, MachineRecord, SimulationSettings, SpringDamper
from nivel.analysis.plan.plan import methods_of
from nivel.analysis.plan.settings import complete
from nivel.analysis.run.dynamics import march
from nivel.analysis.run.prepared_state import prepare
from nivel.machine.core.element import Marker
from nivel.system.laws.laws import law_address

SPRINGS, STEPS, REPEATS = 100, 2000, 15
LAW = """
def tension(length, rate):
    return 50.0 * (length - 0.9) + 0.3 * rate
"""


class Nothing:
    """A sink that keeps nothing."""

    def begin(self, header: object) -> None:
        pass

    def take(self, frames: object) -> None:
        pass


def machine(kind: str) -> MachineRecord:
    """A body on springs to points on a circle; all springs of one kind."""
    forces = []
    for k in range(SPRINGS):
        angle = 2 * np.pi * k / SPRINGS
        ends = (Marker(body="ground", position=(np.cos(angle), np.sin(angle), 0.3)), Marker(body="ball"))
        if kind == "built-in":
            law = {"stiffness": 50.0, "damping": 0.3, "free_length": 0.9}
        elif kind == "expression":
            law = {"law": "50*(length - 0.9) + 0.3*rate"}
        else:
            law = {"law": nivel.PythonLaw(LAW, "tension", ("length", "rate"))}
        forces.append(SpringDamper(name=f"s{k}", markers=ends, **law))
    body = Body(name="ball", mass=2.0, inertia=(0.1, 0.1, 0.1), velocity=(0.3, 0.1, 0))
    settings = SimulationSettings(duration=STEPS * 1e-3, step=1e-3, output_interval=STEPS * 1e-3)
    return MachineRecord(name=kind, bodies=(body,), forces=tuple(forces), simulation=settings)


def main() -> None:
    """Measure and print."""
    kinds = ("built-in", "expression", "python")
    prepared = {kind: (prepare(methods_of(machine(kind))), complete(machine(kind).simulation)) for kind in kinds}
    times: dict[str, list[float]] = {kind: [] for kind in kinds}
    for _ in range(REPEATS):
        for kind, (ready, settings) in prepared.items():
            finished = march(ready, settings, [Nothing()])
            # four evaluations a step, one of them shared with the next
            times[kind].append(finished.timing["loop_seconds"] / finished.timing["evaluations"] / SPRINGS * 1e9)
    least = {kind: statistics.median(each) for kind, each in times.items()}
    for kind in kinds:
        extra = least[kind] - least["built-in"]
        print(f"{kind:12} {least[kind]:6.1f} ns a spring and evaluation, {extra:+6.1f} ns")
    begin = time.perf_counter()
    law_address(nivel.PythonLaw(LAW + f"\n# {time.time_ns()}", "tension", ("length", "rate")), motion=False)
    print(f"a new Python law compiles in {time.perf_counter() - begin:.2f} s (Numba loaded)")


if __name__ == "__main__":
    main()
