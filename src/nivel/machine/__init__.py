"""Machines in words: frozen, typed records with units, defaults and bounds. Nothing here computes a motion."""

from nivel.machine.assembly_settings import AssemblySettings
from nivel.machine.beams.beam import Beam
from nivel.machine.bodies.body import Body
from nivel.machine.bodies.inertia import Inertia, MassProperties, mass_properties
from nivel.machine.bodies.shape import (
    Box,
    Capsule,
    Cylinder,
    Ellipsoid,
    Extrusion,
    Mesh,
    Shape,
    Sphere,
    Standing,
    Tube,
)
from nivel.machine.control import Block
from nivel.machine.core.marker import Marker
from nivel.machine.core.orientation import Orientation, euler_parameters, rotation_matrix
from nivel.machine.core.placement import frame_from_axes, initial_velocity, marker_frame, placement
from nivel.machine.core.record import GROUND, Record
from nivel.machine.forces import (
    BeltDrive,
    Brake,
    Bushing,
    Clutch,
    Contact,
    Force,
    Freewheel,
    Friction,
    GlobalPoint,
    JointSpringDamper,
    Material,
    Motor,
    PairForce,
    PointForce,
    Rope,
    Servo,
    Shaft,
    SpringDamper,
    SpringNode,
    SpringSeries,
    Stop,
    ThreeAxisSpring,
    Torque,
    TorsionalSpringDamper,
    TransmissionLoss,
)
from nivel.machine.joints.coupling import Belt, Coupling, FunctionCoupling, Gear, LinearCoupling, Rack
from nivel.machine.joints.driver import Driver
from nivel.machine.joints.joint import JOINT_COORDINATES, Joint, JointType
from nivel.machine.laws.symbols import find_symbol
from nivel.machine.laws.time_function import Expression, PythonLaw, Table, TimeFunction
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import Baumgarte, SimulationSettings
from nivel.machine.signals.event import Event
from nivel.machine.signals.input import Gamepad, Input, Keys
from nivel.machine.signals.sensor import Sensor
from nivel.machine.signals.state import State
from nivel.machine.units.dimension import KINDS
from nivel.machine.uses.coordinate_reference import resolve

__all__ = [
    "GROUND",
    "JOINT_COORDINATES",
    "KINDS",
    "AssemblySettings",
    "Baumgarte",
    "Beam",
    "Belt",
    "BeltDrive",
    "Block",
    "Body",
    "Box",
    "Brake",
    "Bushing",
    "Capsule",
    "Clutch",
    "Contact",
    "Coupling",
    "Cylinder",
    "Driver",
    "Ellipsoid",
    "Event",
    "Expression",
    "Extrusion",
    "Force",
    "Freewheel",
    "Friction",
    "FunctionCoupling",
    "Gamepad",
    "Gear",
    "GlobalPoint",
    "Inertia",
    "Input",
    "Joint",
    "JointSpringDamper",
    "JointType",
    "Keys",
    "LinearCoupling",
    "MachineRecord",
    "Marker",
    "MassProperties",
    "Material",
    "Mesh",
    "Motor",
    "Orientation",
    "PairForce",
    "PointForce",
    "PythonLaw",
    "Rack",
    "Record",
    "Rope",
    "Sensor",
    "Servo",
    "Shaft",
    "Shape",
    "SimulationSettings",
    "Sphere",
    "SpringDamper",
    "SpringNode",
    "SpringSeries",
    "Standing",
    "State",
    "Stop",
    "Table",
    "ThreeAxisSpring",
    "TimeFunction",
    "Torque",
    "TorsionalSpringDamper",
    "TransmissionLoss",
    "Tube",
    "euler_parameters",
    "find_symbol",
    "frame_from_axes",
    "initial_velocity",
    "marker_frame",
    "mass_properties",
    "placement",
    "resolve",
    "rotation_matrix",
]
