"""Relative coordinates in one state: every body, reaction and output of the tree is that of absolute coordinates."""

from pathlib import Path

import numpy as np
import pytest

import force_zoo
import linked
import machines
import nivel
from assembled import TIME, mass_matrix, random_states
from example_files import RIGID
from nivel.analysis.assembly.equations import MotionEquations
from nivel.kernels.bodies.patch_coordinate import PATCH
from nivel.kernels.core.status import OK
from nivel.kernels.output.observe import observe
from nivel.motion import relative as equations_in_relative
from nivel.system.elimination.topology import FREE
from nivel.system.states.relative import arrange, tree_of
from preparing import prepare

pytestmark = pytest.mark.covering

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def seeded(make, *arguments, **options):
    return lambda: make(*arguments, np.random.default_rng(11), **options)


PAIRS = {
    f"{kind}, {'ground' if ground else 'free'}{', turned' if turned else ''}{', half a turn' if half else ''}": seeded(
        linked.marked_pair, kind, ground=ground, turned=turned, half=half
    )
    for kind in linked.CARRIERS
    for ground in (True, False)
    for turned in (False, True)
    for half in ((False, True) if kind in ("translational", "fixed") else (False,))
}
LOOPS = {
    "slider-crank": machines.slider_crank,
    "four-bar": machines.four_bar,
    "four-bar of revolutes": lambda: machines.four_bar("revolute", "revolute"),
    "loops": lambda: linked.record(linked.loops()),
    "free ring": lambda: linked.record(linked.free_ring()),
}
MACHINES = {
    **LOOPS,
    "heavy-top": machines.heavy_top,
    "tree": seeded(machines.tree),
    "marked tree": seeded(linked.marked_tree),
    "free tree": seeded(linked.marked_tree, free=True),
    "two trees": lambda: two_trees(np.random.default_rng(3)),
    **{f"every element, {model}": (lambda model=model: linked.record(linked.every_element(model)))
       for model in ("coulomb", "stiction", "lugre")},
    **PAIRS,
    **{kind: seeded(machines.pair, kind) for kind in machines.BETWEEN_BODIES if kind not in linked.CARRIERS},
    **{path.name: (lambda path=path: nivel.load(path, allow_code=True).record) for path in RIGID},
}  # fmt: skip
EACH = pytest.mark.parametrize("name", MACHINES)


def two_trees(rng):
    """A tree on the ground, one on nothing, and a body alone."""
    ground, free = linked.marked_tree(rng, branches=1), linked.marked_tree(rng, free=True, branches=1)
    bodies = [body.replace(name=f"other_{body.name}") for body in free.bodies]
    joints = []
    for joint in free.joints:
        ends = tuple(end.replace(body=f"other_{end.body}") for end in joint.markers)
        joints.append(joint.replace(name=f"other_{joint.name}", markers=ends))
    return ground.replace(
        bodies=(*ground.bodies, *bodies, machines.random_body("alone", rng)), joints=(*ground.joints, *joints)
    )


def in_relative(machine, prepared, y):
    """The equations in relative coordinates and the state there that is y."""
    rank = int(prepared.absolute.system.record.control.rank[0])
    system, own = arrange(machine, prepared.absolute.system, y, rank, machine.simulation)
    own[-2:] = y[-2:]
    return MotionEquations(system, equations_in_relative), own


def frame(motion, y):
    """All that a run keeps of the state y, by variable."""
    assert motion.evaluate(TIME, y)[0] == OK
    row = np.zeros(motion.system.layout.width)
    observe(motion.handle.address, TIME, y, row)
    return row


def unique_columns(prepared):
    """Columns of a frame but for multipliers that the equations do not determine, and what is made of them."""
    system, loose = prepared.absolute.system, set(prepared.redundancy.non_unique_joints)
    chosen = np.ones(system.layout.width, dtype=bool)
    chosen[0] = False
    joints = np.array([name not in loose for name in system.joints], dtype=bool)
    rows = np.array([owner not in loose for owner in system.row_owner], dtype=bool)
    for variable in system.layout.variables:
        if variable.dims[1:2] == ("joint",):
            chosen[variable.columns] = np.repeat(joints, 3)
        if variable.name == "constraint_force":
            chosen[variable.columns] = rows
    return chosen


