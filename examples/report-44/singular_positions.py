"""How the methods that keep joints closed go through positions near which, and at which, constraints depend on each other.

    python examples/report-44/singular_positions.py           # both machines, half a minute
    python examples/report-44/singular_positions.py --plot    # and a picture, singular-positions.png (needs nivel[plot])

The four-bar of report 44 has crank and coupler in line at 2.610 s, where report 44 (§7.2) saw Baumgarte's method suffer. A
parallelogram linkage has all bars in line twice a turn: there two rows say the same, and it may go on as an antiparallelogram.
docs/singular-positions.md shows the numbers and says what they mean. The reference of the four-bar is nivel's own run in relative
coordinates by dop853 with a tolerance of 1e-12.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from report_44 import four_bar as report_four_bar
from report_44_program import Equations, Settings

import nivel

MECHANISMS = Path(__file__).parents[1] / "mechanisms"
IN_LINE = 2.610
# Where the four-bar is looked at: past the position in line, before its next fast turn at 3.94 s
DURATION = 3.5
INTERVAL = 0.01
NAMED: dict[str, dict[str, Any]] = {
    "none": {"stabilisation": "none"},
    "direct": {"stabilisation": "direct"},
    "geometric": {"stabilisation": "geometric"},
    "baumgarte 5, 5": {"stabilisation": "baumgarte", "baumgarte": {"alpha": 5.0, "beta": 5.0}},
    "baumgarte 20, 20": {"stabilisation": "baumgarte", "baumgarte": {"alpha": 20.0, "beta": 20.0}},
    "baumgarte eq. 111": {"stabilisation": "baumgarte"},
    "penalty": {"formulation": "penalty", "stabilisation": "none"},
    "penalty, direct": {"formulation": "penalty", "stabilisation": "direct"},
    "augmented": {"formulation": "augmented-lagrangian", "stabilisation": "none"},
    "augmented, direct": {"formulation": "augmented-lagrangian", "stabilisation": "direct"},
    "independent": {"coordinates": "independent", "stabilisation": "none"},
    "relative, none": {"coordinates": "relative", "stabilisation": "none"},
    "relative, direct": {"coordinates": "relative", "stabilisation": "direct"},
}
BAUMGARTE = (1.0, 5.0, 20.0, 50.0, 100.0, 200.0, 500.0)
PENALTY_FACTORS = (1e2, 1e4, 1e6, 1e8, 1e10, 1e12)


def baumgarte(alpha: float) -> dict[str, Any]:
    """Settings of Baumgarte's method with β = α [1/s]."""
    return {"stabilisation": "baumgarte", "baumgarte": {"alpha": alpha, "beta": alpha}}


def penalised(formulation: str, factor: float) -> dict[str, Any]:
    """Settings of a penalty method without correction."""
    return {"formulation": formulation, "stabilisation": "none", "penalty": {"factor": factor}}


@dataclass(frozen=True)
class Errors:
    """Largest violation [m, -], the largest within 0.1 s of IN_LINE, energy error [J], error of positions [m] at the end."""

    violation: float
    near: float
    energy: float
    position: float


def four_bar_run(step: float, **methods: Any) -> nivel.Result:
    """The four-bar of report 44 for DURATION with these methods; raises SolveError."""
    given = {
        "integrator": "rk4",
        "coordinates": "absolute",
        "step": step,
        "output_interval": INTERVAL,
        "duration": DURATION,
    } | methods
    return (
        nivel.load(MECHANISMS / "four-bar.yaml")
        .with_settings(given)
        .simulate(
            verify=False,
        )
    )


@cache
def reference() -> nivel.Result:
    """The four-bar without constraints of its open chain and with a tolerance of 1e-12."""
    given = {"coordinates": "relative", "integrator": "dop853", "tolerance": 1e-12}
    settings = given | {"output_interval": INTERVAL, "duration": DURATION}
    return (
        nivel.load(MECHANISMS / "four-bar.yaml")
        .with_settings(settings)
        .simulate(
            verify=False,
        )
    )


