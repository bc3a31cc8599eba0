"""Wheels with the library are for one kind of system and need no compiler; wheels without it are for all, and need Numba."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

COMPILER = "numba>=0.65"
# the kind of system that the library is for, as `packaging/build_wheel.py` says; empty: there is no library
PLATFORM = os.environ.get("NIVEL_SHIPPED_FOR", "")


class LibraryHook(BuildHookInterface):
    """Puts the library into the wheel."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """`packaging/build_wheel.py` has left it in the package. Raises FileNotFoundError where it is not there."""
        if PLATFORM:
            library = Path(self.root) / "src" / "nivel" / "native" / "shipped"
            if not (library / "manifest.json").exists() or not any(library.glob("*.so")):
                raise FileNotFoundError(
                    f"{library} has no library for {PLATFORM}: start packaging/build_wheel.py, which builds it"
                )
            build_data.update(pure_python=False, tag=f"py3-none-{PLATFORM}")
            build_data["artifacts"].append("src/nivel/native/shipped/*")


class DependencyHook(MetadataHookInterface):
    """Adds the compiler to what is needed."""

    PLUGIN_NAME = "custom"

    def update(self, metadata: dict[str, Any]) -> None:
        """The list of pyproject.toml, with Numba or without."""
        metadata["dependencies"] = [*self.config["dependencies"], *([] if PLATFORM else [COMPILER])]
