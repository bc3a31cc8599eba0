"""Loops of a URDF, which is a tree: pairs of frames that coincide, by their names or as a file beside the model says.

Exports of Onshape name the frames of a loop `closing_NAME_1` and `closing_NAME_2` (onshape-to-robot), collections of parallel robots
`closedloopNAME_A` and `closedloopNAME_B`; a frame is a link, or a joint, which has that of the link beyond it. ROBOT.yaml beside ROBOT.urdf
may have the pairs as `closed_loop`, with a `type` of each, `6d` (both frames stay together) or `3d` (their origins do), and as `joint_name`
and `joint_type` joints that are spherical, universal or fixed, which a URDF cannot say (Gepetto, example-parallel-robots).
"""

import re
from pathlib import Path
from typing import Any, Final

import numpy as np
import yaml

from nivel.errors import Fault, ModelError
from nivel.exchange.bodies import carried, carry, elementary_turn
from nivel.exchange.mechanism import Array, Connection, Frame, Mechanism
from nivel.files.sources import read_text
from nivel.lazy import scipy

PAIRS: Final = (  # the name without its end, the end; and whether origins alone coincide where nothing says so
    (re.compile(r"(.*closedloop.*?)_?([AB])(?:_[36][dD])?"), False),
    (re.compile(r"(closing_.+)_([12])"), True),
)
BY_NAME: Final = "loops are closed as the names of their frames say"
BY_FILE: Final = "loops are closed as the file beside the model says"
MOST_STEPS, LONGEST = 100, 0.2  # of the joints, and how far [rad, m] in a step
NEAR, RANK = 1e-14, 1e-6
OPEN: Final = "frames of a loop without a second one"
TYPES: Final = "SPHERICAL, FIXED, and UJOINT_XY with two of the axes X, Y, Z"


def close_loops(mechanism: Mechanism, path: Path) -> None:
    """Close the loops of a mechanism that is read from `path`. Raises ModelError with what a file beside it says wrong."""
    beside = path.with_suffix(".yaml")
    given = _read(beside) if beside.exists() else {}
    joints = {each.name: each for each in mechanism.connections}
    _change_joints(given, joints, mechanism, beside)
    frames = {each.name: each.bodies[1] for each in mechanism.connections} | {name: name for name in mechanism.links}
    pairs = given.get("closed_loop")
    if pairs is None:
        pairs, kinds = _by_name(frames, mechanism)
    else:
        pairs, kinds = _lists(given, "closed_loop", "type", beside)
    loops = []
    for pair, told in zip(pairs, kinds, strict=True):
        kind, ends = str(told).lower(), [frames.get(str(name), "") for name in pair] if isinstance(pair, list) else []
        if len(ends) != 2 or not all(ends) or kind not in ("3d", "6d"):
            message = f"`{pair}` with the type `{kind}`: two frames of the model and `3d` or `6d` were expected"
            raise ModelError(Fault(str(beside), 1, 1, "closed_loop", message))
        name, at = re.sub(r"_?[AB12]((?:_[36][dD])?)$", r"\1", pair[0]), mechanism.links[ends[0]].place.origin
        type_of = "spherical" if kind == "3d" else "fixed"
        loops.append(Connection(name, type_of, (ends[0], ends[1]), at, frames=(Frame(), Frame())))
        gap = float(np.linalg.norm(at - mechanism.links[ends[1]].place.origin))
        mechanism.notes.change(BY_FILE if "closed_loop" in given else BY_NAME, f"{name}, open by {gap * 1e3:.3g} mm")
    if loops:
        _bring_together(loops, mechanism)
    mechanism.connections += loops


def _bring_together(loops: list[Connection], mechanism: Mechanism) -> None:
    """Turn and push the joints by least norm until the frames of all loops are near each other, by Gauss and Newton's steps."""
    moved = []
    for each in mechanism.connections:
        beyond = set(carried(mechanism, each))
        axes = 3 if each.kind == "spherical" else len(each.axes) if each.coordinate or each.kind == "universal" else 0
        moved += [(each, k, beyond) for k in range(axes) if not each.mimic]
    size = max(float(np.linalg.norm(each.place.origin)) for each in mechanism.links.values()) or 1.0
    for _ in range(MOST_STEPS):
        gaps = [_gap(each, mechanism, size) for each in loops]
        J = np.zeros((sum(map(len, gaps)), len(moved)))
        for column, (joint, k, beyond) in enumerate(moved):
            J[:, column] = np.concatenate([_rate(each, joint, k, beyond, mechanism, size) for each in loops])
        gap = np.concatenate(gaps)
        if np.abs(gap).max() < NEAR:
            return
        step = -np.linalg.lstsq(J, gap, rcond=RANK)[0]
        step *= min(1.0, LONGEST / float(np.abs(step).max(initial=LONGEST)))
        for (joint, k, beyond), way in zip(moved, step.tolist(), strict=True):
            axis = _axis(joint, k)
            carry(mechanism, joint, axis, way, beyond)
            if joint.kind == "universal" and k == 0:
                joint.axes = joint.axes[0], elementary_turn(axis, way) @ joint.axes[1]
            joint.placed += way if joint.coordinate else 0.0


