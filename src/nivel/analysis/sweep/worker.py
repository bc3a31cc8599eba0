"""A process that computes variants: it answers each job with its result (`nivel.native.workers`)."""

from __future__ import annotations

import faulthandler
import os
from typing import Any

from nivel.lazy import nivel
from nivel.native.workers import serve


def main() -> None:
    """Compute variants until the input ends. A job is a task, or None for the one before, and values by path of each of them.

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
                return [*nivel.analysis.sweep.variant.run_variants(task, rows)]
            finally:
                faulthandler.cancel_dump_traceback_later()

        serve(answer)
