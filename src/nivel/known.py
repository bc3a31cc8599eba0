"""Classes of the package for those who name them in annotations, or only ask: `isinstance(force, Rope)`.

Nothing is imported, as a rope exists only where its module was. The stub of this file lists the classes, for type checkers and for this
file.
"""

import sys
from typing import Any, Final

from nivel.lazy import homes

_HOMES: Final = homes(__file__)


class _Known(type):
    """The class of what stands for a class."""

    def __instancecheck__(cls, record: Any) -> bool:
        kind = getattr(sys.modules.get(cls.__module__), cls.__name__, None)
        return kind is not None and isinstance(record, kind)


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"no class `{name}` is known here", name=name)
    globals()[name] = found = _Known(name, (), {"__module__": _HOMES[name][0]})
    return found