def four_bar_errors(step: float, **methods: Any) -> Errors:
    """Errors of a run; raises SolveError."""
    result = four_bar_run(step, **methods)
    violation = np.abs(result.array("constraint_violation")).max(axis=1)
    error = np.abs(result.array("position")[-1] - reference().array("position")[-1]).max()
    near = np.abs(result.time - IN_LINE) < 0.1
    energy = np.abs(result.array("energy_error")).max()
    return Errors(float(violation.max()), float(violation[near].max()), float(energy), float(error))


def independence() -> tuple[np.ndarray, np.ndarray]:
    """Times and, there, the smallest singular value of C_q [-, 1/m] of the four-bar's rows in Euler parameters: 0 where rows depend.

    C_q is that of report_44_program.py, at the positions of the reference.
    """
    result, equations = reference(), Equations(report_four_bar(), Settings())
    poses = np.concatenate([result.array("position"), result.array("orientation")], axis=2).reshape(
        len(result.time), -1
    )
    jacobians = [equations.constraints(np.concatenate([q, np.zeros_like(q)]))[1] for q in poses]
    return result.time, np.array([np.linalg.svd(Cq, compute_uv=False)[-1] for Cq in jacobians])


def four_bar_row(label: str, step: float, **methods: Any) -> str:
    """One line of the table of the four-bar."""
    try:
        found = four_bar_errors(step, **methods)
    except nivel.SolveError as stop:
        return f"{label:24}{step:<7g} {first_words(stop)}"
    return f"{label:24}{step:<7g}{found.violation:12.2e}{found.near:12.2e}{found.energy:12.2e}{found.position:12.2e}"


def first_words(stop: nivel.SolveError) -> str:
    """When and why a run stopped, without what to try."""
    return str(stop).split("\n")[0].split(";")[0]


def parallelogram(speed: float, torque: float = 0.0) -> nivel.Machine:
    """Crank and rocker of 1 m, 2 m apart, at 0.5 rad from the flat position and turning at `speed` [rad/s]; no gravity.

    `torque` [N m] about Z acts on the crank. Without it the bars turn at `speed` for ever.
    """
    tip, far = (float(np.cos(0.5)), float(np.sin(0.5)), 0.0), (2 + float(np.cos(0.5)), float(np.sin(0.5)), 0.0)
    axis = (0.0, 0.0, 1.0)

    def bar(name: str, start: tuple[float, ...], end: tuple[float, ...]) -> nivel.Body:
        shape = {"type": "box", "from": start, "to": end, "width": 0.05, "height": 0.05}
        return nivel.Body(name=name, shape=shape, density=1000)

    def hinge(name: str, body: str, point: tuple[float, ...], **start: Any) -> nivel.Joint:
        return nivel.Joint(name=name, type="revolute", bodies=("ground", body), point=point, axis=axis, **start)

    return nivel.Machine(
        "parallelogram",
        bodies=[bar("crank", (0.0, 0.0, 0.0), tip), bar("coupler", tip, far), bar("rocker", (2.0, 0.0, 0.0), far)],
        joints=[
            hinge("left", "crank", (0.0, 0.0, 0.0), start_rates={"angle": speed}),
            nivel.Joint(name="near", type="spherical", bodies=("crank", "coupler"), point=tip),
            nivel.Joint(name="far", type="cylindrical", bodies=("coupler", "rocker"), point=far, axis=axis),
            hinge("right", "rocker", (2.0, 0.0, 0.0)),
        ],
        forces=[nivel.Torque(name="drive", body="crank", vector=(0.0, 0.0, torque))],
    )


@dataclass(frozen=True)
class Passage:
    """largest angle [rad] between crank and rocker; largest violation [m, -]; largest energy error as a share of the energy."""

    apart: float
    violation: float
    energy: float


