"""The package of one result, or of two laid over each other."""

import json
from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from nivel.errors import ModelError
from nivel.lazy import Struct, nivel, replace
from nivel.looks.diagram import block_diagram
from nivel.machine.core.vectors import Array
from nivel.results.result import Result
from nivel.view import package
from nivel.view.arrows import Moments, arrows, described, places_of, violation_vectors
from nivel.view.couplings import couplings
from nivel.view.extent import extent
from nivel.view.package import Block, to_bytes
from nivel.view.records import PROTOCOL, Arrow, Column, Flexible, Joint, Moment, Motion, Package, Sections, Stage
from nivel.view.stage import Cast, cast, flexible

MOST: Final = 20_000  # variables that are listed
# of variables that belong to what is named after them
PREFIXES: Final = ("force.", "driver.", "coupling.", "hydraulics.")
# what is carried first where not all has room; of equal ones those that stand first in the result
FIRST: Final = (
    "joint_coordinate",
    "kinetic_energy",
    "potential_energy",
    "energy_error",
    "position",
    "joint_force",
    "joint_rate",
)


def column_names(result: Result) -> list[str]:
    """Names of all variables that are one number a frame."""
    names = []
    for name in result.names:
        found = result.selection(name)
        dims = result.variables[found.variable].dims[1:]
        if len(found.where[1:]) == len(dims) and all(isinstance(place, int) for place in found.where[1:]):
            names.append(name)
        if len(names) == MOST:
            break
    return names


def columns(result: Result, frames: slice, block: Block, budget: int) -> list[Column]:
    """All columns; those that have room within `budget` bytes are put into the block. frames : those of the package."""
    names = column_names(result)
    count = len(range(len(result.time))[frames])
    room = budget // max(4 * count, 1)
    variables = {name: result.selection(name).variable for name in names}
    rank = {variable: k for k, variable in enumerate(FIRST)}
    ordered = sorted(names, key=lambda name: rank.get(variables[name], len(FIRST)))
    carried = set(ordered[:room])
    arrays: dict[str, Array] = {}
    elements = _elements(result)
    out = []
    for name in names:
        packed = None
        if name in carried:
            variable = variables[name]
            if variable not in arrays:
                arrays = {variable: result.array(variable, frames)}  # one at a time: names come in their order
            packed = block.add(arrays[variable][(slice(None), *result.selection(name).where[1:])])
        out.append(Column(name, result.units(name), _owner(name, elements), packed))
    return out


def _elements(result: Result) -> set[str]:
    """Names of bodies, joints, and what else owns variables."""
    scene = result.scene
    found = {each["name"] for section in ("bodies", "joints", "forces") for each in scene.get(section, [])}
    return found | {name.split(".")[1] for name in result.variables if name.startswith(PREFIXES)}


def _owner(name: str, elements: set[str]) -> str:
    """The element whose name a variable begins with, after a word for its kind; empty for the whole machine.

    Nodes of beams have names of two words.
    """
    parts = name.split(".")
    rest = parts[1:] if f"{parts[0]}." in PREFIXES and len(parts) > 2 else parts
    candidates = (".".join(rest[:words]) for words in (2, 1) if words < len(rest))
    return next((each for each in candidates if each in elements), "")


MOST_MOMENTS: Final = 500  # events that are marked
LARGEST: Final = 1e30  # [m] beyond it bodies are not drawn: 32-bit numbers could not hold the squares in between


class Budget(Struct):
    """Bytes that a motion, its columns, the strains of beams and the modal stresses of flexible bodies may take before compression; frames
    that are shown and moves of terrains at most; whether arrows come along, and the list of what can be plotted."""

    motion: int
    columns: int
    frames: int
    sections: int = 0
    stress: int = 0
    moves: int = 2_000_000
    vectors: bool = True
    plots: bool = True


SERVED: Final = Budget(motion=64_000_000, columns=0, frames=20_000, sections=16_000_000, stress=24_000_000)
ALONE: Final = Budget(motion=3_000_000, columns=1_000_000, frames=4_000, sections=500_000, stress=2_000_000)
SMALL: Final = Budget(motion=600_000, columns=0, frames=1200, moves=350_000, vectors=False, plots=False)


def playback(results: Sequence[Result], budget: Budget) -> bytes:
    """The package of a result, with further ones as ghosts.

    Raises ModelError where a result has nothing to draw.
    """
    block = Block()
    stages = [stage(result, budget, block, number) for number, result in enumerate(results)]
    return to_bytes(Package(PROTOCOL, "playback", stages), block)


