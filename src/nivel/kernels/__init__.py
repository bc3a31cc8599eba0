"""Numba kernels: floats and arrays in, arrays and status codes out.

Importing this package chooses the compilation cache before any kernel is decorated; see `nivel.kernels.cache`.
"""

from nivel.kernels import cache

cache.install()
