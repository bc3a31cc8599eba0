"""The machine files of the examples whose bodies are rigid and whose circuits, if any, are springs and motors, by name."""

from pathlib import Path

EXAMPLES = Path(__file__).parent.parent / "examples"
FOLDERS = ("mechanisms", "contact", "vehicles", "machines", "control")
RIGID = sorted(path for folder in FOLDERS for path in (EXAMPLES / folder).glob("*.yaml"))


def rigid_example(name: str) -> Path:
    """The file `name`.yaml, whichever subject it stands under."""
    (found,) = (path for path in RIGID if path.stem == name)
    return found
