"""From a model file to a reduced body: read, tie, check, reduce, compute what the moving body needs."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final

import numpy as np

from nivel.errors import Fault, ModelError, refuse
from nivel.flexible.body.body import Interface, LeftOut, ReducedBody, StressModes
from nivel.flexible.body.mass_invariants import beside_kept, invariants, left_out
from nivel.flexible.checks import findings as checks
from nivel.flexible.checks.findings import Findings, findings_of, mesh_error
from nivel.flexible.model.frame import frame_model
from nivel.flexible.model.model import AXES, Array, FiniteElementModel, lumped
from nivel.flexible.model.model_file import Located, read_model
from nivel.flexible.model.selection import NodeSets
from nivel.flexible.reduction import bases
from nivel.flexible.reduction.factor import NoStiffnessError, Whole
from nivel.flexible.reduction.free_body import FreeBody, Orthonormal, held_at, orthonormal
from nivel.flexible.reduction.given_modes import given_modes
from nivel.flexible.reduction.ties import Attachment, with_interfaces
from nivel.lazy import Struct, nivel, replace

Stage = Callable[[str, float], None]


def source_model(located: Located, say: Stage) -> tuple[FiniteElementModel, NodeSets]:
    """The model before its interfaces are tied, and its node sets. `say` hears what begins, with shares from 0 to 1.

    Raises ModelError.
    """
    if located.record.frame is not None:
        return frame_model(located), {}
    if located.record.solid is not None:
        return nivel.flexible.model.solid_source.solid_model(located, say)
    return nivel.flexible.foreign.source.matrix_model(located)


NO_MODE: Final = "no mode is left but rigid motions: ask for normal modes, name interfaces, or give other shapes"


def _silent(_text: str, _share: float) -> None:
    """Nobody listens."""


class Reduction(Struct):
    """A reduced body, and what was found out while it was made."""

    body: ReducedBody
    findings: Findings


def reduce(path: str | Path, *, overrides: Mapping[str, object] | None = None, stage: Stage | None = None) -> Reduction:
    """The reduced body of the model file at `path`. `stage` hears what begins and how much is done, from 0 to 1.

    Raises ModelError.
    """
    return reduce_model(read_model(path, overrides=overrides), stage=stage)


def reduce_model(located: Located, *, stage: Stage | None = None) -> Reduction:
    """The reduced body of a model that has been read. Raises ModelError."""
    say = stage or _silent
    record = located.record
    say("reading the model", 0.0)
    model, sets = source_model(located, lambda text, share: say(text, 0.3 * share))
    untied = model
    model, attachments = with_interfaces(untied, located, sets)
    if record.reduction.mass == "lumped" and record.frame is None:
        model = model.changed(mass=lumped(model.mass))
    say("checking the model", 0.3)
    _check(model, located)
    body = FreeBody.of(model)
    try:
        found = _reduced(body, attachments, located, say)
    except NoStiffnessError as error:
        raise ModelError(_fault(located, checks.mechanism(body, error))) from None
    if not record.recovery.loads:
        return found
    return replace(found, body=replace(found.body, loads=_loads(untied, found.body.modes)))


def _loads(model: FiniteElementModel, modes: Array) -> Array:
    """(n, 6, n_modes) K Φ at the nodes of the model, zero at those that were added to tie its surfaces."""
    out, has = np.zeros_like(modes), model.freedoms >= 0
    full = np.zeros((model.expansion.shape[0], modes.shape[2]))
    full[model.freedoms[has]] = modes[: len(has)][has]
    forces = np.zeros_like(full)
    forces[model.independent] = model.stiffness @ full[model.independent]
    out[: len(has)][has] = forces[model.freedoms[has]]
    return out


def _check(model: FiniteElementModel, located: Located) -> None:
    """Raises ModelError."""
    found = checks.problems(model)
    if found:
        raise ModelError([_fault(located, text) for text in found])
    along = model.rigid_modes()[:, :3]
    mass = float(np.trace(along.T @ (model.mass.matrix @ along))) / 3.0
    alone = located.record.frame is None or not located.record.frame.masses
    volume = model.volume if alone else None
    problem = checks.mass_problem(mass, located.record.expected_mass, volume, model.size)
    if problem:
        given = located.record.expected_mass is not None
        raise ModelError(located.fault(("expected_mass",), problem) if given else _fault(located, problem))


def _fault(located: Located, message: str) -> Fault:
    source = next(key for key in ("frame", "solid", "matrices") if getattr(located.record, key) is not None)
    return located.fault((source,), message, at_key=True)


def _reduced(body: FreeBody, attachments: tuple[Attachment, ...], located: Located, say: Stage) -> Reduction:
    model, record = body.model, located.record
    boundary = np.concatenate([_rows(model, each.node) for each in attachments]) if attachments else np.zeros(0, int)
    say("computing normal and correction modes", 0.35)
    basis = _basis(body, boundary, located)
    if not basis.vectors.shape[1]:
        raise ModelError(located.fault(("reduction", "modes"), NO_MODE))
    say("removing rigid motions", 0.65)
    found = orthonormal(body, basis.vectors, basis.extra)
    if not len(found.eigenvalues):
        raise ModelError(located.fault(("reduction", "modes"), NO_MODE))
    modes, eigenvalues, held = _with_reference(body, found, attachments, located)
    say("computing the modes of the whole model for comparison", 0.7)
    error = mesh_error(located, model, modes, eigenvalues)
    findings = findings_of(body, attachments, boundary, basis, found, modes, error)
    share, text = checks.digits(body, (2.0 * np.pi * findings.full[0]) ** 2) if findings.full else (0.0, "")
    if share > checks.FEW_DIGITS:
        raise ModelError(_fault(located, text[0].lower() + text[1:]))
    body.forget_factor()
    say("computing inertia invariants and stress modes", 0.88)
    reduced = ReducedBody(
        name=record.name,
        eigenvalues=eigenvalues,
        invariants=invariants(model.mass, modes),
        interfaces=(),
        node_ids=model.node_ids,
        position=model.position,
        modes=_node_modes(model, modes),
        reference="fixed" if held else "mean-axis",
        held=held,
        mass_kind=record.reduction.mass,
        stress=_stress(model, modes, located),
        stiffening=_stiffening(body, modes, attachments, located, say),
        triangles=model.triangles,
        lines=model.lines,
        solids=model.solids,
        source=record.description,
        mesh_error=error,
        left_out=_left_out(body, modes, found, basis, attachments),
    )
    say("done", 1.0)
    return Reduction(replace(reduced, interfaces=_interfaces(reduced, attachments)), findings)


def _rows(model: FiniteElementModel, node: int) -> Whole:
    """Independent freedoms of a node."""
    full = model.freedoms[node][model.freedoms[node] >= 0]
    return model.expansion[full].indices.astype(np.int64)


def _basis(body: FreeBody, boundary: Whole, located: Located) -> bases.Basis:
    reduction = located.record.reduction
    if reduction.modes.given:
        return given_modes(body, boundary, located)
    modes = bases.ModeCount(reduction.modes.count, reduction.modes.up_to)
    match reduction.method:
        case "craig-bampton":
            basis = bases.craig_bampton(body, boundary, modes)
        case "free-interface":
            basis = bases.free_interface(body, boundary, modes)
        case "normal-modes":
            basis = bases.normal_only(body, boundary, modes)
    if not reduction.inertia_modes:
        return basis
    own = bases.inertia_modes(body, boundary)
    return replace(basis, vectors=np.hstack([own, basis.vectors]), extra=own.shape[1])


def _with_reference(
    body: FreeBody, found: Orthonormal, attachments: tuple[Attachment, ...], located: Located
) -> tuple[Array, Array, tuple[str, ...]]:
    """Modes and eigenvalues for the reference conditions, and the freedoms that are zero in all modes."""
    reduction, model = located.record.reduction, body.model
    if reduction.reference == "mean-axis" and not reduction.held:
        return found.modes, found.eigenvalues, ()
    held = reduction.held or tuple(f"{reduction.reference}.{axis}" for axis in AXES)
    node_of = {each.name: each.node for each in attachments}
    rows, faults = [], []
    for text in held:
        name, _, axis = text.rpartition(".")
        row = model.freedoms[node_of[name], AXES.index(axis)]
        if row < 0:
            message = (
                f"the node of `{name}` has no freedom `{axis}`; tie a surface to a reference node, which has all six"
            )
            faults.append(located.fault(("reduction", "held" if reduction.held else "reference"), message))
        rows.append(row)
    refuse(faults)
    matrix = model.expansion[np.array(rows)].toarray()
    R = model.rigid_modes(model.position.mean(axis=0)) / np.array([1, 1, 1, *(3 * [model.size])])
    if np.linalg.cond(matrix @ R) > 1e8:
        message = (
            f"the degrees of freedom {', '.join(held)} leave a rigid motion of the body; hold six that stop them all"
        )
        raise ModelError(located.fault(("reduction", "held"), message))
    modes, eigenvalues = held_at(body, found.modes, matrix)
    return modes, eigenvalues, held


def _left_out(
    body: FreeBody, modes: Array, found: Orthonormal, basis: bases.Basis, attachments: tuple[Attachment, ...]
) -> LeftOut:
    """The next modes. Where they do not move the interfaces they are taken as they are, and their loads need no loads there."""
    candidates = basis.left if basis.held else beside_kept(body, found.modes, basis.left)
    return left_out(body, modes, candidates, np.array([each.node for each in attachments], dtype=np.int64))


def _node_modes(model: FiniteElementModel, modes: Array) -> Array:
    """(n, 6, n_modes); the turn of nodes of solids is that of the elements around them."""
    motion = model.node_motion(modes)
    turn = getattr(model.elements, "turn", None)
    if turn is None:
        return motion
    estimated = turn(model.expansion @ modes)
    missing = np.isnan(motion[: len(estimated), 3:])
    motion[: len(estimated), 3:][missing] = estimated[missing]
    return motion


def _interfaces(body: ReducedBody, attachments: tuple[Attachment, ...]) -> tuple[Interface, ...]:
    out = []
    for each in attachments:
        motion = body.modes[each.node]
        turns = bool(np.all(np.isfinite(motion[3:])))
        out.append(
            Interface(each.name, each.node, body.position[each.node], motion[:3], np.nan_to_num(motion[3:]), turns)
        )
    return tuple(out)


def _stress(model: FiniteElementModel, modes: Array, located: Located) -> StressModes | None:
    recovery = located.record.recovery
    if model.elements is None or not recovery.stress:
        return None
    stations = model.elements.station_nodes()
    keep = np.arange(len(stations))
    if not isinstance(recovery.nodes, str):
        missing = [node for node in recovery.nodes if node not in set(model.node_ids.tolist())]
        if missing:
            message = f"there is no node {missing[0]}; nodes have numbers from {model.node_ids.min()} to {model.node_ids.max()}"
            raise ModelError(located.fault(("recovery", "nodes"), message))
        keep = np.flatnonzero(np.isin(model.node_ids[stations], recovery.nodes))
    full = model.expansion @ modes
    labels = model.elements.station_labels()
    return StressModes(
        station_node=stations[keep],
        labels=tuple(labels[k] for k in keep) if labels else (),
        modes=model.elements.stress(full)[keep],
        strain=model.elements.strain(full)[keep] if recovery.strain else None,
    )


def _stiffening(
    body: FreeBody, modes: Array, attachments: tuple[Attachment, ...], located: Located, say: Stage
) -> dict[str, Array]:
    reduction = located.record.reduction
    if not reduction.stiffening:
        return {}
    if body.model.elements is None:
        why = next(
            (note for note in body.model.notes if note.startswith("stress")),
            "matrices of other programs do not have them",
        )
        message = f"geometric stiffness needs the elements and their stress: {why}"
        raise ModelError(located.fault(("reduction", "stiffening"), message))
    say("computing geometric stiffness", 0.93)
    rows = {each.name: _rows(body.model, each.node) for each in attachments}
    chosen = reduction.reference if reduction.reference != "mean-axis" else next(iter(rows), "")
    support = rows.get(chosen, body.pins)
    if len(support) < 6:
        chosen, support = "", body.pins
    return bases.stiffening(body, modes, support, {name: its for name, its in rows.items() if name != chosen})
