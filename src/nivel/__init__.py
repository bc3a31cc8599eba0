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
from typing import Any

from nivel.lazy import provide

__version__ = "0.2.0"

# the names of each module; `packaging/write_settings.py` writes them into a stub, for editors and type checkers
_NAMES = {
    "nivel.api": "Machine import_model load open_result sweep",
    "nivel.elements.forces.actuators": "Motor Servo Stop",
    "nivel.elements.forces.bushing": "Bushing",
    "nivel.elements.forces.drive_lines": "Brake Clutch Freewheel TransmissionLoss",
    "nivel.elements.forces.friction": "Friction",
    "nivel.elements.forces.loads": "PairForce PointForce Torque",
    "nivel.elements.forces.ropes": "Rope",
    "nivel.elements.forces.shafts": "BeltDrive Shaft",
    "nivel.elements.forces.spring_node": "SpringNode",
    "nivel.elements.forces.spring_series": "SpringSeries",
    "nivel.elements.forces.springs": "JointSpringDamper SpringDamper ThreeAxisSpring TorsionalSpringDamper",
    "nivel.elements.joints.couplings": "Belt FunctionCoupling Gear LinearCoupling Rack",
    "nivel.elements.joints.drivers": "Driver",
    "nivel.elements.joints.joint": "Joint",
    "nivel.errors": "ModelError NivelError SolveError",
    "nivel.live.opening": "export_page",
    "nivel.elements.beams.beam": "Beam",
    "nivel.machine.bodies.body": "Body",
    "nivel.machine.control.block": "Block",
    "nivel.machine.core.marker": "Marker",
    "nivel.elements.contacts.contact": "Contact",
    "nivel.machine.laws.time_function": "Expression PythonLaw Table",
    "nivel.machine.machine_record": "MachineRecord",
    "nivel.machine.settings.run": "AssemblySettings Baumgarte SimulationSettings",
    "nivel.machine.signals.event": "Event",
    "nivel.machine.signals.input": "Input",
    "nivel.machine.signals.sensor": "Sensor",
    "nivel.machine.signals.state": "State",
    "nivel.results.comparison": "Comparison",
    "nivel.results.result": "Result",
    "nivel.studies": "load_study",
}
# rooms of records: forces, components of circuits, blocks of the control
_ROOMS = {
    "control": "nivel.elements.control",
    "forces": "nivel.elements.forces",
    "hydraulics": "nivel.elements.circuits",
}
_HOME = {name: module for module, names in _NAMES.items() for name in names.split()}

__all__ = sorted((*_HOME, *_ROOMS))  # noqa: PLE0605


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
    return __all__
