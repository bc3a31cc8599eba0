"""Elements of beams in absolute nodal coordinates with all gradients: d = r' along the line, Y and Z across it.

The line is cubic, the gradients across it linear (Shabana, Yakoub 2001). The strains of the section are Green's, of the first order in
its coordinates, with the stiffness of the section for them, so shear factors and torsion are those of the section (the elastic line of
Schwab, Meijaard 2010), and free of Poisson locking:

    ½ (d·d - 1), d·Y, d·Z        ½ (Y'·Z - Z'·Y), d·Z', -d·Y'

They are integrated at three points, the fewest that leave no motion free. The section deforms too: ½ (Y·Y - 1), ½ (Z·Z - 1) and Y·Z cost
energy at the nodes, between which linear gradients shorten without reason where the beam bends.
"""

import numpy as np

from nivel.elements.beams.exact import gauss, section_forces
from nivel.elements.beams.gradients import STEP, Array, hermite, lengths_of, moved_vectors, unstressed_vectors
from nivel.elements.rows import element
from nivel.kernels.algebra.gradients import (
    DAMPING,
    FORCE,
    OWN,
    RATE,
    VECTOR,
    add_along_line,
    along_line,
    push_vectors,
    read_vectors,
)
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.algebra.vectors import combined, minus, plus, times
from nivel.kernels.record.record import record_at
from nivel.known import Beam
from nivel.lazy import Struct
from nivel.native.function import stage

WIDTH = 4  # vectors of a node
POINTS = 3
# columns of `number`: length of the element [m]; stiffness of the strains of the section (36), and of its deformation, yy, zz and yz (3)
# [N]; for each point its weight [m], place between 0 and 1, weights of r' (4), strain that counts as none (6)
LENGTH, STIFFNESS, SECTION, POINT = OWN, OWN + 1, OWN + 37, OWN + 40
SHARE, SLOPE, STRAIN, COLUMNS = 1, 2, 6, 12
NUMBERS = POINT + POINTS * COLUMNS


@stage
def between(n, first, j, share):
    """Vector j of both nodes, or its rate, from n[first] on: linear between them."""
    a, b = first + 3 * j, first + 3 * (WIDTH + j)
    return combined(1.0 - share, n[a:], share, n[b:])


@stage
def change(n, first, j):
    """Its derivative along the line."""
    return times(1.0 / n[LENGTH], minus(n[first + 3 * (WIDTH + j) :], n[first + 3 * j :]))


@stage
def pull(n, j, share, value, slope):
    """Subtract forces on such a vector, and on its derivative, from those on the vectors of the nodes."""
    a, b, over = FORCE + 3 * j, FORCE + 3 * (WIDTH + j), 1.0 / n[LENGTH]
    for i in range(3):
        n[a + i] -= (1.0 - share) * value[i] - over * slope[i]
        n[b + i] -= share * value[i] + over * slope[i]


@stage
def point_of_section(n, q, control):
    """What one point stores, loses and pulls. q : its columns."""
    share, weights, unstrained = q[SHARE], q[SLOPE : SLOPE + 4], q[STRAIN : STRAIN + 6]
    d, v = along_line(n, VECTOR, weights, WIDTH), along_line(n, RATE, weights, WIDTH)
    Y, Z, Ys = between(n, VECTOR, 2, share), between(n, VECTOR, 3, share), change(n, VECTOR, 2)
    Zs = change(n, VECTOR, 3)
    y, z, ys, zs = between(n, RATE, 2, share), between(n, RATE, 3, share), change(n, RATE, 2), change(n, RATE, 3)
    e0, r0 = 0.5 * dot(d, d) - 0.5 - unstrained[0], dot(d, v)
    e1, r1 = dot(d, Y) - unstrained[1], dot(v, Y) + dot(d, y)
    e2, r2 = dot(d, Z) - unstrained[2], dot(v, Z) + dot(d, z)
    e3 = 0.5 * (dot(Ys, Z) - dot(Zs, Y)) - unstrained[3]
    r3 = 0.5 * (dot(ys, Z) + dot(Ys, z) - dot(zs, Y) - dot(Zs, y))
    e4, r4 = dot(d, Zs) - unstrained[4], dot(v, Zs) + dot(d, zs)
    e5, r5 = -dot(d, Ys) - unstrained[5], -dot(v, Ys) - dot(d, ys)
    strain, rate = (e0, e1, e2, e3, e4, e5), (r0, r1, r2, r3, r4, r5)
    (s0, s1, s2), (s3, s4, s5) = section_forces(n, STIFFNESS, strain, rate, q[0], n[DAMPING], control)
    on_d, across = combined(s1, Y, s2, Z), combined(s4, Zs, -s5, Ys)
    add_along_line(n, weights, WIDTH, plus(plus(times(s0, d), on_d), across))
    pull(n, 2, share, combined(s1, d, -0.5 * s3, Zs), combined(0.5 * s3, Z, -s5, d))
    pull(n, 3, share, combined(s2, d, 0.5 * s3, Ys), combined(-0.5 * s3, Y, s4, d))


