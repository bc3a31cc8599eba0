"""A mode of a linear model as an animated motion."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np

from nivel.errors import ModelError
from nivel.integrate.loop.sink import Header
from nivel.lazy import dataclass
from nivel.machine.core.vectors import Array
from nivel.results.analyses.mode_motion import CYCLES, FRAMES, PERIOD, SHOWN, TURNED, turned
from nivel.results.frames.contents import MemoryContents
from nivel.results.result import Result
from nivel.system.layout import FrameLayout, laid_out

if TYPE_CHECKING:
    from nivel.results.analyses.linear_model import LinearModel


@dataclass(frozen=True)
class Posed:
    """Where the bodies of a machine are: their names, places (B, 3) [m], Euler parameters (B, 4), and the attributes of a result."""

    bodies: tuple[str, ...]
    position: Array
    orientation: Array
    size: float
    attributes: dict[str, str | float | int]


def linear_motion(model: LinearModel, number: int) -> Result:
    """Mode `number` (from 1) of the model: vibrations with a period of a second and their own phases, others rising and falling.

    Raises ModelError where there is no such mode, or where nothing is seen of it.
    """
    modes = model.modes
    if not model.steady:
        raise ModelError(f"the model has no modes: {' '.join(model.notes)}")
    if not 1 <= number <= len(modes):
        raise ModelError(f"the model has no mode {number}: it has 1 to {len(modes)}")
    column = int(np.flatnonzero(model.eigenvalues.imag >= 0.0)[number - 1])
    shift, turn, posed = model.shift[column], model.turn[column], model.posed
    largest = max(
        float(np.abs(shift).max(initial=0.0)) / (SHOWN * posed.size), float(np.abs(turn).max(initial=0.0)) / TURNED
    )
    if not largest > 0.0:
        raise ModelError(f"nothing moves in mode {number}: it is of states beside the motion")
    time = np.linspace(0.0, CYCLES * PERIOD, FRAMES)
    phase = np.exp(2j * np.pi * time / PERIOD) / largest
    places = posed.position + np.real(phase[:, None, None] * shift)
    axes = np.stack([turned(posed.orientation, np.real(each * turn)) for each in phase])
    entries = [
        ("position", ("time", "body", "xyz"), "m", "position of the body frame, global axes"),
        ("orientation", ("time", "body", "euler_parameter"), "1", "Euler parameters of the body frame, scalar first"),
    ]
    names = {"body": posed.bodies, "xyz": ("x", "y", "z"), "euler_parameter": ("0", "1", "2", "3")}
    layout: FrameLayout = laid_out(entries, names)
    name = f"{model.name}, mode {number}: {modes[number - 1].number_in_words} 1/s"
    header = Header(layout, {**posed.attributes, "machine": name, "settings": json.dumps({"mode": number})})
    frames = np.hstack([time[:, None], places.reshape(FRAMES, -1), axes.reshape(FRAMES, -1)])
    return Result(MemoryContents(header, frames, header.attributes))
