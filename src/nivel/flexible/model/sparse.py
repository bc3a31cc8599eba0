"""The name of sparse matrices in signatures."""

from __future__ import annotations

from typing import Any

# a scipy.sparse.csr_array or csc_array with two dimensions; SciPy's own types know neither their shape nor their elements
Sparse = Any
