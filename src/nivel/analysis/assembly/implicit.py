"""The residual of a machine for implicit methods: its tables, its twin on dual numbers, and calls of it from Python."""

from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.analysis.assembly.unknown_groups import frictions_with_stiction, integrals, unknown_groups
from nivel.kernels.core.arrays import dual_twin
from nivel.kernels.core.block import Handle
from nivel.kernels.record import record as kernels
from nivel.kernels.record.hook import FAMILIES, Family
from nivel.kernels.record.implicit_record import Newton, Residual
from nivel.kernels.record.record import Hooks, Record
from nivel.kernels.residual import friction_residual
from nivel.kernels.residual import tangent_entries as entries
from nivel.kernels.residual.element_crossing import pass_nodes
from nivel.kernels.tree.modal_nodes import pass_modes
from nivel.kernels.tree.tree_nodes import pass_sliders
from nivel.lazy import Struct, nivel, replace, scipy
from nivel.motion.catalogue import FORMULATIONS, PathFacts, path_of
from nivel.system.elimination.factor_plan import TangentPlan, plan_tangent
from nivel.system.implicit import newton_tables, parts_of, places, residual_tables
from nivel.system.laws.laws import dual_address
from nivel.system.system import Array, System

Index = NDArray[np.integer]
# Units in the last place by which the position of a point may be wrong for every body on the way to it: a product of two rotations (3
# products, 2 sums), a rotation from its coordinate (2), a turned arm (3) and its sum with the position (1) make 11 half units.
ROUNDINGS = 6.0


class ResidualOptions(Struct):
    """What a method asks of a residual.

    whole : module of one over a whole step; empty: that at a time. corners : times [s] at which functions of time have corners. shifted :
    with room for systems of shifted matrices, see `nivel.kernels.residual.shifted_matrix`. balance : with room to find accelerations, see
    `nivel.kernels.residual.balance`. along : it asks for derivatives along directions, so that none may be found by hand. free : whether
    nothing joins the machine to the ground, for a residual over a whole step. filtered : with room for
    `nivel.integrate.newmark.alpha_step`. accelerations : it solves for them, so that in independent coordinates all that depends on these
    has to be found. compliance : 1/α of penalty methods, or that with which all rows of a redundant machine are met in least squares.
    """

    whole: str = ""
    corners: tuple[float, ...] = ()
    shifted: bool = False
    balance: bool = False
    along: bool = False
    free: bool | None = None
    filtered: bool = False
    accelerations: bool = False
    compliance: Array | None = None


INSTANT = ResidualOptions()
# A row this many times shorter than the longest one is round-off.
NOTHING = 1e-9


def constraint_index(formulation: str, stabilisation: str, path: PathFacts) -> int:
    """What methods that solve for accelerations have the multipliers close, see `Newton.level`."""
    if path.dependent:
        return 0
    if stabilisation in ("direct", "geometric"):
        return 2
    return 1 if FORMULATIONS[formulation].factor > 0.0 or stabilisation == "baumgarte" else 3


def with_residual(
    motion: MotionEquations,
    y: Array,
    coordinates: str,
    wanted: ResidualOptions = INSTANT,
    path: PathFacts | None = None,
) -> MotionEquations:
    """The same equations, with the residual of implicit methods, its derivatives, and the record of its twin on dual numbers.

    path : where they are; None: those of newton-euler in these coordinates.
    Of redundant constraints without compliance those rows stay that say something new at the state y of the start: with the others the
    matrix would be singular.
    """
    rows = len(motion.system.record.saddle.row)
    if path is None:
        flexible = len(motion.system.record.flexible.body) > 0
        path = path_of(coordinates, "newton-euler", "euler-parameters", flexible=flexible)
        assert path is not None
    whole = _with_rows(motion, y, coordinates, wanted, path, np.arange(rows))
    rank = int(motion.system.record.control.rank[0])
    if rank == rows or wanted.compliance is not None:
        return whole
    if wanted.whole:
        whole = _with_rows(motion, y, coordinates, INSTANT, path, np.arange(rows))
    residual = whole.system.record.residual
    residual.y[:] = y
    _, tangent = find_tangent(whole, 0.0, 1.0, 1.0, 1.0)
    first = len(tangent) - len(residual.lam)
    scale = motion.system.record.constraints.scale[motion.system.record.saddle.row]
    kept = _independent(tangent[first : first + rows, : len(residual.vdot)] / scale[:, None], rank)
    return _with_rows(motion, y, coordinates, wanted, path, kept)


