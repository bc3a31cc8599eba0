"""Keywords of settings in `nivel/settings.py`, stubs of records and tables of pages, written from the records.

python packaging/write_settings.py [PAGE …]
"""

import sys
from pathlib import Path

import nivel
from record_stubs import write_stubs
from settings_keywords import module
from settings_tables import with_tables

if __name__ == "__main__":
    (Path(nivel.__file__).parent / "settings.py").write_text(module(), encoding="utf-8")
    write_stubs()
    docs = Path(__file__).parent.parent / "docs"
    for page in map(Path, sys.argv[1:] or docs.rglob("*.md")):
        page.write_text(with_tables(page.read_text(encoding="utf-8")), encoding="utf-8")
