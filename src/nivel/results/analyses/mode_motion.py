"""Modes as animated motions: a vibration about an equilibrium, and a mode of a linear model."""

import json

import numpy as np

from nivel.errors import ModelError
from nivel.integrate.loop.sink import Header
from nivel.known import LinearModel, Result
from nivel.lazy import Struct
from nivel.machine.core.vectors import Array
from nivel.results.frames.contents import MemoryContents
from nivel.system.layout import Entry, laid_out

FRAMES, CYCLES = 121, 3  # of the motion
PERIOD = 1.0  # s, whatever the frequency
# The largest displacement, as a share of the machine's size; the largest turn [rad].
SHOWN, TURNED = 0.08, 0.5


def mode_motion(result: Result, number: int, frame: int = -1) -> MemoryContents:
    """Vibration `number` (from 1) about the state `frame`, with a period of a second and amplitudes that can be seen.

    Raises ModelError where the result has no such vibration.
    """
    position, orientation, bent = _equilibrium(result, frame)
    shift, turn, bending = _shape(result, number, frame)
    time = np.linspace(0.0, CYCLES * PERIOD, FRAMES)
    wave = np.sin(2.0 * np.pi * time / PERIOD)
    blocks = [
        (position + wave[:, None, None] * shift).reshape(FRAMES, -1),
        np.stack([turned(orientation, share * turn) for share in wave]).reshape(FRAMES, -1),
    ]
    names = ["position", "orientation"]
    if bent is not None:
        blocks.append(bent + wave[:, None] * bending)
        names.append("modal_coordinate")
    known = [result.variables[name] for name in names]
    entries = [(each.name, each.dims, each.units, each.long_name) for each in known]
    kept = ("machine_record", "scene", "nivel_version")
    attributes = {key: result.attributes[key] for key in kept if key in result.attributes}
    settings = {"settings": json.dumps({"vibration": number}), "outcome": "done"}
    name = f"{result.name}, {_name(result, number, frame)}"
    return _motion(entries, dict(result.coordinates), {**attributes, "machine": name, **settings}, time, blocks)


def _motion(
    entries: list[Entry],
    names: dict[str, tuple[str, ...]],
    attributes: dict[str, str | float | int],
    time: Array,
    blocks: list[Array],
) -> MemoryContents:
    """The contents of a result with these variables, of `names` along their dimensions, whose numbers are blocks (FRAMES, ·)."""
    wanted = {dim for _, dims, *_ in entries for dim in dims[1:]}
    layout = laid_out(entries, {dim: each for dim, each in names.items() if dim in wanted})
    header = Header(layout, attributes)
    return MemoryContents(header, np.hstack([time[:, None], *blocks]), header.attributes)


def _equilibrium(result: Result, frame: int) -> tuple[Array, Array, Array | None]:
    """Position (bodies, 3), orientation (bodies, 4) and modal coordinates of the state."""
    if not result.is_statics or not len(result.time):
        raise ModelError("only results of `nivel statics` with `--modes` have vibrations to show")
    if not -len(result.time) <= frame < len(result.time):
        raise ModelError(f"there is no state {frame}: the result has {len(result.time)}")
    bent = result.array("modal_coordinate")[frame] if "modal_coordinate" in result.variables else None
    return result.array("position")[frame], result.array("orientation")[frame], bent


def _shape(result: Result, number: int, frame: int) -> tuple[Array, Array, Array]:
    """Displacements, turns and bending of the vibration at their largest."""
    count = len(result.coordinates.get("vibration", ()))
    if not 1 <= number <= count:
        have = f"it has 1 to {count}" if count else "it was made without `--modes`"
        raise ModelError(f"the result has no vibration {number}: {have}")
    shift, turn = result.array("mode_shift")[frame, number - 1], result.array("mode_turn")[frame, number - 1]
    if not np.isfinite(shift).all():
        raise ModelError(f"the machine has no vibration {number}: it has fewer degrees of freedom")
    bending = result.array("mode_bending")[frame, number - 1] if "mode_bending" in result.variables else np.zeros(0)
    size = result.trust.size
    largest = max(float(np.abs(shift).max(initial=0.0)) / (SHOWN * size), float(np.abs(turn).max(initial=0.0)) / TURNED)
    # unit modal mass moves a body of the machine's mass by about 1/√m
    largest = max(largest, float(np.abs(bending).max(initial=0.0)) / (SHOWN * size * float(np.sqrt(_mass(result)))))
    scale = 1.0 / largest if largest > 0.0 else 1.0
    return scale * shift, scale * turn, scale * bending


def _mass(result: Result) -> float:
    """Of all bodies that say it [kg]; at least that of one."""
    bodies = json.loads(str(result.attributes.get("machine_record", "{}"))).get("bodies", [])
    return sum(float(body.get("mass") or 0.0) for body in bodies) or 1.0


def turned(theta: Array, psi: Array) -> Array:
    """Euler parameters (·, 4) after rotation vectors ψ (·, 3) in global axes."""
    half = 0.5 * np.linalg.norm(psi, axis=1, keepdims=True)
    e0, e = np.cos(half), 0.5 * np.sinc(half / np.pi) * psi
    f0, f = theta[:, :1], theta[:, 1:]
    return np.hstack([e0 * f0 - np.sum(e * f, axis=1, keepdims=True), e0 * f + f0 * e + np.cross(e, f)])


def _name(result: Result, number: int, frame: int) -> str:
    square = float(result.array("vibration_stiffness")[frame, number - 1])
    if square < 0.0:
        return f"vibration {number}: unstable"
    return f"vibration {number}: {np.sqrt(square) / (2.0 * np.pi):.4g} Hz"


class Posed(Struct):
    """Where the bodies of a machine are: their names, places (B, 3) [m], Euler parameters (B, 4), and the attributes of a result."""

    bodies: tuple[str, ...]
    position: Array
    orientation: Array
    size: float
    attributes: dict[str, str | float | int]


def linear_motion(model: LinearModel, number: int) -> MemoryContents:
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
    shifted, turning = (float(np.abs(each).max(initial=0.0)) for each in (shift, turn))
    largest = max(shifted / (SHOWN * posed.size), turning / TURNED)
    if not largest > 0.0:
        raise ModelError(f"nothing moves in mode {number}: it is of states beside the motion")
    time = np.linspace(0.0, CYCLES * PERIOD, FRAMES)
    phase = np.exp(2j * np.pi * time / PERIOD) / largest
    places = posed.position + np.real(phase[:, None, None] * shift)
    axes = np.stack([turned(posed.orientation, np.real(each * turn)) for each in phase])
    entries: list[Entry] = [
        ("position", ("time", "body", "xyz"), "m", "position of the body frame, global axes"),
        ("orientation", ("time", "body", "euler_parameter"), "1", "Euler parameters of the body frame, scalar first"),
    ]
    names = {"body": posed.bodies, "xyz": ("x", "y", "z"), "euler_parameter": ("0", "1", "2", "3")}
    name = f"{model.name}, mode {number}: {modes[number - 1].number_in_words} 1/s"
    attributes = {**posed.attributes, "machine": name, "settings": json.dumps({"mode": number})}
    return _motion(entries, names, attributes, time, [places.reshape(FRAMES, -1), axes.reshape(FRAMES, -1)])
