"""Variants on a cluster of Dask: each is a task, and each worker computes it in a process of its own, which it may end."""

from __future__ import annotations

import pickle
from collections import deque
from collections.abc import Generator, Iterable, Mapping
from contextlib import suppress
from threading import Lock
from time import monotonic
from typing import TYPE_CHECKING, Any, Final

from nivel.analysis.sweep.processes import Job, Worker
from nivel.analysis.sweep.task import Task
from nivel.analysis.sweep.variant import KILLED, VariantRun
from nivel.errors import ModelError
from nivel.extras import needed
from nivel.lazy import distributed

if TYPE_CHECKING:
    from distributed import Client

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
        return worker.run(task, values)
    finally:
        with _lock:
            _free.append(worker)
