"""What the peers' chains share: options, the line that they print.

times: µs of process time a step, a list for each way to compute it. energy_error: largest |T + V - V0| over the largest T, and
last_position [m]: centre of mass of the last bar, both of `CHECK_STEPS` steps.
"""

import argparse
import json
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from chain_data import timed_steps


@dataclass(frozen=True)
class Check:
    """How a run over CHECK_STEPS steps came out."""

    energy_error: float
    last_position: list[float]


def process_microseconds(work: Callable[[], object], times: int) -> float:
    """Process time of `work` over `times`."""
    begin = time.process_time()
    work()
    return 1e6 * (time.process_time() - begin) / times


def main(
    program: str,
    version: str,
    measure: Callable[[int, int, int], dict[str, list[float]]],
    check: Callable[[int], Check],
) -> None:
    """Print one JSON line. measure: links, steps, runs → times. check: links → Check."""
    parser = argparse.ArgumentParser(description=f"open chain of bars in {program}: one JSON line")
    parser.add_argument("--links", type=int, default=16)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--no-check", action="store_true", help="time only")
    options = parser.parse_args()
    found: dict[str, object] = {"program": program, "version": version, "links": options.links}
    found["times"] = measure(options.links, timed_steps(options.links), options.runs)
    if not options.no_check:
        found |= vars(check(options.links))
    print(json.dumps(found))
