"""The analyses that the variants of a study can be, and the records of their settings."""

from __future__ import annotations

from typing import Final

from nivel.machine.core.record import Record
from nivel.machine.settings.inverse import InverseSettings
from nivel.machine.settings.kinematics import KinematicsSettings
from nivel.machine.settings.linearise import LineariseSettings
from nivel.machine.settings.run import SimulationSettings
from nivel.machine.settings.statics import StaticsSettings

SETTINGS: Final[dict[str, type[Record]]] = {
    "run": SimulationSettings,
    "statics": StaticsSettings,
    "kinematics": KinematicsSettings,
    "linearise": LineariseSettings,
    "inverse": InverseSettings,
}
