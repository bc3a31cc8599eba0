"""Two arms with two cylinders, a step of nivel beside one of Exudyn, and the errors of both against tight runs of their own.

    python benchmarks/hydraulic_arms.py [--peer PYTHON] [--runs 5]

The machine is that of hydraulic_arms_data.py: four chambers whose pressures follow from first-order states, two valves. `--peer` is the
interpreter of an environment with Exudyn, see README.md. Runs of both programs in turn, process time inside the loops, medians.
The last lines say how far the tight runs of both programs are apart: nivel's flows are those of masses, Exudyn's those of volumes.
"""

import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import hydraulic_arms_data as data
import nivel
from nivel.elements.circuits.fluids import ATMOSPHERE
from nivel.files.reader import parse_machine
from step_time import call_peer

PEER = Path(__file__).resolve().parent / "peers" / "exudyn_hydraulic_arms.py"
EVERY = 0.01
# nivel's method and step [s]; Exudyn's solvers run at the step of the data
METHODS = (
    ("extrapolated-euler", 1e-3),
    ("extrapolated-euler", 2e-3),
    ("rk4", 1e-3),
    ("rk4", 2e-3),
    ("rk4", 2.5e-3),
    ("rk4", 5e-3),
)
SOLVERS = ("trapezoidal", "generalised-alpha")


def text() -> dict:
    """The machine as a file has it."""
    arms, bodies, joints, circuit = ("arm1", "arm2"), {}, {}, {}
    full = 1.0 - 0.5 * 1e-4  # of the ramp by which edges open
    for k, name in enumerate(arms):
        x, y = data.hinge(k)
        bodies[name] = {
            "position": [x, y, 0],
            "orientation": {"axis": [0, 0, 1], "angle": data.ANGLE[k]},
            "mass": data.MASS[k],
            "centre_of_mass": [0.5 * data.LENGTH[k], 0, 0],
            "inertia": [0.1, data.inertia(k), data.inertia(k)],
        }
        carrier = "ground" if k == 0 else arms[0]
        joints[f"hinge{k + 1}"] = {
            "type": "revolute",
            "bodies": [carrier, name],
            "point": [x, y, 0],
            "axis": [0, 0, 1],
        }
        circuit[f"lift{k + 1}"] = {
            "type": "cylinder",
            "bodies": [carrier, name],
            "points": [[*point, 0] for point in data.ends(k)],
            "piston": data.PISTON,
            "rod": data.ROD,
            "stroke": data.STROKE,
            "retracted_length": data.retracted_length(k),
            "dead_volume_A": data.DEAD_VOLUME,
            "dead_volume_B": data.DEAD_VOLUME,
            "friction": {"sliding": 0, "viscous": data.DAMPING},
            "start_A": data.START[k][0] + ATMOSPHERE,
            "start_B": data.START[k][1] + ATMOSPHERE,
        }
        circuit[f"valve{k + 1}"] = {
            "type": "directional-valve",
            "ways": "4/3",
            "ports": {"P": "supply", "T": "tank", "A": f"lift{k + 1}.A", "B": f"lift{k + 1}.B"},
            "flow": data.FLOW * np.sqrt(35e5),
            "pressure_drop": 35e5,
            "transition": 1e3,
            "rounding": 1e-4,
            "command": float(np.copysign(abs(data.OPENING[k]) * full + 0.5e-4, data.OPENING[k])),
        }
    circuit["supply"] = {"type": "tank", "pressure": data.SUPPLY + ATMOSPHERE}
    circuit["tank"] = {"type": "tank", "pressure": data.TANK + ATMOSPHERE}
    return {
        "format": 1,
        "name": "hydraulic-arms",
        "gravity": [0, -data.GRAVITY, 0],
        "fluids": {"oil": {"bulk_modulus": data.MODULUS, "bulk_modulus_slope": 0, "air": 1e-4}},
        "bodies": bodies,
        "joints": joints,
        "hydraulics": circuit,
    }


def run(machine: nivel.Machine, **settings: object) -> tuple[np.ndarray, float]:
    """Angles [rad] and pressures above the air [Pa] at every EVERY, and the time of a step in the loop [µs]."""
    result = machine.simulate(verify=False, duration=data.DURATION, output_interval=EVERY, **settings)
    angles = np.asarray(result.array("joint_coordinate")) + np.array([data.ANGLE[0], data.ANGLE[1] - data.ANGLE[0]])
    names = [f"hydraulics.lift{k}.pressure_{chamber}" for k in (1, 2) for chamber in "AB"]
    pressures = [np.asarray(result.array(name)) - ATMOSPHERE for name in names]
    timing = result.timing
    states = np.column_stack([np.cumsum(angles, axis=1), *pressures])
    return states, 1e6 * timing["loop_seconds"] / timing["steps"]


def peer_states(python: str, solver: str, step: float) -> np.ndarray:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "states.json"
        command = [python, str(PEER), "--runs", "1", "--solver", solver, "--step", repr(step), "--states", str(file)]
        subprocess.run(command, check=True, capture_output=True)
        return np.array(json.loads(file.read_text()))


def show(name: str, step: float, times: list[float], states: np.ndarray, tight: np.ndarray) -> None:
    """One line: µs a step, µs of computing per simulated millisecond, largest errors."""
    apart, microseconds = np.abs(states - tight), statistics.median(times)
    angle, pressure = apart[:, :2].max(), apart[:, 2:].max() / 1e5
    each = microseconds * 1e-3 / step
    print(f"{name:32} {1e3 * step:4.1f} ms {microseconds:8.2f} {each:8.2f} {angle:12.2e} {pressure:12.2e}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--peer")
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    machine = nivel.Machine.from_record(parse_machine(json.dumps(text())))
    tight, _ = run(machine, integrator="radau", tolerance=1e-9)
    own: dict[tuple[str, float], list[float]] = {key: [] for key in METHODS}
    peers: dict[str, list[float]] = {solver: [] for solver in SOLVERS}
    for _ in range(options.runs):
        for method, step in METHODS:
            own[method, step].append(run(machine, integrator=method, step=step)[1])
        for solver in SOLVERS if options.peer else ():
            command = [options.peer, str(PEER), "--runs", "1", "--solver", solver]
            peers[solver].append(call_peer(command)["microseconds"])
    print(f"{'method':32} {'step':>7} {'µs/step':>8} {'µs/ms':>8} {'angle [rad]':>12} {'pressure [bar]':>12}")
    for (method, step), times in own.items():
        show(f"nivel {method}", step, times, run(machine, integrator=method, step=step)[0], tight)
    if options.peer:
        peer_tight = peer_states(options.peer, "trapezoidal", data.STEP / 32.0)
        for solver, times in peers.items():
            show(f"exudyn {solver}", data.STEP, times, peer_states(options.peer, solver, data.STEP), peer_tight)
        apart = np.abs(tight - peer_tight)
        print(f"tight runs apart: {apart[:, :2].max():.2e} rad, {apart[:, 2:].max() / 1e5:.2e} bar")


if __name__ == "__main__":
    main()
