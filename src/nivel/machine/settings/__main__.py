"""Command `python -m nivel.machine.settings [PAGE …]`: writes the keywords of all settings, and the tables of pages."""

import sys
from pathlib import Path

import nivel
from nivel.machine.settings.keywords import module
from nivel.machine.settings.tables import with_tables

if __name__ == "__main__":
    (Path(nivel.__file__).parent / "settings.py").write_text(module(), encoding="utf-8")
    for page in map(Path, sys.argv[1:]):
        page.write_text(with_tables(page.read_text(encoding="utf-8")), encoding="utf-8")
