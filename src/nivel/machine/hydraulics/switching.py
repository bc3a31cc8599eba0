"""Delays of valves that are on or off, in words."""

from __future__ import annotations

from nivel.machine.core.checked import Checked
from nivel.machine.core.coefficient import NotNegativeDuration
from nivel.machine.given import Field
from nivel.machine.units.quantity import Duration


class Switching(Checked):
    """Delays of a valve that is on or off: on where its command is above one half."""

    on_delay: NotNegativeDuration = Field(default=0.0, description="from the command until it moves")
    off_delay: NotNegativeDuration = Field(default=0.0, description="the same when it is switched off")
    time: Duration = Field(default=0.01, description="from where it begins to move until it is open, or closed")
