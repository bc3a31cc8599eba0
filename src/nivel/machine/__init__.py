"""Machines in words: frozen, typed records with units, defaults and bounds. Nothing here computes a motion."""

from nivel.machine.body import Body
from nivel.machine.dimension import KINDS
from nivel.machine.force import Force, PointForce, Torque
from nivel.machine.inertia import Inertia, MassProperties, mass_properties
from nivel.machine.joint import Joint, JointType
from nivel.machine.machine_record import MachineRecord
from nivel.machine.marker import Marker
from nivel.machine.orientation import Orientation, euler_parameters, rotation_matrix
from nivel.machine.placement import frame_from_axes, initial_velocity, marker_frame, placement
from nivel.machine.record import GROUND, Record
from nivel.machine.settings import Baumgarte, SimulationSettings
from nivel.machine.shape import Box, Cylinder, Shape, Sphere, Tube
from nivel.machine.time_function import Expression, Table, TimeFunction

__all__ = [
    "GROUND",
    "KINDS",
    "Baumgarte",
    "Body",
    "Box",
    "Cylinder",
    "Expression",
    "Force",
    "Inertia",
    "Joint",
    "JointType",
    "MachineRecord",
    "Marker",
    "MassProperties",
    "Orientation",
    "PointForce",
    "Record",
    "Shape",
    "SimulationSettings",
    "Sphere",
    "Table",
    "TimeFunction",
    "Torque",
    "Tube",
    "euler_parameters",
    "frame_from_axes",
    "initial_velocity",
    "marker_frame",
    "mass_properties",
    "placement",
    "rotation_matrix",
]
