"""What the two Exudyn models share: building, timing, and the error of a run against the reference solution.

Timing: `SolveSteps` of Exudyn's solver object alone, after its initialisation (where it computes initial
accelerations), with no file, no sensor, no message. Errors come from a separate run with sensors at every step.

Exudyn runs at its defaults (modified Newton, dense solver, its tolerances, Euler parameters) in its fast build,
compiled without range checks. That build must be asked for before the first import of exudyn, so the models take
`items` (its item classes) from here.
"""

import argparse
import contextlib
import json
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

sys.exudynFast = True  # pyright: ignore[reportAttributeAccessIssue]  # read by exudyn on import
with contextlib.redirect_stdout(sys.stderr):
    import exudyn as exu
    import exudyn.itemInterface as items  # noqa: N813
    from exudyn.utilities import RigidBodyInertia

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "verification"))
from references.one_dof import Linkage, Motion, potential_energy  # noqa: E402

SOLVERS = {
    "generalised-alpha": exu.DynamicSolverType.GeneralizedAlpha,
    "trapezoidal": exu.DynamicSolverType.TrapezoidalIndex2,
}
CHANNELS = {
    "position": exu.OutputVariableType.Position,
    "velocity": exu.OutputVariableType.Velocity,
    "rotation": exu.OutputVariableType.RotationMatrix,
    "spin": exu.OutputVariableType.AngularVelocityLocal,
}


@dataclass(frozen=True)
class Machine:
    """A machine as its reference solution knows it, and its joints in Exudyn's words.

    start: crank angle [rad]; duration [s]; joints: adds the joints to a system that has its bodies;
    solve: times (n,) -> reference motion; angle: crank rotation matrices (n, 3, 3) -> crank angle (n,), any branch
    """

    name: str
    linkage: Linkage
    start: float
    duration: float
    joints: Callable[["System"], None]
    solve: Callable[[np.ndarray], Motion]
    angle: Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class System:
    """An Exudyn system under construction: container (keeps it alive), system, ground, bodies."""

    container: Any
    mbs: Any
    ground: Any
    bodies: tuple[Any, ...]

    def marker(self, body: int | None, point: tuple, rotation: np.ndarray | None = None) -> Any:
        """A frame on body number `body` (None: ground) at `point`, turned by `rotation`, both in body axes."""
        place = exu.HT(rotation=np.eye(3) if rotation is None else rotation, translation=list(point))
        number = self.ground if body is None else self.bodies[body]
        return self.mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=number, localHT=place))


def build(machine: Machine, *, sensors: bool) -> tuple[System, list[dict[str, Any]]]:
    """The assembled system, and the sensors of each body when asked for."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    linkage = machine.linkage
    position, rotation = linkage.pose(np.array([machine.start]))
    bodies = tuple(
        mbs.CreateRigidBody(
            name=name,
            inertia=RigidBodyInertia(mass=linkage.mass[i], inertiaTensor=np.diag(linkage.inertia[i])),
            referencePosition=position[0, i],
            referenceRotationMatrix=rotation[0, i],
            gravity=linkage.gravity,
        )
        for i, name in enumerate(linkage.names)
    )
    system = System(container, mbs, mbs.AddObject(items.ObjectGround()), bodies)
    machine.joints(system)
    mbs.CreateTorque(itemNumber=bodies[linkage.driven], loadVector=linkage.drive * linkage.drive_axis)
    channels = [_sensors(mbs, body) for body in bodies] if sensors else []
    mbs.Assemble()
    return system, channels


def _sensors(mbs: Any, body: Any) -> dict[str, Any]:
    return {
        name: mbs.AddSensor(
            items.SensorBody(bodyNumber=body, storeInternal=True, writeToFile=False, outputVariableType=variable)
        )
        for name, variable in CHANNELS.items()
    }


def settings(machine: Machine, solver: str, step: float) -> exu.SimulationSettings:
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.solverType = SOLVERS[solver]
    chosen.timeIntegration.numberOfSteps = round(machine.duration / step)
    chosen.timeIntegration.endTime = machine.duration
    chosen.timeIntegration.verboseMode = 0
    chosen.timeIntegration.verboseModeFile = 0
    chosen.solution.file.write = False
    chosen.solution.sensors.writePeriod = step
    chosen.parallel.numberOfThreads = 1
    return chosen


def step_time(machine: Machine, solver: str, step: float) -> tuple[float, float]:
    """Process and wall time of one step [s], in the solver's loop only."""
    system, _ = build(machine, sensors=False)
    chosen = settings(machine, solver, step)
    if solver == "trapezoidal":  # what SolveDynamic sets for this solver type
        chosen.timeIntegration.generalizedAlpha.useNewmark = True
        chosen.timeIntegration.generalizedAlpha.useIndex2Constraints = True
    implicit = exu.MainSolverImplicitSecondOrder()
    if not implicit.InitializeSolver(system.mbs, chosen):
        raise RuntimeError("Exudyn could not start")
    process, wall = time.process_time(), time.perf_counter()
    succeeded = implicit.SolveSteps(system.mbs, chosen)
    process, wall = time.process_time() - process, time.perf_counter() - wall
    implicit.FinalizeSolver(system.mbs, chosen)
    if not succeeded:
        raise RuntimeError("Exudyn stopped early")
    steps = chosen.timeIntegration.numberOfSteps
    return process / steps, wall / steps


