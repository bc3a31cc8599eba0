"""Rows of values: the variants that lists of equal length make."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from nivel.errors import Fault, ModelError, refuse
from nivel.words.arguments import plain
from nivel.words.wording import shown


def rows_of(values: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Values by path of each variant. Raises ModelError where lists are none, empty, or of several lengths."""
    if not values:
        raise ModelError(Fault.at("values", "nothing varies: give lists by path, {'bodies.rod.mass': [1, 2, 3]}"))
    lists, faults = {}, []
    for path, given in values.items():
        each = given.tolist() if getattr(given, "ndim", 0) == 1 else given
        if isinstance(each, str) or not isinstance(each, Sequence) or not len(each):
            faults.append(Fault.at(path, f"a list of values was expected, got {shown(given)}"))
        else:
            lists[path] = [plain(value) for value in each]
    if not faults and len({len(each) for each in lists.values()}) > 1:
        listed = ", ".join(f"{len(each)} of `{path}`" for path, each in lists.items())
        faults.append(Fault.at("values", f"lists of one length are needed; there are {listed}"))
    refuse(faults)
    return [dict(zip(lists, row, strict=True)) for row in zip(*lists.values(), strict=True)]
