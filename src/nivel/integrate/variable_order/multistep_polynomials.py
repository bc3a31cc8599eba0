"""The polynomials behind multistep methods of variable step: Adams–Moulton and BDF through the points that there are.

With x = (t - t_n)/h and ξ_i = (t_n - t_{n-i})/h, the solution of order q is carried as the polynomial P of degree q that takes

    Adams–Moulton  the value at t_n, and the rates at t_n … t_{n-q+1};
    BDF            the values at t_n … t_{n-q}, and the rate at t_n.

The step before predicts with its own polynomial; both take the same past, so their difference is e c(x) with c(0) = 1 and

    Adams–Moulton  c(-1) = 0, c'(x) ∝ Π_{1}^{q-1} (x + ξ_i)
    BDF            c(x) = Π_{1}^{q} (1 + x/ξ_i)

(Byrne, Hindmarsh 1975, there by recurrences). The unknown e is the correction of the predicted value. In terms of
D_q = h^{q+1} y^{(q+1)}/(q+1)! the error formula of interpolation gives e = K D_q and the error of one step C_q D_q with

    Adams–Moulton  K = (q+1) ξ_q ∫ Π_{1}^{q-1} (x + ξ_i) dx,   C_q = (q+1) |∫ x Π_{1}^{q-1} (x + ξ_i) dx|,   ∫ from -1 to 0
    BDF            K = Π_{1}^{q+1} ξ_i,                          C_q = Π_{1}^{q} ξ_i / Σ_{1}^{q} 1/ξ_i

With BDF the remembered values err like the new one, so e is a difference of values that all miss the solution by about the same.
"""

import numpy as np

from nivel.native.function import leaf

ADAMS, BDF = 0, 1


@leaf
def multiply(p, degree, root):
    """p(x) := p(x) (x + root), ascending coefficients."""
    p[degree + 1] = p[degree]
    for m in range(degree):
        k = degree - m
        p[k] = p[k - 1] + root * p[k]
    p[0] *= root


@leaf
def moment(p, degree, power):
    """∫ x^power p(x) dx from -1 to 0."""
    total, sign = 0.0, 1.0 if power % 2 == 0 else -1.0
    for k in range(degree + 1):
        total += sign * p[k] / (k + power + 1.0)
        sign = -sign
    return total


@leaf
def correction(family, order, xi, p, c):
    """Fill the coefficients c (order + 1,); returns (K, C_{q-1}, C_q, C_{q+1}), C_0 = 0. xi[i] = ξ_i up to q + 1; p (q + 3,) is work."""
    return _adams(order, xi, p, c) if family == ADAMS else _bdf(order, xi, c)


@leaf
def _adams(q, xi, p, c):
    p[0], below = 1.0, 0.0
    for i in range(1, q):
        if i == q - 1:
            below = q * np.abs(moment(p, i - 1, 1))
        multiply(p, i - 1, xi[i])
    area = moment(p, q - 1, 0)
    c[0] = 1.0
    for k in range(1, q + 1):
        c[k] = p[k - 1] / (k * area)
    same = (q + 1.0) * np.abs(moment(p, q - 1, 1))
    multiply(p, q - 1, xi[q])
    return (q + 1.0) * xi[q] * area, below, same, (q + 2.0) * np.abs(moment(p, q, 1))


@leaf
def _bdf(q, xi, c):
    c[0] = 1.0
    product, total, below, same = 1.0, 0.0, 0.0, 0.0
    for i in range(1, q + 1):
        c[i] = c[i - 1] / xi[i]
        for m in range(1, i):
            k = i - m
            c[k] += c[k - 1] / xi[i]
        below = same
        product *= xi[i]
        total += 1.0 / xi[i]
        same = product / total
    product *= xi[q + 1]
    return product, below, same, product / (total + 1.0 / xi[q + 1])


@leaf
def monic(family, degree, xi, p):
    """Fill the coefficients of x^degree + … that vanishes with everything that a polynomial of order degree - 1 takes from the past:
    what may be added or subtracted when the order changes."""
    p[0] = 1.0
    if family == BDF:
        for i in range(degree):
            multiply(p, i, xi[i])
        return
    for i in range(degree - 1):
        multiply(p, i, xi[i])
    for m in range(degree):
        k = degree - m
        p[k] = degree * p[k - 1] / k
    p[0] = 0.0
