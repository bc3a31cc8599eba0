"""The residual of a machine for implicit methods: its tables, its twin on complex numbers, and calls of it from Python."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np

from nivel.analysis.equations import MotionEquations
from nivel.kernels.arrays import complex_twin
from nivel.kernels.handle import Handle
from nivel.kernels.hook import FAMILIES
from nivel.kernels.record import MEASURE, RESIDUAL, Hooks, Record
from nivel.machine.settings import SimulationSettings
from nivel.system.implicit import newton_tables, parts_of, places, residual_tables
from nivel.system.system import Array

RESIDUALS = {"absolute": "nivel.motion.newton_euler_residual", "relative": "nivel.motion.relative_residual"}


def equip(motion: MotionEquations, y: Array, coordinates: str, settings: SimulationSettings) -> MotionEquations:
    """The same equations, with the residual of implicit methods and the record of its complex twin."""
    del settings
    system = motion.system
    record, positions = system.record, system.positions
    states = len(record.elements.state)
    velocities = len(y) - positions - states - 2
    place = places(system.map, velocities, positions)
    part = parts_of(record, coordinates == "relative")
    rows = len(record.saddle.row)
    residual = residual_tables(system.body_count, len(y), velocities, states, record.saddle.row, part)
    size = velocities + states + rows
    evaluated = range(velocities + states)
    newton = newton_tables(place, len(y), states, rows, [[j] for j in evaluated], [range(size) for _ in evaluated])
    family = import_module(RESIDUALS[coordinates]).residual
    record = record._replace(residual=residual, newton=newton, hooks=record.hooks._replace(address=record.hooks.address.copy()))
    record.hooks.address[RESIDUAL] = family.address
    twin = _twin(record)
    record.newton.address[:] = twin.address, family.complex_address
    return MotionEquations(replace(system, record=record), motion.kernels, twin)


def _twin(record: Record) -> Handle:
    """The record with complex work, and with the families of forces compiled for it."""
    twin = complex_twin(record)
    address = np.zeros_like(record.hooks.address)
    address[MEASURE] = _complex(record.hooks.address[MEASURE])
    families = np.array([_complex(each) for each in record.elements.address], dtype=np.uint64)
    return Handle(twin._replace(elements=twin.elements._replace(address=families), hooks=Hooks(address)))


def _complex(address: Any) -> int:
    """Address of the same family on complex numbers; 0 where there is none."""
    return FAMILIES[int(address)].complex_address if address else 0


def evaluate_residual(motion: MotionEquations, t: float) -> int:
    """Status of the residual for what its record asks; its value is left there."""
    return int(import_module("nivel.kernels.tangent_entries").evaluate_residual(motion.handle.address, t))


def find_tangent(motion: MotionEquations, t: float, position: float, velocity: float, state: float) -> tuple[int, Array]:
    """Status and matrix (N, N) of Newton's iteration; unknowns move positions, velocities and states by these shares [s², s, s]."""
    entries, newton = import_module("nivel.kernels.tangent_entries"), motion.system.record.newton
    status = int(entries.find_tangent(motion.handle.address, t, position, velocity, state))
    size = len(newton.b)
    row = np.repeat(np.arange(size), np.diff(newton.row_start.astype(np.int64)))
    out = np.zeros((size, size))
    out[row, newton.column] = newton.value
    return status, out
