"""Findings about a reduction: frequencies against the whole model, shapes, masses, and what each neglect would cost.

Discretisation error of a finite-element model: the error of the energy of each mode, estimated at reduction.
Solids by the strain that is left when strains are smoothed over the nodes (Zienkiewicz, Zhu 1987): the share of its strain energy that
a mode lacks, so by how much its eigenvalue is too high. Of bent bars of one to four quadratic tetrahedra over their height it was half
of that, so it is doubled. Frames by elements of half the length: the deflection between nodes that forces
at nodes make is exact, so there the error is that of inertia between the nodes alone.
"""

from typing import Any, Final

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from nivel.flexible.body.body import MeshError
from nivel.flexible.body.invariants import Invariants
from nivel.flexible.body.mass_invariants import invariants
from nivel.flexible.model.frame import frame_model
from nivel.flexible.model.model import AXES, Array, FiniteElementModel, Sparse
from nivel.flexible.model.model_file import Located
from nivel.flexible.model.solid_elements import SolidElements
from nivel.flexible.model.solid_shapes import TETRAHEDRON_4, TETRAHEDRON_10
from nivel.flexible.reduction.bases import Basis
from nivel.flexible.reduction.factor import NoStiffnessError, Whole
from nivel.flexible.reduction.free_body import FreeBody, Orthonormal
from nivel.flexible.reduction.ties import Attachment
from nivel.lazy import Struct, asdict

# Faults of a finite-element model, found before it is solved, and said with what to do.

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


MOST: Final = 40  # modes of the whole model that are computed for comparison
DEFLECTION: Final = 0.01  # of the size of the body: for what neglected invariants would cost
TURN: Final = 0.05  # [rad] or so much turn of a node, whatever is less
EQUAL: Final = 1e-4  # frequencies that differ relatively by less are taken as equal
FINE: Final = 0.01  # of a frequency, that the mesh makes it wrong by, at most
HOURGLASS: Final = 0.1  # of the energy of a mode, by hourglass control: its frequency is wrong by half of that
ILL: Final = 1e10  # condition of the basis from which on it is told


class Findings(Struct):
    """Numbers of the report; lists, so that they go to JSON as they are.

    full, reduced : [Hz] elastic frequencies of the free body: of the whole model, and of the reduced one in their order.
    mac : (full, reduced) modal assurance criterion, mass-weighted. normal : [Hz] of the normal modes, as the body was held.
    effective_mass : (modes, 6) share of mass and inertia about the mass centre that a mode of the body held at its
    interfaces moves; empty where there are none. Columns x, y, z, about x, y, z.
    mesh_error : share by which the mesh makes the energy of each mode of the body wrong, estimated; empty where it is not known.
    neglect : largest relative change of the mass matrix without I5, I8, I9, while the body is bent by a hundredth of its size.
    """

    freedoms: int
    nodes: int
    mass: float
    volume: float | None
    centre_of_mass: list[float]
    inertia: list[list[float]]
    principal_inertia: list[float]
    full: list[float]
    reduced: list[float]
    mac: list[list[float]]
    normal: list[float]
    effective_mass: list[list[float]]
    rigid_frequencies: list[float]
    condition: float
    dependent: int
    boundary: list[str]
    neglect: dict[str, float]
    mesh_error: list[float]
    statements: list[str]
    notes: list[str]

    @property
    def partners(self) -> list[int]:
        """The reduced mode, from 0, that is most alike each mode of the whole model."""
        return [max(range(len(row)), key=row.__getitem__) for row in self.mac]

    @property
    def errors(self) -> list[float]:
        """Relative error of the reduced frequencies."""
        return [r / f - 1.0 for f, r in zip(self.full, self.reduced, strict=False)]

    def as_data(self) -> dict[str, Any]:
        """Everything, for JSON."""
        return asdict(self) | {"errors": self.errors}


