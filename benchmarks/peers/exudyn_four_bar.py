"""The planar four-bar of report 44 in Exudyn. Prints one JSON line; see exudyn_machine.py for what is measured."""

import numpy as np
from exudyn_machine import Machine, System, items, main

from references import four_bar as reference

CRANK, COUPLER, ROCKER = reference.CRANK, reference.COUPLER, reference.ROCKER


def joints(system: System) -> None:
    add, marker = system.mbs.AddObject, system.marker
    hinge = [marker(None, (0, 0, 0)), marker(CRANK, (-1, 0, 0))]
    pin = [marker(CRANK, (1, 0, 0)), marker(COUPLER, (-2, 0, 0))]
    sleeve = [marker(COUPLER, (2, 0, 0)), marker(ROCKER, (2, 0, 0))]
    pivot = [marker(None, (2.5, 0, 0)), marker(ROCKER, (-2, 0, 0))]
    add(items.ObjectJointRevoluteZ(markerNumbers=hinge))
    add(items.ObjectJointSpherical(markerNumbers=pin))
    add(items.ObjectJointGeneric(markerNumbers=sleeve, constrainedAxes=[1, 1, 0, 1, 1, 0]))  # cylindrical about Z
    add(items.ObjectJointRevoluteZ(markerNumbers=pivot))


def angle(crank: np.ndarray) -> np.ndarray:
    return np.arctan2(crank[:, 1, 0], crank[:, 0, 0])


if __name__ == "__main__":
    main(Machine("four-bar", reference.LINKAGE, reference.PRINTED_CRANK_ANGLE, 4.0, joints, reference.solve, angle))
