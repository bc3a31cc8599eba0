"""The kernels that one run needs, compiled one after another; later processes load them from the cache."""

from __future__ import annotations

import sys
from importlib import import_module
from time import perf_counter

from nivel.analysis.listener import Listener
from nivel.kernels import cache
from nivel.machine.machine_record import MachineRecord
from nivel.march.catalogue import INTEGRATORS
from nivel.march.stabilise.catalogue import STABILISATIONS
from nivel.motion.catalogue import FORMULATIONS
from nivel.system.forces import FORCES

LOADS = ("force", "torque")
RARE = {
    "nivel.kernels.measure": "measured coordinates",
    "nivel.kernels.friction": "friction",
    "nivel.kernels.sensor": "sensors",
}


def compile_path(
    machine: MachineRecord, formulation: str, integrator: str, stabilisation: str, listener: Listener
) -> float:
    """Import the kernel modules of a run of `machine`; tell the listener about each that is not in the cache.

    A check has no integrator and no stabilisation: empty names. Unknown names are left alone. Returns the wall time [s].
    """
    begin = perf_counter()
    parts = [("nivel.kernels.observe", "output"), *_rare_parts(machine)]
    if formulation in FORMULATIONS:
        parts.insert(0, (FORMULATIONS[formulation].module, f"the equations of motion, {formulation}"))
        if stabilisation in STABILISATIONS and STABILISATIONS[stabilisation].CORRECTS:
            parts.insert(1, (FORMULATIONS[formulation].correction, "the direct correction"))
    if integrator in INTEGRATORS:
        parts.append(("nivel.march.loop", "the time loop"))
        parts.append((INTEGRATORS[integrator].module, f"the integrator {integrator}"))
    missing = [part for part in parts if part[0] not in sys.modules and not cache.is_warm(part[0].rsplit(".", 1)[1])]
    for module, what in parts:
        if (module, what) in missing:
            place = f"{missing.index((module, what)) + 1}/{len(missing)}"
            listener.say(f"compiling {what} ({place}; only the first run does this)")
        import_module(module)
    return perf_counter() - begin


def rare_modules() -> list[str]:
    """Modules of all kinds of forces and of everything else that only some machines have."""
    families = dict.fromkeys(family for kind in FORCES.values() for family in kind.families)
    return [*(f"nivel.kernels.forces.{family}" for family in families), *RARE]


def _rare_parts(machine: MachineRecord) -> list[tuple[str, str]]:
    """Modules of what only some machines have: kinds of forces, measured coordinates, friction, sensors."""
    types = {force.type for force in machine.forces}
    families = dict.fromkeys(family for force in types for family in FORCES[force].families)
    needed = {
        "nivel.kernels.measure": bool(machine.joints or machine.drivers or machine.sensors or types - {*LOADS}),
        "nivel.kernels.friction": "friction" in types,
        "nivel.kernels.sensor": bool(machine.sensors),
    }
    parts = [(f"nivel.kernels.forces.{family}", f"forces: {family}") for family in families]
    return parts + [(module, what) for module, what in RARE.items() if needed[module]]
