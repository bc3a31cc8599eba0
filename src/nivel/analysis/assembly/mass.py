"""Mass, centre of mass and inertia of a machine, or of some of its bodies, as assembled, about any marker."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from nivel.analysis.assembly.assemble import assemble
from nivel.analysis.assembly.equations import equations
from nivel.errors import Fault, refuse
from nivel.files.joint_parts import rotors_of
from nivel.lazy import dataclass
from nivel.machine.bodies.inertia import point_mass_inertia
from nivel.machine.core.placement import marker_frame
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import unknown_name
from nivel.system.system import Array, System


@dataclass(frozen=True)
class MassProperties:
    """mass [kg] of `bodies`; centre_of_mass (3,) [m] from the point of `about`; inertia (3, 3) [kg m²] about this point, central_inertia
    about the centre of mass; all along the axes of `about`. Products carry the minus sign of the tensor: xy = -∫ x y dm.

    principal_moments (3,) [kg m²] about the centre of mass, ascending; principal_axes (3, 3) : a column each.
    """

    about: str
    bodies: tuple[str, ...]
    mass: float
    centre_of_mass: Array
    inertia: Array
    central_inertia: Array
    principal_moments: Array
    principal_axes: Array

    def summary(self) -> dict[str, Any]:
        """For programs."""
        facts = {name: getattr(self, name) for name in self.__dataclass_fields__}
        return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in facts.items()}

    def __str__(self) -> str:
        def row(values: Array) -> str:
            size = float(np.abs(self.inertia).max(initial=0.0))
            return ", ".join(f"{value if abs(value) > 1e-12 * size else 0.0:.6g}" for value in values)

        x, y, z = (f"{value if abs(value) > 1e-15 else 0.0:.6g}" for value in self.centre_of_mass)
        return "\n".join(
            [
                f"mass of {', '.join(self.bodies)}: {self.mass:.9g} kg, about {self.about} and along its axes",
                f"  centre of mass: ({x}, {y}, {z}) m",
                *(f"  inertia {axis}: {row(values)} kg m²" for axis, values in zip("xyz", self.inertia, strict=True)),
                f"  principal moments about the centre of mass: {row(self.principal_moments)} kg m²",
            ]
        )


def mass_properties(machine: MachineRecord, about: str = GROUND, bodies: Sequence[str] = ()) -> MassProperties:
    """Of these bodies, or of all but the rotors of `rotor_inertia`. about : a marker, a body (its frame), or the ground (the global frame).

    Raises ModelError for unknown names, for beams, and where the machine cannot be assembled.
    """
    faults = [
        _fault("bodies", unknown_name("body", name, list(machine.body_named)))
        for name in bodies
        if name not in machine.body_named
    ]
    known = [GROUND, *machine.marker_named, *machine.body_named]
    if about not in known:
        faults.append(_fault("about", unknown_name("marker or body", about, known)))
    if machine.beams and not bodies:
        faults.append(_fault("bodies", "beams have no part in mass properties: name the bodies"))
    refuse(faults)
    motion = equations(machine)
    motion.evaluate(0.0, assemble(machine, motion).y)
    system = motion.system
    place, axes = _frame(machine, system, about)
    rotors = rotors_of(machine)
    chosen = tuple(bodies) or tuple(name for name in machine.body_named if name not in rotors)
    parts = system.record.bodies
    mass, moment, inertia = 0.0, np.zeros(3), np.zeros((3, 3))
    for name in chosen:
        b = system.bodies.index(name)
        A, m = parts.A[b], float(parts.mass[b])
        centre = axes.T @ (parts.R[b] + A @ parts.centre_b[b] - place)
        turned = axes.T @ A
        if not system.point_masses[b]:
            inertia += turned @ parts.inertia_b[b] @ turned.T
        inertia += point_mass_inertia(m, centre)
        mass, moment = mass + m, moment + m * centre
    centre = moment / mass
    central = inertia - point_mass_inertia(mass, centre)
    moments, directions = np.linalg.eigh(central)
    return MassProperties(about, chosen, mass, centre, inertia, central, moments, directions)


def _frame(machine: MachineRecord, system: System, about: str) -> tuple[Array, Array]:
    """(place, axes as columns) of a marker, a body or the ground."""
    marker = machine.marker_named.get(about)
    body = marker.body if marker is not None else about
    place, axes = (np.zeros(3), np.eye(3)) if marker is None else marker_frame(marker)
    if body == GROUND:
        return place, axes
    b = system.bodies.index(body)
    A = system.record.bodies.A[b]
    return system.record.bodies.R[b] + A @ place, A @ axes


def _fault(field: str, message: str) -> Fault:
    return Fault.at(f"mass_properties.{field}", message)
