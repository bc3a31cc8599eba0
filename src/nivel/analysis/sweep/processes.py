"""Worker processes of a sweep. They need no `if __name__ == "__main__"` in the script that sweeps."""

from __future__ import annotations

import faulthandler
import os
import pickle
import threading
from collections import deque
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from queue import SimpleQueue
from threading import Lock
from time import monotonic
from typing import TYPE_CHECKING, Any, Final, TypeVar

from nivel.analysis.sweep.outputs import Task
from nivel.analysis.sweep.variant import KILLED, VariantRun, at_once, run_variants
from nivel.analysis.sweep.variant_runs import TIMED_OUT
from nivel.errors import ModelError
from nivel.extras import needed
from nivel.lazy import distributed
from nivel.native.workers import EndedError, Process, serve, signal_of
from nivel.words.wording import seconds

if TYPE_CHECKING:
    from distributed import Client


ONE_THREAD: Final = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")

# number of the variant, its task, its values by path
Job = tuple[int, Task, Mapping[str, Any]]
Group = Sequence[Job]
T = TypeVar("T")


def run_in_processes(
    groups: Iterable[Group], count: int, *, here: bool = True
) -> Generator[tuple[int, VariantRun], None, None]:
    """Number and run of each variant, as they are finished, by `count` processes. here : this one is one of them, which goes on while the
    others start; without it no variant can end this process. Workers are ended where the caller stops.

    Raises what a worker could not do for a fault of nivel.
    """
    left, finished = deque(groups), SimpleQueue[tuple[int, Any] | None]()
    workers = [Worker() for _ in range(min(count - here, len(left)))]
    for worker in workers:
        threading.Thread(target=_serve, args=(worker, left, finished), daemon=True).start()
    working = len(workers)
    try:
        while working or (here and left):
            if here and finished.empty() and (group := next_of(left)) is not None:
                yield from run_group(group)
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


def next_of(left: deque[T]) -> T | None:
    """What no other thread has taken; None where nothing is left."""
    try:
        return left.popleft()
    except IndexError:
        return None


def grouped(jobs: Sequence[Job]) -> list[Group]:
    """Jobs that are computed together; the first one apart, so that a name in `save` that is none is told at once."""
    size = at_once(jobs[0][1]) if jobs else 1
    return [jobs[k : k + size] if k else jobs[:1] for k in (*range(min(1, len(jobs))), *range(1, len(jobs), size))]


def run_group(group: Group) -> Iterator[tuple[int, VariantRun]]:
    """Number and run of jobs of one task, computed here."""
    runs = run_variants(group[0][1], [values for _, _, values in group])
    return zip((number for number, _, _ in group), runs, strict=True)


def _serve(worker: Worker, left: deque[Group], finished: SimpleQueue[Any]) -> None:
    try:
        while (group := next_of(left)) is not None:
            runs = worker.run(group[0][1], [values for _, _, values in group])
            for (number, _, _), run in zip(group, runs, strict=True):
                finished.put((number, run))
    except BaseException as problem:  # whatever it is, nobody may wait for it
        finished.put((-1, problem))
    finished.put(None)


class Worker:
    """A process that computes one variant after the other. Where one of them ends it, the next one starts it anew."""

    def __init__(self) -> None:
        self._ended = False
        self._start()

    def _start(self) -> None:
        self._process = Process(
            "nivel.analysis.sweep.processes", {"env": {**os.environ, **dict.fromkeys(ONE_THREAD, "1")}}
        )
        self._task: Task | None = None
        self._lives = True

    def run(self, task: Task, rows: Sequence[Mapping[str, Any]]) -> list[VariantRun]:
        """Variants, computed by the process; one that was killed or timed out where the process ends on the way."""
        if not self._lives and not self._ended:
            self._start()
        sent, self._task = (None if task is self._task else task), task
        begin = monotonic()
        try:
            return self._process.ask((sent, rows))
        except EndedError as ended:
            status, self._lives = ended.status, False
        if len(rows) > 1:  # which of them it was, is found singly
            return [run for values in rows for run in self.run(task, [values])]
        if task.time_limit is not None and monotonic() - begin >= task.time_limit:
            return [VariantRun(TIMED_OUT, f"it took longer than the time limit of {seconds(task.time_limit)}")]
        what = f"status {status}" if status >= 0 else f"the signal {signal_of(status).removeprefix('signal ')}"
        return [VariantRun(KILLED, f"the process that ran it ended with {what}")]

    def end(self) -> None:
        """Stop it, whatever it does."""
        self._ended = True
        self._process.end()


