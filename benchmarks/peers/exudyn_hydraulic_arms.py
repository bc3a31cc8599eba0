"""The two arms of hydraulic_arms_data.py in Exudyn: plane bodies, hinges, its hydraulic actuator with pressures as states.

    python benchmarks/peers/exudyn_hydraulic_arms.py [--step 1e-3] [--runs 5] [--solver trapezoidal] [--states FILE]

Prints one JSON line: process time of a step inside the solver's loop, median of the runs. --states writes the angles of the arms and the
pressures at every centisecond, of a run of its own. Valves stand still, so that no Python runs in the loop.
"""

import argparse
import contextlib
import json
import statistics
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

sys.exudynFast = True  # pyright: ignore[reportAttributeAccessIssue]  # read by exudyn on import
with contextlib.redirect_stdout(sys.stderr):
    import exudyn as exu
    import exudyn.itemInterface as items  # noqa: N813

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import hydraulic_arms_data as data  # noqa: E402

EVERY = 0.01  # s


def build() -> tuple[Any, Any, list[Any]]:
    """Container (keeps the system alive), system, sensors of arms and pressures."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    carriers = [mbs.AddObject(items.ObjectGround())]
    sensors = []
    for arm in range(2):
        half = 0.5 * data.LENGTH[arm]
        x, y = data.on_arm(arm, (half, 0.0))
        node = mbs.AddNode(items.NodeRigidBody2D(referenceCoordinates=[x, y, data.ANGLE[arm]]))
        body = mbs.AddObject(items.ObjectRigidBody2D(mass=data.MASS[arm], inertia=data.inertia(arm), nodeNumber=node))

        def marker(number: Any, point: tuple[float, float], middle: float) -> Any:
            return mbs.AddMarker(
                items.MarkerBodyPosition(bodyNumber=number, localPosition=[point[0] - middle, point[1], 0.0])
            )

        # points of bodies are given from their centres of mass
        centre = 0.0 if arm == 0 else 0.5 * data.LENGTH[0]
        end = (0.0, 0.0) if arm == 0 else (data.LENGTH[0], 0.0)
        hinge = [marker(carriers[-1], end, centre), marker(body, (0.0, 0.0), half)]
        mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=hinge))
        weight = marker(body, (half, 0.0), half)
        mbs.AddLoad(items.LoadForceVector(markerNumber=weight, loadVector=[0.0, -data.MASS[arm] * data.GRAVITY, 0.0]))
        eyes = [marker(carriers[-1], data.FOOT[arm], centre), marker(body, data.EYE[arm], half)]
        pressures = mbs.AddNode(
            items.NodeGenericODE1(
                referenceCoordinates=[0.0, 0.0], initialCoordinates=list(data.START[arm]), numberOfODE1Coordinates=2
            )
        )
        mbs.AddObject(
            items.ObjectConnectorHydraulicActuatorSimple(
                markerNumbers=eyes,
                nodeNumbers=[pressures],
                offsetLength=data.retracted_length(arm),
                strokeLength=data.STROKE,
                chamberCrossSection0=data.AREA[0],
                chamberCrossSection1=data.AREA[1],
                hoseVolume0=data.DEAD_VOLUME,
                hoseVolume1=data.DEAD_VOLUME,
                valveOpening0=data.OPENING[arm],
                valveOpening1=-data.OPENING[arm],
                actuatorDamping=data.DAMPING,
                oilBulkModulus=data.MODULUS,
                nominalFlow=data.FLOW,
                systemPressure=data.SUPPLY,
                tankPressure=data.TANK,
                useChamberVolumeChange=True,
            )
        )
        carriers.append(body)
        sensors += [_sensor(mbs, number) for number in (node, pressures)]
    mbs.Assemble()
    return container, mbs, sensors


def _sensor(mbs: Any, node: Any) -> Any:
    """Of the coordinates of a node."""
    kind = exu.OutputVariableType.Coordinates
    return mbs.AddSensor(
        items.SensorNode(nodeNumber=node, storeInternal=True, writeToFile=False, outputVariableType=kind)
    )


def settings(step: float, solver: str) -> Any:
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.numberOfSteps = round(data.DURATION / step)
    chosen.timeIntegration.endTime = data.DURATION
    chosen.timeIntegration.verboseMode = 0
    chosen.timeIntegration.newton.useModifiedNewton = True
    chosen.timeIntegration.newton.numericalDifferentiation.minimumCoordinateSize = 1.0
    chosen.timeIntegration.newton.relativeTolerance = 1e-6
    chosen.timeIntegration.newton.absoluteTolerance = 1e-10
    if solver == "trapezoidal":  # what SolveDynamic sets for this solver type
        chosen.timeIntegration.generalizedAlpha.useNewmark = True
        chosen.timeIntegration.generalizedAlpha.useIndex2Constraints = True
    else:
        chosen.timeIntegration.generalizedAlpha.spectralRadius = 0.5
    chosen.solution.file.write = False
    chosen.solution.sensors.writePeriod = EVERY
    chosen.parallel.numberOfThreads = 1
    return chosen


def step_time(step: float, solver: str) -> float:
    """Process time of one step [s], in the solver's loop only, without sensors."""
    _container, mbs, _ = build()
    chosen = settings(step, solver)
    chosen.solution.sensors.writePeriod = 10.0 * data.DURATION
    implicit = exu.MainSolverImplicitSecondOrder()
    if not implicit.InitializeSolver(mbs, chosen):
        raise RuntimeError("Exudyn could not start")
    begin = time.process_time()
    succeeded = implicit.SolveSteps(mbs, chosen)
    spent = time.process_time() - begin
    implicit.FinalizeSolver(mbs, chosen)
    if not succeeded:
        raise RuntimeError("Exudyn stopped early")
    return spent / chosen.timeIntegration.numberOfSteps


def states(step: float, solver: str) -> list[list[float]]:
    """(angle, angle, pressures of both cylinders) at every EVERY."""
    _container, mbs, sensors = build()
    chosen = settings(step, solver)
    implicit = exu.MainSolverImplicitSecondOrder()
    if not (implicit.InitializeSolver(mbs, chosen) and implicit.SolveSteps(mbs, chosen)):
        raise RuntimeError("Exudyn stopped early")
    implicit.FinalizeSolver(mbs, chosen)
    first, p1, second, p2 = (mbs.GetSensorStoredData(sensor) for sensor in sensors)
    # coordinates are those from the reference
    angles = [first[:, 3] + data.ANGLE[0], second[:, 3] + data.ANGLE[1]]
    return np.column_stack([*angles, p1[:, 1:3], p2[:, 1:3]]).tolist()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="two hydraulic arms in Exudyn: one JSON line")
    parser.add_argument("--step", type=float, default=data.STEP)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--solver", choices=("trapezoidal", "generalised-alpha"), default="trapezoidal")
    parser.add_argument("--states", type=Path)
    options = parser.parse_args()
    with contextlib.redirect_stdout(sys.stderr):
        times = [step_time(options.step, options.solver) for _ in range(options.runs)]
        if options.states:
            options.states.write_text(json.dumps(states(options.step, options.solver)))
    print(json.dumps({"version": exu.__version__, "microseconds": 1e6 * statistics.median(times)}))