def forget(motion):
    """Make everything that an evaluation has to write useless; entries of rows that are always zero are written once only.

    The load of a patch says whether its rows have to be cleared: it is one of surfaces that touched.
    """
    record = motion.system.record
    constraints, coordinates, bodies, markers, frames = (
        record.constraints, record.coordinates, record.bodies, record.markers, record.frames
    )  # fmt: skip
    for array in (constraints.C, constraints.Cdot, constraints.gamma, constraints.lam):
        array[:] = np.nan
    for array in (coordinates.value, coordinates.rate, coordinates.bias, record.outputs.value):
        array[:] = np.nan
    coordinates.value[coordinates.what[:, 0] == PATCH] = 1.0
    for array in (bodies.R, bodies.theta, bodies.A, bodies.Rdot, bodies.omega, bodies.omega_b, bodies.c, bodies.wrench):
        array[:-1] = np.nan
    for array in (bodies.Rddot, bodies.alpha_b, frames.R, frames.theta, frames.Rdot, frames.Rddot):
        array[:-1] = np.nan
    for array in (markers.u, markers.r, markers.A, markers.rdot, markers.bias):
        array[:] = np.nan


@EACH
def test_frames_are_those_of_absolute_coordinates(name, rng):
    """Poses with the signs of Euler parameters, velocities, accelerations, reactions, rows, joint coordinates, energies, outputs."""
    machine = MACHINES[name]()
    prepared = prepare(machine, "newton-euler", "relative")
    for y in random_states(prepared, rng):
        assert_frames_agree(machine, prepared, y)


@pytest.mark.parametrize("name", [name for name, case in force_zoo.CASES.items() if "stick" in name and case.touches])
def test_frames_of_surfaces_that_rub_are_those_of_absolute_coordinates(name, rng):
    """The body is put where it touches; a state counts where friction has an effort."""
    case = force_zoo.CASES[name]
    machine = force_zoo.bed(case)
    prepared = prepare(machine, "newton-euler", "relative")
    body, other, offset = case.place
    first, origin = (7 * prepared.absolute.system.bodies.index(each) if each else None for each in (body, other))
    for y in random_states(prepared, rng, 10):
        y[first : first + 3] = np.array(offset) + (0.0 if origin is None else y[origin : origin + 3])
        if assert_frames_agree(machine, prepared, y).record.friction.force.any():
            return
    raise AssertionError(f"no state of {name} has an effort of friction")


def assert_frames_agree(machine, prepared, y):
    """The system in relative coordinates, whose frame in the state y is that of absolute ones."""
    motion, own = in_relative(machine, prepared, y)
    expected = frame(prepared.absolute, y)
    frame(prepared.absolute, prepared.assembly.y)
    forget(motion)
    got = frame(motion, own)
    chosen = unique_columns(prepared)
    largest = {each.name: np.abs(expected[each.columns]).max(initial=0.0) for each in motion.system.layout.variables}
    # where no body can turn, angular accelerations are round-off of what the same forces accelerate
    if largest["angular_acceleration"] < 1e-12 * largest["acceleration"]:
        largest["angular_acceleration"] = largest["acceleration"]
    # and where forces have no lever, torques of joints are round-off of these
    load = max(size for name, size in largest.items() if name == "joint_force" or name.endswith(".magnitude"))
    if largest["joint_torque"] < 1e-9 * load:
        largest["joint_torque"] = largest["joint_torque_local"] = load
    # components of a vector are on the scale of the vector
    for name in [each for each in largest if each.startswith("force.") and each.endswith("_x")]:
        parts = [part for part in (name[:-1] + axis for axis in "xyz") if part in largest]
        largest |= dict.fromkeys(parts, max(largest[part] for part in parts))
    # the middle of forces that are round-off is anywhere; what is apart says zero
    loose = tuple(
        name.removesuffix("normal_force")
        for name in largest
        if name.endswith("normal_force") and 0.0 < largest[name] < 1e-9
    )
    for variable in motion.system.layout.variables:
        if variable.name.startswith(loose):
            continue
        columns = np.arange(variable.columns.start, variable.columns.stop)
        columns = columns[chosen[columns]]
        scale = 1.0 + largest[variable.name]
        np.testing.assert_allclose(got[columns], expected[columns], atol=1e-9 * scale, err_msg=variable.name)
    return motion.system


