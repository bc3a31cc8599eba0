"""The built page: as the server gives it out, and with a package inside as one file that opens anywhere."""

import base64
import hashlib
import os
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from html import escape
from pathlib import Path
from typing import Final

from nivel.files.target import keep_sources, write_file
from nivel.native.store import folder, read, write
from nivel.results.result import Result
from nivel.view.package import compressed_text
from nivel.view.playback import ALONE, Budget, playback
from nivel.view.sources import Source

FOLDER: Final = Path(__file__).parent / "page"
# makes the script from its compressed text and runs it
UNPACK: Final = (
    "(async()=>{const t=document.getElementById('code').textContent,"
    "b=Uint8Array.from(atob(t),c=>c.charCodeAt(0)),"
    "s=document.createElement('script');"
    "s.textContent=await new Response(new Blob([b]).stream().pipeThrough(new DecompressionStream('deflate'))).text();"
    "document.body.append(s)})()"
)
MACHINE_POLICY: Final = (
    "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; img-src data: blob:; "
    "worker-src blob:"
)
ALONE_POLICY: Final = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:"
NO_SCRIPT: Final = '<noscript><p class="complaint">The viewer needs JavaScript.</p></noscript>'


@cache
def built(name: str) -> str:
    """A file that `npm run build` made: viewer.js, program.js, viewer.css or NOTICE."""
    return (FOLDER / name).read_text(encoding="utf-8")


def served_page() -> str:
    """The page without data: it asks the server that it came from."""
    return _document("nivel", f"{NO_SCRIPT}<script>{built('viewer.js')}</script>", "")


def script_hash() -> str:
    """What a content security policy calls the one script of the served page."""
    digest = hashlib.sha256(built("viewer.js").encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"


def page_alone(package: bytes, title: str) -> str:
    """One HTML file with script and data inside, both compressed; it needs no network and nothing beside it."""
    return _alone(title, ALONE_POLICY, package=compressed_text(package), code=_compressed("viewer.js"))


def page_with_machine(title: str, package: bytes, machine: bytes, memory: bytes, kernels: bytes) -> str:
    """The same of a live machine, which moves in it. machine : its records (`local.LocalMachine`). memory : at its start. kernels : its
    machine code, a module of WebAssembly."""
    data = {"package": package, "machine": machine, "memory": memory, "kernels": kernels}
    texts = {name: compressed_text(content) for name, content in data.items()}
    return _alone(title, MACHINE_POLICY, **texts, program=_compressed("program.js"), code=_compressed("viewer.js"))


def _alone(title: str, policy: str, **texts: str) -> str:
    """A page with compressed texts in it, the last of them its script."""
    body = "".join(f'<script type="text/plain" id="{name}">{text}</script>' for name, text in texts.items())
    head = f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
    return _document(title, f"{NO_SCRIPT}{body}<script>{UNPACK}</script>", head)


@cache
def _compressed(name: str) -> str:
    """A built file as text for a page; kept beside the machine code, where there is room for it."""
    content = built(name).encode()
    path = folder() / f"{name}-{hashlib.sha256(content).hexdigest()[:24]}"
    kept = read(path)
    if kept is None:
        kept = compressed_text(content).encode()
        with suppress(OSError):
            write(path, kept)
    return kept.decode()


def _document(title: str, body: str, head: str) -> str:
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<meta name="color-scheme" content="light dark">{head}<title>{escape(title)}</title>'
        f'<link rel="icon" href="data:,"><style>{built("viewer.css")}</style>\n'
        f"<!--\n{built('NOTICE').replace('--', '- -')}-->\n</head>\n<body>{body}</body>\n</html>\n"
    )


def scene_html(results: Sequence[Result], budget: Budget = ALONE) -> str:
    """The page of a result, with further ones as ghosts: it needs no network and nothing beside it."""
    return page_alone(playback(results, budget), results[0].name)


def page_of(source: Source) -> str:
    """The page of a source, without what would come later."""
    return page_alone(source.package(), "nivel")


def write_scene(results: Sequence[Result], path: str | os.PathLike[str]) -> Path:
    """Write the page of results to `path`; an existing file is replaced."""
    target = Path(path)
    keep_sources(target, "page", [result.path for result in results if result.path])
    return write_file(target, "page", scene_html(results))


def write_page(source: Source, path: Path) -> Path:
    """Write the page of a source to `path`; an existing file is replaced."""
    return write_file(path, "page", page_of(source))


class Inline:
    """A playback that notebooks show. height : of the frame, in pixels."""

    def __init__(self, results: list[Result], height: int) -> None:
        self._name = results[0].name
        self._html = scene_html(results)
        self._height = height

    def _repr_html_(self) -> str:
        # without an origin of its own: the page can reach nothing of the notebook
        return (
            f'<iframe title="{escape(self._name)} in motion" sandbox="allow-scripts" srcdoc="{escape(self._html)}" '
            f'style="width:100%;height:{self._height}px;border:0;border-radius:12px"></iframe>'
        )

    def __repr__(self) -> str:
        return (
            f"<view of {self._name}: shown in notebooks; elsewhere `nivel view`, or result.export_scene('scene.html')>"
        )