@stage
def section_of_node(n, a, control):
    """What the deformation of the section at node a stores, loses and pulls, for half the element."""
    Y, Z = VECTOR + 3 * (WIDTH * a + 2), VECTOR + 3 * (WIDTH * a + 3)
    y, z = n[Y : Y + 3], n[Z : Z + 3]
    vy, vz = n[Y + RATE - VECTOR : Y + RATE - VECTOR + 3], n[Z + RATE - VECTOR : Z + RATE - VECTOR + 3]
    half, lag = 0.5 * n[LENGTH], n[DAMPING]
    e0, e1, e2 = 0.5 * dot(y, y) - 0.5, 0.5 * dot(z, z) - 0.5, dot(y, z)
    r0, r1, r2 = dot(y, vy), dot(z, vz), dot(y, vz) + dot(vy, z)
    k0, k1, k2 = half * n[SECTION], half * n[SECTION + 1], half * n[SECTION + 2]
    control.stored[0] += 0.5 * (k0 * e0 * e0 + k1 * e1 * e1 + k2 * e2 * e2)
    control.power[1] += lag * (k0 * r0 * r0 + k1 * r1 * r1 + k2 * r2 * r2)
    s0, s1, s2 = k0 * (e0 + lag * r0), k1 * (e1 + lag * r1), k2 * (e2 + lag * r2)
    on_y, on_z = FORCE + 3 * (WIDTH * a + 2), FORCE + 3 * (WIDTH * a + 3)
    for i in range(3):
        n[on_y + i] -= s0 * y[i] + s2 * z[i]
        n[on_z + i] -= s1 * z[i] + s2 * y[i]


@element
def apply(machine, index, n, t):
    """An element."""
    record = record_at(machine)
    read_vectors(record.markers, index, n, WIDTH)
    for g in range(POINTS):
        point_of_section(n, n[POINT + COLUMNS * g : POINT + COLUMNS * (g + 1)], record.control)
    section_of_node(n, 0, record.control)
    section_of_node(n, 1, record.control)
    push_vectors(record.bodies, record.markers, index, n, WIDTH)


class Strains(Struct):
    """Strains of sections at points, and what they are measured with.

    share : (n, g) between 0 and 1 in each element. weight : (n, g) [m]. value : (…, n, g, 6) (Γ, Κ).
    """

    share: Array
    weight: Array
    value: Array


def beam_strains(beam: Beam, v: Array) -> Strains:
    """Of `ancf-beam`, for the vectors v (…, N, 4, 3) of its nodes; complex ones too."""
    xi, weight = gauss(POINTS)
    lengths = lengths_of(beam)
    slope = np.stack([hermite(xi, length, 1) for length in lengths])
    a, b = v[..., :-1, :, :], v[..., 1:, :, :]
    line = np.stack([a[..., 0, :], a[..., 1, :], b[..., 0, :], b[..., 1, :]], axis=-2)
    d = np.einsum("ngj,...nji->...ngi", slope, line)
    across, turning = [], []
    for j in (2, 3):
        across.append(
            np.einsum("g,...ni->...ngi", 1.0 - xi, a[..., j, :]) + np.einsum("g,...ni->...ngi", xi, b[..., j, :])
        )
        turning.append(((b - a)[..., j, :] / lengths[:, None])[..., None, :] + 0.0 * across[-1])
    (Y, Z), (Ys, Zs) = across, turning

    def dot(x: Array, y: Array) -> Array:
        return np.sum(x * y, axis=-1)

    value = [0.5 * dot(d, d) - 0.5, dot(d, Y), dot(d, Z), 0.5 * (dot(Ys, Z) - dot(Zs, Y)), dot(d, Zs), -dot(d, Ys)]
    share = np.tile(xi, (len(lengths), 1))
    return Strains(share, weight * lengths[:, None], np.stack(value, axis=-1))


def section_stiffness(C: Array, length: float) -> Array:
    """(3,) [N] what the deformation of a section of stiffness C costs in an element of this length [m], yy, zz and yz.

    As much as stretch and shear of the beam do, and more in elements that are shorter than the section is high. A moment M feels
    -M d·Y': where the slopes of elements lean by ±g in turn and sections stretch by ±b, they store 2 (GA g²/4 + k b²/4) a unit of length
    and M gains 2 M g b/length, so that M = ½ length √(GA k) would be a critical load that falls with every refinement. With
    k = EA + 144 EI/length² it is at least 6 √(GA EI), where fibres are strained by more than one.
    """
    stretch, shear = C[0, 0], 0.5 * (C[1, 1] + C[2, 2])
    turns = 144.0 * np.array([C[5, 5], C[4, 4], np.sqrt(C[4, 4] * C[5, 5]) * shear / stretch]) / length**2
    return np.asarray(np.array([stretch, stretch, shear]) + turns, dtype=float)


def beam_numbers(beam: Beam) -> list[list[float]]:
    """Numbers from OWN on, an element each."""
    C = beam.properties.stiffness
    xi, _ = gauss(POINTS)
    unstressed = beam_strains(beam, unstressed_vectors(beam))
    out = []
    for e, length in enumerate(lengths_of(beam).tolist()):
        table = np.column_stack([unstressed.weight[e], xi, hermite(xi, length, 1), unstressed.value[e]])
        section = section_stiffness(C, length)
        out.append([length, *C.ravel().tolist(), *section.tolist(), *table.ravel().tolist()])
    return out


def beam_stiffness(beam: Beam, length: float) -> Array:
    """Stiffness of an element of this length [m], straight and unstressed, for the vectors of its nodes."""
    moved = moved_vectors(beam)
    strains = beam_strains(beam, moved)
    B = strains.value[:, 0].imag / STEP
    K = np.einsum("iga,ab,jgb,g->ij", B, beam.properties.stiffness, B, strains.weight[0])
    Y, Z = moved[:, :, 2], moved[:, :, 3]
    squares = 0.5 * np.sum(Y * Y, axis=-1), 0.5 * np.sum(Z * Z, axis=-1), np.sum(Y * Z, axis=-1)
    for share, value in zip(section_stiffness(beam.properties.stiffness, length), squares, strict=True):
        b = value.imag / STEP
        K += 0.5 * length * share * b @ b.T
    return np.asarray(K, dtype=float)
