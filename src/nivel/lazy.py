"""Late making: modules that are imported when one of their names is first used, the only place of such imports, functions of rooms
above, and the methods of dataclasses.

A function that needs a heavy or optional module, or one that few runs need, writes its name in full, `scipy.linalg.expm(A)`, with
`from nivel.lazy import scipy` at the head of its file. `Late` stands for the package; type checkers read `lazy.pyi`, which
`packaging/write_settings.py` writes from the names that are used.

A lower room asks for a function of a room above by its subject; `nivel/__init__.py`, which stands above all rooms, says where each stands.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import asdict, field, fields, is_dataclass, replace  # noqa: F401
from importlib import import_module
from threading import RLock
from types import ModuleType
from typing import Any, Final

PLACES: Final[dict[str, str]] = {}


class Late:
    """A package whose modules are imported when one of their names is first used."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, name: str) -> Any:
        """A name of the package or of one of its modules. Raises ImportError where the package is not installed or has none such."""
        package = import_module(self._name)
        value = getattr(package, name, package)
        if value is package:
            value = import_module(f"{self._name}.{name}")
        if isinstance(value, ModuleType):
            value = Late(value.__name__) if hasattr(value, "__path__") else value
            setattr(self, name, value)
        return value


PIL, distributed, gymnasium, h5py, imageio_ffmpeg, matplotlib, meshio, nivel = map(
    Late, ("PIL", "distributed", "gymnasium", "h5py", "imageio_ffmpeg", "matplotlib", "meshio", "nivel")
)
numpy, pint, pyarrow, rich, scipy, skfem, websockets, xarray = map(
    Late, ("numpy", "pint", "pyarrow", "rich", "scipy", "skfem", "websockets", "xarray")
)


def provide(places: Mapping[str, str]) -> None:
    """State where functions stand: subject → `module:function`."""
    PLACES.update(places)


def provided(subject: str) -> Any:
    """The function or class of a subject, whose module is imported now."""
    module, _, name = PLACES[subject].partition(":")
    return getattr(import_module(module), name)


class _Unmade:
    """Stands for a method of a dataclass; where it is asked for, the class gets all of its own.

    Those of the standard library are text that is compiled, up to a millisecond a class, and a run uses a third of the classes that it
    imports.
    """

    __slots__ = ("make", "name")

    def __init__(self, name: str, make: Callable[[], None]) -> None:
        self.name, self.make = name, make

    def __get__(self, record: Any, owner: type | None = None) -> Any:
        self.make()
        return getattr(owner if record is None else record, self.name)


_MAKING = RLock()
_OF_ALL = ("__init__", "__repr__", "__dataclass_fields__", "__dataclass_params__", "__match_args__")
_FROZEN = ("__setattr__", "__delattr__")
_ORDER = ("__lt__", "__le__", "__gt__", "__ge__")


def _complete(kind, own, options):
    """Give a class what `dataclasses` makes for its double, which has its `own` names: while it is made other threads meet the stubs,
    which wait, and no class that is half made."""
    own = {name: value for name, value in own.items() if name not in ("__dict__", "__weakref__")}
    double = type(kind)(kind.__name__, kind.__bases__, own | {"__qualname__": kind.__qualname__})
    before = dict(vars(double))
    dataclasses.dataclass(double, **options)
    for name, value in vars(double).items():
        if before.get(name, _MAKING) is not value:
            for cell in getattr(value, "__closure__", None) or ():
                if cell.cell_contents is double:  # in `super(double, self)`
                    cell.cell_contents = kind
            setattr(kind, name, value)
    for name in before.keys() - vars(double).keys():
        delattr(kind, name)


def dataclass(kind=None, /, **options):
    """As `dataclasses.dataclass`, without `slots`: the class is completed when one of its methods is first asked for."""
    if kind is None:
        return lambda made: dataclass(made, **options)
    compared, frozen = options.get("eq", True), options.get("frozen", False)
    if compared and not frozen and "__hash__" not in vars(kind):
        kind.__hash__ = None
    names = {*_OF_ALL, *_FROZEN * frozen, *_ORDER * options.get("order", False), *("__eq__",) * compared}
    stubs = {}

    def make():
        with _MAKING:
            if stubs:
                own = {name: value for name, value in vars(kind).items() if stubs.get(name, _MAKING) is not value}
                stubs.clear()
                _complete(kind, own, options)

    for name in names.union(("__hash__",) * (compared and frozen)).difference(vars(kind)):
        stubs[name] = _Unmade(name, make)
        setattr(kind, name, stubs[name])
    return kind
