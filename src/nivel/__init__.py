"""nivel: machines and mechanisms, simulated with numbers one can trust.

    import nivel

    machine = nivel.load("slider-crank.yaml")
    result = machine.simulate(duration=8.0, step=1e-3)
    result["hinge.angle"]

Names are loaded when they are used: importing `nivel` costs nothing.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.2.0"

if TYPE_CHECKING:
    from nivel.api import Machine as Machine
    from nivel.api import import_model as import_model
    from nivel.api import load as load
    from nivel.api import open_result as open_result
    from nivel.api import sweep as sweep
    from nivel.errors import ModelError as ModelError
    from nivel.errors import NivelError as NivelError
    from nivel.errors import SolveError as SolveError
    from nivel.machine import AssemblySettings as AssemblySettings
    from nivel.machine import Baumgarte as Baumgarte
    from nivel.machine import Beam as Beam
    from nivel.machine import Belt as Belt
    from nivel.machine import BeltDrive as BeltDrive
    from nivel.machine import Block as Block
    from nivel.machine import Body as Body
    from nivel.machine import Brake as Brake
    from nivel.machine import Bushing as Bushing
    from nivel.machine import Clutch as Clutch
    from nivel.machine import Contact as Contact
    from nivel.machine import Driver as Driver
    from nivel.machine import Event as Event
    from nivel.machine import Expression as Expression
    from nivel.machine import Freewheel as Freewheel
    from nivel.machine import Friction as Friction
    from nivel.machine import FunctionCoupling as FunctionCoupling
    from nivel.machine import Gear as Gear
    from nivel.machine import Input as Input
    from nivel.machine import Joint as Joint
    from nivel.machine import JointSpringDamper as JointSpringDamper
    from nivel.machine import LinearCoupling as LinearCoupling
    from nivel.machine import MachineRecord as MachineRecord
    from nivel.machine import Marker as Marker
    from nivel.machine import Motor as Motor
    from nivel.machine import PairForce as PairForce
    from nivel.machine import PointForce as PointForce
    from nivel.machine import PythonLaw as PythonLaw
    from nivel.machine import Rack as Rack
    from nivel.machine import Rope as Rope
    from nivel.machine import Sensor as Sensor
    from nivel.machine import Servo as Servo
    from nivel.machine import Shaft as Shaft
    from nivel.machine import SimulationSettings as SimulationSettings
    from nivel.machine import SpringDamper as SpringDamper
    from nivel.machine import SpringNode as SpringNode
    from nivel.machine import SpringSeries as SpringSeries
    from nivel.machine import State as State
    from nivel.machine import Stop as Stop
    from nivel.machine import Table as Table
    from nivel.machine import ThreeAxisSpring as ThreeAxisSpring
    from nivel.machine import Torque as Torque
    from nivel.machine import TorsionalSpringDamper as TorsionalSpringDamper
    from nivel.machine import TransmissionLoss as TransmissionLoss
    from nivel.results.comparison.comparison import Comparison as Comparison
    from nivel.results.result import Result as Result
    from nivel.studies import load_study as load_study

_HOME = {
    "Machine": "nivel.api",
    "import_model": "nivel.api",
    "load": "nivel.api",
    "open_result": "nivel.api",
    "sweep": "nivel.api",
    "ModelError": "nivel.errors",
    "NivelError": "nivel.errors",
    "SolveError": "nivel.errors",
    "AssemblySettings": "nivel.machine",
    "Baumgarte": "nivel.machine",
    "Beam": "nivel.machine",
    "Belt": "nivel.machine",
    "Block": "nivel.machine",
    "Body": "nivel.machine",
    "Bushing": "nivel.machine",
    "Contact": "nivel.machine",
    "Driver": "nivel.machine",
    "Event": "nivel.machine",
    "Expression": "nivel.machine",
    "BeltDrive": "nivel.machine",
    "Brake": "nivel.machine",
    "Clutch": "nivel.machine",
    "Freewheel": "nivel.machine",
    "Shaft": "nivel.machine",
    "TransmissionLoss": "nivel.machine",
    "Friction": "nivel.machine",
    "FunctionCoupling": "nivel.machine",
    "Gear": "nivel.machine",
    "Input": "nivel.machine",
    "Joint": "nivel.machine",
    "JointSpringDamper": "nivel.machine",
    "LinearCoupling": "nivel.machine",
    "MachineRecord": "nivel.machine",
    "Marker": "nivel.machine",
    "Motor": "nivel.machine",
    "PairForce": "nivel.machine",
    "PointForce": "nivel.machine",
    "PythonLaw": "nivel.machine",
    "Rack": "nivel.machine",
    "Rope": "nivel.machine",
    "Sensor": "nivel.machine",
    "Servo": "nivel.machine",
    "SimulationSettings": "nivel.machine",
    "SpringDamper": "nivel.machine",
    "SpringNode": "nivel.machine",
    "SpringSeries": "nivel.machine",
    "State": "nivel.machine",
    "Stop": "nivel.machine",
    "Table": "nivel.machine",
    "Torque": "nivel.machine",
    "ThreeAxisSpring": "nivel.machine",
    "TorsionalSpringDamper": "nivel.machine",
    "Comparison": "nivel.results.comparison.comparison",
    "Result": "nivel.results.result",
    "load_study": "nivel.studies",
}

__all__ = [
    "AssemblySettings",
    "Baumgarte",
    "Beam",
    "Belt",
    "BeltDrive",
    "Block",
    "Body",
    "Brake",
    "Bushing",
    "Clutch",
    "Comparison",
    "Contact",
    "Driver",
    "Event",
    "Expression",
    "Freewheel",
    "Friction",
    "FunctionCoupling",
    "Gear",
    "Input",
    "Joint",
    "JointSpringDamper",
    "LinearCoupling",
    "Machine",
    "MachineRecord",
    "Marker",
    "ModelError",
    "Motor",
    "NivelError",
    "PairForce",
    "PointForce",
    "PythonLaw",
    "Rack",
    "Result",
    "Rope",
    "Sensor",
    "Servo",
    "Shaft",
    "SimulationSettings",
    "SolveError",
    "SpringDamper",
    "SpringNode",
    "SpringSeries",
    "State",
    "Stop",
    "Table",
    "ThreeAxisSpring",
    "Torque",
    "TorsionalSpringDamper",
    "TransmissionLoss",
    "import_model",
    "load",
    "load_study",
    "open_result",
    "sweep",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'nivel' has no attribute '{name}'", name=name, obj=sys.modules[__name__])
    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
