"""Hydraulic components of a part, placed: ends of cylinders follow it, functions of signals are written for the placed part."""

from __future__ import annotations

from typing import Any

from nivel.files.placed_forces import placed_ends
from nivel.files.scene import Scene
from nivel.files.substitution import NotRepresentableError
from nivel.machine import Expression, PythonLaw, Table
from nivel.machine.forces import Ends


def placed_component(component: Any, scene: Scene) -> Any:
    """`component` in the placed part.

    Raises NotRepresentableError.
    """
    coordinate = getattr(component, "coordinate", None)
    if coordinate is not None and scene.is_opposite(coordinate):
        raise NotRepresentableError(f"`{coordinate}` changes its sign there")
    changes = placed_ends(component, scene, with_axes=False) if isinstance(component, Ends) else {}
    varied = {
        name: scene.varied(value) for name, value in component if isinstance(value, Expression | PythonLaw | Table)
    }
    return component.replace(**changes, **varied) if changes or varied else component
