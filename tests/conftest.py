"""Settings that all tests share."""

import numpy as np
import pytest
from hypothesis import settings

# the first example of a test may compile a kernel, so there is no deadline; the same examples every time keep CI steady
settings.register_profile("nivel", deadline=None, derandomize=True)
settings.load_profile("nivel")


@pytest.fixture
def rng():
    return np.random.default_rng(20031)
