"""Findings about a reduction: frequencies against the whole model, shapes, masses, and what each neglect would cost.

Discretisation error of a finite-element model: the error of the energy of each mode, estimated at reduction.
Solids by the strain that is left when strains are smoothed over the nodes (Zienkiewicz, Zhu 1987): the share of its strain energy that
a mode lacks, so by how much its eigenvalue is too high. Of bent bars of one to four quadratic tetrahedra over their height it was half
of that, so it is doubled. Frames by elements of half the length: the deflection between nodes that forces
at nodes make is exact, so there the error is that of inertia between the nodes alone.
"""

from typing import Any, Final

import numpy as np

from nivel.flexible.body.body import MeshError
from nivel.flexible.body.invariants import Invariants
from nivel.flexible.body.mass_invariants import invariants
from nivel.flexible.checks.checks import DIGITS, ONE_POINT, digits
from nivel.flexible.model.frame import frame_model
from nivel.flexible.model.model import AXES, Array, FiniteElementModel
from nivel.flexible.model.model_file import Located
from nivel.flexible.model.solid_elements import SolidElements
from nivel.flexible.model.solid_shapes import TETRAHEDRON_4, TETRAHEDRON_10
from nivel.flexible.reduction.bases import Basis
from nivel.flexible.reduction.factor import Whole
from nivel.flexible.reduction.free_body import FreeBody, Orthonormal
from nivel.flexible.reduction.ties import Attachment
from nivel.lazy import asdict, dataclass

MOST: Final = 40  # modes of the whole model that are computed for comparison
DEFLECTION: Final = 0.01  # of the size of the body: for what neglected invariants would cost
TURN: Final = 0.05  # [rad] or so much turn of a node, whatever is less
EQUAL: Final = 1e-4  # frequencies that differ relatively by less are taken as equal
FINE: Final = 0.01  # of a frequency, that the mesh makes it wrong by, at most
HOURGLASS: Final = 0.1  # of the energy of a mode, by hourglass control: its frequency is wrong by half of that
ILL: Final = 1e10  # condition of the basis from which on it is told


@dataclass(frozen=True)
class Findings:
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
