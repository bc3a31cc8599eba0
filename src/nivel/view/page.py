"""The built page: as the server gives it out, and with a package inside as one file that opens anywhere."""

from __future__ import annotations

import base64
import hashlib
from functools import cache
from html import escape
from pathlib import Path
from typing import Final

from nivel.view.package import compressed_text

FOLDER: Final = Path(__file__).parent / "page"
# makes the script from its compressed text and runs it
UNPACK: Final = (
    "(async()=>{const t=document.getElementById('code').textContent,"
    "b=Uint8Array.from(atob(t),c=>c.charCodeAt(0)),"
    "s=document.createElement('script');"
    "s.textContent=await new Response(new Blob([b]).stream().pipeThrough(new DecompressionStream('deflate'))).text();"
    "document.body.append(s)})()"
)
ALONE_POLICY: Final = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:"
NO_SCRIPT: Final = '<noscript><p class="complaint">The viewer needs JavaScript.</p></noscript>'


@cache
def built(name: str) -> str:
    """A file that `npm run build` made: viewer.js, viewer.css or NOTICE."""
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
    code = _compressed_script()
    body = (
        f'{NO_SCRIPT}<script type="text/plain" id="package">{compressed_text(package)}</script>'
        f'<script type="text/plain" id="code">{code}</script><script>{UNPACK}</script>'
    )
    policy = f'<meta http-equiv="Content-Security-Policy" content="{ALONE_POLICY}">'
    return _document(title, body, policy)


@cache
def _compressed_script() -> str:
    return compressed_text(built("viewer.js").encode())


def _document(title: str, body: str, head: str) -> str:
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<meta name="color-scheme" content="light dark">{head}<title>{escape(title)}</title>'
        f'<link rel="icon" href="data:,"><style>{built("viewer.css")}</style>\n'
        f"<!--\n{built('NOTICE').replace('--', '- -')}-->\n</head>\n<body>{body}</body>\n</html>\n"
    )
