"""Faults of a finite-element model, found before it is solved, and said with what to do."""

from typing import Final

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from nivel.flexible.model.model import AXES, FiniteElementModel, Sparse
from nivel.flexible.model.solid_elements import SolidElements
from nivel.flexible.reduction.factor import NoStiffnessError
from nivel.flexible.reduction.free_body import FreeBody

SYMMETRIC: Final = 1e-8  # unsymmetric part as a share of the largest element
GROUNDED: Final = 1e-6  # force of a rigid motion as a share of what stiffness could give
SLOWEST, FASTEST = 5.0, 1e5  # [m/s] of waves in materials
FEW: Final = 100  # nodes below which a model may be condensed, and waves through its matrices are only a rough guess
POINT: Final = 1e-10  # of mass times size², below which an inertia is none
LIGHTEST, DENSEST = 0.01, 1e5  # [kg/m^3]
NEGATIVE: Final = 1e-9  # share of the largest eigenvalue, below which a negative one is round-off
LANCZOS: Final = 60  # vectors
MORE_DIGITS: Final = "Take larger or thicker elements, or matrices with more digits"
ONE_POINT: Final = (
    "Elements with strain at their middle alone (C3D8R, and S4R, which is one layer of these) bend without any: take S4 or S8R, C3D8I or "
    "C3D20R, in their place"
)
# energy of rigid motions by that of the lowest mode: from where it is told, and refused
DIGITS, FEW_DIGITS = (1e-4, 0.02)
SPREAD: Final = 8.0  # times this the energy of a mode was wrong, of thin plates as CalculiX writes them
THIN: Final = 1e-5  # frequency of rigid motions by that of a wave along the body, above which digits are missing
SHOWN: Final = 6  # nodes that a message names


def unsymmetric(matrix: Sparse, what: str) -> str:
    """Why `matrix` is not symmetric; empty where it is."""
    difference = sp.coo_array(matrix - matrix.T)
    scale = np.abs(matrix.data).max() if matrix.nnz else 1.0
    if not difference.nnz or np.abs(difference.data).max() <= SYMMETRIC * scale:
        return ""
    at = int(np.argmax(np.abs(difference.data)))
    i, j = difference.coords[0][at], difference.coords[1][at]
    one_triangle = sp.tril(matrix, -1).nnz == 0 or sp.triu(matrix, 1).nnz == 0
    triangle = " Only one triangle is stored and the file says the whole matrix." if one_triangle else ""
    return (
        f"the {what} matrix is not symmetric: element ({i + 1}, {j + 1}) is {matrix[i, j]:.6g}, ({j + 1}, {i + 1}) is "
        f"{matrix[j, i]:.6g}.{triangle} Export the symmetric matrix of a linear step, without friction, follower loads or rotor terms"
    )


def problems(model: FiniteElementModel) -> list[str]:
    """Everything found without solving."""
    found = [unsymmetric(model.stiffness, "stiffness"), unsymmetric(model.mass.matrix, "mass")]
    found += [_unconnected(model), _without_mass(model), _grounded(model)]
    found = [each for each in found if each]
    return found or [each for each in [_negative_energy(model), _waves(model)] if each]


def _unconnected(model: FiniteElementModel) -> str:
    """Parts between which there is no stiffness. The freedoms of a node belong together."""
    nodes, axes = np.nonzero(model.freedoms >= 0)
    rows = (np.ones(len(nodes)), (nodes, model.freedoms[nodes, axes]))
    share = sp.csr_array(rows, shape=(len(model.position), model.expansion.shape[0])) @ abs(model.expansion)
    number, part = connected_components(share @ abs(model.stiffness) @ share.T, directed=False)
    if number == 1:
        return ""
    sizes = np.bincount(part)
    order = np.argsort(sizes)[::-1]
    firsts = [model.node_ids[np.flatnonzero(part == p)[0]] for p in order[:SHOWN]]
    texts = [
        f"{sizes[p]} node{'s' if sizes[p] > 1 else ''} from node {first}"
        for p, first in zip(order, firsts, strict=False)
    ]
    more = f" and {number - SHOWN} more" if number > SHOWN else ""
    return (
        f"the model falls into {number} parts that no stiffness joins: {'; '.join(texts)}{more}. Merge coincident nodes, tie the "
        "parts in the finite-element program, or reduce each part as a body of its own"
    )


