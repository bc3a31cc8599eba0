"""The constraint rows of the program of report 44 (report_44_program.py): basic constraints s, d1 and d2 of all joints at once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Rows:
    """The basic constraints s, d1 and d2 (eqs. 7, 10, 11) of all joints: s rows first (x, y, z of each), then d1, then d2.

    All vectors fixed in bodies are in one table, `vector` (m, 3) in the axes of bodies `body` (m,). With u = A ū they have
    C_θ = -A ũ Ḡ (Table 1, eq. 27) and at θ̈ = 0 the acceleration A ω̃ ω̃ ū; Table 1 and eqs. 31–33 are sums of products of these.
    """

    def __init__(self, rows: tuple[tuple[Any, ...], ...], ground: int) -> None:
        vectors: list[tuple[int, Array]] = []
        self.points, self.axes, self.distances = (
            np.array([_attached(row[1:], ground, vectors) for row in rows if row[0] == kind], dtype=int).reshape(
                -1, width
            )
            for kind, width in (("s", 2), ("d1", 2), ("d2", 3))
        )
        self.body = np.array([body for body, _ in vectors])
        self.vector = np.array([vector for _, vector in vectors])
        self.tilde = tilde(self.vector)
        self.count = 3 * len(self.points) + len(self.axes) + len(self.distances)

    def fill(self, R: Array, A: Array, G: Array, rates: Array, C: Array, Cq: Array, Qd: Array) -> None:
        """C (rows,), C_q (rows, n+1, 7) and Q_d (rows,) at R, A, 2Ē of all bodies and `rates` (n+1, 7) of (R, θ)."""
        body, at = self.body, A[self.body]
        spin = tilde(np.einsum("bij,bj->bi", G, rates[:, 3:]))[body]
        u = np.einsum("mij,mj->mi", at, self.vector)
        change = -(at @ self.tilde) @ G[body]
        udot = np.einsum("mij,mj->mi", change, rates[body, 3:])
        bend = np.einsum("mij,mj->mi", at @ spin @ spin, self.vector)

        i, j = self.points.T
        s = 3 * len(i)
        C[:s] = (R[body[j]] + u[j] - R[body[i]] - u[i]).ravel()
        Qd[:s] = (bend[i] - bend[j]).ravel()
        for k in range(3):
            row = np.arange(k, s, 3)
            Cq[row, body[i], k], Cq[row, body[j], k] = -1.0, 1.0
            Cq[row, body[i], 3:], Cq[row, body[j], 3:] = -change[i, k], change[j, k]

        i, j = self.axes.T
        row = np.arange(s, s + len(i))
        C[row] = np.sum(u[i] * u[j], axis=1)
        Qd[row] = -np.sum(u[j] * bend[i] + u[i] * bend[j] + 2.0 * udot[i] * udot[j], axis=1)
        Cq[row, body[i], 3:] = np.einsum("mi,mij->mj", u[j], change[i])
        Cq[row, body[j], 3:] = np.einsum("mi,mij->mj", u[i], change[j])

        a, i, j = self.distances.T
        row = np.arange(s + len(self.axes), self.count)
        between = R[body[j]] + u[j] - R[body[i]]
        along = rates[body[j], :3] + udot[j] - rates[body[i], :3]
        # aᵀ u_i of the two vectors of one body is the constant āᵀ ū_i (eq. 10), the rest is the product of a with `between`
        C[row] = np.sum(u[a] * between, axis=1) - np.sum(self.vector[a] * self.vector[i], axis=1)
        distance = between - u[i]
        fixed = np.einsum("mi,mij->mj", self.vector[a], self.tilde[i])
        Qd[row] = -np.sum(u[a] * bend[j] + distance * bend[a] + 2.0 * udot[a] * along, axis=1)
        Qd[row] -= np.einsum("mi,mi->m", self.vector[i], np.einsum("mij,mj->mi", spin[i] @ spin[i], self.vector[a]))
        Cq[row, body[a], :3], Cq[row, body[j], :3] = -u[a], u[a]
        Cq[row, body[a], 3:] = np.einsum("mi,mij->mj", distance, change[a]) + np.einsum("mi,mij->mj", fixed, G[body[a]])
        Cq[row, body[j], 3:] = np.einsum("mi,mij->mj", u[a], change[j])


def _attached(row: tuple[Any, ...], ground: int, vectors: list[tuple[int, Array]]) -> list[int]:
    """Put the vectors of a row, written (body, vectors …, body, vector), into the table. Returns their places."""
    places, body = [], ground
    for item in row:
        if isinstance(item, int):
            body = item
        else:
            places.append(len(vectors))
            vectors.append((ground if body < 0 else body, np.array(item, dtype=float)))
    return places


def tilde(a: Array) -> Array:
    """(m, 3, 3) of (m, 3): ã b = a × b (eq. 26)."""
    x, y, z = a.T
    zero = np.zeros_like(x)
    return np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)
