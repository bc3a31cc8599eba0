"""Results: sinks that keep the frames of a run, the result made of them, and how far to trust it."""

from nivel.results.memory import Memory
from nivel.results.result import Result
from nivel.results.store import Store

__all__ = ["Memory", "Result", "Store"]
