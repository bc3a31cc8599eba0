"""Tables 9 to 11 of report 44 (Rouvinen 2003) once more: the report's numbers, those of its program written again, and nivel's.

    python examples/report-44/report_44.py           # three tables and the corrector's iterations, about a minute
    python examples/report-44/report_44.py --habits  # Table 11 with the habits of the report's program left out one at a time, two minutes

"without" is the program without those habits, which should be what nivel computes.

The program is report_44_program.py; docs/report-44.md says what agrees, what does not, and why.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from report_44_program import Array, Machine, Run, Settings, simulate

import nivel

MECHANISMS = Path(__file__).parents[1] / "mechanisms"
STEP = 0.01
STABILISATIONS = ("none", "baumgarte", "direct")
INTEGRATORS = ("rk4", "rkn4", "gear")
CASES = tuple((stabilisation, integrator) for stabilisation in STABILISATIONS for integrator in INTEGRATORS)
MACHINES = ("four-bar", "slider-crank")

# Report 44, Tables 9 to 11, in the order of CASES; the scan of Tables 9 and 10 ends before the cell of direct correction with Gear.
NONE = float("nan")
LARGEST_VIOLATION = {
    "four-bar": (
        9.848036e-3,
        1.164647e-2,
        1.2178076e-2,
        4.52974e-4,
        3.63236e-4,
        4.980726e-3,
        5.51388e-5,
        6.10e-5,
        NONE,
    ),
    "slider-crank": (1.5435, 5.502, 1.0053, 1.4e-3, 7.2e-3, 6.1e-2, 1.624e-5, 1.624e-5, NONE),
}
MEAN_VIOLATION = {
    "four-bar": (2.11e-4, 2.43e-4, 2.36e-4, 4.77e-6, 4.86e-6, 2.08e-5, 7.44e-8, 7.44e-8, NONE),
    "slider-crank": (9.2e-3, 2.86e-2, 3.42e-2, 2.3372e-5, 1.7174e-4, 1.1e-3, 8.60e-8, 8.60e-8, NONE),
}
LARGEST_ENERGY_ERROR = {
    "four-bar": (
        84.84454687, 149.0886473, 1762.301813,
        166.2576949, 187.7381778, 2236.332335,
        313.185301, 521.4993693, 6571.980015,
    ),
    "slider-crank": (3399.0, 12700.0, 4515.4, 58.0411, 1049.3, 4330.7, 94.3761, 51.3247, 2378.4),
}  # fmt: skip
# §7.1: mean iterations of Gear's corrector with direct correction
ITERATIONS = {"four-bar": 2.52, "slider-crank": 4.46}

X, Y, Z = (tuple(axis) for axis in np.eye(3))
ORIGIN = (0.0, 0.0, 0.0)
GROUND = -1

# What leaves out each habit of the report's program, and all of them
HABITS: dict[str, dict[str, bool]] = {
    "exact at |θ|≠1": {"homogeneous": False},
    "with Q_v": {"gyroscopic": True},
    "mass metric": {"mass_weights": True},
    "exact work": {"angles": True},
}
WITHOUT = {key: value for each in HABITS.values() for key, value in each.items()}


@dataclass(frozen=True)
class Errors:
    """What the tables hold of one run: largest and mean |C|, largest |energy error| [J], mean iterations of the corrector."""

    largest_violation: float
    mean_violation: float
    energy: float
    iterations: float


def bar_inertia(mass: float, length: float) -> float:
    """Third moment [kg m²] of a bar with the report's section of 10 cm by 5 cm; Table 5 prints it with three digits."""
    return mass * (length**2 + 0.05**2) / 12.0


