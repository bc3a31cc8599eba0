"""Two hinged beams in Exudyn: geometrically exact elements, generalised-α with its modified Newton, the same load and steps.

Prints JSON: µs of process time a step, and the place of the tip at the end. Timing: the solver's loop alone, as in exudyn_machine.py.
"""

import contextlib
import json
import sys
import time
from itertools import pairwise

import numpy as np

sys.exudynFast = True  # pyright: ignore[reportAttributeAccessIssue]  # read by exudyn on import
with contextlib.redirect_stdout(sys.stderr):
    import exudyn as exu
    import exudyn.itemInterface as items  # noqa: N813


def beams(elements: int, load: float) -> tuple[exu.SystemContainer, exu.MainSystem, int]:
    """Container (keeps the system alive), system, node of the tip."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    section = exu.BeamSection()
    section.stiffnessMatrix = np.diag([1e6, 1e6, 1e6, 1e3, 1e3, 1e3])
    section.inertia = np.eye(3)
    section.massPerLength = 1.0

    def beam(start: float) -> list[int]:
        count = elements // 2
        nodes = [
            mbs.AddNode(items.NodeRigidBodyEP(referenceCoordinates=[start + 5.0 * k / count, 0, 0, 1, 0, 0, 0]))
            for k in range(count + 1)
        ]
        for pair in pairwise(nodes):
            mbs.AddObject(
                items.ObjectBeamGeometricallyExact(nodeNumbers=list(pair), length=5.0 / count, sectionData=section)
            )
        return nodes

    inner, outer = beam(0.0), beam(5.0)
    ground = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=mbs.AddObject(items.ObjectGround())))
    ends = [mbs.AddMarker(items.MarkerNodeRigid(nodeNumber=node)) for node in (inner[0], inner[-1], outer[0])]
    for pair in ((ground, ends[0]), (ends[1], ends[2])):
        mbs.AddObject(items.GenericJoint(markerNumbers=list(pair), constrainedAxes=[1, 1, 1, 1, 1, 0]))
    tip = mbs.AddMarker(items.MarkerNodePosition(nodeNumber=outer[-1]))
    mbs.AddLoad(items.LoadForceVector(markerNumber=tip, loadVector=[0, -load, 0]))
    mbs.Assemble()
    return container, mbs, outer[-1]


def run(elements: int, step: float, steps: int, load: float) -> dict[str, object]:
    """µs of process time a step, and the tip."""
    keep, mbs, node = beams(elements, load)
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.numberOfSteps = steps
    chosen.timeIntegration.endTime = steps * step
    chosen.timeIntegration.verboseMode = 0
    chosen.solution.file.write = False
    chosen.parallel.numberOfThreads = 1
    chosen.timeIntegration.newton.useModifiedNewton = True
    chosen.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    chosen.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    solver = exu.MainSolverImplicitSecondOrder()
    if not solver.InitializeSolver(mbs, chosen):
        raise RuntimeError("Exudyn could not start")
    begin = time.process_time()
    succeeded = solver.SolveSteps(mbs, chosen)
    spent = time.process_time() - begin
    solver.FinalizeSolver(mbs, chosen)
    tip = mbs.GetNodeOutput(node, exu.OutputVariableType.Position)
    del keep
    return {"microseconds": 1e6 * spent / steps if succeeded else None, "tip": np.asarray(tip).tolist()}


if __name__ == "__main__":
    print(json.dumps(run(int(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4]))))
