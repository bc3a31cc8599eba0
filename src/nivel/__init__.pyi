# The names of the package, each loaded when it is used.
# ruff: noqa: F401

from nivel.api import Machine as Machine
from nivel.api import import_model as import_model
from nivel.api import load as load
from nivel.api import open_result as open_result
from nivel.api import sweep as sweep
from nivel.elements import circuits as hydraulics
from nivel.elements import control as control
from nivel.elements import forces as forces
from nivel.elements.beams.beam import Beam as Beam
from nivel.elements.contacts.contact import Contact as Contact
from nivel.elements.forces.actuators import Motor as Motor
from nivel.elements.forces.actuators import Servo as Servo
from nivel.elements.forces.actuators import Stop as Stop
from nivel.elements.forces.bushing import Bushing as Bushing
from nivel.elements.forces.drive_lines import Brake as Brake
from nivel.elements.forces.drive_lines import Clutch as Clutch
from nivel.elements.forces.drive_lines import Freewheel as Freewheel
from nivel.elements.forces.drive_lines import TransmissionLoss as TransmissionLoss
from nivel.elements.forces.friction import Friction as Friction
from nivel.elements.forces.loads import PairForce as PairForce
from nivel.elements.forces.loads import PointForce as PointForce
from nivel.elements.forces.loads import Torque as Torque
from nivel.elements.forces.ropes import Rope as Rope
from nivel.elements.forces.shafts import BeltDrive as BeltDrive
from nivel.elements.forces.shafts import Shaft as Shaft
from nivel.elements.forces.spring_node import SpringNode as SpringNode
from nivel.elements.forces.spring_series import SpringSeries as SpringSeries
from nivel.elements.forces.springs import JointSpringDamper as JointSpringDamper
from nivel.elements.forces.springs import SpringDamper as SpringDamper
from nivel.elements.forces.springs import ThreeAxisSpring as ThreeAxisSpring
from nivel.elements.forces.springs import TorsionalSpringDamper as TorsionalSpringDamper
from nivel.elements.joints.couplings import Belt as Belt
from nivel.elements.joints.couplings import FunctionCoupling as FunctionCoupling
from nivel.elements.joints.couplings import Gear as Gear
from nivel.elements.joints.couplings import LinearCoupling as LinearCoupling
from nivel.elements.joints.couplings import Rack as Rack
from nivel.elements.joints.drivers import Driver as Driver
from nivel.elements.joints.joint import Joint as Joint
from nivel.errors import ModelError as ModelError
from nivel.errors import NivelError as NivelError
from nivel.errors import SolveError as SolveError
from nivel.live.page import export_page as export_page
from nivel.machine.bodies.body import Body as Body
from nivel.machine.control.block import Block as Block
from nivel.machine.core.element import Marker as Marker
from nivel.machine.laws.time_function import Expression as Expression
from nivel.machine.laws.time_function import PythonLaw as PythonLaw
from nivel.machine.laws.time_function import Table as Table
from nivel.machine.machine_record import MachineRecord as MachineRecord
from nivel.machine.settings.run import AssemblySettings as AssemblySettings
from nivel.machine.settings.run import Baumgarte as Baumgarte
from nivel.machine.settings.run import SimulationSettings as SimulationSettings
from nivel.machine.signals.input import Event as Event
from nivel.machine.signals.input import Input as Input
from nivel.machine.signals.input import State as State
from nivel.machine.signals.sensor import Sensor as Sensor
from nivel.results.comparison import Comparison as Comparison
from nivel.results.result import Result as Result
from nivel.studies import load_study as load_study

__version__: str
__all__: list[str]
