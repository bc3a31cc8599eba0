"""Values that users could give by mistake, for functions that take something else."""

from pathlib import Path

import numpy as np

import nivel
from nivel.errors import ModelError


class Odd:
    """Nothing that any function could take."""

    def __repr__(self):
        return "Odd()"


ODD = Odd()
WRONG = [
    *[
        None,
        True,
        0,
        -1,
        2**70,
        10**400,
        0.5,
        float("nan"),
        float("inf"),
        1j,
        "",
        "x",
        "nan",
        "3 kg",
        "\0",
        "ü" * 300,
        b"x",
    ],
    *[
        [],
        [None],
        [ODD],
        (),
        {},
        {"x": 1},
        {3: 4},
        {1, 2},
        ODD,
        Odd,
        print,
        range(3),
        slice(1, 2),
        Path("none/x.nc"),
        nivel,
    ],
    *[np.float32(1e-3), np.int64(2), np.bool_(True), np.array([1.0, 2.0]), np.array(1.0), np.array(["a"])],
]


def told_or_done(call):
    """`call` returns, or says in words what is wrong."""
    try:
        call()
    except ModelError as error:
        words = str(error)
    else:
        return
    assert words.strip()
