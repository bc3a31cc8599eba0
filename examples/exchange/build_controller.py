"""Make `controller.fmu` of the C file and the description in `controller`: python build_controller.py

It takes a C compiler, `cc`. Most controllers come as an FMU from another program.
"""

import platform
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

HERE = Path(__file__).parent


def build(target):
    """Write the FMU for this system."""
    suffix = ".dll" if sys.platform == "win32" else ".so"
    system = {"win32": "windows"}.get(sys.platform, "linux")
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / f"controller{suffix}"
        source = HERE / "controller" / "controller.c"
        subprocess.run(["cc", "-O2", "-fPIC", "-shared", "-o", library, source], check=True)
        with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as packed:
            packed.write(HERE / "controller" / "modelDescription.xml", "modelDescription.xml")
            packed.write(library, f"binaries/{platform.machine()}-{system}/{library.name}")


if __name__ == "__main__":
    build(HERE / "controller.fmu")
