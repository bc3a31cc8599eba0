"""Processor time of a sweep over that of its compiled loops: 100 variants of a suspension after the first, in one process.

    OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 python benchmarks/sweep.py [MACHINE] [--path PATH --from 24e3 --to 32e3] [--variants 100]

Every round sweeps from equilibrium and as given, one after the other. Ratios and milliseconds a variant are medians over the rounds; the
phases are parts of the whole: the machine is read with its values, prepared (built, assembled, put to rest), run, and judged.
"""

import argparse
import statistics
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from time import process_time
from typing import Any
from unittest.mock import patch

import numpy as np
from rich.console import Console
from rich.table import Table

import nivel
from nivel.analysis.run import simulate

ROOT = Path(__file__).resolve().parents[1]
# phase: where its function is looked up, and the name of it
PHASES = {
    "read": (nivel.Machine, "with_values"),
    "prepared": (simulate, "prepare"),
    "run": (simulate, "march"),
    "judged": (simulate, "close_run"),
}


def main() -> None:
    args = _arguments()
    machine, values = nivel.load(args.machine), np.linspace(args.low, args.high, args.variants)
    measured: dict[str, list[dict[str, float]]] = {"equilibrium": [], "as-given": []}
    for start in measured:
        machine.sweep({args.path: values[:1]}, processes=1, start=start)
    for _ in range(args.rounds):
        for start, rows in measured.items():
            rows.append(_measured(machine, args.path, values, start))
    table = Table("start", "ratio", *(f"{name} [ms]" for name in ("whole", "loops", *PHASES)))
    for start, rows in measured.items():
        median = {name: statistics.median(row[name] for row in rows) for name in rows[0]}
        ratio = statistics.median(row["whole"] / row["loops"] for row in rows)
        table.add_row(start, f"{ratio:.2f}", *(f"{1e3 * each / len(values):.1f}" for each in median.values()))
    Console().print(table)


def _measured(machine: nivel.Machine, path: str, values: Any, start: str) -> dict[str, float]:
    """Processor time [s] of the whole sweep, of its loops, and of each phase."""
    with _spent() as spent:
        begin = process_time()
        found = machine.sweep({path: values}, processes=1, start=start)
        whole = process_time() - begin
    assert (found.outcome == "done").all()
    return {"whole": whole, "loops": found.attrs["loop_seconds"], **spent}


@contextmanager
def _spent() -> Iterator[dict[str, float]]:
    """Processor time [s] of each phase, while this lasts."""
    spent = dict.fromkeys(PHASES, 0.0)

    def timed(phase: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*args: Any, **kwargs: Any) -> Any:
            begin = process_time()
            try:
                return function(*args, **kwargs)
            finally:
                spent[phase] += process_time() - begin

        return call

    with ExitStack() as stack:
        for phase, (holder, name) in PHASES.items():
            stack.enter_context(patch.object(holder, name, timed(phase, getattr(holder, name))))
        yield spent


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Processor time of a sweep over that of its compiled loops.")
    parser.add_argument("machine", nargs="?", default=ROOT / "examples" / "vehicles" / "suspension.yaml")
    parser.add_argument("--path", default="parameters.stiffness")
    parser.add_argument("--from", dest="low", type=float, default=24e3)
    parser.add_argument("--to", dest="high", type=float, default=32e3)
    parser.add_argument("--variants", type=int, default=100)
    parser.add_argument("--rounds", type=int, default=3)
    return parser.parse_args()


if __name__ == "__main__":
    main()
