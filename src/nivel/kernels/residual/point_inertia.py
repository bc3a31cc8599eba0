"""Mass that points of a machine have in common: a constant matrix between their velocities, as shape functions of elements give it.

To the kinetic energy of the bodies that the points are on every set of points adds ½ Σ C_ij ẋ_i·ẋ_j, so every point feels -Σ C_ij ẍ_j:
exact for any motion, without terms of velocities.
"""

from nivel.kernels.algebra.spatial import dot
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.kernels.residual.residual import acceleration_of
from nivel.native.function import stage


@family
def apply(machine, job, t):
    """Subtract what all sets of points ask for at their accelerations from the wrenches of the bodies."""
    record = record_at(machine)
    points, markers, wrench = record.points, record.markers, record.bodies.wrench
    for e in range(points.marker.shape[0]):
        index, C = points.marker[e], points.matrix[e]
        for j in range(index.shape[0]):
            if index[j] == NONE:
                break
            a = acceleration_of(machine, markers.body[index[j]])
            for i in range(index.shape[0]):
                if index[i] == NONE:
                    break
                F = wrench[markers.body[index[i]]]
                for k in range(3):
                    F[k] -= C[i, j] * a[3 + k]
    return OK


@stage
def point_kinetic_energy(markers, points, e):
    """What set e adds to the kinetic energy of the bodies [J]."""
    index, C, total = points.marker[e], points.matrix[e], 0.0
    for i in range(index.shape[0]):
        if index[i] == NONE:
            break
        for j in range(index.shape[0]):
            if index[j] == NONE:
                break
            total += 0.5 * C[i, j] * dot(markers.rdot[index[i]], markers.rdot[index[j]])
    return total
