"""Disk space, taken before HDF5 needs it.

When a disk or a quota is full, HDF5 fails in the middle of its own bookkeeping: the file may become unreadable, and the
process may crash when it ends. So zeros are written behind the end of the file first. If that fails nothing has
happened yet, and HDF5 only ever writes into space that is there.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

AHEAD = 1024 * 1024  # bytes taken beyond what is needed now, so that small blocks do not take space each time
PIECE = bytes(256 * 1024)


class Space:
    """Room behind the end of an HDF5 file that is open for writing."""

    def __init__(self, path: Path, file: Any) -> None:
        self._path = path
        self._file = file

    def ensure(self, size: int) -> None:
        """Make sure that the file can grow by `size` bytes. Raises OSError where it cannot."""
        end, needed = self._path.stat().st_size, self._file.id.get_filesize() + size
        if end >= needed:
            return
        with self._path.open("r+b", buffering=0) as raw:
            raw.seek(end)
            try:
                while end < needed + AHEAD:
                    end += raw.write(PIECE)
            except OSError:
                if end < needed:
                    raise

    def close(self) -> None:
        """Close the file, which must be flushed, and give back what HDF5 did not use."""
        size = self._file.id.get_filesize()
        self._file.close()
        with self._path.open("r+b", buffering=0) as raw:
            raw.truncate(size)
            os.fsync(raw.fileno())