def _negative_energy(model: FiniteElementModel) -> str:
    """Whether a motion has negative energy; elements known here give none. The rest of this check is that of the factor.

    By Lanczos' method on the stiffness scaled to a unit diagonal, whose Ritz values are never below the least eigenvalue.
    """
    if model.elements is not None:
        return ""
    diagonal = model.stiffness.diagonal()
    if diagonal.min(initial=0.0) < 0.0:
        return _not_elastic(model, int(np.argmin(diagonal)))
    scale = 1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
    basis, rows = [np.random.default_rng(4).normal(size=len(scale))], []
    basis[0] /= np.linalg.norm(basis[0])
    for _ in range(min(LANCZOS, len(scale))):
        image = scale * (model.stiffness @ (scale * basis[-1]))
        rows.append(image)
        new = image.copy()
        for _ in range(2):
            new -= np.array(basis).T @ (np.array(basis) @ new)
        size = np.linalg.norm(new)
        if size < 1e-12:
            break
        basis.append(new / size)
    V = np.array(basis[: len(rows)])
    small = V @ np.array(rows).T
    values, vectors = np.linalg.eigh(0.5 * (small + small.T))
    if values[0] >= -NEGATIVE * values[-1]:
        return ""
    return _not_elastic(model, int(np.argmax(np.abs(scale * (V.T @ vectors[:, 0])))))


def _not_elastic(model: FiniteElementModel, independent: int) -> str:
    return (
        f"the stiffness matrix has a motion of negative energy, at most at node {_node_of(model, independent)}, which no elastic body has. "
        "Export it without a load near buckling, and look for a wrong sign or rows in another order than the table `freedoms` says"
    )


def _node_of(model: FiniteElementModel, independent: int) -> str:
    """The number of the node of an independent freedom, with its direction."""
    full = int(model.independent[independent])
    node, axis = np.argwhere(model.freedoms == full)[0]
    return f"{model.node_ids[node]} ({AXES[axis]})"


def _without_mass(model: FiniteElementModel) -> str:
    along = model.rigid_modes()[:, :3]
    rigid = along.T @ (model.mass.matrix @ along)
    total = float(np.trace(rigid)) / 3.0
    if total <= 0.0:
        return "the model has no mass: give the materials a density, or a mass matrix"
    if np.abs(rigid - total * np.eye(3)).max() > 1e-3 * total:
        masses = ", ".join(f"{m:.6g}" for m in np.diag(rigid))
        return (
            f"the mass matrix has another mass along x, y and z ({masses} kg): degrees of freedom are missing, supports were removed from "
            "the matrix, or rows stand for other directions than the table `freedoms` says"
        )
    R = model.rigid_modes(model.position.mean(axis=0))
    about = R.T @ (model.mass.matrix @ R)
    inertia, axes = np.linalg.eigh(about[3:, 3:] - about[3:, :3] @ about[:3, 3:] / total)  # about the centre of mass
    if inertia[0] <= POINT * total * model.size**2:
        axis = ", ".join(f"{x:.3g}" for x in axes[:, 0] * np.sign(axes[np.argmax(np.abs(axes[:, 0])), 0]))
        return (
            f"the mass matrix has no inertia about the axis ({axis}) through the centre of mass: all mass is on a line or at a point, as "
            "that of a single element C3D8R is; take more elements, or elements with more points, such as C3D8I or C3D20R"
        )
    return ""


