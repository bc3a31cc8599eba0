"""The kernels as plain Python: every index is checked, nothing is compiled.

`install` must run before a kernel is imported, in a process with NUMBA_DISABLE_JIT=1. Numba's decorators then leave a function as it is;
what is left to replace is what reads machine addresses: views of records, calls of families and laws. Indices out of range fail as NumPy
has it, and so do negative ones and slices that reach beyond their array, which compiled code would take for something else.
"""

import itertools
import sys
from functools import cached_property, wraps
from weakref import WeakValueDictionary

import numpy as np

from nivel.native.duals import DUAL, duals
from plain_duals import MATH, NONE, Dual, slope, unit

FUNCTIONS = {}
UNSIGNED = (np.uint32, np.uint64)
# (file, first line) of the kernels that were called
CALLED = set()
_addresses = itertools.count(1_000_003, 16)


class Checked(np.ndarray):
    """An array whose indices must be within it; entries that are indices come as Python's integers, which do not wrap, dual numbers as
    those of plain Python."""

    def __getitem__(self, key):
        if type(key) is not int or key < 0:
            _check(self.shape, key)
        found = _get(self, key)
        if type(found) is np.void:
            slopes = found["slopes"]
            return Dual(found["value"], slopes.copy() if np.count_nonzero(slopes) else NONE)
        return int(found) if type(found) in UNSIGNED else found

    def __setitem__(self, key, value):
        if type(key) is not int or key < 0:
            _check(self.shape, key)
        if self.dtype == DUAL:
            value = _as_stored(value)
        _set(self, key, value)


def _as_stored(value):
    """A number, or an array, as an array of dual numbers takes it."""
    if isinstance(value, Dual):
        return value.real, value.slopes
    if not isinstance(value, np.ndarray):
        return value, NONE
    return value if value.dtype == DUAL else duals(value)


_get, _set = np.ndarray.__getitem__, np.ndarray.__setitem__


def _check(shape, key):
    """Refuse what NumPy lets pass: negative indices, and slices that reach beyond the array."""
    for k, part in enumerate(key if type(key) is tuple else (key,)):
        if type(part) is slice:
            first, last = part.start or 0, shape[k] if part.stop is None else part.stop
            if not 0 <= first <= last <= shape[k]:
                raise IndexError(f"slice {first}:{last} of axis {k} with {shape[k]} entries")
        elif part < 0:
            raise IndexError(f"index {part} of axis {k} with {shape[k]} entries")


def checked(record):
    """The record with checked views of its arrays."""
    fields = [checked(field) if isinstance(field, tuple) else field.view(Checked) for field in record]
    return type(record)(*fields)


def noted(function):
    """`function`, which leaves a note that it was called."""
    code = function.__code__
    place = code.co_filename, code.co_firstlineno

    @wraps(function)
    def called(*arguments):
        CALLED.add(place)
        return function(*arguments)

    return called


def called_from_python(entry, *arguments):
    """An entry; dual numbers come as arrays of one."""
    kinds = zip(entry.signature.arguments, arguments, strict=True)
    return entry.plain(*(each.view(Checked)[0] if kind == "dual" else each for kind, each in kinds))


def address_of(function):
    """A number that stands for the address of this function."""
    address = next(_addresses)
    FUNCTIONS[address] = function
    return address


def install():
    """Let everything that is imported from now on run as plain Python."""
    assert not [name for name in sys.modules if name.startswith("nivel.kernels.")], "kernels are imported already"
    import numba

    assert numba.config.DISABLE_JIT, "set NUMBA_DISABLE_JIT=1"
    from nivel.native import function, library
    from nivel.native.entry import Entry
    from nivel.native.signature import Signature
    from nivel.native.with_numba.laws import law_of

    function.leaf = function.part = function.stage = function.shared = noted
    # entries and laws are called by numbers that stand for their addresses
    function.caller = lambda *_: lambda address, *arguments: FUNCTIONS[int(address)](*arguments)
    Entry.plain = cached_property(lambda self: noted(self.py_func))
    Entry.plain.__set_name__(Entry, "plain")
    Entry.address = cached_property(lambda self: address_of(self.plain))
    Entry.address.__set_name__(Entry, "address")
    Entry.__call__ = called_from_python
    Signature.function_at = lambda _, address: FUNCTIONS[int(address)]
    library.missing = lambda _: []

    def address_of_law(text, _):
        law = law_of(text, "<law>")
        law.__globals__["math"] = MATH
        return address_of(noted(law))

    library.address_of_law = address_of_law
    from nivel.kernels.core import block, handle, lanes, number

    handles = WeakValueDictionary()
    make = block.Handle.__init__

    def kept(self, record):
        make(self, record)
        self.checked = checked(record)
        handles[int(self.address)] = self

    def record_at(address):
        return handles[int(address[0] if isinstance(address, tuple) else address)].checked

    lanes.unit, lanes.slope = unit, slope
    # gradients of runs are compiled only
    lanes.is_whole = lambda address: False
    number.number_of = lambda address, x: x.real
    number.without_slopes = lambda x: x
    number.where = lambda truth, x, y: x if truth else y
    number.some, number.share_of_lanes = bool, lambda truth: 1.0
    block.Handle.__init__ = kept
    handle.reader = lambda *_: record_at
