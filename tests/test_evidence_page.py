"""The map from capabilities to tests in `docs/evidence.md`: complete, and nothing in it that is not there."""

import re
from pathlib import Path

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "evidence.md").read_text(encoding="utf-8")


def folders_with_tests():
    """Folders of tests, those of `verification` by themselves."""
    return {path.parent.relative_to(ROOT).as_posix() for path in (ROOT / "tests").glob("*/**/test_*.py")}


def test_every_folder_of_tests_is_in_the_map():
    assert folders_with_tests() - set(re.findall(r"`(tests/[\w/]+)`", PAGE)) == set()


def test_paths_of_tests_on_pages_exist():
    pages = [*(ROOT / "docs").rglob("*.md"), ROOT / "CONTRIBUTING.md", ROOT / "benchmarks" / "README.md"]
    missing = [
        (page.name, path)
        for page in pages
        for path in re.findall(r"\btests/[\w/.-]*\w", page.read_text(encoding="utf-8"))
        if not (ROOT / path).exists()
    ]
    assert missing == []