def findings_of(
    body: FreeBody,
    attachments: tuple[Attachment, ...],
    boundary: Whole,
    basis: Basis,
    found: Orthonormal,
    modes: Array,
    error: MeshError | None,
) -> Findings:
    """The findings of a reduction. `found` : of mean axes; `modes` (N, n) : those of the body; `error` : of its mesh."""
    model = body.model
    its = invariants(model.mass, modes)
    centre = its.I2 / its.I1
    inertia = its.I7 - its.I1 * ((centre @ centre) * np.eye(3) - np.outer(centre, centre))
    values, whole = body.elastic_modes(min(MOST, len(found.eigenvalues)))
    reduced = np.sqrt(np.maximum(found.eigenvalues, 0.0)) / (2.0 * np.pi)
    full = np.sqrt(values) / (2.0 * np.pi)
    shapes = likeness(whole.T @ (body.M @ found.modes), full)
    return Findings(
        freedoms=model.count,
        nodes=len(model.position),
        mass=its.I1,
        volume=model.volume,
        centre_of_mass=centre.tolist(),
        inertia=inertia.tolist(),
        principal_inertia=np.linalg.eigvalsh(inertia).tolist(),
        full=full.tolist(),
        reduced=reduced.tolist(),
        mac=shapes.tolist(),
        normal=basis.frequencies.tolist(),
        effective_mass=_effective_mass(body, boundary, basis, centre, inertia, its.I1),
        rigid_frequencies=found.rigid_frequencies.tolist(),
        condition=found.condition,
        dependent=found.dependent,
        boundary=[f"{each.name}.{axis}" for each in attachments for axis in _axes(body, each)],
        neglect=neglect(its, _bent(body, modes)),
        mesh_error=[] if error is None else error.share.tolist(),
        statements=[
            *_statements(full, reduced, found),
            *_hourglass_statement(body, values, whole),
            *_digits_statement(body, values),
            *_mesh_statement(error),
        ],
        notes=list(model.notes),
    )


def likeness(products: Array, full: Array) -> Array:
    """MAC from the products wholeᵀ M reduced of orthonormal modes, (f, r). Modes of the whole model with equal frequencies `full`
    are any mixture of each other: they are mixed so that they fit the reduced ones.
    """
    products = products.copy()
    start = 0
    while start < len(full):
        stop = start + 1
        while stop < len(full) and full[stop] < full[start] * (1.0 + EQUAL):
            stop += 1
        if stop - start > 1:
            block = products[start:stop]
            nearest = np.sort(np.argsort(-(block**2).sum(axis=0))[: stop - start])
            left, _, right = np.linalg.svd(block[:, nearest])
            products[start:stop] = (left @ right).T @ block
        start = stop
    return products**2


def _axes(body: FreeBody, each: Attachment) -> list[str]:
    return [axis for k, axis in enumerate(AXES) if body.model.freedoms[each.node, k] >= 0]


def _bent(body: FreeBody, modes: Array) -> Array:
    """(n,) modal coordinates that bend the body by DEFLECTION of its size or turn a node by TURN, whatever is less [kg^½ m]."""
    motion = np.nan_to_num(body.model.node_motion(modes)) ** 2
    moved, turned = (np.sqrt(part.sum(axis=1)).max(axis=0) for part in (motion[:, :3], motion[:, 3:]))
    return 1.0 / np.maximum(np.maximum(moved / (DEFLECTION * body.model.size), turned / TURN), 1e-300)


def _effective_mass(
    body: FreeBody, boundary: Whole, basis: Basis, centre: Array, inertia: Array, mass: float
) -> list[list[float]]:
    """Squared participation of the normal modes in rigid motions of the whole, as shares: Σ over all modes is one, less what
    sits on the interfaces themselves.
    """
    if not basis.normal or not len(boundary):
        return []
    normal = basis.vectors[:, basis.vectors.shape[1] - basis.normal :]
    R = body.model.rigid_modes(centre)
    participation = (R.T @ (body.M @ normal)) ** 2
    whole = np.concatenate([np.full(3, mass), np.diag(inertia)])
    return (participation / whole[:, None]).T.tolist()


def neglect(its: Invariants, q: Array) -> dict[str, float]:
    """What leaving out I5, I8 or I9 changes in the mass matrix, relative, at most, for a modal coordinate q (n,) of one mode."""
    if not len(q):
        return {}
    inertia = np.abs(its.I7).max()
    linear = np.abs(its.I8 + its.I8.transpose(0, 2, 1)).max(axis=(1, 2)) * q
    quadratic = np.abs(np.einsum("jjab->jab", its.I9)).max(axis=(1, 2)) * q**2
    # M_θf couples turns (J) and modes (unit mass): of the geometric mean of both
    turning = np.abs(its.I5).max(axis=(1, 2)) * q / np.sqrt(inertia)
    return {"I5": float(turning.max()), "I8": float(linear.max() / inertia), "I9": float(quadratic.max() / inertia)}