def test_zoo_has_every_carrier_both_ways_on_the_ground_and_between_bodies():
    seen = set()
    for make in (*PAIRS.values(), MACHINES["marked tree"], MACHINES["free tree"]):
        machine = make()
        for branch in tree_of(machine, machine.simulation).branches:
            if branch.joint != FREE:
                seen.add((machine.joints[branch.joint].type, branch.turned, branch.parent == len(machine.bodies)))
    ways = (True, False)
    assert seen == {(kind, turned, ground) for kind in linked.CARRIERS for turned in ways for ground in ways}


TREES = {name: MACHINES[name] for name in ("marked tree", "free tree", "two trees", "loops", "free ring", *PAIRS)}
EACH_TREE = pytest.mark.parametrize("name", TREES)


def velocities_of(motion, y, u):
    """(Ṙ, ω̄) of all bodies (6 B,) in the coordinates' own frames, for joint velocities u at y."""
    system = motion.system
    state = y.copy()
    state[system.positions : system.positions + len(u)] = u
    motion.evaluate(TIME, state)
    bodies, count = system.record.bodies, system.body_count
    omega_b = np.einsum("bji,bj->bi", bodies.A[:count], bodies.omega[:count])
    return np.hstack([bodies.Rdot[:count], omega_b]).ravel()


def columns_of(motion, y):
    """H (6 B, U): velocities of all bodies for every joint velocity."""
    count = len(motion.system.record.tree.column)
    rows = [velocities_of(motion, y, unit) for unit in np.eye(count)]
    return np.array(rows).reshape(count, 6 * motion.system.body_count).T


@EACH_TREE
def test_factor_of_the_mass_matrix_is_that_of_the_kinetic_energy(name, rng):
    """∂²T/∂u² = Hᵀ M H. Whitened rows W = D^{-1/2} L⁻¹ Jᵀ give W Wᵀ = J (Hᵀ M H)⁻¹ Jᵀ, and the recursion its determinant Π D."""
    machine = TREES[name]()
    prepared = prepare(machine, "newton-euler", "relative")
    y = next(random_states(prepared, rng))
    motion, own = in_relative(machine, prepared, y)
    H = columns_of(motion, own)
    motion.evaluate(TIME, own)
    record = motion.system.record
    M = H.T @ mass_matrix(motion.system) @ H
    saddle = record.saddle
    if M.size == 0:
        return
    sign, logarithm = np.linalg.slogdet(M)
    assert sign == 1.0
    assert np.sum(-np.log(record.tree.Dinv)) == pytest.approx(logarithm, abs=1e-10 * max(1, len(M)))
    if not len(saddle.row):
        return
    W = np.zeros((len(saddle.row), len(M)))
    for (row, _, _, column), value in zip(saddle.block[: int(saddle.blocks[0])], saddle.W[:, 0], strict=False):
        W[row, column] = value
    J = rates_of_rows(motion, own)
    expected = J @ np.linalg.solve(M, J.T)
    np.testing.assert_allclose(W @ W.T, expected, atol=1e-10 * np.abs(expected).max())


def rates_of_rows(motion, y):
    """(K, U) Jacobian of the rows that are left: their rates for every joint velocity."""
    system, rows = motion.system, motion.system.record.saddle.row
    rates = []
    for unit in np.vstack([np.zeros(len(system.record.tree.column)), np.eye(len(system.record.tree.column))]):
        state = y.copy()
        state[system.positions : system.positions + len(unit)] = unit
        motion.evaluate(TIME, state)
        rates.append(system.record.constraints.Cdot[rows].copy())
    return (np.array(rates[1:]) - rates[0]).T