def four_bar(start: float = 1.047) -> Machine:
    """Tables 5 and 6, closed at the printed crank angle: coupler and rocker and the line between their ends are isosceles."""
    tip, pivot = 2.0 * np.array([np.cos(start), np.sin(start)]), np.array([2.5, 0.0])
    span = pivot - tip
    reach = np.sqrt(span @ span)
    apex = (tip + pivot) / 2 + np.sqrt(16.0 - reach**2 / 4) * np.array([-span[1], span[0]]) / reach
    ends = ((np.zeros(2), tip), (tip, apex), (pivot, apex))
    angle = np.array([np.arctan2(*(end - begin)[::-1]) for begin, end in ends])
    crank, bar = bar_inertia(78.1, 2.0), bar_inertia(156.2, 4.0)
    return Machine(
        mass=np.array([78.1, 156.2, 156.2]),
        inertia=np.array([[8.14e-2, 26.1, crank], [0.163, 208.4, bar], [0.163, 208.4, bar]]),
        position=np.array([[*(begin + end) / 2, 0.0] for begin, end in ends]),
        theta=np.array([[np.cos(a / 2), 0.0, 0.0, np.sin(a / 2)] for a in angle]),
        torque=np.array([[0.0, 0.0, -1200.0], ORIGIN, ORIGIN]),
        duration=4.0,
        rows=(
            *revolute(GROUND, ORIGIN, X, Y, 0, (-1.0, 0.0, 0.0), Z),
            ("s", 0, (1.0, 0.0, 0.0), 1, (-2.0, 0.0, 0.0)),
            *(("d1", 1, axis, 2, Z) for axis in (X, Y)),
            *(("d2", 1, axis, (2.0, 0.0, 0.0), 2, (2.0, 0.0, 0.0)) for axis in (X, Y)),
            *revolute(2, (-2.0, 0.0, 0.0), X, Y, GROUND, (2.5, 0.0, 0.0), Z),
        ),
    )