def _statements(full: Array, reduced: Array, found: Orthonormal) -> list[str]:
    """What deserves attention, in sentences."""
    out = []
    if len(found.rigid_frequencies):
        count, highest = len(found.rigid_frequencies), max(found.rigid_frequencies)
        out.append(f"{count} rigid-body modes were found (below {highest:.1g} Hz) and removed.")
    else:
        out.append("The basis spans no rigid motion; there was none to remove.")
    if found.dependent:
        out.append(f"{found.dependent} vectors of the basis depended on others and were left out.")
    if found.condition > ILL:
        text = "some degrees of freedom of the interfaces move the body in the same way, or move hardly any mass"
        out.append(f"The basis is ill-conditioned ({found.condition:.2g}): {text}; take away interfaces that coincide.")
    count = min(len(full), len(reduced))
    good = np.flatnonzero(np.abs(reduced[:count] / full[:count] - 1.0) > 0.01)
    if count:
        until = count if not len(good) else int(good[0])
        limit = f", up to {full[until - 1]:.4g} Hz" if until else ""
        out.append(
            f"The first {until} of {count} frequencies of the free body are within 1 % of those of the whole model{limit}."
        )
    return out


def _hourglass_statement(body: FreeBody, values: Array, modes: Array) -> list[str]:
    """Modes (N, n) with the eigenvalues (n,) whose elements have hardly any strain, though no rigid motion is left: what resists them is a
    control that keeps elements of one point from moving like an hourglass, and no property of the body."""
    elements = body.model.elements
    if not isinstance(elements, SolidElements) or not elements.has_one_point or not len(values):
        return []
    control = 1.0 - elements.strain_energy(body.model.expansion @ modes) / (0.5 * np.maximum(values, 1e-300))
    bad = np.flatnonzero(control > HOURGLASS)
    if not len(bad):
        return []
    first = int(bad[0])
    frequency, strained = np.sqrt(values[first]) / (2.0 * np.pi), 100.0 * (1.0 - control[first])
    return [
        f"{len(bad)} of {len(values)} modes of the free body are hourglass modes: in mode {first + 1} at {frequency:.4g} Hz strains of the "
        f"elements make {strained:.2g} % of the energy, the rest is hourglass control. {ONE_POINT}."
    ]


def _digits_statement(body: FreeBody, values: Array) -> list[str]:
    share, text = digits(body, float(values[0])) if len(values) else (0.0, "")
    return [f"{text}."] if share > DIGITS else []


def _mesh_statement(error: MeshError | None) -> list[str]:
    """What the mesh makes of the frequencies: half of what it makes of energies."""
    if error is None:
        return []
    off = 0.5 * error.share
    good = np.flatnonzero(off > FINE)
    until = len(off) if not len(good) else int(good[0])
    advice = "" if not len(good) else ("; take more `elements`" if error.dynamic else "; take a smaller `element_size`")
    return [
        f"The mesh makes the frequency of the first mode wrong by {100 * off[0]:.2g} %, that of the last one by {100 * off[-1]:.2g} % "
        f"(estimated): the first {until} of {len(off)} are within {100 * FINE:g} %{advice}."
    ]


# Freedoms of the finer frame, at most; modes that are compared.
MOST_FREEDOMS, COMPARED = 30_000, 30
SMOOTHED = 2.0
RICHARDSON = 4.0 / 3.0  # for errors that fall with the square of the length, or faster


def mesh_error(located: Located, model: FiniteElementModel, modes: Array, eigenvalues: Array) -> MeshError | None:
    """The estimate for `modes` (N, n) of a body with these `eigenvalues` (n,) [1/s²]; None where elements are not known
    or are no tetrahedra."""
    if isinstance(model.elements, SolidElements):
        if any(block.shape not in (TETRAHEDRON_4, TETRAHEDRON_10) for block in model.elements.blocks):
            return None
        return MeshError(SMOOTHED * model.elements.energy_error(model.expansion @ modes), dynamic=False)
    if located.record.frame is None or 2 * model.count > MOST_FREEDOMS:
        return None
    values = FreeBody.of(frame_model(located)).elastic_modes(COMPARED)[0]
    finer = FreeBody.of(frame_model(_halved(located))).elastic_modes(len(values))[0]
    error = np.maximum.accumulate(np.abs(RICHARDSON * (values / finer[: len(values)] - 1.0)))
    return MeshError(np.interp(eigenvalues, values, error), dynamic=True)


def _halved(located: Located) -> Located:
    """The model with twice as many elements in each of its beams."""
    record, frame = located.record, located.record.frame
    assert frame is not None
    beams = {name: beam.model_copy(update={"elements": 2 * beam.elements}) for name, beam in frame.beams.items()}
    return located.with_record(
        record.model_copy(update={"frame": frame.model_copy(update={"beams": beams}), "interfaces": {}})
    )
