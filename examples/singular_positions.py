"""How the methods that keep joints closed go through positions near which, and at which, constraints depend on each other.

    python examples/singular_positions.py           # both machines
    python examples/singular_positions.py --plot    # and a picture, singular-positions.png (needs nivel[plot])

The four-bar of report 44 has crank and coupler in line at 2.611 s, where report 44 (§7.2) saw trouble; its rows stay independent there.
A parallelogram linkage has all bars in line twice a turn: there two rows say the same, and it may go on as an antiparallelogram.
docs/singular-positions.md shows the numbers and says what they mean. The reference is a one-degree-of-freedom solution of the
tests (tests/verification/references/four_bar.py).
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np

import nivel

FOLDER = Path(__file__).parent
sys.path.append(str(FOLDER.parent / "tests" / "verification"))

from references import four_bar as reference  # noqa: E402

COLLINEAR = 2.611
# Where the four-bar is looked at: past the position in line, before its next fast turn at 3.95 s
DURATION = 3.5
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


def four_bar_run(step: float, **methods: Any) -> nivel.Result:
    """The four-bar of report 44 for DURATION with these methods; raises SolveError."""
    given = {"coordinates": "absolute", "step": step, "output_interval": 0.01, "duration": DURATION} | methods
    return nivel.load(FOLDER / "four-bar.yaml").with_settings(given).simulate()


def four_bar_errors(result: nivel.Result) -> tuple[float, float, float, float]:
    """Largest violation, the largest within 0.1 s of the position in line, energy error [J], error of positions [m] at the end."""
    x, y, _ = result.array("position")[0, 0]
    expected = reference.solve(result.time, crank_angle=np.arctan2(y, x))
    violation = np.abs(result.array("constraint_violation")).max(axis=1)
    near = np.abs(result.time - COLLINEAR) < 0.1
    error = np.abs(result.array("position")[-1] - expected.position[-1]).max()
    return violation.max(), violation[near].max(), np.abs(result.array("energy_error")).max(), error


def four_bar_row(label: str, step: float, **methods: Any) -> str:
    """One line of the table of the four-bar."""
    try:
        found = four_bar_errors(four_bar_run(step, **methods))
    except nivel.SolveError as stop:
        return f"{label:24}{step:<7g} {stop}".split("\n")[0]
    return f"{label:24}{step:<7g}" + "".join(f"{number:12.2e}" for number in found)


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


def branch(result: nivel.Result) -> str:
    """What the linkage is at the end, from the angle between its crank and its rocker."""
    left, right = (result.array(f"{name}.angle") for name in ("left", "right"))
    # both angles count from the start, where the bars are parallel
    apart = np.abs(np.angle(np.exp(1j * (left - right))))
    violation = np.abs(result.array("constraint_violation")).max()
    energy = np.abs(result.array("energy_error")).max() / result.array("kinetic_energy")[0]
    shape = "parallelogram" if apart.max() < 0.01 else f"leaves it at {result.time[np.argmax(apart > 0.01)]:.2f} s"
    return f"{shape:22}violation {violation:.1e}  energy error {energy:.1e}"


def parallelogram_run(speed: float, step: float, torque: float = 0.0, **methods: Any) -> str:
    """What came of a run of 3 s, in words."""
    given = {"coordinates": "absolute", "step": step, "output_interval": step, "duration": 3.0} | methods
    try:
        return branch(parallelogram(speed, torque).with_settings(given).simulate())
    except nivel.SolveError as stop:
        return str(stop).split("\n")[0]


def print_four_bar() -> None:
    """The methods, then the coefficients of Baumgarte's method and of the penalties."""
    print(
        f"Four-bar, {DURATION} s, RK4: largest violation, that near {COLLINEAR} s, energy error [J], position error at the end [m]"
    )
    for step in (0.01, 0.001):
        for label, methods in NAMED.items():
            print(four_bar_row(label, step, **methods))
    print("\nBaumgarte's coefficients, alpha = beta [1/s]")
    for step in (0.01, 0.001):
        for alpha in BAUMGARTE:
            own = {"stabilisation": "baumgarte", "baumgarte": {"alpha": alpha, "beta": alpha}}
            print(four_bar_row(f"alpha = beta = {alpha:g}", step, **own))
    print("\nPenalty and augmented Lagrangian, penalty as a multiple of the mass behind each row")
    for formulation in ("penalty", "augmented-lagrangian"):
        for factor in PENALTY_FACTORS:
            own = {"formulation": formulation, "stabilisation": "none", "penalty": {"factor": factor}}
            print(four_bar_row(f"{formulation[:9]} {factor:g}", 0.001, **own))


def print_parallelogram() -> None:
    """Through the flat position between two steps, at a step, and with a torque that loads it."""
    for title, speed, step, torque in (
        ("flat at 1.32 s, between two steps", 2.0, 7e-4, 0.0),
        ("flat at 1 s, at a step", -0.5, 1e-3, 0.0),
        ("flat at 1 s, at a step, 0.1 s", -0.5, 1e-1, 0.0),
        ("5 N m on the crank, flat near 1 s", 1.0, 1e-3, 5.0),
    ):
        print(f"\nParallelogram, {title}: {speed:g} rad/s, step {step:g} s")
        for label, methods in NAMED.items():
            print(f"{label:20}{parallelogram_run(speed, step, torque, **methods)}")


def draw(path: str) -> None:
    """Violations of the four-bar about its position in line, with a step of 10 ms."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(layout="constrained", figsize=(8, 4.5))
    for label in ("none", "baumgarte 5, 5", "baumgarte 20, 20", "baumgarte eq. 111", "penalty", "augmented"):
        result = four_bar_run(0.01, **NAMED[label])
        axes.semilogy(
            result.time[1:], np.abs(result.array("constraint_violation")[1:]).max(axis=1), label=label, linewidth=1.2
        )
    axes.axvline(COLLINEAR, color="0.6", linewidth=0.8, linestyle="--")
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
