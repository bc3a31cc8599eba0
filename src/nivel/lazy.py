"""Late making: modules that are imported when one of their names is first used, the only place of such imports, functions of rooms
above, and dataclasses without text that is compiled.

A function that needs a heavy or optional module, or one that few runs need, writes its name in full, `scipy.linalg.expm(A)`, with
`from nivel.lazy import scipy` at the head of its file. `Late` stands for the package; type checkers read `lazy.pyi`, which
`packaging/write_settings.py` writes from the names that are used.

A lower room asks for a function of a room above by its subject; `nivel/__init__.py`, which stands above all rooms, says where each stands.
"""

import dataclasses
import gc
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, field, fields, is_dataclass, replace  # noqa: F401
from functools import partial, total_ordering
from importlib import import_module
from inspect import Parameter, Signature, signature
from operator import attrgetter
from pathlib import Path
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


def homes(file: str) -> dict[str, tuple[str, str]]:
    """The names that the stub beside a file imports, which are imported when they are used: name → module, and its name there."""
    rows = (line.split() for line in Path(file).with_suffix(".pyi").read_text("utf-8").splitlines())
    return {row[-1]: (row[1], row[3]) for row in rows if row and row[0] == "from"}


def provide(places: Mapping[str, str]) -> None:
    """State where functions stand: subject → `module:function`."""
    PLACES.update(places)


def provided(subject: str) -> Any:
    """The function or class of a subject, whose module is imported now."""
    module, _, name = PLACES[subject].partition(":")
    return getattr(import_module(module), name)


@contextmanager
def all_kept() -> Iterator[None]:
    """Without the search for objects that only each other know: where a machine is built it takes a quarter of the time and finds none."""
    searches = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if searches:
            gc.enable()


class _Signature:
    """The signature of a dataclass, made when it is asked for."""

    def __get__(self, record: Any, owner: type) -> Signature:
        return Signature(sorted(map(_parameter, fields(owner)), key=lambda each: each.kind))


def _parameter(told: dataclasses.Field[Any]) -> Parameter:
    kind = Parameter.KEYWORD_ONLY if told.kw_only else Parameter.POSITIONAL_OR_KEYWORD
    given = (value for value in (told.default, told.default_factory) if value is not dataclasses.MISSING)
    return Parameter(told.name, kind, default=next(given, Parameter.empty), annotation=told.type)


def dataclass(kind=None, /, *, frozen=False, eq=True, repr=True, order=False, kw_only=False):
    """As `dataclasses.dataclass`, with methods that go over the fields: those of the standard library are text that is compiled, about a
    millisecond a class."""
    if kind is None:
        return partial(dataclass, frozen=frozen, eq=eq, repr=repr, order=order, kw_only=kw_only)
    kind.__doc__ = kind.__doc__ or kind.__name__  # or it would be made of a signature
    its_own = dict(vars(kind))
    dataclasses.dataclass(kind, init=False, repr=False, eq=False, kw_only=kw_only)
    every = fields(kind)
    known = dict.fromkeys(each.name for each in every).keys()
    unnamed = [each.name for each in every if not each.kw_only]
    defaults = {each.name: each.default for each in every if each.default is not dataclasses.MISSING}
    factories = {each.name: each.default_factory for each in every if each.default_factory is not dataclasses.MISSING}
    compared = attrgetter("__class__", *(each.name for each in every if each.compare))
    ends = hasattr(kind, "__post_init__")

    def made(self, /, *given, **named):
        values = vars(self)
        values.update(defaults)
        values.update(zip(unnamed, given, strict=False))
        values.update(named)
        for name, make in factories.items():
            if name not in values:
                values[name] = make()
        twice = given and named and not named.keys().isdisjoint(unnamed[: len(given)])
        if twice or values.keys() != known or len(given) > len(unnamed):
            signature(kind).bind(*given, **named)  # tells what is wrong
        if ends:
            self.__post_init__()

    def told(self):
        shown = (f"{each.name}={getattr(self, each.name)!r}" for each in every if each.repr)
        return f"{type(self).__qualname__}({', '.join(shown)})"

    def equal(self, other):
        return compared(self) == compared(other) if type(other) is type(self) else NotImplemented

    def less(self, other):
        return compared(self) < compared(other) if type(other) is type(self) else NotImplemented

    def refuse(self, name, *value):
        if type(self) is kind or name in known:
            raise dataclasses.FrozenInstanceError(f"cannot {'assign to' if value else 'delete'} field {name!r}")
        (super(kind, self).__setattr__ if value else super(kind, self).__delattr__)(name, *value)

    methods = {"__init__": made} | ({"__repr__": told} if repr else {}) | ({"__eq__": equal} if eq else {})
    methods |= ({"__lt__": less} if order else {}) | ({"__setattr__": refuse, "__delattr__": refuse} if frozen else {})
    for name in methods.keys() - its_own.keys():
        setattr(kind, name, methods[name])
    if eq and its_own.get("__hash__") is None:
        kind.__hash__ = (lambda record: hash(compared(record))) if frozen else None
    kind.__signature__ = _Signature()
    return total_ordering(kind) if order else kind


class Struct:
    """A record: each class below is a dataclass that refuses changes, but for those with `frozen=False`."""

    def __init_subclass__(cls, *, frozen: bool = True, **options: bool) -> None:
        super().__init_subclass__()
        dataclass(cls, frozen=frozen, **options)
