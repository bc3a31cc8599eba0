"""Machines in words: frozen, typed records with units, defaults and bounds. Nothing here computes a motion."""

from nivel.machine.assembly_settings import AssemblySettings
from nivel.machine.beams.beam import Beam
from nivel.machine.body import Body
from nivel.machine.control import Block
from nivel.machine.coordinate_reference import resolve
from nivel.machine.coupling import Belt, Coupling, Gear, LinearCoupling, Rack
from nivel.machine.driver import Driver
from nivel.machine.event import Event
from nivel.machine.forces import (
    Bushing,
    Contact,
    Force,
    Friction,
    GlobalPoint,
    JointSpringDamper,
    Material,
    Motor,
    PairForce,
    PointForce,
    Rope,
    Servo,
    SpringDamper,
    Stop,
    ThreeAxisSpring,
    Torque,
    TorsionalSpringDamper,
)
from nivel.machine.inertia import Inertia, MassProperties, mass_properties
from nivel.machine.input import Gamepad, Input, Keys
from nivel.machine.joint import JOINT_COORDINATES, Joint, JointType
from nivel.machine.machine_record import MachineRecord
from nivel.machine.marker import Marker
from nivel.machine.orientation import Orientation, euler_parameters, rotation_matrix
from nivel.machine.placement import frame_from_axes, initial_velocity, marker_frame, placement
from nivel.machine.record import GROUND, Record
from nivel.machine.sensor import Sensor
from nivel.machine.settings import Baumgarte, SimulationSettings
from nivel.machine.shape import Box, Capsule, Cylinder, Extrusion, Mesh, Shape, Sphere, Tube
from nivel.machine.state import State
from nivel.machine.symbols import find_symbol
from nivel.machine.time_function import Expression, PythonLaw, Table, TimeFunction
from nivel.machine.units.dimension import KINDS

__all__ = [
    "GROUND",
    "JOINT_COORDINATES",
    "KINDS",
    "AssemblySettings",
    "Baumgarte",
    "Beam",
    "Belt",
    "Block",
    "Body",
    "Box",
    "Bushing",
    "Capsule",
    "Contact",
    "Coupling",
    "Cylinder",
    "Driver",
    "Event",
    "Expression",
    "Extrusion",
    "Force",
    "Friction",
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
    "Shape",
    "SimulationSettings",
    "Sphere",
    "SpringDamper",
    "State",
    "Stop",
    "Table",
    "ThreeAxisSpring",
    "TimeFunction",
    "Torque",
    "TorsionalSpringDamper",
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