@EACH_TREE
def test_velocities_and_accelerations_are_derivatives_of_the_motion(name, rng):
    """Along y(t + s) = y + s ẏ: Ṙ, ω and R̈, α of every body against central differences of what the tree makes of it."""
    machine = TREES[name]()
    prepared = prepare(machine, "newton-euler", "relative")
    y = next(random_states(prepared, rng))
    motion, own = in_relative(machine, prepared, y)
    layout = {variable.name: variable.columns for variable in motion.system.layout.variables}
    frame(motion, own)
    _, rate = motion.evaluate(TIME, own)
    # second order in time: positions move along q̇ and ½ q̈, whose Euler parameters are differenced themselves
    s = 1e-5
    _, later = motion.evaluate(TIME, own + 1e-6 * rate)
    _, earlier = motion.evaluate(TIME, own - 1e-6 * rate)
    second = (later - earlier) / 2e-6
    ahead, behind = (frame(motion, own + k * s * rate + 0.5 * s**2 * second) for k in (1, -1))
    now = frame(motion, own)
    for value, derivative in (
        ("position", "velocity"),
        ("velocity", "acceleration"),
        ("angular_velocity", "angular_acceleration"),
        ("joint_coordinate", "joint_rate"),
    ):
        expected = now[layout[derivative]]
        got = (ahead[layout[value]] - behind[layout[value]]) / (2 * s)
        np.testing.assert_allclose(got, expected, atol=1e-6 * (1 + np.abs(expected).max(initial=0)), err_msg=derivative)
    # θ̇ = ½ ω ∘ θ
    theta, omega = now[layout["orientation"]].reshape(-1, 4), now[layout["angular_velocity"]].reshape(-1, 3)
    got = ((ahead - behind)[layout["orientation"]] / (2 * s)).reshape(-1, 4)
    expected = 0.5 * np.column_stack(
        [-np.sum(omega * theta[:, 1:], axis=1), theta[:, :1] * omega + np.cross(omega, theta[:, 1:])]
    )
    np.testing.assert_allclose(got, expected, atol=1e-6 * (1 + np.abs(omega).max()))


PENALISED = {
    **LOOPS,
    "bennett": machines.bennett,
    "tree": MACHINES["tree"],
    "every element": MACHINES["every element, coulomb"],
    "rssr": MACHINES["rssr.yaml"],
}


def accelerations(machine, formulation, coordinates, **penalty):
    """R̈ and α of all bodies at the start, as the formulation has them."""
    simulation = machine.simulation.replace(formulation=formulation, coordinates=coordinates, penalty=penalty)
    prepared = prepare(machine.replace(simulation=simulation), formulation, coordinates)
    motion = prepared.motion
    motion.system.record.control.stabilise[:] = 0.0
    row = np.zeros(motion.system.layout.width)
    assert motion.evaluate(0.0, prepared.start)[0] == OK
    observe(motion.handle.address, 0.0, prepared.start, row)
    columns = {variable.name: variable.columns for variable in motion.system.layout.variables}
    return np.concatenate([row[columns["acceleration"]], row[columns["angular_acceleration"]]])


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("name", PENALISED)
def test_penalties_come_near_as_they_grow_and_augmented_lagrangian_arrives(name, coordinates):
    """Accelerations of M v̇ + C_qᵀ α (C_q v̇ - γ) = Q: what is left of C̈ is λ/α, so the error falls as 1/α; iterated, it goes. Redundant
    machines too."""
    machine = PENALISED[name]()
    exact = accelerations(machine, "newton-euler", "absolute")
    scale = 1 + np.abs(exact).max()

    def error(formulation, **penalty):
        return np.abs(accelerations(machine, formulation, coordinates, **penalty) - exact).max() / scale

    assert error("augmented-lagrangian") < 1e-8
    assert error("penalty") < 1e-6
    coarse, fine = error("penalty", factor=1e4), error("penalty", factor=1e5)
    assert coarse < 1e-2
    if coarse > 1e-12:  # a tree has no rows left
        assert coarse / fine == pytest.approx(10.0, rel=0.05)
