"""Where compiled kernels are kept.

Numba stamps a cached kernel with its own file only: an edit of a callee in another file, a change of bounds checking or of the
processor would go unseen. The directory name therefore carries a hash of all sources that hold kernels, of Numba, Python, the
processor and the flags; old directories are simply not found again.
"""

from __future__ import annotations

import hashlib
import os
import platform
import sys
import tempfile
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent
KERNEL_PACKAGES = ("kernels", "motion", "march")


@cache
def directory() -> Path:
    """The cache directory of this installation: ``<user cache>/nivel/kernels-<hash>``, or a temporary one if not writable.

    ``NIVEL_CACHE_DIR`` names another place for the user cache.
    """
    root = Path(os.environ.get("NIVEL_CACHE_DIR") or _user_cache())
    path = root / f"kernels-{_fingerprint()}"
    try:
        path.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            pass
    except OSError:
        path = Path(tempfile.mkdtemp(prefix="nivel-kernels-"))
    return path


def is_warm(module: str) -> bool:
    """Whether compiled kernels of `module` (the last part of its name) are in the cache."""
    return any(directory().glob(f"**/{module}.*.nbi"))


def is_warm_on_complex_numbers(module: str) -> bool:
    """Whether those of its families that run on complex numbers are: they are the second machine code of the same function."""
    return any(directory().glob(f"**/{module}.*.2.nbc"))


def install() -> None:
    """Point Numba at the cache directory; must run before the first kernel is decorated."""
    import numba

    numba.config.CACHE_DIR = str(directory())  # type: ignore[attr-defined]


def _user_cache() -> Path:
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or str(Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = str(Path.home() / "Library" / "Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "nivel"


def _fingerprint() -> str:
    from importlib.metadata import version

    digest = hashlib.sha256()
    for package in KERNEL_PACKAGES:
        for source in sorted((PACKAGE / package).rglob("*.py")):
            digest.update(str(source.relative_to(PACKAGE)).encode())
            digest.update(source.read_bytes())
    facts = [version("numba"), version("numpy"), sys.version, platform.machine(), _processor()]
    facts += [f"{key}={value}" for key, value in sorted(os.environ.items()) if key.startswith("NUMBA_")]
    digest.update("\n".join(facts).encode())
    return digest.hexdigest()[:16]


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    wanted = ("model name", "flags", "Features")
    return "\n".join(next((line for line in lines if line.startswith(key)), "") for key in wanted)
