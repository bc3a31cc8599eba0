"""Pages from templates: one HTML file with styles and scripts inside."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

from jinja2 import Environment, FileSystemBytecodeCache, FileSystemLoader
from jinja2.bccache import Bucket

from nivel import __version__
from nivel.native.store import folder

HERE: Final = Path(__file__).parent


class _Kept(FileSystemBytecodeCache):
    """Byte code of templates beside the machine code, where there is room for it."""

    def dump_bytecode(self, bucket: Bucket) -> None:
        with suppress(OSError):
            super().dump_bytecode(bucket)


def text_of(name: str) -> str:
    """The text of a file beside the templates: a style or a script."""
    return (HERE / name).read_text(encoding="utf-8")


def page(
    template: str, styles: tuple[str, ...], filters: Mapping[str, Callable[..., str]] | None = None, **values: Any
) -> str:
    """The page of a template with its `values`, the style of all pages and further `styles`; `filters` are those of Jinja."""
    environment = Environment(
        loader=FileSystemLoader(HERE),
        bytecode_cache=_Kept(str(folder())),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(filters or {})
    looks = {"page_style": text_of("page.css"), "style": "".join(map(text_of, styles))}
    return environment.get_template(template).render(version=__version__, **looks, **values)
