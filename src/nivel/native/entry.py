"""Entries: functions with an address, called by Python and by other entries.

Every entry is known by its name, `module:function`. Its machine code is found when its address is first asked for.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, update_wrapper
from importlib import import_module
from typing import Any

from nivel.native.signature import Signature


class Entry:
    """A function with an address. name : `module:attribute`, where a worker finds the entry."""

    def __init__(self, function: Callable[..., Any], signature: Signature, name: str = "") -> None:
        self.py_func, self.signature = function, signature
        self.name = name or f"{function.__module__}:{function.__qualname__}"
        update_wrapper(self, function)

    @property
    def symbol(self) -> str:
        """Its name in object files and libraries."""
        return "".join(c if c.isalnum() else "_" for c in self.name)

    @cached_property
    def address(self) -> int:
        """Address of the machine code, compiled now where there is none."""
        from nivel.native.library import address_of

        return address_of(self)

    @cached_property
    def whole(self) -> Entry:
        """The same code for records of which all numbers are dual, for gradients of runs."""
        return Entry(self.py_func, self.signature.on("whole"), f"{self.name}.whole")

    @cached_property
    def packed(self) -> Entry:
        """The same code for records of which all numbers are packs, for several machines at once."""
        return Entry(self.py_func, self.signature.on("packed"), f"{self.name}.packed")

    @cached_property
    def compiled(self) -> Any:
        """Numba's function, for entries that have this one within them."""
        from nivel.native.with_numba.functions import compiled

        return compiled(self)

    @cached_property
    def _call(self) -> Any:
        return self.signature.function_at(self.address)

    def __call__(self, *arguments: Any) -> Any:
        return self._call(*arguments)


def entry(signature: Signature) -> Callable[[Callable[..., Any]], Entry]:
    """Decorator: a function of the module, compiled for this signature, with an address."""
    return lambda function: Entry(function, signature)


def entry_of(name: str) -> Entry:
    """The entry of this name: `module:function`, or `module:family.twin` for that on dual numbers."""
    module, path = name.split(":")
    found: Any = import_module(module)
    for part in path.split("."):
        found = getattr(found, part)
    return found
