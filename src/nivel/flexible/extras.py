"""Libraries of the extra `flex`, loaded where they are used."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from nivel.errors import ModelError


def needed(name: str, why: str) -> ModuleType:
    """The module `name` of the extra `flex`. Raises ModelError where it is not installed, which says what to do."""
    try:
        return import_module(name)
    except ModuleNotFoundError:
        raise ModelError(f"{why} needs {name}: pip install nivel[flex]") from None
    except OSError as error:  # gmsh needs libraries of the system
        raise ModelError(f"{why} needs {name}, which cannot be loaded here: {error}") from None
