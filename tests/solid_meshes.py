"""Closed surfaces of triangles for tests, counter-clockwise seen from outside."""

import numpy as np


def box_mesh(a, b, c):
    """vertices (8, 3) and triangles (12, 3) of a box about the origin."""
    vertices = np.array([[x, y, z] for x in (-a, a) for y in (-b, b) for z in (-c, c)]) / 2
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for p, q, r, s in quads for t in ((p, q, r), (p, r, s))]
    return vertices, np.array(triangles, dtype=np.uint32)


def ball_mesh(fineness):
    """An octahedron whose triangles are halved `fineness` times, its vertices on the unit sphere."""
    vertices = [np.array(v, dtype=float) for v in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(fineness):
        middles, finer = {}, []

        def middle(i, j, middles=middles):
            key = (min(i, j), max(i, j))
            if key not in middles:
                point = vertices[i] + vertices[j]
                middles[key] = len(vertices)
                vertices.append(point / np.linalg.norm(point))
            return middles[key]

        for i, j, k in triangles:
            a, b, c = middle(i, j), middle(j, k), middle(k, i)
            finer += [(i, a, c), (a, j, b), (c, b, k), (a, b, c)]
        triangles = finer
    return np.array(vertices), np.array(triangles, dtype=np.uint32)