def _independent(C_q: Array, rank: int) -> Index:
    """Numbers of `rank` independent rows, in units of their scales. Of a row that joints of a tree hold already round-off is left."""
    lengths = np.linalg.norm(C_q, axis=1, keepdims=True)
    unit = np.where(lengths > NOTHING * lengths.max(), C_q / np.maximum(lengths, 1e-300), 0.0)
    pivoted: Any = scipy.linalg.qr(unit.T, mode="economic", pivoting=True)
    order = pivoted[2]
    return np.sort(order[:rank])


def _with_rows(
    motion: MotionEquations, y: Array, coordinates: str, wanted: ResidualOptions, path: PathFacts, kept: Index
) -> MotionEquations:
    """With the rows `kept` of those of the saddle."""
    system = motion.system
    record = system.record
    row, part = np.ascontiguousarray(record.saddle.row[kept]), _parts(record, coordinates, kept)
    velocities = len(y) - system.positions - len(record.elements.state) - 2
    # residuals over a whole step have elements of beams act at the mean place too
    # and by hand nothing is known of rotation coordinates, of modes that move nodes of beams, nor of beams that move nodes of others
    by_rates = coordinates == "absolute" and len(system.map.turns) == 0
    unknown = wanted.whole or wanted.along or by_rates or nivel.system.beam_tables.has_carried_nodes(record)
    by_hand = not unknown and nivel.system.beam_tables.has_elastic_beams(record)
    plain = nivel.system.beam_tables.plain_nodes(system, part) if by_hand else {}
    # over a whole step the forces of joints act at the mean place, C is that of the end
    mirrored = wanted.free is None and not len(system.frictions)
    groups = unknown_groups(system, velocities, row, part, coordinates)
    plan = plan_tangent(
        *groups,
        mirrored=mirrored,
        found=plain.values(),
        alone=integrals(system, groups[1]),
        stages=3 if wanted.shifted else 0,
    )
    record = record._replace(
        residual=_residual(system, y, velocities, row, part, wanted),
        newton=_newton(system, y, velocities, len(row), plan, wanted),
        hooks=_hooks(system, path, wanted, by_hand=by_hand),
    )
    if by_hand:
        record = record._replace(beams=nivel.system.beam_tables.tangent_tables(record, plan, plain))
    twin = _twin(record, held=by_hand)
    family, instant = _families(path, wanted)
    record.newton.address[:] = twin.address, family.dual_address, instant.dual_address
    return MotionEquations(replace(system, record=record), motion.kernels, twin)


def _parts(record: Record, coordinates: str, kept: Index) -> NDArray[np.uint32]:
    """Parts of the rows `kept`, with their numbers among these: `Residual.part`."""
    part = parts_of(record, coordinates == "relative")
    renumbered = np.full(len(record.saddle.row), kernels.NONE, dtype=np.uint32)
    renumbered[kept] = np.arange(len(kept))
    part[:, 0] = renumbered[part[:, 0]]
    return np.ascontiguousarray(part[part[:, 0] != kernels.NONE])


def _residual(
    system: System,
    y: Array,
    velocities: int,
    row: NDArray[np.uint32],
    part: NDArray[np.uint32],
    wanted: ResidualOptions,
) -> Residual:
    """Its tables, with what is known of the inertia of bodies where it is one over a whole step."""
    record, own = system.record, system.record.flexible
    whole = wanted.free is not None
    residual = residual_tables(
        len(record.bodies.wrench) - 1,
        len(y),
        velocities,
        len(record.elements.state),
        row,
        part,
        stiction=frictions_with_stiction(system),
        free=wanted.free,
        flexible=(len(own.p), len(own.frame), len(own.body)) if whole else (0, 0, 0),
        nodes=nivel.elements.beams.exact.nodes_of_elements(record) if whole else [],
    )
    if whole:
        solid = np.flatnonzero(~system.point_masses)
        residual.interval.inertia[solid] = record.bodies.inertia_b[solid]
    return residual


def _newton(system: System, y: Array, velocities: int, rows: int, plan: TangentPlan, wanted: ResidualOptions) -> Newton:
    """Tables of Newton's iteration for so many rows of constraints."""
    newton = newton_tables(
        places(system.map, velocities, system.positions),
        len(y),
        len(system.record.elements.state),
        rows + len(frictions_with_stiction(system)),
        plan,
        wanted.corners,
        length=system.size,
        shifted=wanted.shifted,
        balance=wanted.balance,
        filtered=wanted.filtered,
        compliance=wanted.compliance,
    )
    newton.settings[3] = ROUNDINGS * _longest_chain(system.record)
    return newton


