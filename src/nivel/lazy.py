"""Late bindings: functions of rooms above that lower rooms call, such as the page that a result opens.

A lower room asks for a function by its subject; `nivel/__init__.py`, which stands above all rooms, says where each stands. The module is
imported when its function is first asked for.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any, Final

PLACES: Final[dict[str, str]] = {}


def provide(places: Mapping[str, str]) -> None:
    """State where functions stand: subject → `module:function`."""
    PLACES.update(places)


def provided(subject: str) -> Any:
    """The function or class of a subject, whose module is imported now."""
    module, _, name = PLACES[subject].partition(":")
    return getattr(import_module(module), name)
