"""Processes that answer jobs, one after the other, and end with this one; and those that compile, as many as there are processors."""

import atexit
import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from importlib.util import find_spec
from queue import SimpleQueue
from typing import Any

START = (
    "import json, sys; sys.path[:], parent, module = json.loads(sys.argv.pop(1)); from importlib import import_module; "
    "from nivel.native.workers import end_with_parent; end_with_parent(parent); import_module(module).main()"
)


def python(module: str, *words: str) -> list[str]:
    """The command of a process that calls `main` of a module, which it finds where this process does, and that ends with this one."""
    return [
        sys.executable,
        *["-B"] * sys.dont_write_bytecode,
        "-c",
        START,
        json.dumps([sys.path, os.getpid(), module]),
        *words,
    ]


def end_with_parent(parent: int) -> None:
    """End this process, whatever it does, within a second of the end of the process `parent` that started it."""

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(0.5)
        os._exit(1)

    if os.name == "posix":
        threading.Thread(target=watch, daemon=True).start()


LONGEST_END = 10.0  # s that a process which answers no more may take to end by itself


class EndedError(Exception):
    """A process has ended before it had an answer. status : its exit code, or less than zero that of the signal that ended it."""

    def __init__(self, status: int) -> None:
        super().__init__(status)
        self.status = status


def signal_of(status: int) -> str:
    """The signal that ended a process, by its name, or as `signal 35` where it has none."""
    try:
        return signal.Signals(-status).name
    except ValueError:
        return f"signal {-status}"


class Process:
    """A process in which `main` of a module answers jobs (`serve`). given : further arguments of `subprocess.Popen`."""

    def __init__(self, module: str, given: Mapping[str, Any]) -> None:
        self._process = subprocess.Popen(python(module), stdin=subprocess.PIPE, stdout=subprocess.PIPE, **given)

    def ask(self, job: Any) -> Any:
        """The answer to a job. Raises what the job raised there, and EndedError."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            pickle.dump(job, self._process.stdin, protocol=pickle.HIGHEST_PROTOCOL)
            self._process.stdin.flush()
            came, answer = pickle.load(self._process.stdout)
        except (OSError, ValueError, EOFError, pickle.UnpicklingError):
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(LONGEST_END)
            self.end()
            raise EndedError(self._process.returncode) from None
        if came:
            return answer
        raise answer

    @property
    def is_alive(self) -> bool:
        """Whether it can take a job."""
        return self._process.poll() is None

    def end(self) -> None:
        """Stop it, whatever it does."""
        self._process.kill()
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):  # what was still to be written is for nobody
                pipe.close()  # type: ignore[union-attr]


def serve(answer: Callable[[Any], Any], idle: int = 0) -> None:
    """Answer the jobs that come on the standard input until it ends. idle : s after which a process without a job ends; 0: never."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the program that asked, which ends this one
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what foreign code prints is no answer
    alarm = getattr(signal, "alarm", lambda seconds: None)
    while True:
        alarm(idle)
        try:
            job = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        alarm(0)
        try:
            found = True, answer(job)
        except Exception as problem:  # whatever it is, the process that asked has to say it
            found = False, problem
        pickle.dump(found, answers, protocol=pickle.HIGHEST_PROTOCOL)
        answers.flush()


class Pool:
    """Processes of a module, which are started when there is a job, wait for the next one, and end with this process.

    given : further arguments of `subprocess.Popen`, found as a process is started.
    """

    def __init__(self, module: str, given: Callable[[], Mapping[str, Any]]) -> None:
        self._module, self._given, self._lock = module, given, threading.Lock()
        self._started: list[Process] = []
        self._idle: list[Process] = []
        atexit.register(self.end_all)

    def take(self) -> Process:
        """A process that waits, or a new one."""
        with self._lock:
            while self._idle:
                if (process := self._idle.pop()).is_alive:
                    return process
            process = Process(self._module, self._given())
            self._started.append(process)
            return process

    def give_back(self, process: Process) -> None:
        """Let it wait for the next job."""
        with self._lock:
            self._idle.append(process)

    def end_all(self) -> None:
        """End the processes, which keep their memory while they wait; what has to be done later starts new ones."""
        with self._lock:
            for process in self._started:
                process.end()
            self._started.clear()
            self._idle.clear()


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


def processors() -> int:
    """How many processes may compile at once."""
    return max(1, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)


def compile_all(jobs: Iterable[dict[str, Any]], done: Callable[[dict[str, Any]], None] = lambda job: None) -> None:
    """Let workers write the object files of these jobs; done(job) is called, here, as each is finished.

    Jobs that stand near each other in the list have functions in common, which a worker translates once: half of the workers begin at
    its end. What was written before an interruption stays. Raises CompilationError of the first job that fails, OSError
    where its file cannot be written.
    """
    left = deque(jobs)
    if left and find_spec("numba") is None:
        raise CompilationError("there is no compiler here: pip install 'nivel[laws]' brings one", NO_COMPILER)
    count = min(len(left), processors())
    finished: SimpleQueue[dict[str, Any] | BaseException | None] = SimpleQueue()

    def work(take: Callable[[], dict[str, Any]]) -> None:
        problem: BaseException | None = None
        try:
            process = COMPILERS.take()
            try:
                while (job := _next(take)) is not None:
                    _compile(process, job)
                    finished.put(job)
            except (CompilationError, OSError) as found:  # the process can take other jobs
                problem = found
            COMPILERS.give_back(process)
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


def _compile(process: Process, job: dict[str, Any]) -> None:
    """Raises CompilationError, and OSError where the file cannot be written."""
    try:
        answer = process.ask({**job, "places": sys.path})
    except EndedError as ended:
        what = f"the process that compiled {job['symbol']} ended with status {ended.status}"
        raise CompilationError(what, "died") from None
    if answer is not None:
        raise CompilationError(*answer)


def _surroundings() -> Mapping[str, Any]:
    """Settings of Numba change machine code, and are no part of its name."""
    own = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    return {"env": own | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}}


COMPILERS = Pool("nivel.native.worker", _surroundings)