def played_frames(result: Result, budget: Budget) -> slice:
    """The frames of a result that have room, evenly taken."""
    scene = result.scene
    bodies, joints, forces = (len(scene.get(name, [])) for name in ("bodies", "joints", "forces"))
    modes = len(result.coordinates.get("mode", ()))
    width = 7 * bodies + modes + (3 * (4 * joints + 2 * forces) if budget.vectors else 0)
    count = _usable(result.abscissa)
    most = max(min(budget.frames, budget.motion // max(4 * width, 1)), 2)
    return slice(0, count, max(-(-count // most), 1))


def _usable(time: Array) -> int:
    """How many frames from the first on have a time that is a number and not before the one of the frame before."""
    wrong = ~np.isfinite(time)
    wrong[1:] |= np.diff(time) < 0.0
    return int(np.argmax(wrong)) if wrong.any() else len(time)


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # a run beyond all bounds is drawn as far as it can be
def stage(result: Result, budget: Budget, block: Block, number: int = 0) -> Stage:
    """What the page needs of a result; `number` : 0, or of a ghost."""
    scene, record = _described(result)
    _refuse_empty(result, scene)
    players = _cast(result, scene, record, block, budget)
    bodies = len(players.bodies)
    frames = played_frames(result, budget)
    position, orientation = _poses(result, bodies, frames)
    where = extent(players, position, orientation)
    drawn = _vectors(players, result, frames, Moments.of(position, orientation)) if budget.vectors else NO_VECTORS
    vectors = drawn.values if budget.vectors else np.zeros((len(position), 0, 3))
    modal = _read(result, "modal_coordinate", frames)
    rows = package.rows(position - np.array(where.origin), orientation, modal, vectors)
    bending, felt, colourless = flexible(scene, block, modal), None, []
    if number == 0:
        bending, felt, colourless = _coloured(result, bending, frames, block, budget)
    return Stage(
        **vars(where),
        **{**players.lists, "joints": drawn.joints or players.joints},
        name=result.name,
        title=str(result.path.name) if result.path else result.name,
        layout=package.layout(bodies, 0 if modal is None else modal.shape[1], vectors.shape[1]),
        flexible=bending,
        sections=felt,
        colourless=colourless,
        arrows=drawn.arrows,
        couplings=couplings(players, position, orientation),
        columns=columns(result, frames, block, budget.columns)
        if budget.plots and (number == 0 or budget.columns)
        else [],
        circuit=_circuit(result, record) if number == 0 else "",
        diagram=block_diagram(record, str(result.attributes.get("machine_source", "")))
        if number == 0 and budget.plots
        else [],
        moments=[Moment(name, float(at)) for name, at in result.marks if np.isfinite(at)][:MOST_MOMENTS],
        notes=_notes(result, rows[:, : 7 * bodies], frames),
        motion=Motion(
            block.add(result.abscissa[frames], "f8"),
            block.add(rows.T),
            len(result.time),
            frames.step,
            block.add(result.time[frames], "f8") if result.is_statics else None,
        ),
    )


def _circuit(result: Result, record: dict[str, Any]) -> str:
    """The diagram of its hydraulic circuits; empty without one. Machines without load nothing for it."""
    if not record.get("hydraulics") or not len(result.time):
        return ""
    return nivel.looks.circuit.drawing.circuit_diagram(
        record, nivel.results.frames.circuit_balance.pressures_at(result, 0)
    )


def _coloured(
    result: Result, bending: list[Flexible], frames: slice, block: Block, budget: Budget
) -> tuple[list[Flexible], Sections | None, list[str]]:
    """Flexible bodies with their stress, what beams feel, and in sentences what is left out. Machines without both load nothing for it."""
    felt, missing, more = None, [], []
    if result.scene.get("sweeps"):
        felt, missing = nivel.view.colours.sections(result, frames, block, budget.sections)
    if bending:
        bending, more = nivel.view.colours.with_stress(result, bending, block, budget.stress)
    return bending, felt, [*missing, *more]


class Vectors(Struct):
    """values (n, V, 3) of the frames; the arrows that they are, and the joints with the places of their violations."""

    values: Array
    arrows: list[Arrow]
    joints: list[Joint]


NO_VECTORS: Final = Vectors(np.zeros((0, 0, 3)), [], [])


def _vectors(players: Cast, result: Result, frames: slice, moments: Moments) -> Vectors:
    """Arrows first, then where they stand, then a gap and a turn for each joint."""
    traced = arrows(players, moments, lambda name: _read(result, name, frames))
    vectors = [*(each.vectors for each in traced), *places_of(traced)]
    parts = [np.zeros((len(moments.position), 0, 3)), *(each[:, None] for each in vectors)]
    joints, violation = players.joints, _read(result, "constraint_violation", frames)
    if violation is not None:
        parts.append(violation_vectors(joints, result.coordinates["constraint"], violation, moments))
        joints = [replace(joint, violation=len(vectors) + 2 * k) for k, joint in enumerate(joints)]
    return Vectors(np.concatenate(parts, axis=1), described(traced, 0), joints)


def _described(result: Result) -> tuple[dict[str, Any], dict[str, Any]]:
    """Scene and machine record of a result, the record empty where there is none.

    Raises ModelError where they are damaged.
    """
    try:
        found = result.scene, json.loads(str(result.attributes.get("machine_record", "{}")))
    except ValueError:
        found = None, None
    scene, record = found
    if not isinstance(scene, dict) or not isinstance(record, dict):
        raise ModelError(f"{_title(result)}: its description of the machine cannot be read")
    return scene, record


def _cast(result: Result, scene: dict[str, Any], record: dict[str, Any], block: Block, budget: Budget) -> Cast:
    past = {name: each.thinned(budget.moves) for name, each in result.terrains.items()}
    try:
        return cast(scene, record, block, past)
    except (KeyError, TypeError, ValueError, IndexError, AttributeError) as error:
        raise ModelError(f"{_title(result)}: its description of the machine is damaged ({error!r})") from error


def _refuse_empty(result: Result, scene: dict[str, Any]) -> None:
    if not scene.get("bodies") and any(name.startswith("hydraulics.") for name in result.variables):
        raise ModelError(f"{_title(result)} is of a circuit without bodies, which has no picture; its report has plots")
    if not scene.get("bodies"):
        raise ModelError(
            f"{_title(result)} says nothing about bodies to draw: it was written by another version of nivel"
        )
    if "position" not in result.variables or "orientation" not in result.variables:
        raise ModelError(f"{_title(result)} has no positions of bodies")
    if tuple(body["name"] for body in scene["bodies"]) != tuple(result.coordinates["body"]):
        raise ModelError(f"{_title(result)}: the bodies of its picture are not those of its motion")
    if not len(result.time):
        raise ModelError(f"{_title(result)} has no frame: the run ended before its first moment was stored")
    if not _usable(result.abscissa):
        raise ModelError(f"{_title(result)} has no times: that of its first frame is {result.abscissa[0]}")


def _title(result: Result) -> str:
    return str(result.path) if result.path else result.name


def _poses(result: Result, bodies: int, frames: slice) -> tuple[Array, Array]:
    position, orientation = result.array("position", frames), result.array("orientation", frames)
    length = np.linalg.norm(orientation, axis=-1, keepdims=True)
    orientation = np.divide(orientation, length, out=np.full_like(orientation, np.nan), where=length > 0.0)
    return position.reshape(-1, bodies, 3), orientation.reshape(-1, bodies, 4)


def _read(result: Result, name: str, frames: slice) -> Array | None:
    return result.array(name, frames) if name in result else None


def _notes(result: Result, poses: Array, frames: slice) -> list[str]:
    """What the user has to know before looking. poses : (n, 7 B) of the frames that are shown."""
    notes = []
    if result.outcome == "failed":
        notes.append(f"The run failed: {result.failure or 'the reason is not known'}")
    elif result.outcome != "done":
        notes.append(
            {"running": "The run goes on, or was killed."}.get(result.outcome, f"The run was {result.outcome}.")
        )
    infinite = ~np.all(np.isfinite(poses), axis=1)
    huge = ~infinite & np.any(np.abs(poses) > LARGEST, axis=1)
    for bad, what in ((infinite, "that are not finite"), (huge, f"beyond {LARGEST:.0e} m")):
        if bad.any():
            notes.append(
                f"{int(bad.sum())} of {len(poses)} frames have positions {what}; those bodies are not drawn there."
            )
    left = len(result.time) - frames.stop
    if left:
        notes.append(f"The last {left} frames are left out: their times are no numbers, or go back.")
    if frames.step > 1:
        notes.append(f"Every {_ordinal(frames.step)} of {len(result.time)} frames is shown.")
    return notes


def _ordinal(n: int) -> str:
    last = {1: "st", 2: "nd", 3: "rd"}.get(n % 10, "th") if n % 100 not in (11, 12, 13) else "th"
    return f"{n}{last}"
