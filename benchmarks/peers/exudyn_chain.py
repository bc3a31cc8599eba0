"""The chain in Exudyn: a kinematic tree with its explicit RK4, and bodies with joints by its trapezoidal rule at the same step.

Timing: the solver's loop alone, as in exudyn_machine.py. The check is of the kinematic tree; its energy is not compared, because
Exudyn gives no kinetic energy of links. See peer_chain.py for what is printed.
"""

import contextlib
import math
import sys
import time
from typing import Any

import numpy as np
from peer_chain import Check, main

from chain_data import CHECK_STEPS, GRAVITY, INERTIA, LENGTH, MASS, STEP

sys.exudynFast = True  # pyright: ignore[reportAttributeAccessIssue]  # read by exudyn on import
with contextlib.redirect_stdout(sys.stderr):
    import exudyn as exu
    import exudyn.itemInterface as items  # noqa: N813
    from exudyn.utilities import RigidBodyInertia

DOWN = [0.0, -GRAVITY, 0.0]


def tree(links: int) -> tuple[Any, Any, Any]:
    """Container (keeps the system alive), system, sensor of the last bar's centre."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    zeros = [0.0] * links
    node = mbs.AddNode(
        items.NodeGenericODE2(
            referenceCoordinates=zeros,
            initialCoordinates=zeros,
            initialCoordinates_t=zeros,
            numberOfODE2Coordinates=links,
        )
    )
    turns, offsets, inertias = exu.Matrix3DList(), exu.Vector3DList(), exu.Matrix3DList()
    centres, nothing = exu.Vector3DList(), exu.Vector3DList()
    for i in range(links):
        turns.Append(np.eye(3))
        offsets.Append([LENGTH if i else 0.0, 0.0, 0.0])
        inertias.Append(np.diag(INERTIA))
        centres.Append([LENGTH / 2, 0.0, 0.0])
    found = mbs.AddObject(
        items.ObjectKinematicTree(
            nodeNumber=node,
            gravity=DOWN,
            jointTypes=[exu.JointType.RevoluteZ] * links,
            linkParents=list(range(-1, links - 1)),
            jointTransformations=turns,
            jointOffsets=offsets,
            linkInertiasCOM=inertias,
            linkCOMs=centres,
            linkMasses=[MASS] * links,
            linkForces=nothing,
            linkTorques=nothing,
        )
    )
    sensor = mbs.AddSensor(
        items.SensorKinematicTree(
            objectNumber=found,
            linkNumber=links - 1,
            localPosition=[LENGTH / 2, 0, 0],
            outputVariableType=exu.OutputVariableType.Position,
            writeToFile=False,
        )
    )
    mbs.Assemble()
    return container, mbs, sensor


def joints(links: int) -> tuple[Any, Any]:
    """Container, system: a body and five multipliers a link."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    before = mbs.AddObject(items.ObjectGround())
    for i in range(links):
        body = mbs.CreateRigidBody(
            inertia=RigidBodyInertia(mass=MASS, inertiaTensor=np.diag(INERTIA)),
            referencePosition=[(i + 0.5) * LENGTH, 0, 0],
            gravity=DOWN,
        )
        ends = [
            mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=b, localPosition=p))
            for b, p in ((before, [LENGTH / 2 if i else 0, 0, 0]), (body, [-LENGTH / 2, 0, 0]))
        ]
        mbs.AddObject(items.ObjectJointRevoluteZ(markerNumbers=ends))
        before = body
    mbs.Assemble()
    return container, mbs


def settings(steps: int) -> exu.SimulationSettings:
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.numberOfSteps = steps
    chosen.timeIntegration.endTime = steps * STEP
    chosen.timeIntegration.verboseMode = 0
    chosen.timeIntegration.verboseModeFile = 0
    chosen.solution.file.write = False
    chosen.parallel.numberOfThreads = 1
    return chosen


def explicit(mbs: Any, steps: int) -> float:
    """µs of process time a step."""
    chosen = settings(steps)
    chosen.timeIntegration.solverType = exu.DynamicSolverType.RK44
    return _run(exu.MainSolverExplicit(), mbs, chosen)


def implicit(mbs: Any, steps: int, links: int) -> float:
    """µs of process time a step."""
    chosen = settings(steps)
    chosen.timeIntegration.generalizedAlpha.useNewmark = True
    chosen.timeIntegration.generalizedAlpha.useIndex2Constraints = True
    chosen.linearSolver.solverType = exu.LinearSolverType.EigenSparse if links > 4 else exu.LinearSolverType.EXUdense
    return _run(exu.MainSolverImplicitSecondOrder(), mbs, chosen)


def _run(solver: Any, mbs: Any, chosen: exu.SimulationSettings) -> float:
    if not solver.InitializeSolver(mbs, chosen):
        raise RuntimeError("Exudyn could not start")
    begin = time.process_time()
    succeeded = solver.SolveSteps(mbs, chosen)
    spent = time.process_time() - begin
    solver.FinalizeSolver(mbs, chosen)
    if not succeeded:
        return math.nan
    return 1e6 * spent / chosen.timeIntegration.numberOfSteps


def measure(links: int, steps: int, runs: int) -> dict[str, list[float]]:
    times: dict[str, list[float]] = {"tree, rk4": [], "joints, trapezoidal": []}
    for _ in range(runs):
        keep = tree(links)
        # its time grows with the third power
        times["tree, rk4"].append(explicit(keep[1], min(steps, max(20, 40_000_000 // links**3))))
        keep = joints(links)
        times["joints, trapezoidal"].append(implicit(keep[1], min(steps, CHECK_STEPS), links))
    return times


def check(links: int) -> Check:
    _, mbs, sensor = tree(links)
    explicit(mbs, CHECK_STEPS)
    return Check(math.nan, np.asarray(mbs.GetSensorValues(sensor)).tolist())


if __name__ == "__main__":
    with contextlib.redirect_stdout(sys.stderr):
        version = exu.__version__
    main("exudyn", version, measure, check)
