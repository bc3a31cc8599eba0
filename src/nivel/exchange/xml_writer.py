"""XML documents of elements that are written one in a line."""

from __future__ import annotations

from collections.abc import Iterable
from xml.sax.saxutils import escape, quoteattr


class Lines:
    """Lines of a document, indented by the elements that are open."""

    def __init__(self) -> None:
        self._lines: list[str] = ['<?xml version="1.0"?>']
        self._open: list[str] = []

    def comment(self, lines: Iterable[str]) -> None:
        """A comment of several lines."""
        text = "\n     ".join(each.replace("--", "- -") for each in lines)
        self._lines.append(f"<!-- {text}\n-->")

    def element(self, tag: str, **attributes: object) -> None:
        """An element without content; attributes that are None are left out."""
        self._lines.append(f"{self._indent}<{tag}{_attributes(attributes)}/>")

    def start(self, tag: str, **attributes: object) -> None:
        """The beginning of an element."""
        self._lines.append(f"{self._indent}<{tag}{_attributes(attributes)}>")
        self._open.append(tag)

    def end(self) -> None:
        """The end of the element that is open."""
        tag = self._open.pop()
        self._lines.append(f"{self._indent}</{tag}>")

    def text(self) -> str:
        """The document."""
        return "\n".join(self._lines) + "\n"

    @property
    def _indent(self) -> str:
        return "  " * len(self._open)


def words(values: Iterable[float]) -> str:
    """Numbers with all their digits, separated by spaces."""
    return " ".join(repr(float(each)).removesuffix(".0") for each in values)


def _attributes(attributes: dict[str, object]) -> str:
    given = ((name.rstrip("_"), value) for name, value in attributes.items() if value is not None)
    return "".join(f" {name}={quoteattr(_shown(value))}" for name, value in given)


def _shown(value: object) -> str:
    return repr(value).removesuffix(".0") if isinstance(value, float) else escape(str(value))