def _grounded(model: FiniteElementModel) -> str:
    """Whether a rigid motion costs energy."""
    R = model.rigid_modes(model.position.mean(axis=0))
    R = R / np.abs(R).max(axis=0)
    force = np.abs(model.stiffness @ R)
    possible = np.abs(model.stiffness) @ np.abs(R)
    share = force.max(axis=0) / np.maximum(possible.max(axis=0), 1e-300)
    worst = int(np.argmax(share))
    if share[worst] <= GROUNDED:
        return ""
    where = _node_of(model, int(np.argmax(force[:, worst])))
    motions = [f"along {a}" for a in "xyz"] + [f"about {a}" for a in "xyz"]
    causes = f"a rigid motion {motions[worst]} causes a force at node {where}, {share[worst]:.2g} of what its stiffness could give."
    elements = model.elements
    if worst > 2 and isinstance(elements, SolidElements) and elements.has_one_point:
        return (
            f"{causes} The hourglass control of elements C3D8R and S4R resists turns where they are no parallelepipeds. {ONE_POINT}. If "
            "there are supports or springs to ground in the deck, remove these"
        )
    return (
        f"the stiffness matrix holds the body to the ground: {causes} Remove supports, springs to ground and boundary conditions in the "
        "finite-element program; interfaces are held by joints later. If there are none, coordinates and matrix differ in units or axes"
    )


def _waves(model: FiniteElementModel) -> str:
    """Whether stiffness, mass and lengths fit together: waves in materials travel between 5 m/s and 100 km/s."""
    speed = wave_speed(model)
    doubt = 10.0 if len(model.position) < FEW else 1.0
    if speed is None or SLOWEST / doubt <= speed <= FASTEST * doubt:
        return ""
    return (
        f"stiffness, mass and lengths do not fit together: waves would travel at {speed:.2g} m/s, in metals it is about 5000 m/s. "
        f"{_likely(speed / 5000.0)} Say what the units of the files are, `units: {{length: mm, mass: t}}` for instance"
    )


def _likely(ratio: float) -> str:
    """The slip that gives a wave speed that is wrong by `ratio`: it goes with length × √(stiffness / mass)."""
    candidates = {
        1e-3: "Lengths look like metres where the matrices are in N, t and mm (or masses are 1e6 times too large).",
        31.6: "The mass looks 1000 times too small: t for kg.",
        0.0316: "The mass looks 1000 times too large: g for kg.",
        1e3: "Lengths look like millimetres, or the mass looks 1e6 times too small.",
        10**4.5: "The mass looks 1e9 times too small: a density in t/mm³ for kg/m³ with lengths in m.",
        10**-4.5: "The mass looks 1e9 times too large: a density in kg/m³ with lengths in mm.",
        1e6: "The mass looks 1e12 times too small: a density in t/mm³ with lengths in m.",
        1e-6: "The mass looks 1e12 times too large.",
    }
    nearest = min(candidates, key=lambda each: abs(np.log(each / ratio)))
    return candidates[nearest]


