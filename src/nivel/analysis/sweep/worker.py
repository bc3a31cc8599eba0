"""A process that runs variants: it reads pickled jobs from its input and answers each with a pickled result."""

from __future__ import annotations

import os
import pickle
import signal
import sys
from typing import Any


def main() -> None:
    """Run variants until the input ends. A job is a machine, or None for the one before, values by path, names to keep, and whether
    runs are verified."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the program that asked, which ends its workers
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what foreign code prints is no answer
    from nivel.analysis.sweep.variant import run_variant

    base: Any = None
    while True:
        try:
            machine, values, save, verify = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        base = machine or base
        try:
            answer: Any = run_variant(base, values, save, verify)
        except Exception as problem:  # whatever it is, the process that asked has to say it
            answer = problem
        pickle.dump(answer, answers, protocol=pickle.HIGHEST_PROTOCOL)
        answers.flush()