def _axis(joint: Connection, k: int) -> Array:
    """The k-th unit axis of a joint; those of a spherical one are the global ones."""
    return joint.axes[k] / np.linalg.norm(joint.axes[k]) if joint.axes else np.eye(3)[k]


def _gap(loop: Connection, mechanism: Mechanism, size: float) -> Array:
    """What both frames of a loop differ by: origins by the size, and the turn from the second to the first where axes are parallel."""
    first, second = (mechanism.links[name].place for name in loop.bodies)
    apart = (first.origin - second.origin) / size
    if loop.kind == "spherical":
        return apart
    return np.concatenate([apart, scipy.spatial.transform.Rotation.from_matrix(first.axes @ second.axes.T).as_rotvec()])


def _rate(loop: Connection, joint: Connection, k: int, beyond: set[str], mechanism: Mechanism, size: float) -> Array:
    """Rate of the gap of a loop, while it is small, by a motion along the k-th axis of a joint that carries the links `beyond`."""
    a, turns, rate = _axis(joint, k), joint.kind != "translational", np.zeros(6)
    for name, sign in zip(loop.bodies, (1.0, -1.0), strict=True):
        if name in beyond:
            shift = np.cross(a, mechanism.links[name].place.origin - joint.point) if turns else a
            rate += sign * np.concatenate([shift / size, turns * a])
    return rate[: 3 if loop.kind == "spherical" else 6]


def _read(file: Path) -> dict[str, Any]:
    """The file beside a model, empty where it is another one, such as its machine file."""
    try:
        given = yaml.safe_load(read_text(file))
    except yaml.YAMLError:
        return {}
    return given if isinstance(given, dict) and "closed_loop" in given else {}


def _lists(given: dict[str, Any], first: str, second: str, beside: Path) -> tuple[list[Any], list[Any]]:
    """Two lists of a file beside the model, whose numbers go in pairs."""
    one, two = given.get(first, []), given.get(second, [])
    if not (isinstance(one, list) and isinstance(two, list) and len(one) == len(two)):
        raise ModelError(
            Fault(str(beside), 1, 1, first, f"`{first}` and `{second}` were expected as lists of one length")
        )
    return one, two


def _by_name(frames: dict[str, str], mechanism: Mechanism) -> tuple[list[list[str]], list[str]]:
    found: dict[str, list[tuple[str, str]]] = {}
    for name in frames:
        for pattern, is_point in PAIRS:
            if match := pattern.fullmatch(name):
                kind = "3d" if is_point or name[-3:].lower() == "_3d" else "6d"
                found.setdefault(match[1], []).append((name, kind))
    for pair in found.values():
        if len(pair) != 2:
            mechanism.notes.leave(OPEN, ", ".join(name for name, _ in pair), acts=True)
    whole = [sorted(pair) for pair in found.values() if len(pair) == 2]
    return [[first, second] for (first, _), (second, _) in whole], [pair[0][1] for pair in whole]


def _change_joints(given: dict[str, Any], joints: dict[str, Connection], mechanism: Mechanism, beside: Path) -> None:
    for name, told in zip(*_lists(given, "joint_name", "joint_type", beside), strict=True):
        kind, joint = str(told), joints.get(str(name))
        turns = re.fullmatch(r"UJOINT_([XYZ])([XYZ])", kind)
        if turns is None and kind not in ("SPHERICAL", "FIXED"):
            message = f"`{name}` has the type `{kind}`; there are {TYPES}"
            raise ModelError(Fault(str(beside), 1, 1, "joint_type", message))
        if joint is None:
            mechanism.notes.leave("joints of the file beside the model that the model has not", name)
            continue
        axes = mechanism.links[joint.bodies[1]].place.axes
        joint.kind = "universal" if turns else kind.lower()
        joint.axes = tuple(axes[:, "XYZ".index(each)] for each in turns.groups()) if turns else ()
        joint.lower = joint.upper = joint.effort = None
        joint.damping = joint.friction = 0.0
        mechanism.notes.change("joints are those of the file beside the model", f"{name} {joint.kind}")
