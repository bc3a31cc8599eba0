"""Files that are given where a machine file is expected: results, reports, and models of other programs."""

from __future__ import annotations

from typing import Final

_BEGINNINGS: Final[tuple[tuple[bytes, str], ...]] = (
    (
        b"\x89HDF\r\n",
        "this is a result, not a machine file: `nivel view {file}` plays it, `nivel explain {file}` says how far it can be trusted; "
        "the machine that made it is the file that was run",
    ),
    (b"CDF\x01", "this is a NetCDF-3 file, not a machine file"),
    (b"CDF\x02", "this is a NetCDF-3 file, not a machine file"),
    (b"<!doctype html", "this is a page for a browser, such as a report of nivel, not a machine file"),
    (b"<html", "this is a page for a browser, such as a report of nivel, not a machine file"),
    (b"PK\x03\x04", "this is a zip file, not a machine file"),
    (b"solid ", "this is a mesh (STL), not a machine file; a body refers to it: `shape: {{type: mesh, file: {file}}}`"),
    (b"iso-10303-21", "this is a CAD file (STEP), which nivel does not read; save the parts as meshes (STL)"),
)
_ROOTS: Final[tuple[tuple[bytes, str], ...]] = (
    (b"<robot", "URDF"),
    (b"<mujoco", "MuJoCo"),
    (b"<sdf", "SDF"),
    (b"<?xml", "XML"),
)
_LOOKED_AT: Final = 4000  # bytes


def foreign_content(content: bytes) -> str:
    """What the file with this `content` is, and what to do, with `{file}` for its name; empty where it may be a machine file."""
    start = content[:_LOOKED_AT]
    text = start.removeprefix(b"\xef\xbb\xbf").lstrip().lower()
    for beginning, answer in _BEGINNINGS:
        if start.startswith(beginning) or text.startswith(beginning):
            return answer
    if text.startswith(b"<"):
        for root, name in _ROOTS:
            if root in text:
                return (
                    f"this is a model in {name}, which nivel does not read; write its bodies and joints in a machine file: "
                    "`nivel new NAME` starts one"
                )
    return ""
