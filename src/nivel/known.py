"""Classes of the package for those who name them in annotations, or only ask: `isinstance(force, Rope)`.

Nothing is imported, as a rope exists only where its module was. The stub of this file, which `packaging/write_settings.py` writes, has the
classes themselves.
"""

from __future__ import annotations

import sys
from typing import Any, Final

HOMES: Final = {
    "nivel.analysis.optimise.identify": "Identified",
    "nivel.analysis.optimise.optimise": "Optimum",
    "nivel.analysis.preparation.preparation": "Prepared",
    "nivel.analysis.progress.journal": "Journal",
    "nivel.analysis.progress.log": "Listener",
    "nivel.analysis.sweep.resolution": "Resolved",
    "nivel.analysis.sweep.variants": "Variants",
    "nivel.api": "Machine",
    "nivel.elements.beams.beam": "Beam",
    "nivel.elements.beams.sections": "BeamSection",
    "nivel.elements.beams.segments": "Segments",
    "nivel.elements.circuits": "HydraulicComponent",
    "nivel.elements.circuits.actuators": "HydraulicCylinder TelescopicCylinder",
    "nivel.elements.circuits.component": "Component Rating",
    "nivel.elements.circuits.fluids": "AnyFluid Fluid Gas",
    "nivel.elements.circuits.kind": "ComponentKind NodeMaker Swept",
    "nivel.elements.circuits.nodes": "Node",
    "nivel.elements.circuits.pumps": "HydraulicMotor Pump",
    "nivel.elements.circuits.rotary": "RotaryMachine",
    "nivel.elements.circuits.spool_valves": "SpoolValve",
    "nivel.elements.contacts.contact": "Contact Contacts Material",
    "nivel.elements.contacts.shapes": "Hull",
    "nivel.elements.control": "ControlBlock",
    "nivel.elements.control.held": "Delay",
    "nivel.elements.control.units": "UnitBlock",
    "nivel.elements.forces": "Force",
    "nivel.elements.forces.actuators": "Stop",
    "nivel.elements.forces.drive_lines": "TransmissionLoss",
    "nivel.elements.forces.friction": "Friction",
    "nivel.elements.forces.hand": "Hand",
    "nivel.elements.forces.loads": "PointForce Torque",
    "nivel.elements.forces.ropes": "Rope",
    "nivel.elements.forces.shafts": "BeltDrive",
    "nivel.elements.forces.springs": "JointSpringDamper TorsionalSpringDamper",
    "nivel.elements.joints.couplings": "Belt Coupling FunctionCoupling",
    "nivel.elements.joints.drivers": "Driver",
    "nivel.files.assembly": "Assembly",
    "nivel.flexible.body.body": "Interface LeftOut MeshError ReducedBody",
    "nivel.flexible.body.invariants": "Invariants",
    "nivel.flexible.checks.findings": "Findings",
    "nivel.flexible.reduce": "Reduction",
    "nivel.kernels.record.hook": "Family",
    "nivel.live.budget": "Cost",
    "nivel.live.replay": "Replay",
    "nivel.looks.circuit.power_flow": "PowerFlow",
    "nivel.machine.bodies.body": "Body",
    "nivel.machine.bodies.shape": "Shape",
    "nivel.machine.control.block": "Block",
    "nivel.machine.control.order": "PartOf",
    "nivel.machine.control.part": "CFacts FmuFacts Part PartFunction UnitFacts UnitOutput",
    "nivel.machine.core.element": "ForceElement",
    "nivel.machine.core.marker": "Marker",
    "nivel.machine.laws.time_function": "TimeFunction",
    "nivel.machine.machine_record": "MachineRecord",
    "nivel.machine.signals.event": "Event",
    "nivel.machine.signals.input": "Input",
    "nivel.machine.signals.sensor": "Sensor",
    "nivel.machine.signals.state": "State",
    "nivel.results.analyses.linear_model": "LinearModel",
    "nivel.results.analyses.linear_sweep": "LinearSweep",
    "nivel.results.analyses.mechanism": "Studies",
    "nivel.results.comparison": "Comparison",
    "nivel.results.frames.circuit_balance": "ComponentBalance",
    "nivel.results.result": "Result",
    "nivel.results.stress": "RecoveredBody",
    "nivel.studies": "Study",
    "nivel.system.builder": "SystemBuilder",
    "nivel.system.joint_rows": "RowTable",
    "nivel.view.page": "Inline",
}
_MODULES: Final = {name: module for module, names in HOMES.items() for name in names.split()}


class _Known(type):
    """The class of what stands for a class."""

    def __instancecheck__(cls, record: Any) -> bool:
        kind = getattr(sys.modules.get(cls.__module__), cls.__name__, None)
        return kind is not None and isinstance(record, kind)


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"no class `{name}` is known here", name=name)
    globals()[name] = found = _Known(name, (), {"__module__": _MODULES[name]})
    return found
