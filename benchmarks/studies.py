"""Slider-cranks of 8 s at 1 ms as a study: one process against two, the share of the processor time that is steps, and the cost of Dask.

    python benchmarks/studies.py [--variants 1000] [--duration 8] [--dask 200]

Each with trust reports and without (`judge: false`).

Wall times are those between the first and the last variant that is finished, so that the start of processes does not count; the processor
time is that of the workers in between. The overhead of Dask is the time a variant of tiny runs on one worker of a local cluster takes
longer than in one process of this machine. Run it on a machine that does nothing else.
"""

import argparse
import json
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter
from typing import Any

import psutil
from rich.console import Console
from rich.table import Table

import nivel

ROOT = Path(__file__).resolve().parents[1]
MACHINE = ROOT / "examples" / "mechanisms" / "slider-crank.yaml"


def main() -> None:
    args = _arguments()
    with tempfile.TemporaryDirectory() as folder:
        table = Table(
            "trust reports",
            "workers",
            "wall [s]",
            "processor [s]",
            "ms a variant",
            "steps of the processor time",
            "speed-up",
        )
        first = 0.0
        for judge, workers in ((True, 1), (True, 2), (False, 1), (False, 2)):
            study = _study(Path(folder), args.variants, args.duration, judge=judge)
            wall, processor, loop, count = _measured(study, workers=workers)
            first = wall if workers == 1 else first
            each = f"{1e3 * processor / count:.1f}"
            numbers = f"{wall:.2f}", f"{processor:.2f}", each, f"{loop / processor:.0%}", f"{first / wall:.2f}"
            table.add_row("yes" if judge else "no", str(workers), *numbers)
        Console().print(table)
        if args.dask:
            tiny = _study(Path(folder), args.dask, 0.01)
            here, spent_here, _, count = _measured(tiny, workers=1)
            with _cluster() as address:
                there, spent_there, *_ = _measured(tiny, scheduler=address)
            wall, processor = (1e3 * each / count for each in (there - here, spent_there - spent_here))
            print(
                f"Dask: {wall:.2f} ms a variant over {1e3 * here / count:.2f} ms in one process; processor time {processor:.2f} ms"
            )


def _study(folder: Path, variants: int, duration: float, *, judge: bool = True) -> Any:
    content = {
        "format": 1,
        "machine": str(MACHINE),
        "parameters": {"bodies.rod.mass": {"type": "tolerance", "tolerance": "0.7 kg"}},
        "design": "latin-hypercube",
        "samples": variants,
        "judge": judge,
        "settings": {"duration": duration, "step": "1 ms"},
        "outputs": {"angle": {"type": "final", "of": "hinge.angle"}},
    }
    (folder / "study.yaml").write_text(json.dumps(content), encoding="utf-8")
    return nivel.load_study(folder / "study.yaml")


def _measured(study: Any, **words: Any) -> tuple[float, float, float, int]:
    """Wall time, processor time of processes below this one, time in loops [s], and number of variants, after the first of each process."""
    skipped = words.get("workers", 1)
    marks: list[tuple[float, float]] = []
    loops: list[float] = []
    total = len(study.variants.values)

    def heard(_: int, run: Any) -> None:
        loops.append(run.loop_seconds)
        if len(loops) in (skipped, total):
            marks.append((perf_counter(), _processor_time()))

    study.sweep(heard=heard, **words)
    (begin, spent_before), (end, spent) = marks
    return end - begin, spent - spent_before, sum(loops[skipped:]), total - skipped


def _processor_time() -> float:
    """[s] of this process and all below it that live."""
    mine = psutil.Process(os.getpid())
    return sum(sum(each.cpu_times()[:2]) for each in (mine, *mine.children(recursive=True)))


@contextmanager
def _cluster() -> Iterator[str]:
    """A local cluster with one worker."""
    from distributed import LocalCluster

    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        yield cluster.scheduler_address


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--variants", type=int, default=1000)
    parser.add_argument("--duration", type=float, default=8.0)
    parser.add_argument("--dask", type=int, default=200, help="variants of tiny runs on a cluster; 0: none")
    return parser.parse_args()


if __name__ == "__main__":
    main()
