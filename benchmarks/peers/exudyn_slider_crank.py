"""The spatial slider-crank of report 44 in Exudyn. Prints one JSON line; see exudyn_machine.py for what is measured."""

import numpy as np
from exudyn_machine import Machine, System, items, main

from references import slider_crank as reference

CRANK, ROD, SLIDER = reference.CRANK, reference.ROD, reference.SLIDER
Z_TO_X = np.array(
    [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]
)  # columns -Z, Y, X: the crank's axes at the start


def joints(system: System) -> None:
    add, marker = system.mbs.AddObject, system.marker
    hinge = [marker(None, (0, 0, 0), Z_TO_X), marker(CRANK, (-0.25, 0, 0))]
    pin = [marker(CRANK, (0.25, 0, 0)), marker(ROD, (-0.9, 0, 0))]
    knee = [marker(ROD, (0.9, 0, 0)), marker(SLIDER, (0, 0, 0))]
    slide = [marker(None, (1.8, 0, -0.5)), marker(SLIDER, (0, 0, 0))]
    add(items.ObjectJointRevoluteZ(markerNumbers=hinge))
    add(items.ObjectJointSpherical(markerNumbers=pin))
    # one constrained rotation, the first: y of the first frame (rod) stays perpendicular to z of the second (slider)
    add(items.ObjectJointGeneric(markerNumbers=knee, constrainedAxes=[1, 1, 1, 1, 0, 0]))
    add(items.ObjectJointPrismaticX(markerNumbers=slide))


def angle(crank: np.ndarray) -> np.ndarray:
    """The crank's y axis is (0, cos φ, sin φ)."""
    return np.arctan2(crank[:, 2, 1], crank[:, 1, 1])


if __name__ == "__main__":
    main(Machine("slider-crank", reference.LINKAGE, 0.0, 8.0, joints, reference.solve, angle))