def errors(machine: Machine, solver: str, step: float) -> dict[str, float]:
    """Largest energy error over largest kinetic energy, and largest position error [m], over all steps."""
    system, channels = build(machine, sensors=True)
    mbs = system.mbs
    mbs.SolveDynamic(settings(machine, solver, step))
    data = [{name: mbs.GetSensorStoredData(sensor) for name, sensor in body.items()} for body in channels]
    times = data[0]["position"][:, 0]
    reference = machine.solve(times)
    position = np.stack([body["position"][:, 1:] for body in data], axis=1)
    kinetic = _kinetic_energy(machine.linkage, data)
    relative = _energy_error(machine, data, position, kinetic) / np.max(kinetic)
    apart = np.linalg.norm(position - reference.position, axis=2)
    return {
        "energy_error": float(np.max(np.abs(relative))),
        "position_error": float(np.max(apart)),
        "largest_kinetic_energy": float(np.max(kinetic)),
    }


def _kinetic_energy(linkage: Linkage, data: list[dict[str, np.ndarray]]) -> np.ndarray:
    energy = np.zeros(len(data[0]["position"]))
    for body, mass, inertia in zip(data, linkage.mass, linkage.inertia, strict=True):
        energy += 0.5 * mass * np.sum(body["velocity"][:, 1:] ** 2, axis=1)
        energy += 0.5 * np.sum(inertia * body["spin"][:, 1:] ** 2, axis=1)
    return energy


def _energy_error(machine: Machine, data, position: np.ndarray, kinetic: np.ndarray) -> np.ndarray:
    """T + V - V0 - W; the start is at rest. The torque is constant about a fixed axis, so W = torque times angle."""
    linkage = machine.linkage
    potential = -np.einsum("b,nbx,x->n", linkage.mass, position, linkage.gravity)
    start = potential_energy(linkage, np.array([machine.start]))[0]
    crank = data[linkage.driven]["rotation"][:, 1:].reshape(-1, 3, 3)
    angle = np.unwrap(machine.angle(crank))
    work = linkage.drive * (angle - angle[0])
    return kinetic + potential - start - work


def main(machine: Machine) -> None:
    parser = argparse.ArgumentParser(description=f"{machine.name} in Exudyn: one JSON line")
    parser.add_argument("--step", type=float, default=1e-3, help="step [s]")
    parser.add_argument("--runs", type=int, default=5, help="timed runs (median)")
    parser.add_argument("--solver", choices=SOLVERS, default="generalised-alpha")
    parser.add_argument("--no-errors", action="store_true", help="time only")
    options = parser.parse_args()
    with contextlib.redirect_stdout(sys.stderr):
        found = measure(machine, options.solver, options.step, runs=options.runs, with_errors=not options.no_errors)
    print(json.dumps(found))


def measure(machine: Machine, solver: str, step: float, *, runs: int, with_errors: bool) -> dict[str, object]:
    """Medians over `runs` timed runs (one more before them is not counted), and the errors when asked for."""
    step_time(machine, solver, step)
    timed = [step_time(machine, solver, step) for _ in range(runs)]
    found: dict[str, object] = {
        "program": "exudyn",
        "version": exu.__version__,
        "machine": machine.name,
        "solver": solver,
        "step": step,
        "runs": runs,
        "process_microseconds_per_step": 1e6 * statistics.median(process for process, _ in timed),
        "wall_microseconds_per_step": 1e6 * statistics.median(wall for _, wall in timed),
        "process_microseconds_range": [1e6 * min(timed)[0], 1e6 * max(timed)[0]],
    }
    return found | errors(machine, solver, step) if with_errors else found
