"""A process that computes variants: it reads pickled jobs from its input and answers each with a pickled result."""

from __future__ import annotations

import faulthandler
import os
import pickle
import signal
import sys
from typing import Any

from nivel.lazy import nivel


def main() -> None:
    """Compute variants until the input ends. A job is a task, or None for the one before, and values by path.

    What goes on for longer than the time limit of the task ends the process, whatever it does.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the program that asked, which ends its workers
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what foreign code prints is no answer
    task: Any = None
    with open(os.devnull, "w", encoding="utf-8") as nowhere:
        while True:
            try:
                sent, values = pickle.load(sys.stdin.buffer)
            except EOFError:
                return
            task = sent or task
            if task.time_limit is not None:
                faulthandler.dump_traceback_later(task.time_limit, exit=True, file=nowhere)
            try:
                answer: Any = nivel.analysis.sweep.variant.run_variant(task, values)
            except Exception as problem:  # whatever it is, the process that asked has to say it
                answer = problem
            faulthandler.cancel_dump_traceback_later()
            pickle.dump(answer, answers, protocol=pickle.HIGHEST_PROTOCOL)
            answers.flush()
