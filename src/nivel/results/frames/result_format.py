"""Format of result files, and the nivel that wrote one: `docs/versions.md` says what may change within a format."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, Final

import nivel
from nivel.errors import ModelError

FORMAT: Final = 1
ATTRIBUTE: Final = "result_format"  # of the file; nivel 0.1.0 wrote files of format 1 without it


def check_format(path: object, attributes: Mapping[str, Any]) -> None:
    """Refuse a result file of another format. `attributes` has `nivel_version`.

    Raises ModelError, and ValueError or TypeError where the attribute is no whole number.
    """
    given = int(attributes.get(ATTRIBUTE, FORMAT))
    if given == FORMAT:
        return
    version = _version(attributes)
    raise ModelError(
        f"{path} was written by nivel {version} in result format {given}; nivel {nivel.__version__}, which runs here, reads "
        f"format {FORMAT}: `pip install nivel=={version}` installs the version that reads the file"
    )


def written_by_newer(attributes: Mapping[str, Any]) -> str:
    """End of a message on what cannot be read: that a newer nivel wrote the file; empty where none did."""
    version = _version(attributes)
    if _numbers(version) <= _numbers(nivel.__version__):
        return ""
    return (
        f"; it was written by nivel {version}, and nivel {nivel.__version__} runs here: "
        f"`pip install nivel=={version}` installs the version that reads the file"
    )


def _version(attributes: Mapping[str, Any]) -> str:
    """The version that the file states; empty where the attribute is damaged."""
    try:
        given = attributes.get("nivel_version", "")
    except (KeyError, OSError, RuntimeError, ValueError):  # of the HDF5 library
        return ""
    return given.decode(errors="replace") if isinstance(given, bytes) else str(given)


def _numbers(version: str) -> tuple[int, ...]:
    """0.10.2 is newer than 0.9; what is no version is older than all."""
    found = re.match(r"\d{1,9}(?:\.\d{1,9})*", version)
    return tuple(int(each) for each in found[0].split(".")) if found else ()
