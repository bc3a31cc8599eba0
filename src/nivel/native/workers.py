"""Worker processes, as many as there are processors; they are started when something has to be compiled, and end with this process."""

from __future__ import annotations

import atexit
import json
import os
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from importlib.util import find_spec
from queue import SimpleQueue
from typing import Any

START = (
    "import json, sys; sys.path[:], parent, module = json.loads(sys.argv.pop(1)); from importlib import import_module; "
    "from nivel.native.workers import end_with_parent; end_with_parent(parent); import_module(module).main()"
)


def python(module: str, *words: str) -> list[str]:
    """The command of a process that calls `main` of a module, which it finds where this process does, and that ends with this one."""
    return [sys.executable, "-c", START, json.dumps([sys.path, os.getpid(), module]), *words]


# kind of error of what calls functions of Numba when it runs, which object files cannot
NEEDS_NUMBA = "NeedsNumbaError"
# and of what cannot be compiled, because there is no compiler
NO_COMPILER = "NoCompilerError"
# and of a level of processors that there is not, or that this one is below
UNKNOWN_LEVEL = "UnknownLevelError"


class CompilationError(Exception):
    """What cannot be compiled. kind : the name of the error, `SyntaxError` and the like."""

    def __init__(self, message: str, kind: str) -> None:
        super().__init__(message)
        self.kind = kind


def end_with_parent(parent: int) -> None:
    """End this process, whatever it does, within a second of the end of the process `parent` that started it."""

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(0.5)
        os._exit(1)

    if os.name == "posix":
        threading.Thread(target=watch, daemon=True).start()


def processors() -> int:
    """How many processes may compile at once."""
    return max(1, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)


def compile_all(jobs: Iterable[dict[str, Any]], done: Callable[[dict[str, Any]], None] = lambda job: None) -> None:
    """Let workers write the object files of these jobs; done(job) is called, here, as each is finished.

    Jobs that stand near each other in the list have functions in common, which a worker translates once: half of the workers begin at
    its end. What was written before an interruption stays. Raises CompilationError of the first job that fails.
    """
    left = deque(jobs)
    if left and find_spec("numba") is None:
        raise CompilationError("there is no compiler here: pip install 'nivel[laws]' brings one", NO_COMPILER)
    count = min(len(left), processors())
    finished: SimpleQueue[dict[str, Any] | BaseException | None] = SimpleQueue()

    def work(take: Callable[[], dict[str, Any]]) -> None:
        problem: BaseException | None = None
        try:
            worker = _take_worker()
            try:
                while (job := _next(take)) is not None:
                    worker.compile(job)
                    finished.put(job)
            except CompilationError as found:  # the worker can take other jobs
                problem = found
            _idle.put(worker)
        except BaseException as found:  # whatever it is, nobody may wait for it
            problem = found
        if problem is not None:
            left.clear()
        finished.put(problem)

    for k in range(count):
        threading.Thread(target=work, args=(left.pop if k % 2 else left.popleft,), daemon=True).start()
    problem = None
    try:
        while count:
            match finished.get():
                case None:
                    count -= 1
                case BaseException() as found:
                    problem, count = problem or found, count - 1
                case job:
                    done(job)
    finally:
        left.clear()
    if problem is not None:
        raise problem


def _next(take: Callable[[], dict[str, Any]]) -> dict[str, Any] | None:
    try:
        return take()
    except IndexError:
        return None


class _Worker:
    def __init__(self) -> None:
        command = python("nivel.native.worker")
        # settings of Numba change machine code, and are no part of its name
        own = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
        own |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=own, encoding="utf-8"
        )

    def compile(self, job: dict[str, Any]) -> None:
        """Raises CompilationError."""
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
        if problem := json.loads(answer):
            raise CompilationError(problem["problem"], problem["kind"])

    @property
    def is_alive(self) -> bool:
        """Whether it can take a job."""
        return self._process.poll() is None

    def end(self) -> None:
        """Stop it, whatever it does."""
        self._process.kill()
        self._process.communicate()


_idle: SimpleQueue[_Worker] = SimpleQueue()
_started: list[_Worker] = []
_lock = threading.Lock()


def _take_worker() -> _Worker:
    with _lock:
        while not _idle.empty():
            if (worker := _idle.get()).is_alive:
                return worker
        worker = _Worker()
        _started.append(worker)
        return worker


@atexit.register
def end_all() -> None:
    """End the workers, which keep their memory while they wait; what has to be compiled later starts new ones."""
    with _lock:
        for worker in _started:
            worker.end()
        _started.clear()
