"""Refusals of wheels that roll without slip: they tie velocities, so positions alone do not say how they may move."""

from __future__ import annotations

from nivel.errors import Fault, ModelError
from nivel.integrate.catalogue import INTEGRATORS
from nivel.machine.machine_record import MachineRecord
from nivel.motion.catalogue import FORMULATIONS


def refuse_rolling(machine: MachineRecord, instead: str) -> None:
    """Raises ModelError for every wheel; instead : what to do, in words."""
    faults = [
        Fault(
            "",
            0,
            0,
            f"joints.{joint.name}.type",
            f"'rolling' without slip constrains velocities, not positions, so the position of a wheel depends on its path: {instead}",
        )
        for joint in machine.joints
        if joint.type == "rolling"
    ]
    if faults:
        raise ModelError(faults)


def refuse_rolling_by_positions(machine: MachineRecord, coordinates: str) -> None:
    """Raises ModelError for methods whose multipliers close positions, and so would let wheels slip."""
    settings = machine.simulation
    integrator = INTEGRATORS[settings.integrator]
    if integrator.needs == "whole steps":
        refuse_rolling(
            machine,
            f"`integrator: {settings.integrator}` solves position constraints only; use generalised-alpha, radau or rk4",
        )
    feeds_back = FORMULATIONS[settings.formulation].factor > 0.0
    closes_positions = settings.stabilisation == "none" and not feeds_back and coordinates != "independent"
    if integrator.needs == "accelerations" and closes_positions:
        refuse_rolling(
            machine,
            f"with 'none' the multipliers of `integrator: {settings.integrator}` close positions alone (index 3); "
            f"take `stabilisation: direct`",
        )
