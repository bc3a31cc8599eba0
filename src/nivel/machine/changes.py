"""Simulation settings of a machine with some of them replaced for one run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from nivel.machine.settings.run import SimulationSettings


def changed(settings: SimulationSettings, changes: Mapping[str, Any]) -> SimulationSettings:
    """`settings` with `changes`, of `cut` also a single name; what belongs to a method that is replaced is left behind,
    unless it is among the changes itself.

    Raises ModelError where the words are not known or the numbers do not fit together.
    """
    changes = dict(changes)
    if isinstance(changes.get("cut"), str):
        changes["cut"] = (changes["cut"],)
    words = {name: each for name, each in changes.items() if isinstance(each, str)}  # anything else is refused below
    # own Baumgarte coefficients belong to the stabilisation they were given with
    if words.get("stabilisation", "baumgarte") != "baumgarte" and settings.baumgarte is not None:
        changes.setdefault("baumgarte", None)
    # velocities that are kept as unknowns belong to independent coordinates
    if words.get("coordinates", "independent") not in ("auto", "independent") and settings.independent:
        changes.setdefault("independent", ())
    # rotation coordinates belong to lagrange in absolute coordinates
    if (words.get("formulation", "lagrange"), words.get("coordinates", "absolute")) != ("lagrange", "absolute"):
        changes.setdefault("rotations", "euler-parameters")
    return settings.replace(**changes)
