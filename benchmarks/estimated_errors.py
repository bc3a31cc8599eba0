"""Estimated errors of verified runs against true ones: a table of ratios, one row a method.

python benchmarks/estimated_errors.py [METHOD ...]
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "verification"))

from test_estimated_errors import FULL, METHODS, STEPS, known_ratios, ratios


def main() -> None:
    """Least, middle and largest ratio of every method, and how many are within a third and three."""
    every: list[float] = []
    print(f"{'method':20} {'pairs':>5} {'least':>8} {'median':>8} {'largest':>8}")
    for method in sys.argv[1:] or (*METHODS, *FULL):
        found = [*ratios((method,), STEPS).values(), *known_ratios((method,), STEPS).values()]
        every += found
        if found:
            print(f"{method:20} {len(found):5} {min(found):8.3f} {np.median(found):8.3f} {max(found):8.3f}", flush=True)
    within = sum(1.0 / 3.0 <= ratio <= 3.0 for ratio in every)
    above = sum(ratio >= 1.0 / 3.0 for ratio in every)
    print(f"all: least {min(every):.3f}, median {np.median(every):.3f}")
    print(f"{above} of {len(every)} pairs at least a third of the true error, {within} within a third and three times")


if __name__ == "__main__":
    main()