def passage(speed: float, step: float, torque: float = 0.0, **methods: Any) -> Passage:
    """A run of the parallelogram for 3 s; raises SolveError."""
    given = {
        "integrator": "rk4",
        "coordinates": "absolute",
        "step": step,
        "output_interval": step,
        "duration": 3.0,
    } | methods
    result = (
        parallelogram(speed, torque)
        .with_settings(given)
        .simulate(
            verify=False,
        )
    )
    # both angles count from the start, where the bars are parallel
    left, right = (result.array(f"{name}.angle") for name in ("left", "right"))
    apart = np.abs(np.angle(np.exp(1j * (left - right)))).max()
    violation = np.abs(result.array("constraint_violation")).max()
    energy = np.abs(result.array("energy_error")).max() / result.array("kinetic_energy").max()
    return Passage(float(apart), float(violation), float(energy))


def passage_row(label: str, speed: float, step: float, torque: float, **methods: Any) -> str:
    """One line of a table of the parallelogram."""
    try:
        found = passage(speed, step, torque, **methods)
    except nivel.SolveError as stop:
        return f"{label:20}{first_words(stop)}"
    shape = "a parallelogram" if found.apart < 0.01 else f"apart by {found.apart:.2g} rad"
    return f"{label:20}{shape:20}{found.violation:12.2e}{found.energy:12.2e}"


# title, speed [rad/s], step [s], torque [N m]
PASSAGES = (
    ("flat between two steps", 2.0, 7e-4, 0.0),
    ("flat at a step", -0.5, 1e-3, 0.0),
    ("flat between two steps, loaded", 1.0, 1e-3, 5.0),
)


def print_four_bar() -> None:
    """The rows' independence; the methods; the coefficients of Baumgarte's method and of the penalties."""
    time, value = independence()
    print(
        f"Four-bar: smallest singular value of C_q at {IN_LINE:.2f} s {value[np.searchsorted(time, IN_LINE - 1e-6)]:.3f}"
    )
    print(
        f"least {value.min():.3f} at {time[value.argmin()]:.2f} s, largest {value.max():.3f} at {time[value.argmax()]:.2f} s"
    )
    print(f"\nRK4, {DURATION} s: violation, that near {IN_LINE} s, energy error [J], position error at the end [m]")
    for step in (0.01, 0.001):
        for label, methods in NAMED.items():
            print(four_bar_row(label, step, **methods))
    print("\nBaumgarte's coefficients, alpha = beta [1/s]")
    for step in (0.01, 0.001):
        for alpha in BAUMGARTE:
            print(four_bar_row(f"alpha = beta = {alpha:g}", step, **baumgarte(alpha)))
    print("\nPenalty and augmented Lagrangian, penalty as a multiple of the mass behind each row")
    for formulation in ("penalty", "augmented-lagrangian"):
        for factor in PENALTY_FACTORS:
            print(four_bar_row(f"{formulation[:9]} {factor:g}", 0.001, **penalised(formulation, factor)))


def print_parallelogram() -> None:
    """Through the flat position between two steps, at a step, and with a torque that loads it."""
    for title, speed, step, torque in PASSAGES:
        print(
            f"\nParallelogram, {title}: {speed:g} rad/s, {torque:g} N m, step {step:g} s; violation, share of energy lost"
        )
        for label, methods in NAMED.items():
            print(passage_row(label, speed, step, torque, **methods))


def draw(path: str) -> None:
    """Violations of the four-bar about its position in line, with a step of 10 ms."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(layout="constrained", figsize=(8, 4.5))
    for name in ("none", "baumgarte 5, 5", "baumgarte 20, 20", "baumgarte eq. 111", "augmented"):
        result = four_bar_run(0.01, **NAMED[name])
        # on the scale of the picture the two are one line
        label = "penalty and augmented" if name == "augmented" else name
        axes.semilogy(
            result.time[1:], np.abs(result.array("constraint_violation")[1:]).max(axis=1), label=label, linewidth=1.2
        )
    axes.axvline(IN_LINE, color="0.6", linewidth=0.8, linestyle="--")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("largest violation [m, -]")
    axes.grid(alpha=0.3)
    axes.legend(loc="best", fontsize="small", frameon=False)
    figure.savefig(path, dpi=100)


if __name__ == "__main__":
    print_four_bar()
    print_parallelogram()
    if "--plot" in sys.argv[1:]:
        draw("singular-positions.png")
