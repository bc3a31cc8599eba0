"""XML documents as elements that know their lines.

A document type or an entity is refused, and so is a document that is too large or too deep: what it says must stand in it as it is, and its
size must be that of its file.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final
from xml.parsers import expat

from nivel.errors import Fault, ModelError
from nivel.lazy import Struct, field

MOST_BYTES: Final = 200 * 10**6
MOST_ELEMENTS: Final = 1_000_000
DEEPEST: Final = 200  # elements inside each other
MOST_FAULTS: Final = 100


class Element(Struct, frozen=False):
    """One element. line, column : where it begins, from 1. text : of it alone."""

    tag: str
    attributes: dict[str, str]
    line: int
    column: int
    children: list[Element] = field(default_factory=list)
    text: str = ""

    def first(self, tag: str) -> Element | None:
        """The first child of this tag."""
        return next(self.all(tag), None)

    def all(self, tag: str) -> Iterator[Element]:
        """The children of this tag."""
        return (child for child in self.children if child.tag == tag)

    def every(self) -> Iterator[Element]:
        """The element and all that stand in it, in the order of the document."""
        pending: list[Element] = [self]
        while pending:
            yield (element := pending.pop())
            pending += reversed(element.children)

    def get(self, attribute: str, default: str = "") -> str:
        """An attribute without the spaces around it."""
        return self.attributes.get(attribute, default).strip()

    @property
    def shown(self) -> str:
        """The element in a message, by its tag and its name."""
        name = self.get("name")
        return f'<{self.tag} name="{name}">' if name else f"<{self.tag}>"


class Document:
    """An XML document and the faults that are found in it; `raise_faults` raises them all at once."""

    def __init__(self, content: bytes, file: str) -> None:
        """Raises ModelError where this is no XML, or more than is read."""
        self.file = file
        self.faults: list[Fault] = []
        self.root = _parsed(content, file)

    def fault(self, element: Element, message: str) -> None:
        """Remember what is wrong with an element."""
        if len(self.faults) < MOST_FAULTS:
            self.faults.append(Fault(self.file, element.line, element.column, element.shown, message))

    def raise_faults(self) -> None:
        """Raises ModelError where there were faults."""
        if self.faults:
            raise ModelError(self.faults)

    def numbers(self, element: Element | None, attribute: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """As many numbers as the default has, of an attribute, or of the text where the attribute is empty; a fault gives the default."""
        if element is None:
            return default
        given = element.get(attribute) if attribute else element.text.strip()
        if not given:
            return default
        words = given.split()
        what = f'{attribute}="{_short(given)}"' if attribute else f"`{_short(given)}`"
        if len(words) != len(default):
            example = " ".join(f"{value:g}" for value in default)
            count = f"{len(default)} numbers" if len(default) > 1 else "one number"
            right = f'{attribute}="{example}"' if attribute else f"`{example}`"
            self.fault(element, f"{count} such as {right} expected, got {what}")
            return default
        try:
            values = tuple(float(word) for word in words)
        except ValueError:
            self.fault(element, f"{what} is no number")
            return default
        if not all(map(math.isfinite, values)):
            self.fault(element, f"{what} is not finite")
            return default
        return values

    def number(self, element: Element | None, attribute: str, default: float) -> float:
        """One number of an attribute, or of the text where the attribute is empty."""
        return self.numbers(element, attribute, (default,))[0]


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 40 else f"{line[:37]}…"


def _parsed(content: bytes, file: str) -> Element:
    if len(content) > MOST_BYTES:
        message = f"the file has {len(content) / 1e6:.0f} MB; up to {MOST_BYTES // 10**6} MB of XML are read"
        raise ModelError(Fault(file, 1, 1, "", message))
    parser = expat.ParserCreate()
    parser.buffer_text = True
    top = Element("", {}, 0, 0)
    stack, count = [top], 0

    def refuse(message: str) -> None:
        raise ModelError(Fault(file, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1, "", message))

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        if count > MOST_ELEMENTS:
            refuse(f"the file has more than {MOST_ELEMENTS} elements")
        if len(stack) > DEEPEST:
            refuse(f"more than {DEEPEST} elements stand inside each other")
        element = Element(tag, attributes, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1)
        stack[-1].children.append(element)
        stack.append(element)

    def data(text: str) -> None:
        stack[-1].text += text

    def doctype(*_: object) -> None:
        refuse(
            "a document type (<!DOCTYPE …>) can define entities and name other files; it is not read: remove the line"
        )

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _: stack.pop()
    parser.CharacterDataHandler = data
    parser.StartDoctypeDeclHandler = doctype
    parser.EntityDeclHandler = doctype
    try:
        parser.Parse(content, True)
    except expat.ExpatError as error:
        message = f"this is no XML: {expat.errors.messages[error.code]}"
        raise ModelError(Fault(file, error.lineno, error.offset + 1, "", message)) from None
    except (LookupError, ValueError) as error:  # an encoding that does not exist
        raise ModelError(Fault(file, 1, 1, "", f"this is no XML that can be read: {error}")) from None
    return top.children[0]
