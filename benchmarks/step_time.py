"""Time of one step and energy error of the two report machines, for coordinates, formulations and stabilisations, beside Exudyn.

    python benchmarks/step_time.py [--peer PYTHON] [--runs 7] [--step 1e-3] [--integrator rk4] [--json FILE]

The first run of every combination compiles and is not counted. Then every round runs each combination once and, with
`--peer` (the interpreter of an environment with Exudyn, see README.md), each Exudyn model once: a slow moment of the
machine falls on all alike, and ratios mean something. Medians over the rounds; process time inside the compiled loop.

Errors come from one more run with output at every step: the largest energy error over the largest kinetic energy, and
the largest distance of a body from the one-degree-of-freedom reference solution of the tests.
"""

import argparse
import json
import statistics
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

import nivel

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "verification"))
from references import four_bar, slider_crank  # noqa: E402

DURATIONS = {"slider-crank": 8.0, "four-bar": 4.0}
# coordinates, formulation, stabilisations
METHODS = (
    ("relative", "newton-euler", ("none", "direct")),
    ("absolute", "newton-euler", ("none", "baumgarte", "direct")),
    ("absolute", "lagrange", ("none", "baumgarte", "direct")),
    ("independent", "newton-euler", ("none",)),
)
IMPLICIT_METHODS = (
    ("relative", "newton-euler", ("direct", "geometric")),
    ("absolute", "newton-euler", ("direct", "geometric")),
)
PEER_SOLVERS = ("generalised-alpha", "trapezoidal")


@dataclass
class Row:
    """One line of the table. times: µs per step, one for each round."""

    machine: str
    program: str
    method: str
    stabilisation: str
    times: list[float] = field(default_factory=list)
    energy_error: float = float("nan")
    position_error: float = float("nan")

    @property
    def microseconds(self) -> float:
        return statistics.median(self.times)


class OwnRun:
    """A combination of nivel's options on one machine."""

    def __init__(
        self, name: str, coordinates: str, formulation: str, stabilisation: str, step: float, integrator: str
    ) -> None:
        self.row = Row(name, "nivel", f"{coordinates}, {formulation}", stabilisation)
        self._machine = nivel.load(ROOT / "examples" / "mechanisms" / f"{name}.yaml")
        self._options = {
            "duration": DURATIONS[name],
            "step": step,
            "integrator": integrator,
            "coordinates": coordinates,
            "formulation": formulation,
            "stabilisation": stabilisation,
        }

    def measure(self, *, counted: bool = True) -> None:
        timing = self._machine.simulate(verify=False, **self._options, output_interval=0.1).timing
        if counted:
            self.row.times.append(1e6 * timing["loop_seconds"] / timing["steps"])

    def find_errors(self) -> None:
        result = self._machine.simulate(verify=False, **self._options, output_interval=self._options["step"])
        kinetic = np.max(result["kinetic_energy"].values)
        self.row.energy_error = float(np.max(np.abs(result["energy_error"].values)) / kinetic)
        position = result["position"].values
        apart = np.linalg.norm(position - reference_position(self.row.machine, result.time, position), axis=2)
        self.row.position_error = float(np.max(apart))


class PeerRun:
    """An Exudyn model, run by the interpreter that has it."""

    def __init__(self, python: str, name: str, solver: str, step: float) -> None:
        self.row = Row(name, "exudyn", solver, "-")
        self._command = peer_command(python, name, solver, step)

    def measure(self, *, counted: bool = True) -> None:
        if counted:
            self.row.times.append(call_peer([*self._command, "--no-errors"])["process_microseconds_per_step"])

    def find_errors(self) -> None:
        found = call_peer(self._command)
        self.row.energy_error, self.row.position_error = found["energy_error"], found["position_error"]


def peer_command(python: str, name: str, solver: str, step: float) -> list[str]:
    """Run the Exudyn model of machine `name` once, with the interpreter `python`."""
    script = ROOT / "benchmarks" / "peers" / f"exudyn_{name.replace('-', '_')}.py"
    return [python, str(script), "--solver", solver, "--step", repr(step), "--runs", "1"]


def call_peer(command: list[str]) -> dict:
    """What a peer prints."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)} failed:\n{done.stderr[-2000:]}")
    return json.loads(done.stdout)


def reference_position(name: str, times: np.ndarray, position: np.ndarray) -> np.ndarray:
    """The reference from where the run starts: assembly moves the four-bar's crank by some 1e-5 rad."""
    if name == "slider-crank":
        return slider_crank.solve(times).position
    x, y, _ = position[0, four_bar.CRANK]
    return four_bar.solve(times, crank_angle=float(np.arctan2(y, x))).position


def runs(peer: str | None, step: float, integrator: str) -> Iterator[OwnRun | PeerRun]:
    for name in DURATIONS:
        for coordinates, formulation, stabilisations in METHODS if integrator == "rk4" else IMPLICIT_METHODS:
            for stabilisation in stabilisations:
                yield OwnRun(name, coordinates, formulation, stabilisation, step, integrator)
        for solver in PEER_SOLVERS if peer else ():
            yield PeerRun(peer, name, solver, step)


def show(rows: list[Row], title: str, console: Console) -> None:
    """One table; ratios against the faster Exudyn solver and against the more accurate one, of the same machine."""
    table = Table(title=f"{title}; ratio > 1: nivel is better", title_justify="left")
    for heading in ("machine", "program", "method", "stabilisation"):
        table.add_column(heading)
    for heading in ("µs/step", "range", "energy error / max T", "position error, m", "time ratio", "energy ratio"):
        table.add_column(heading, justify="right")
    for row in rows:
        peers = [other for other in rows if other.program == "exudyn" and other.machine == row.machine]
        ratios = ("", "")
        if peers and row.program == "nivel":
            time_ratio = min(other.microseconds for other in peers) / row.microseconds
            energy_ratio = min(other.energy_error for other in peers) / row.energy_error
            ratios = (f"{time_ratio:.1f}", f"{energy_ratio:.3g}")
        table.add_row(
            row.machine,
            row.program,
            row.method,
            row.stabilisation,
            f"{row.microseconds:.2f}",
            f"{min(row.times):.2f}-{max(row.times):.2f}",
            f"{row.energy_error:.2e}",
            f"{row.position_error:.2e}",
            *ratios,
            end_section=row.program == "exudyn" and row is peers[-1],
        )
    console.print(table)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--peer", metavar="PYTHON", help="interpreter of the environment with Exudyn")
    parser.add_argument("--runs", type=int, default=7, help="rounds (median)")
    parser.add_argument("--step", type=float, default=1e-3, help="step [s]")
    parser.add_argument(
        "--integrator", default="rk4", help="rk4, or one that takes stiff machines, e.g. generalised-alpha"
    )
    parser.add_argument("--json", metavar="FILE", type=Path, help="write the rows there as well")
    options = parser.parse_args()
    # a pipe has no width of its own
    console = Console() if sys.stdout.isatty() else Console(width=170)
    cases = list(runs(options.peer, options.step, options.integrator))
    with console.status("compiling"):
        for case in cases:
            case.measure(counted=False)
    for turn in range(options.runs):
        with console.status(f"round {turn + 1} of {options.runs}"):
            for case in cases:
                case.measure()
    with console.status("errors"):
        for case in cases:
            case.find_errors()
    rows = [case.row for case in cases]
    show(rows, f"{options.integrator}, step {options.step:g} s", console)
    if options.json:
        options.json.write_text(json.dumps([vars(row) for row in rows], indent=1) + "\n")


if __name__ == "__main__":
    main()
