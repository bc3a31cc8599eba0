"""Time of one implicit step of two hinged beams, with the hinge eliminated or kept with multipliers, beside Exudyn; and how the time grows
with the number of elements.

    python benchmarks/beams.py [--peer PYTHON] [--runs 5] [--elements 40] [--longest 10000]

Two beams of 5 m (the section of the hinged beams of Mäkinen and Marjamäki) hang on a revolute joint, a second one between them; a force
of 30 N at the tip starts the motion. Generalised-α, the same steps in both programs. Every round runs each combination once, so a slow
moment of the machine falls on all alike. Medians; process time inside the compiled loop.
"""

import argparse
import json
import statistics
import subprocess
from pathlib import Path

from rich.console import Console
from rich.table import Table

import nivel

PEER = Path(__file__).parent / "peers" / "exudyn_beams.py"
STEPS = (0.01, 0.0025)
LOAD = 30.0
DURATION = 1.0


def machine(elements: int) -> nivel.Machine:
    """The hinged beams under a force at the tip."""
    section = {"type": "general", "stiffness": [1e6, 1e6, 1e6, 1e3, 1e3, 1e3], "mass": 1.0, "inertia": [1.0, 1.0, 1.0]}
    beam = {"section": section, "elements": elements // 2}
    record = {
        "name": "hinged-beams",
        "beams": [
            {"name": "inner", "from": [0, 0, 0], "to": [5, 0, 0], **beam},
            {"name": "outer", "from": [5, 0, 0], "to": [10, 0, 0], **beam},
        ],
        "joints": [
            {
                "name": "root",
                "type": "revolute",
                "bodies": ["ground", "inner.start"],
                "point": [0, 0, 0],
                "axis": [0, 0, 1],
            },
            {
                "name": "hinge",
                "type": "revolute",
                "bodies": ["inner.end", "outer.start"],
                "point": [5, 0, 0],
                "axis": [0, 0, 1],
            },
        ],
        "forces": [{"name": "tip", "type": "force", "body": "outer.end", "vector": [0, -LOAD, 0]}],
    }
    return nivel.Machine.from_record(nivel.MachineRecord(**record))


def step_time(
    elements: int, coordinates: str, step: float, duration: float = DURATION
) -> tuple[float, float, list[float]]:
    """µs a step, Newton iterations a step, place of the tip at the end."""
    result = machine(elements).simulate(
        verify=False,
        duration=duration,
        step=step,
        integrator="generalised-alpha",
        coordinates=coordinates,
        output_interval=duration,
    )
    timing = result.timing
    tip = result.dataset["position"].sel(body="outer.end").values[-1]
    return 1e6 * timing["loop_seconds"] / timing["steps"], timing["iterations"] / timing["steps"], tip.tolist()


def peer(python: str, elements: int, step: float) -> tuple[float, list[float]]:
    """The same of Exudyn."""
    command = [python, str(PEER), str(elements), str(step), str(round(DURATION / step)), str(LOAD)]
    out = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[-1])
    return out["microseconds"], out["tip"]


def main() -> None:
    """Both tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--peer", help="interpreter of an environment with Exudyn")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--elements", type=int, default=40)
    parser.add_argument("--longest", type=int, default=10_000)
    chosen = parser.parse_args()
    console, table = Console(), Table("step", "program", "µs a step", "iterations", "tip at the end", "ratio")
    for step in STEPS:
        rows: dict[str, list[float]] = {}
        tips: dict[str, list[float]] = {}
        iterations: dict[str, float] = {}
        for run in range(chosen.runs + 1):
            for coordinates in ("relative", "absolute"):
                spent, count, tip = step_time(chosen.elements, coordinates, step)
                name = f"nivel, {coordinates}"
                iterations[name], tips[name] = count, tip
                if run:  # the first one compiles
                    rows.setdefault(name, []).append(spent)
            if chosen.peer and run:
                spent, tips["Exudyn"] = peer(chosen.peer, chosen.elements, step)
                rows.setdefault("Exudyn", []).append(spent)
        of_peer = statistics.median(rows["Exudyn"]) if "Exudyn" in rows else float("nan")
        for name, times in rows.items():
            median = statistics.median(times)
            tip = ", ".join(f"{value:.4f}" for value in tips[name])
            table.add_row(
                f"{step:g}",
                name,
                f"{median:.0f}",
                f"{iterations[name]:.1f}" if name in iterations else "–",
                tip,
                f"{of_peer / median:.1f}",
            )
    console.print(table)
    growth = Table("elements", "µs a step and element")
    for elements in (chosen.elements, 400, 4000, chosen.longest):
        spent, _, _ = step_time(elements, "relative", 0.0025, 0.05)
        growth.add_row(str(elements), f"{spent / elements:.2f}")
    console.print(growth)


if __name__ == "__main__":
    main()
