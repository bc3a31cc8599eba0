"""Lines of an input file of CalculiX or Abaqus as it comes: comments, lower case, lines that go on, and *INCLUDE.

Blanks have no meaning in keywords and options, and case has none but in names of files.
"""

from collections.abc import Iterator
from difflib import get_close_matches
from pathlib import Path
from typing import Final, NamedTuple

from nivel.flexible.foreign.matrix import FormatError, text_lines

DEEPEST: Final = 10  # files that include each other


class Line(int):
    """The number of a line; `file` : the included file in which it is, or None in the deck itself."""

    file: Path | None = None

    @classmethod
    def of(cls, number: int, file: Path | None) -> "Line":
        """The line `number` of `file`."""
        line = cls(number)
        line.file = file
        return line


class Card(NamedTuple):
    """A keyword in capitals, as `CARDS` names it; its options by names in capitals without blanks; its line."""

    keyword: str
    options: dict[str, str]
    line: Line

    def name(self, key: str) -> str:
        """The value of an option in capitals, as of a set or a material; empty where it is not given."""
        return self.options.get(key, "").upper()


def entries(path: Path) -> Iterator[tuple[Card, Line, list[str] | None]]:
    """Each card, with None, and then each line of its data: the card, the line, what stands between commas.

    Raises FormatError for cards that cannot be followed and that are not known.
    """
    card: Card | None = None
    head, start = "", Line(0)
    for line, text in _lines(path, path.parent, None, 0):
        if head:
            text, line = head + text, start  # noqa: PLW2901 a keyword goes on after a comma
        head = ""
        if text.startswith("*"):
            if text.endswith(","):
                head, start = text, line
                continue
            card = _card(text, line)
            yield card, line, None
        elif card is not None:
            yield card, line, [part.strip() for part in text.split(",")]
        else:
            raise FormatError(f"a keyword such as `*NODE` was expected, got `{text[:60]}`", line)
    if head:
        raise FormatError(f"the file ends where `{head[:60]}` goes on", start)


def _lines(path: Path, folder: Path, file: Path | None, depth: int) -> Iterator[tuple[Line, str]]:
    """Lines that are no comments, without blanks around them; those of included files in their place."""
    waiting = ""
    for number, raw in text_lines(path):
        text = raw.strip()
        if not text or text.startswith("**"):
            continue
        line = Line.of(number, file)
        if _squeezed(text.split(",")[0]) == "*INCLUDE" or waiting:
            waiting += text
            if waiting.endswith(","):
                continue
            yield from _included(_card(waiting, line), folder, depth)
            waiting = ""
            continue
        yield line, text


def _included(card: Card, folder: Path, depth: int) -> Iterator[tuple[Line, str]]:
    """The lines of the file that an *INCLUDE names, from the folder of the deck. Raises FormatError."""
    name = card.options.get("INPUT", "")
    path = folder / name
    if not name or not path.is_file():
        raise FormatError(f"*INCLUDE needs `INPUT=` with a file; there is no file `{path}`", card.line)
    if depth == DEEPEST:
        raise FormatError(
            f"*INCLUDE of `{name}`: files include each other {DEEPEST} deep; does one include itself?", card.line
        )
    yield from _lines(path, folder, path, depth + 1)


def _card(text: str, line: Line) -> Card:
    first, *parts = text.split(",")
    options = {}
    for part in parts:
        name, _, value = part.partition("=")
        options[_squeezed(name)] = value.strip().strip('"')
    squeezed = _squeezed(first[1:])
    plain = " ".join(first[1:].upper().split())
    # CalculiX looks at the begin of a keyword
    keyword = CARDS.get(squeezed) or CARDS.get(squeezed.removesuffix("S"), plain)
    if problem := refusal(keyword):
        raise FormatError(problem, line)
    return Card(keyword, options, line)


def _squeezed(text: str) -> str:
    return "".join(text.upper().split())


def _cards(group: str) -> dict[str, str]:
    """Cards of a group of `cards.txt`: name → what is said of it."""
    out = {}
    for block in Path(__file__).with_name("cards.txt").read_text(encoding="utf-8").split("\n\n")[1:]:
        head, _, names = block.partition("\n")
        kind, _, sentence = head.partition(":")
        if kind == group:
            out |= dict.fromkeys((" ".join(name.split()) for name in names.split("|")), sentence.strip())
    return out


USED, WITHOUT_INFLUENCE = frozenset(_cards("used")), frozenset(_cards("without influence"))
NO_STRESS, REFUSED = _cards("no stress"), _cards("refused")  # with why
# names by how CalculiX reads them: without blanks
CARDS: Final = {name.replace(" ", ""): name for name in (*USED, *WITHOUT_INFLUENCE, *NO_STRESS, *REFUSED)}


def refusal(keyword: str) -> str:
    """Why a deck with this card cannot be read; empty where it can. keyword : in capitals, as in CARDS or as it stands."""
    if keyword in REFUSED:
        return f"*{keyword}: {REFUSED[keyword]}"
    if keyword.replace(" ", "") in CARDS:
        return ""
    near = get_close_matches(keyword, CARDS.values(), n=1, cutoff=0.75)
    hint = f"did you mean `*{near[0]}`?" if near else "take it out if nodes, rows and elasticity do not depend on it"
    return f"*{keyword} is no card that is known here; {hint}"
