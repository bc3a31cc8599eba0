"""Machines in words: frozen, typed records with units, defaults and bounds. Nothing here computes a motion."""

from typing import Any


def __getattr__(name: str) -> Any:
    """Records by the names that `nivel` has for them, so that `nivel.machine.Body` is `nivel.Body`."""
    import nivel

    if name.startswith("_") or name not in nivel.__all__:
        raise AttributeError(f"module 'nivel.machine' has no attribute '{name}'")
    return getattr(nivel, name)