def wave_speed(model: FiniteElementModel) -> float | None:
    """[m/s] estimated from translations: distance to stiff neighbours × √(K_ii / M_ii), median over nodes."""
    K, M = model.stiffness, model.mass.matrix
    at = model.independent
    rows = np.full(model.expansion.shape[0], -1)
    rows[at] = np.arange(len(at))
    own = rows[model.freedoms[:, 0]]
    nodes = np.flatnonzero((own >= 0) & (model.freedoms[:, 0] >= 0))[:: max(1, len(own) // 200)]
    speeds = []
    for node in nodes:
        row = own[node]
        neighbours = K.indices[K.indptr[row] : K.indptr[row + 1]]
        owners = np.flatnonzero(np.isin(model.freedoms[:, :3], at[neighbours]).any(axis=1))
        distances = np.linalg.norm(model.position[owners] - model.position[node], axis=1)
        distances = distances[distances > 0.0]
        k, m = K[row, row], M[row, row]
        if len(distances) and k > 0.0 and m > 0.0:
            speeds.append(distances.min() * np.sqrt(k / m))
    return float(np.median(speeds)) if speeds else None


def mass_problem(mass: float, expected: float | None, volume: float | None, size: float) -> str:
    """Why the mass [kg] cannot be right; empty where it can. volume : [m³] of the mesh; size : [m] of the body."""
    if expected is not None:
        ratio = mass / expected
        if 0.5 <= ratio <= 2.0:
            return ""
        return f"the model weighs {mass:.6g} kg and {expected:.6g} kg were expected, {ratio:.3g} times as much{_power(ratio)}"
    density = mass / (volume if volume is not None else size**3)
    lightest = LIGHTEST if volume is not None else 1e-5
    if lightest <= density <= DENSEST:
        return ""
    what = "a mean density" if volume is not None else "a mean density, in a cube around it,"
    return f"the model weighs {mass:.6g} kg with a size of {size:.4g} m: {what} of {density:.3g} kg/m^3{_power(density / 1000.0)}"


def _power(ratio: float) -> str:
    """What a factor of about a power of a thousand usually means."""
    exponent = 3 * round(np.log10(ratio) / 3.0)
    meaning = {
        3: "masses in g or t taken for kg",
        6: "lengths in mm taken for m in two of three places",
        9: "a density in kg/m³ used with lengths in mm, or in t/mm³ taken for kg/mm³",
        12: "a density in kg/m³ used with a model in t and mm",
    }.get(abs(exponent))
    if exponent == 0 or meaning is None or abs(np.log10(ratio) - exponent) > 1.3:
        return "; check the units of densities and lengths"
    return f", about 1e{exponent}: {meaning}; check `units`, and the units of densities"


def rigid_energy(body: FreeBody) -> float:
    """[1/s²] the largest energy of a rigid motion by its kinetic energy at 1 rad/s: zero but for the digits of the stiffness matrix."""
    return float(np.abs(np.linalg.eigvalsh(body.rigid.T @ (body.K @ body.rigid))).max())


def digits(body: FreeBody, lowest: float) -> tuple[float, str]:
    """Energy of rigid motions as a share of that of the lowest mode, with eigenvalue `lowest` [1/s²], and what it means."""
    share = rigid_energy(body) / max(lowest, 1e-300)
    return share, (
        f"Rigid motions store {share:.2g} of the energy of the lowest mode: the stiffness matrix has too few digits for a body as thin as "
        f"this, and the lowest frequencies may be wrong by {50.0 * SPREAD * share:.2g} %. {MORE_DIGITS}"
    )


def mechanism(body: FreeBody, error: NoStiffnessError) -> str:
    """Which nodes can move although no rigid motion is left; or that the digits of the matrix are too few to know."""
    noise, speed = np.sqrt(rigid_energy(body)), wave_speed(body.model)
    if speed is not None and noise > THIN * 2.0 * np.pi * speed / body.model.size:
        return (
            f"the stiffness matrix has too few digits for a body as thin as this: rigid motions store the energy of "
            f"{noise / (2.0 * np.pi):.2g} Hz, and a motion that is not rigid stores none. {MORE_DIGITS}"
        )
    moved = np.nan_to_num(body.model.node_motion(error.motion[:, None])[:, :, 0])
    size = np.abs(moved).max(axis=1)
    nodes = np.argsort(size)[::-1]
    nodes = nodes[size[nodes] > 0.5 * size.max()][:SHOWN]
    texts = [f"{body.model.node_ids[node]} ({AXES[int(np.argmax(np.abs(moved[node])))]})" for node in nodes]
    elements = body.model.elements
    hourglass = f". {ONE_POINT}" if isinstance(elements, SolidElements) and elements.has_one_point else ""
    return (
        f"the stiffness is singular beyond the six rigid motions: a mechanism is left in which node{'s' if len(texts) > 1 else ''} "
        f"{', '.join(texts)} move{'' if len(texts) > 1 else 's'} most. Join what is loose, remove hinges and degrees of freedom without "
        f"stiffness{hourglass}"
    )
