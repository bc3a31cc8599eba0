"""Words of other programs and textbooks, and what nivel calls the same thing: asked only where a word is not known.

A word of ours answers where it is valid in that place. Where no single word says it, a line to write does.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).parent


class Line(NamedTuple):
    """What to write for a word, where the words of `beside` are valid."""

    words: str
    beside: str
    answer: str


@cache
def same() -> Mapping[str, str]:
    """Words of ours, and how other programs call each. Spelling counts without case, `-`, `_` and spaces."""
    rows = (HERE / "same_words.txt").read_text(encoding="utf-8").splitlines()
    pairs = (row.partition(": ") for row in rows if not row.startswith("#"))
    return {ours: others for ours, _, others in pairs}


@cache
def lines() -> tuple[Line, ...]:
    """Lines to write for words that no single word of ours stands for."""
    return tuple(_lines((HERE / "lines_to_write.txt").read_text(encoding="utf-8")))


def _lines(table: str) -> Iterator[Line]:
    """The lines of a table, whose indentation tells what stands there: words of ours are valid beside words of others (two spaces), and
    below these stands what to write (four)."""
    beside, words, answer = "", "", ""
    for text in (*table.strip().splitlines(), ""):
        if not text.startswith("    ") and answer:
            yield Line(words, beside, answer)
            answer = ""
        if text.startswith("    "):
            answer = f"{answer} {text.strip()}".strip()
        elif text.startswith("  "):
            words = text.strip()
        else:
            beside = text


def translated(word: str, valid: Sequence[str]) -> str:
    """What to write for `word` of another vocabulary where the words `valid` are known; empty where nothing is known of it."""
    meant = plain(word)
    for own in valid:
        if plain(own) == meant:
            return f"did you mean `{own}`?"
    for line in lines():
        if all(word in valid for word in line.beside.split(", ")) and meant in _plain_words(line.words):
            return line.answer
    for own, others in same().items():
        if own in valid and meant in _plain_words(others):
            return f"did you mean `{own}`?"
    return ""


def plain(word: str) -> str:
    """`word` without case, `-`, `_` and spaces."""
    return "".join(letter for letter in word.casefold() if letter not in "-_ ")


def _plain_words(words: str) -> tuple[str, ...]:
    return tuple(plain(word) for word in words.split(","))
