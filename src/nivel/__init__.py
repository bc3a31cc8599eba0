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

from nivel.lazy import provide

__version__ = "0.2.0"

if TYPE_CHECKING:
    from nivel.api import Machine as Machine
    from nivel.api import import_model as import_model
    from nivel.api import load as load
    from nivel.api import open_result as open_result
    from nivel.api import sweep as sweep
    from nivel.elements import circuits as hydraulics
    from nivel.elements import control as control
    from nivel.elements import forces as forces
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
    from nivel.errors import ModelError as ModelError
    from nivel.errors import NivelError as NivelError
    from nivel.errors import SolveError as SolveError
    from nivel.live.opening import export_page as export_page
    from nivel.machine.assembly_settings import AssemblySettings as AssemblySettings
    from nivel.machine.beams.beam import Beam as Beam
    from nivel.machine.bodies.body import Body as Body
    from nivel.machine.control.block import Block as Block
    from nivel.machine.core.marker import Marker as Marker
    from nivel.machine.forces.contact import Contact as Contact
    from nivel.machine.joints.coupling import Belt as Belt
    from nivel.machine.joints.coupling import FunctionCoupling as FunctionCoupling
    from nivel.machine.joints.coupling import Gear as Gear
    from nivel.machine.joints.coupling import LinearCoupling as LinearCoupling
    from nivel.machine.joints.coupling import Rack as Rack
    from nivel.machine.joints.driver import Driver as Driver
    from nivel.machine.joints.joint import Joint as Joint
    from nivel.machine.laws.time_function import Expression as Expression
    from nivel.machine.laws.time_function import PythonLaw as PythonLaw
    from nivel.machine.laws.time_function import Table as Table
    from nivel.machine.machine_record import MachineRecord as MachineRecord
    from nivel.machine.settings.run import Baumgarte as Baumgarte
    from nivel.machine.settings.run import SimulationSettings as SimulationSettings
    from nivel.machine.signals.event import Event as Event
    from nivel.machine.signals.input import Input as Input
    from nivel.machine.signals.sensor import Sensor as Sensor
    from nivel.machine.signals.state import State as State
    from nivel.results.comparison import Comparison as Comparison
    from nivel.results.result import Result as Result
    from nivel.studies import load_study as load_study

_HOME = {
    "Machine": "nivel.api",
    "export_page": "nivel.live.opening",
    "import_model": "nivel.api",
    "load": "nivel.api",
    "open_result": "nivel.api",
    "sweep": "nivel.api",
    "ModelError": "nivel.errors",
    "NivelError": "nivel.errors",
    "SolveError": "nivel.errors",
    "AssemblySettings": "nivel.machine.assembly_settings",
    "Baumgarte": "nivel.machine.settings.run",
    "Beam": "nivel.machine.beams.beam",
    "Belt": "nivel.machine.joints.coupling",
    "Block": "nivel.machine.control.block",
    "Body": "nivel.machine.bodies.body",
    "Bushing": "nivel.elements.forces.bushing",
    "Contact": "nivel.machine.forces.contact",
    "Driver": "nivel.machine.joints.driver",
    "Event": "nivel.machine.signals.event",
    "Expression": "nivel.machine.laws.time_function",
    "BeltDrive": "nivel.elements.forces.shafts",
    "Brake": "nivel.elements.forces.drive_lines",
    "Clutch": "nivel.elements.forces.drive_lines",
    "Freewheel": "nivel.elements.forces.drive_lines",
    "Shaft": "nivel.elements.forces.shafts",
    "TransmissionLoss": "nivel.elements.forces.drive_lines",
    "Friction": "nivel.elements.forces.friction",
    "FunctionCoupling": "nivel.machine.joints.coupling",
    "Gear": "nivel.machine.joints.coupling",
    "Input": "nivel.machine.signals.input",
    "Joint": "nivel.machine.joints.joint",
    "JointSpringDamper": "nivel.elements.forces.springs",
    "LinearCoupling": "nivel.machine.joints.coupling",
    "MachineRecord": "nivel.machine.machine_record",
    "Marker": "nivel.machine.core.marker",
    "Motor": "nivel.elements.forces.actuators",
    "PairForce": "nivel.elements.forces.loads",
    "PointForce": "nivel.elements.forces.loads",
    "PythonLaw": "nivel.machine.laws.time_function",
    "Rack": "nivel.machine.joints.coupling",
    "Rope": "nivel.elements.forces.ropes",
    "Sensor": "nivel.machine.signals.sensor",
    "Servo": "nivel.elements.forces.actuators",
    "SimulationSettings": "nivel.machine.settings.run",
    "SpringDamper": "nivel.elements.forces.springs",
    "SpringNode": "nivel.elements.forces.spring_node",
    "SpringSeries": "nivel.elements.forces.spring_series",
    "State": "nivel.machine.signals.state",
    "Stop": "nivel.elements.forces.actuators",
    "Table": "nivel.machine.laws.time_function",
    "Torque": "nivel.elements.forces.loads",
    "ThreeAxisSpring": "nivel.elements.forces.springs",
    "TorsionalSpringDamper": "nivel.elements.forces.springs",
    "Comparison": "nivel.results.comparison",
    "Result": "nivel.results.result",
    "load_study": "nivel.studies",
}

# rooms of records: forces, components of circuits, blocks of the control
_ROOMS = {
    "control": "nivel.elements.control",
    "forces": "nivel.elements.forces",
    "hydraulics": "nivel.elements.circuits",
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
    "control",
    "export_page",
    "forces",
    "hydraulics",
    "import_model",
    "load",
    "load_study",
    "open_result",
    "sweep",
]


# functions that results call and that stand in rooms above them
provide(
    {
        "comparison": "nivel.report.compare_page:write_comparison",
        "efforts": "nivel.report.motion_pages:efforts_html",
        "linear model": "nivel.report.linear_page:linear_html",
        "linear sweep": "nivel.report.linear_page:sweep_html",
        "mechanism": "nivel.report.motion_pages:mechanism_html",
        "notebook": "nivel.view.page:Inline",
        "report": "nivel.report.write:write_report",
        "result file": "nivel.results.store:save",
        "scene": "nivel.view.page:write_scene",
        "trust of remains": "nivel.judge.after.report:assess_remains",
    }
)


def __getattr__(name: str) -> Any:
    if name in _ROOMS:
        return import_module(_ROOMS[name])
    if name not in _HOME:
        hint = _hint(name) if name[:1].isupper() else ""
        raise AttributeError(f"module 'nivel' has no attribute '{name}'{hint}", name=name, obj=sys.modules[__name__])
    return getattr(import_module(_HOME[name]), name)


def _hint(name: str) -> str:
    """Where a record stands that `nivel` itself does not have; the records of all forces for `Force`, and so on."""
    for room, kind in (("forces", "Force"), ("hydraulics", "Component"), ("control", "Block")):
        records = dir(__getattr__(room))
        if name in records:
            return f"; write `nivel.{room}.{name}`"
        if name == kind:
            return f"; there are, in `nivel.{room}`, {', '.join(records)}"
    return ""


def __dir__() -> list[str]:
    return sorted(__all__)
