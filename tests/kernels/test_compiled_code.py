"""Kernels cannot allocate: they are compiled without Numba's runtime, which makes an allocation a compile error."""

import numpy as np
import pytest
from numba.core.errors import NumbaError

from nivel.analysis.plan.compilation import all_entries
from nivel.elements.circuits.kind import SLOPES
from nivel.native.function import OPTIONS, leaf


def test_a_kernel_that_allocates_does_not_compile():
    @leaf
    def careless(n):
        return np.zeros(n)[0]

    with pytest.raises(NumbaError, match="empty"):
        careless(3)


def test_functions_and_entries_are_compiled_without_the_runtime_that_allocates():
    assert OPTIONS["_nrt"] is False


def test_names_and_symbols_of_entries_are_their_own():
    entries = all_entries()
    assert len({entry.name for entry in entries}) == len({entry.symbol for entry in entries}) == len(set(entries))


def test_slopes_of_components_by_hand_are_among_all_entries():
    """A run calls them by their addresses, so that nothing else asks for their code."""
    by_hand = {each.code for each in SLOPES.values() if each is not None}
    assert len(by_hand) > 15
    assert by_hand <= set(all_entries())
