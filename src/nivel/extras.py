"""Libraries that an installation may lack: what brings them, and the refusal of what needs them, before anything else is done."""

import sys
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Final, NamedTuple

from nivel.errors import Fault, ModelError


class Library(NamedTuple):
    """A library as it is installed. extra : of nivel that brings it; empty: nivel itself does."""

    package: str
    extra: str


LIBRARIES: Final = {
    "asammdf": Library("asammdf", "measured"),
    "asyncua": Library("asyncua", "opcua"),
    "cma": Library("pycma", "search"),
    "coacd": Library("coacd", "shapes"),
    "control": Library("python-control", "control"),
    "gymnasium": Library("gymnasium", "gym"),
    "distributed": Library("Dask", "studies"),
    "gmsh": Library("gmsh", "flex"),
    "jax": Library("jax", "jax"),
    "imageio_ffmpeg": Library("ffmpeg", "film"),
    "matplotlib": Library("matplotlib", "plot"),
    "mcap.reader": Library("mcap", "measured"),
    "mcap.writer": Library("mcap", "measured"),
    "mcap_ros2.decoder": Library("mcap-ros2-support", "measured"),
    "meshio": Library("meshio", "flex"),
    "mujoco": Library("mujoco-core", "robots"),
    "optuna": Library("Optuna", "search"),
    "paho.mqtt.client": Library("paho-mqtt", "mqtt"),
    "pandas": Library("pandas", ""),
    "pyarrow.parquet": Library("pyarrow", "measured"),
    "PIL": Library("pillow", "film"),
    "pyDOE3": Library("pyDOE3", "studies"),
    "skfem": Library("scikit-fem", "flex"),
    "torch": Library("torch", "torch"),
    "websockets": Library("websockets", ""),
}


def is_installed(module: str) -> bool:
    """Whether a library of LIBRARIES can be imported; it is not loaded."""
    if module in sys.modules:
        return sys.modules[module] is not None
    try:
        return find_spec(module) is not None
    except (ImportError, ValueError):
        return False


def require(needs: str, *modules: str) -> None:
    """Refuse to go on without libraries of LIBRARIES, which `needs` ("plots need"). Raises ModelError with all that are missing."""
    missing = [LIBRARIES[module] for module in modules if not is_installed(module)]
    if missing:
        raise ModelError([Fault.at("", f"{needs} {each.package}: {_command(each)}") for each in missing])


def _command(library: Library) -> str:
    return "pip install " + (f"'nivel[{library.extra}]'" if library.extra else library.package)


def needed(module: str, needs: str) -> ModuleType:
    """A library of LIBRARIES. Raises ModelError where it is not installed, or cannot be loaded, which says what to do."""
    require(needs, module)
    try:
        return import_module(module)
    except OSError as error:  # gmsh needs libraries of the system
        raise ModelError(f"{needs} {LIBRARIES[module].package}, which cannot be loaded here: {error}") from None
