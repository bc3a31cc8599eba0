"""What the build of the site adds to the pages: reference, gallery, moving pictures, and files that pages link to."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

sys.path.insert(0, str(Path(__file__).parent))

from cheat_sheet import SHEET_STYLE, cheat_sheet
from gallery import crane_at_work, gallery
from notebooks import notebook_page
from reference import command_page, key_page

ROOT = Path(__file__).parents[2]
# pages that stand beside docs/
PAGES = {
    "NOTATION.md": "notation.md",
    "benchmarks/README.md": "benchmarks.md",
    "README.md": "index.md",
    "ARCHITECTURE.md": "architecture.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
}
OUTSIDE = re.compile(r"\]\(((?:\.\./)+[^)#\s]+)(#[^)\s]*)?\)")
ANY = re.compile(r"\]\((?!http|#)([^)#\s]+)(#[^)\s]*)?\)")


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Pages of docs/ that the navigation does not name stand at the end of the guides."""
    named = set(re.findall(r"'([\w/-]+\.md)'", str(config.nav)))
    rest = sorted(path.name for path in Path(config.docs_dir).glob("*.md") if path.name not in named)
    for entry in config.nav or []:
        if isinstance(entry, dict) and "Guides" in entry:
            entry["Guides"] += rest
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add what is generated."""

    def add(path: str, content: str | bytes) -> None:
        files.append(File.generated(config, path, content=content))

    add("assets/nivel.css", STYLE + SHEET_STYLE)
    add("assets/iframe-worker.js", (ROOT / "docs" / "site" / "iframe-worker.js").read_bytes())
    add("keys.md", key_page())
    add("cheat-sheet.md", cheat_sheet())
    add("command-line.md", command_page())
    for source, page in PAGES.items():
        if page != "index.md":
            add(page, _with_links((ROOT / source).read_text(encoding="utf-8"), source))
    for path in sorted((ROOT / "examples").rglob("*")):
        if path.is_file() and path.suffix in (".yaml", ".py"):
            add(f"files/{path.relative_to(ROOT).as_posix()}", path.read_bytes())
    for place in sorted(_files_linked()):
        add(f"files/{place}", (ROOT / place).read_bytes())
    pictures = os.environ.get("NIVEL_SITE_PICTURES", "1") == "1"
    for path in sorted((ROOT / "docs" / "notebooks").glob("*.ipynb")):
        text, shown = notebook_page(path, executed=pictures)
        add(f"notebooks/{path.stem}.md", text)
        for name, picture in shown.items():
            add(f"notebooks/{name}", picture)
    page, made = gallery(pictures, pictures and os.environ.get("NIVEL_SITE_MACHINES", "1") == "1")
    add("gallery.md", page)
    for name, text in made.items():
        add(name, text)
    if pictures:
        add("moving/crane.html", crane_at_work())
    return files


STYLE = (
    ".md-typeset td code{word-break:normal;white-space:nowrap}.md-typeset table:not([class]){font-size:.66rem}"
    ".md-typeset .admonition td code{white-space:normal}"
)


def on_page_content(html: str, **_: Any) -> str:
    """Docstrings end a sentence before code with two colons."""
    return html.replace("::</p>", ":</p>")


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Links that lead out of docs/ lead to copies in the site. Without the moving crane the first page has a picture in its place."""
    source = page.file.src_uri
    if os.environ.get("NIVEL_SITE_PICTURES", "1") != "1":
        markdown = re.sub(
            r'<iframe src="moving/[^>]*></iframe>', "![A machine in the viewer](pictures/viewer.png)", markdown
        )
    return markdown if source in PAGES.values() and source != "index.md" else _with_links(markdown, f"docs/{source}")


def _with_links(markdown: str, source: str) -> str:
    """`markdown` of the file `source` with links to where things stand in the site."""
    up = "../" * PAGES.get(source, source.removeprefix("docs/")).count("/")

    def moved(match: re.Match[str]) -> str:
        place, anchor = _linked(match, source), match[2] or ""
        if place.startswith("docs/"):
            return f"]({up}{place.removeprefix('docs/')}{anchor})"
        return f"]({up}{PAGES[place]}{anchor})" if place in PAGES else f"]({up}files/{place})"

    return (ANY if source in PAGES else OUTSIDE).sub(moved, markdown)


def _linked(match: re.Match[str], source: str) -> str:
    """The file to which a link of the file `source` leads, as a path in the repository."""
    return os.path.normpath((Path(source).parent / match[1]).as_posix())


def _files_linked() -> set[str]:
    """The files outside of docs/ to which its pages link, besides pages and examples."""
    found = set()
    for path in (ROOT / "docs").rglob("*.md"):
        source = path.relative_to(ROOT).as_posix()
        found |= {_linked(match, source) for match in OUTSIDE.finditer(path.read_text(encoding="utf-8"))}
    return {place for place in found if place not in PAGES and not place.startswith(("docs/", "examples/"))}
