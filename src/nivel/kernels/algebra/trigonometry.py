"""Cosine and sine of one angle at once.

Two calls of the C library took a tenth of an evaluation of the slider-crank, and LLVM cannot move code across them. Here they share the
reduction to |r| <= π/4 (Cody and Waite 1980) and are Taylor polynomials in r, whose next terms are below 1e-19. Complex x for exact
tangents works as well: only the number of quarter turns is taken from the real part.
"""

import numpy as np

from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.number import where
from nivel.native.function import stage

# π/2 in three parts; the first two have 33 bits, so that their products with less than 2²⁰ quarter turns are exact.
FIRST, SECOND, THIRD = 0x1921FB544 / 2**32, 0x10B4611A6 / 2**66, 2.02226624879595063154e-21
MOST = 2**20
S3, S5, S7, S9 = -1 / 6, 1 / 120, -1 / 5040, 1 / 362880
S11, S13, S15, S17 = -1 / 39916800, 1 / 6227020800, -1 / 1307674368000, 1 / 355687428096000
C4, C6, C8, C10 = 1 / 24, -1 / 720, 1 / 40320, -1 / 3628800
C12, C14, C16, C18 = 1 / 479001600, -1 / 87178291200, 1 / 20922789888000, -1 / 6402373705728000


@stage
def cosine_and_sine(x):
    """cos x and sin x, each within 1.5 units in the last place of one."""
    quarters = np.floor(real(x) * (2 / np.pi) + 0.5)
    if not np.abs(quarters) < MOST:
        return np.cos(x), np.sin(x)
    r = ((x - quarters * FIRST) - quarters * SECOND) - quarters * THIRD
    z = r * r
    s = r + r * z * (S3 + z * (S5 + z * (S7 + z * (S9 + z * (S11 + z * (S13 + z * (S15 + z * S17)))))))
    c = 1.0 + z * (-0.5 + z * (C4 + z * (C6 + z * (C8 + z * (C10 + z * (C12 + z * (C14 + z * (C16 + z * C18))))))))
    turn = quarters - 4.0 * np.floor(0.25 * quarters)
    odd = turn - 2.0 * np.floor(0.5 * turn) > 0.5
    c, s = where(odd, s, c), where(odd, c, s)
    return where(np.abs(turn - 1.5) < 1.0, -c, c), where(turn > 1.5, -s, s)
