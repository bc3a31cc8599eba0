"""Worker processes of a sweep. They need no `if __name__ == "__main__"` in the script that sweeps."""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Iterable, Iterator
from queue import SimpleQueue
from typing import Any

from nivel.analysis.sweep.variant import FAILED, VariantRun, run_variant
from nivel.model import Model

START = "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from nivel.analysis.sweep.worker import main; main()"

# number of the variant, its machine, its values
Job = tuple[int, Model, Any]


def run_in_processes(
    jobs: Iterable[Job], save: tuple[str, ...], verify: bool, count: int
) -> Iterator[tuple[int, VariantRun]]:
    """Number and run of each variant, as they are finished, by `count` processes: this one, which goes on while the others start, and
    workers. Those are ended where the caller stops.

    Raises what a worker could not do for a fault of nivel.
    """
    left, finished = deque(jobs), SimpleQueue[tuple[int, Any] | None]()
    workers = [_Worker() for _ in range(min(count - 1, len(left)))]
    for worker in workers:
        threading.Thread(target=_serve, args=(worker, left, save, verify, finished), daemon=True).start()
    working = len(workers)
    try:
        while working or left:
            if finished.empty() and (job := _next(left)) is not None:
                number, machine, values = job
                yield number, run_variant(machine, values, save, verify)
                continue
            match finished.get():
                case None:
                    working -= 1
                case (_, BaseException() as problem):
                    raise problem
                case (number, run):
                    yield number, run
    finally:
        left.clear()
        for worker in workers:
            worker.end()


def _next(left: deque[Job]) -> Job | None:
    try:
        return left.popleft()
    except IndexError:
        return None


def _serve(worker: _Worker, left: deque[Job], save: tuple[str, ...], verify: bool, finished: SimpleQueue[Any]) -> None:
    try:
        while (job := _next(left)) is not None:
            number, machine, values = job
            finished.put((number, worker.run(machine, values, save, verify)))
    except BaseException as problem:  # whatever it is, nobody may wait for it
        finished.put((-1, problem))
    finished.put(None)


class _Worker:
    def __init__(self) -> None:
        self._start()

    def _start(self) -> None:
        one = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
        self._process = subprocess.Popen(
            [sys.executable, "-c", START, json.dumps(sys.path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, **one},
        )
        self._machine: Model | None = None

    def run(self, machine: Model, values: Any, save: tuple[str, ...], verify: bool) -> VariantRun:
        """The variant, run by the process; a failed one where the process ends on the way."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        sent, self._machine = (None if machine is self._machine else machine), machine
        try:
            pickle.dump((sent, values, save, verify), self._process.stdin, protocol=pickle.HIGHEST_PROTOCOL)
            self._process.stdin.flush()
            answer = pickle.load(self._process.stdout)
        except (BrokenPipeError, EOFError):
            status = self._process.wait()
            self._start()
            return VariantRun(FAILED, f"the process that ran it ended with status {status}")
        if isinstance(answer, Exception):
            raise answer
        return answer

    def end(self) -> None:
        """Stop it, whatever it does."""
        self._process.kill()
        self._process.communicate()