def _families(path: PathFacts, wanted: ResidualOptions) -> tuple[Family, Family]:
    """The residual, and the one at an instant where accelerations are found by it."""
    family = import_module(wanted.whole or path.residual).residual
    return family, import_module(path.residual).residual if wanted.balance else family


def _hooks(system: System, path: PathFacts, wanted: ResidualOptions, *, by_hand: bool) -> Hooks:
    """Those of the system, with what the residual of this machine calls. by_hand : derivatives of elements of beams are."""
    record = system.record
    address = record.hooks.address.copy()
    family, instant = _families(path, wanted)
    address[kernels.RESIDUAL], address[kernels.MOMENTARY] = family.address, instant.address
    if by_hand:
        address[kernels.TANGENT] = nivel.elements.beams.exact_slopes.tangent.address
    if len(record.modal.carrier):
        address[kernels.MODES] = pass_modes.address
    elif wanted.whole and len(record.flexible.body):
        address[kernels.MODES] = import_module(wanted.whole).pass_flexible.address
    if len(record.tree.slider):
        address[kernels.PASS] = pass_nodes.address
        address[kernels.SLIDERS] = pass_sliders.address
    if wanted.accelerations and path.dependent:
        address[kernels.DEPENDENT] = import_module(path.dependent).depend.address
    if len(system.frictions):
        address[kernels.GIVEN_FRICTION] = friction_residual.apply.address
    return record.hooks._replace(address=address)


def _longest_chain(record: Record) -> int:
    """Bodies on the longest way from the ground along the tree; 1 where bodies have coordinates of their own."""
    depth: dict[int, int] = {}
    for n, (child, parent) in enumerate(record.tree.node[:, :2].tolist()):
        depth[child] = max(depth.get(each, 0) for each in (parent, *nivel.system.beam_tables.rail_of(record, n))) + 1
    return max(depth.values(), default=1)


def _twin(record: Record, *, held: bool) -> Handle:
    """The record with dual numbers for its work, and with the families of forces compiled for it.

    held : elements of beams without damping keep their wrenches, since their derivatives are found by hand.
    """
    twin = dual_twin(record)
    address = np.zeros_like(record.hooks.address)
    # behind the others are motions of joints, and then what adds slopes of circuits, which are real numbers
    end = len(address) - len(record.circuit.tangent.family)
    for hook in (
        kernels.MEASURE,
        kernels.RAIL,
        kernels.GIVEN_FRICTION,
        kernels.POINTS,
        kernels.MODES,
        kernels.SLIDERS,
        *range(kernels.HOOKS, end),
    ):
        address[hook] = _on_duals(record.hooks.address[hook])
    families = np.array([_on_duals(each) for each in record.elements.address], dtype=np.uint64)
    if held:
        families[nivel.system.beam_tables.elastic_family(record)] = nivel.elements.beams.exact.hold.dual_address
    laws = np.array([dual_address(int(each)) if each else 0 for each in record.functions.address], dtype=np.uint64)
    return Handle(
        twin._replace(
            elements=twin.elements._replace(address=families),
            functions=twin.functions._replace(address=laws),
            hooks=Hooks(address),
        )
    )


def _on_duals(address: Any) -> int:
    """Address of the same family on dual numbers; 0 where there is none."""
    return FAMILIES[int(address)].dual_address if address else 0


def evaluate_residual(motion: MotionEquations, t: float) -> int:
    """Status of the residual for what its record asks; its value is left there."""
    return int(entries.evaluate_residual(motion.handle.address, t))


def find_tangent(
    motion: MotionEquations, t: float, position: float, velocity: float, state: float
) -> tuple[int, Array]:
    """Status and matrix (N, N) of Newton's iteration; unknowns move positions, velocities and states by these shares [s², s, s]."""
    newton = motion.system.record.newton
    status = int(entries.find_tangent(motion.handle.address, t, position, velocity, state))
    size = len(newton.b)
    row = np.repeat(np.arange(size), np.diff(newton.row_start.astype(np.int64)))
    out = np.zeros((size, size))
    out[row, newton.column] = newton.value
    return status, out
