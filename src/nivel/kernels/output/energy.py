"""Kinetic and potential energy of all bodies and springs in the state last evaluated."""

from __future__ import annotations

from nivel.kernels.bodies.floating_dynamics import flexible_kinetic_energy
from nivel.kernels.bodies.rigid import kinetic_energy, potential_energy
from nivel.kernels.bodies.shared_mass import shared_kinetic_energy
from nivel.kernels.record.record import record_at
from nivel.kernels.residual.point_inertia import point_kinetic_energy
from nivel.native.function import stage


@stage
def energies(machine):
    """(kinetic, potential) [J]; ω̄ of the bodies has to be known."""
    record = record_at(machine)
    bodies, flexible = record.bodies, record.flexible
    kinetic, potential = 0.0, record.control.stored[0]
    for b in range(bodies.mass.shape[0]):
        kinetic += kinetic_energy(bodies, b)
        potential += potential_energy(bodies, b)
    for f in range(flexible.body.shape[0]):
        # in place of what it would be if it were rigid
        kinetic += flexible_kinetic_energy(bodies, flexible, f) - kinetic_energy(bodies, flexible.body[f])
    for k in range(record.shared.pair.shape[0]):
        kinetic += shared_kinetic_energy(bodies, record.markers, record.shared, k)
    for e in range(record.points.marker.shape[0]):
        kinetic += point_kinetic_energy(record.markers, record.points, e)
    return kinetic, potential
