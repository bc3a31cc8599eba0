"""Values that a comma has cut in two: `[min(time, 2), 0, 0]` without quotes has four entries in YAML."""

from __future__ import annotations

from nivel.files.nodes import Mapping, Node, Scalar, Sequence


def cut_at_comma(node: Mapping | Sequence) -> str:
    """The first expression whose parentheses are closed behind a comma only, as a whole; empty where there is none."""
    open_parts: list[str] = []
    for text in _texts(node):
        if open_parts or text.count("(") > text.count(")"):
            open_parts.append(text)
            whole = ", ".join(open_parts)
            if whole.count("(") <= whole.count(")"):
                return whole
    return ""


def _texts(node: Mapping | Sequence) -> list[str]:
    """What stands between the commas, without keys; a value that was cut goes on in keys that have no value."""
    if isinstance(node, Sequence):
        return [_text(entry) for entry in node.entries]
    return [_text(key) if _text(value) == "" and _is_plain(value) else _text(value) for key, value in node.pairs]


def _text(node: Node) -> str:
    return node.text if _is_plain(node) and isinstance(node, Scalar) else "…"


def _is_plain(node: Node) -> bool:
    return isinstance(node, Scalar) and node.plain
