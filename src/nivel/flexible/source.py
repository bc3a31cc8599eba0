"""The finite-element model that a model file describes, from whatever source."""

from __future__ import annotations

from collections.abc import Callable

from nivel.flexible.model.frame import frame_model
from nivel.flexible.model.model import FiniteElementModel
from nivel.flexible.model.model_file import Located
from nivel.flexible.model.selection import NodeSets
from nivel.lazy import nivel

Stage = Callable[[str, float], None]


def source_model(located: Located, say: Stage) -> tuple[FiniteElementModel, NodeSets]:
    """The model before its interfaces are tied, and its node sets. `say` hears what begins, with shares from 0 to 1.

    Raises ModelError.
    """
    if located.record.frame is not None:
        return frame_model(located), {}
    if located.record.solid is not None:
        return nivel.flexible.model.solid_source.solid_model(located, say)
    return nivel.flexible.foreign.source.matrix_model(located)
