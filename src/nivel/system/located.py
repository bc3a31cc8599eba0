"""The place in the machine of faults that come up where it is not known."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from nivel.errors import ModelError


@contextmanager
def located(place: str) -> Iterator[None]:
    """Faults without a place that come up inside get this one."""
    try:
        yield
    except ModelError as error:
        raise ModelError([replace(fault, path=fault.path or place) for fault in error.faults]) from error