def main() -> None:
    """In a worker: compute variants until the input ends. A job is a task, or None for the one before, and values by path of each of them.

    What goes on for longer than the time limit of the task ends the process, whatever it does.
    """
    task: Any = None
    with open(os.devnull, "w", encoding="utf-8") as nowhere:

        def answer(job: Any) -> Any:
            nonlocal task
            sent, rows = job
            task = sent or task
            if task.time_limit is not None:
                faulthandler.dump_traceback_later(task.time_limit, exit=True, file=nowhere)
            try:
                return [*run_variants(task, rows)]
            finally:
                faulthandler.cancel_dump_traceback_later()

        serve(answer)


AHEAD: Final = 2  # tasks that are submitted for each thread of the cluster, so that none waits for the next
LOOK: Final = 2.0  # s between two looks at how many threads there are
PATIENCE: Final = "10 s"

_free: list[Worker] = []  # in a worker of Dask: processes that wait for a variant
_lock = Lock()


def client_of(address: str) -> Client:
    """A client of the scheduler at `address`, as tcp://HOST:8786. Raises ModelError where Dask is missing, or nobody answers."""
    distributed = needed("distributed", "studies on a cluster need")
    try:
        return distributed.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        message = f"no scheduler of Dask answers at {address}: start one with `dask scheduler`, and workers with `dask worker {address}`"
        raise ModelError(f"{message} ({error})") from None


def threads_of(client: Client) -> int:
    """Number of variants that the cluster computes at once."""
    threads: Any = client.nthreads()
    return max(1, sum(threads.values()))


def run_on_cluster(jobs: Iterable[Job], client: Client) -> Generator[tuple[int, VariantRun], None, None]:
    """Number and run of each variant, as they are finished. Tasks are given up where the caller stops.

    Dask gives up a task whose worker died several times. It may have been together with the one that was to blame, so it is run once
    more, alone. Raises what a worker could not do for a fault of nivel.
    """
    left, alone = deque(jobs), deque[Job]()
    together = distributed.as_completed(loop=client.loop, with_results=True, raise_errors=False)
    pending: dict[Any, Job] = {}
    packed: dict[int, bytes] = {}

    def submit(job: Job) -> None:
        _, task, values = job
        content = packed.get(id(task)) or packed.setdefault(id(task), pickle.dumps(task, pickle.HIGHEST_PROTOCOL))
        future = client.submit(compute, content, values, pure=False)
        pending[future] = job
        together.add(future)

    room, asked = 0, -LOOK

    def fill() -> None:
        nonlocal room, asked
        if monotonic() - asked >= LOOK:
            room, asked = AHEAD * threads_of(client), monotonic()
        while left and len(pending) < room:
            submit(left.popleft())

    try:
        fill()
        for future, result in together:
            job = pending.pop(future)
            if left:
                fill()
            if future.status == "finished":
                yield job[0], result
                continue
            error: Any = future.exception()
            if not isinstance(error, distributed.KilledWorker):
                raise error
            alone.append(job)
        for job in alone:
            yield job[0], _alone(client, job)
    finally:
        client.cancel(list(pending))
        together.clear()
        with suppress(OSError, TimeoutError):  # the scheduler may be gone
            client.run(end_free)


def _alone(client: Client, job: Job) -> VariantRun:
    _, task, values = job
    future = client.submit(compute, pickle.dumps(task, pickle.HIGHEST_PROTOCOL), values, pure=False)
    error: Any = future.exception()
    if isinstance(error, distributed.KilledWorker):
        return VariantRun(KILLED, "the worker of Dask that ran it died, each time that it was tried")
    if error is not None:
        raise error
    return future.result()


class _Tasks:
    """The task that was unpacked last; all variants of a study have the same."""

    content: bytes = b""
    task: Task | None = None


def end_free() -> None:
    """In a worker of Dask: end the processes that wait for a variant."""
    with _lock:
        while _free:
            _free.pop().end()


def compute(content: bytes, values: Mapping[str, Any]) -> VariantRun:
    """In a worker of Dask: a variant of the packed task."""
    with _lock:
        if content != _Tasks.content:
            _Tasks.task, _Tasks.content = pickle.loads(content), content
        task = _Tasks.task
        worker = _free.pop() if _free else Worker()
    assert task is not None
    try:
        return worker.run(task, [values])[0]
    finally:
        with _lock:
            _free.append(worker)
