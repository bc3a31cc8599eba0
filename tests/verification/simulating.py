"""Machines in the words of machine files, mappings in place of YAML, and their runs: what the tests of elements build on."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from nivel.api import Machine
from nivel.files.reader import parse_machine
from nivel.results.result import Result

G = 9.81


def machine(sections: Mapping[str, Any]) -> Machine:
    """The machine of `sections`; every YAML reader reads JSON. A `step` without an integrator is one of rk4."""
    settings = sections.get("simulation", {})
    if "step" in settings and not settings.keys() & {"integrator", "step_control"}:
        sections = {**sections, "simulation": {**settings, "integrator": "rk4"}}
    return Machine.from_record(parse_machine(json.dumps({"format": 1, **sections}, default=_plain), allow_code=True))


def simulate(sections: Mapping[str, Any], **simulation: Any) -> Result:
    """The run of the machine of `sections`; `simulation` are keys of the section of that name."""
    settings = {**sections.get("simulation", {}), **simulation}
    return machine({**sections, "simulation": settings}).simulate()


def solid(mass: float = 1.0, inertia: float | tuple[float, ...] = 0.1, **more: Any) -> dict[str, Any]:
    """A rigid body with the frame at its centre of mass; one number of inertia holds for all three axes."""
    moments = [inertia] * 3 if isinstance(inertia, float | int) else list(inertia)
    return {"mass": mass, "inertia": moments, **more}


def wheel(inertia: float, **more: Any) -> dict[str, Any]:
    """A body that turns about Z with the moment of inertia `inertia`."""
    return solid(1.0, (0.6 * inertia, 0.6 * inertia, inertia), **more)


def hinge(first: str, second: str, point: tuple[float, ...] = (0, 0, 0), **more: Any) -> dict[str, Any]:
    """A revolute about Z."""
    return {"type": "revolute", "bodies": [first, second], "point": list(point), "axis": [0, 0, 1], **more}


def slide(first: str, second: str, axis: tuple[float, ...] = (1, 0, 0), **more: Any) -> dict[str, Any]:
    """A translational joint through the origin unless a `point` is given."""
    return {"type": "translational", "bodies": [first, second], "point": [0, 0, 0], "axis": list(axis), **more}


def slopes(steps: list[float], errors: list[float]) -> np.ndarray:
    """Orders of convergence from one step to the next."""
    return np.diff(np.log(errors)) / np.diff(np.log(steps))


def turning_error(rate: float, step: float) -> float:
    """Relative error of an angle that RK4 finds from Euler parameters, whose phase runs at half the rate ω: the phase of
    one step is off by (ω h/2)⁵/120. Doubled for machines in which two bodies share the error.
    """
    return 2 * (abs(rate) * step / 2) ** 4 / 120 + 1e-11


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.tolist()
    return float(value)
