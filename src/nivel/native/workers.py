"""Worker processes, as many as there are processors; they are started when something has to be compiled, and end with this process."""

from __future__ import annotations

import atexit
import json
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor, as_completed
from queue import SimpleQueue
from typing import Any

# the sources of entries are found where this process finds them
START = "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from nivel.native.worker import main; main()"


# kind of error of what calls functions of Numba when it runs, which object files cannot
NEEDS_NUMBA = "NeedsNumbaError"


class CompilationError(Exception):
    """What cannot be compiled. kind : the name of the error, `SyntaxError` and the like."""

    def __init__(self, message: str, kind: str) -> None:
        super().__init__(message)
        self.kind = kind


def processors() -> int:
    """How many processes may compile at once."""
    return max(1, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)


def compile_all(jobs: Iterable[dict[str, Any]], done: Callable[[dict[str, Any]], None] = lambda job: None) -> None:
    """Let workers write the object files of these jobs; done(job) is called, here, as each is finished.

    What was written before an interruption stays. Raises CompilationError of the first job that fails.
    """
    jobs = list(jobs)
    with ThreadPoolExecutor(min(len(jobs), processors()) or 1) as threads:
        running = {threads.submit(_compile, job): job for job in jobs}
        try:
            for finished in as_completed(running):
                finished.result()
                done(running[finished])
        except BaseException:
            threads.shutdown(wait=False, cancel_futures=True)
            raise


class _Worker:
    def __init__(self) -> None:
        command = [sys.executable, "-c", START, json.dumps(sys.path)]
        own = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "NUMBA_DISABLE_JIT": "0"}
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=own, encoding="utf-8"
        )

    def compile(self, job: dict[str, Any]) -> dict[str, Any]:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            self._process.stdin.write(json.dumps({**job, "places": sys.path}) + "\n")
            self._process.stdin.flush()
            answer = self._process.stdout.readline()
        except BrokenPipeError:
            answer = ""
        if not answer:
            status = self._process.wait()
            raise CompilationError(f"the process that compiled {job['symbol']} ended with status {status}", "died")
        return json.loads(answer)

    def end(self) -> None:
        """Stop it, whatever it does."""
        self._process.kill()
        self._process.communicate()


_idle: SimpleQueue[_Worker] = SimpleQueue()
_started: list[_Worker] = []
_lock = threading.Lock()


def _compile(job: dict[str, Any]) -> None:
    with _lock:
        worker = _Worker() if _idle.empty() else _idle.get()
        if worker not in _started:
            _started.append(worker)
    answer = worker.compile(job)
    _idle.put(worker)
    if "problem" in answer:
        raise CompilationError(answer["problem"], answer["kind"])


@atexit.register
def _end_all() -> None:
    for worker in _started:
        worker.end()