def slider_crank() -> Machine:
    """Tables 7 and 8."""
    half = np.sqrt(0.5)
    return Machine(
        mass=np.array([21.0, 71.7, 7.8]),
        inertia=np.array([[2.2e-2, 0.513, 0.526], [7.5e-2, 20.22, 20.27], [1.3e-2, 1.3e-2, 1.3e-2]]),
        position=np.array([[0.0, 0.0, -0.25], [0.9, 0.0, -0.5], [1.8, 0.0, -0.5]]),
        # 3-1-3 angles π/2, π/2, -π/2 and zeros
        theta=np.array([[half, 0.0, half, 0.0], [1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]),
        torque=np.array([[-50.0, 0.0, 0.0], ORIGIN, ORIGIN]),
        duration=8.0,
        rows=(
            ("s", 0, (0.25, 0.0, 0.0), 1, (-0.9, 0.0, 0.0)),
            *(("d1", GROUND, axis, 2, X) for axis in (Y, Z)),
            *(("d2", GROUND, axis, ORIGIN, 2, (-1.8, 0.0, 0.5)) for axis in (Y, Z)),
            ("d1", GROUND, Y, 2, Z),
            ("s", 1, (0.9, 0.0, 0.0), 2, ORIGIN),
            ("d1", 1, Y, 2, Z),
            *revolute(0, (-0.25, 0.0, 0.0), X, Y, GROUND, ORIGIN, X),
        ),
    )


def revolute(i: int, u_i: Any, f: Any, g: Any, j: int, u_j: Any, h: Any) -> tuple[tuple[Any, ...], ...]:
    """Eq. 36: points coincide, and h of body j is perpendicular to f and g of body i."""
    return ("s", i, u_i, j, u_j), ("d1", i, f, j, h), ("d1", i, g, j, h)


def run_of_report(name: str, stabilisation: str, integrator: str, **habits: Any) -> Run:
    """A run of the report's program; the slider-crank without Q_v unless `habits` say otherwise."""
    machine = four_bar() if name == "four-bar" else slider_crank()
    given = {"gyroscopic": name == "four-bar"} | habits
    with np.errstate(over="ignore", invalid="ignore"):
        return simulate(machine, Settings(integrator=integrator, stabilisation=stabilisation, step=STEP, **given))


def iterations_of_seconds(name: str) -> list[tuple[float, int]]:
    """Figure 23, second by second: (mean, most) iterations of a step with Gear and direct correction."""
    run = run_of_report(name, "direct", "gear")
    time = run.time[-len(run.iterations) :]
    seconds = np.ceil(time - 1e-9).astype(int)
    parts = [run.iterations[seconds == k] for k in range(1, seconds.max() + 1)]
    return [(float(part.mean()), int(part.max())) for part in parts]


def of_report(name: str, stabilisation: str, integrator: str, **habits: Any) -> Errors:
    """What the tables hold of such a run. Infinite where the motion runs away."""
    run = run_of_report(name, stabilisation, integrator, **habits)
    if not np.all(np.isfinite(run.energy_error)):
        return Errors(np.inf, np.inf, np.inf, NONE)
    iterations = float(np.mean(run.iterations)) if len(run.iterations) else NONE
    return errors(run.violation, run.energy_error, iterations)


def of_nivel(name: str, stabilisation: str, integrator: str) -> Errors:
    """The library with the methods of the same names, from the machine's file; infinite where it refuses to go on."""
    settings = {
        "step": STEP,
        "output_interval": STEP,
        "formulation": "lagrange",
        "coordinates": "absolute",
        "integrator": "gear4" if integrator == "gear" else integrator,
        "stabilisation": stabilisation,
        "corrector": {"tolerance": 1e-5},
    }
    if stabilisation == "baumgarte":
        settings["baumgarte"] = {"alpha": 5.0, "beta": 5.0}
    machine = nivel.load(MECHANISMS / f"{name}.yaml", OVERRIDES.get(name)).with_settings(settings)
    try:
        result = machine.simulate(
            verify=False,
        )
    except nivel.SolveError as stop:
        print(f"nivel, {name}, {stabilisation}, {integrator}: {stop}")
        return Errors(np.inf, np.inf, np.inf, NONE)
    return errors(result.array("constraint_violation"), result.array("energy_error"), NONE)


# The four-bar of `four_bar()`, which differs from the file in digits that the report does not print
OVERRIDES = {
    "four-bar": {
        "bodies.crank.inertia": f"[8.14e-2, 26.1, {bar_inertia(78.1, 2.0)}]",
        "bodies.coupler.inertia": f"[0.163, 208.4, {bar_inertia(156.2, 4.0)}]",
        "bodies.rocker.inertia": f"[0.163, 208.4, {bar_inertia(156.2, 4.0)}]",
        "joints.crank_pivot.start": "{angle: 1.047}",
    }
}


def errors(violation: Array, energy: Array, iterations: float) -> Errors:
    """Of the histories (s, rows) of C and (s,) of the energy."""
    size = np.abs(violation)
    return Errors(float(size.max()), float(size.mean()), float(np.abs(energy).max()), iterations)


def table(
    title: str, printed: dict[str, tuple[float, ...]], field: str, runs: dict[Any, tuple[Errors, Errors, Errors]]
) -> str:
    """One table: the printed number, the program's with its ratio to it, the program's without its habits, and nivel's."""
    lines = ["", title, f"{'':26}{'report':>12}{'again':>12}{'ratio':>8}{'without':>12}{'nivel':>12}"]
    for name in MACHINES:
        for case, number in zip(CASES, printed[name], strict=True):
            again, without, ours = (getattr(each, field) for each in runs[name, case])
            ratio = "-" if np.isnan(number) else f"{again / number:.3f}"
            line = f"{name:13}{case[0]:10}{case[1]:5}{number:10.4g}{again:12.4g}{ratio:>8}{without:12.4g}{ours:12.4g}"
            lines.append(line.replace("nan", "  -").replace("    inf", "stopped"))
    return "\n".join(lines)


def print_tables() -> None:
    """Tables 9 to 11 and the iterations of §7.1."""
    runs = {
        (name, case): (of_report(name, *case), of_report(name, *case, **WITHOUT), of_nivel(name, *case))
        for name in MACHINES
        for case in CASES
    }
    print(table("Table 9: largest violation of a constraint", LARGEST_VIOLATION, "largest_violation", runs))
    print(table("Table 10: mean violation of the constraints", MEAN_VIOLATION, "mean_violation", runs))
    print(table("Table 11: largest error of the energy balance [J]", LARGEST_ENERGY_ERROR, "energy", runs))
    print("\nMean iterations of Gear's corrector, direct correction (§7.1)")
    for name in MACHINES:
        print(f"{name:13} report {ITERATIONS[name]:.2f}, again {runs[name, ('direct', 'gear')][0].iterations:.2f}")
        print(f"{'':13} second by second: {', '.join(f'{mean:.2f}' for mean, _ in iterations_of_seconds(name))}")


def print_habits() -> None:
    """Ratios to Table 11 without each habit of the report's program."""
    print("Largest error of the energy balance over that of Table 11")
    print(f"{'':28}{''.join(f'{word:>16}' for word in ('as it was', *HABITS, 'all four'))}")
    choices = ({}, *HABITS.values(), WITHOUT)
    for name in MACHINES:
        for case, number in zip(CASES, LARGEST_ENERGY_ERROR[name], strict=True):
            ratios = [of_report(name, *case, **habits).energy / number for habits in choices]
            line = f"{name:13}{case[0]:10}{case[1]:5}{''.join(f'{ratio:16.3f}' for ratio in ratios)}"
            print(line.replace("     inf", "diverges"))


if __name__ == "__main__":
    if "--habits" in sys.argv[1:]:
        print_habits()
    else:
        print_tables()
