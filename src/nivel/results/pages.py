"""Pages that results open, and the trust report of a run that was killed, by the functions that make them.

These functions stand in packages above results, so they are imported by name, when they are asked for.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from nivel.results.result import Result
    from nivel.results.trust import Trust

MAKERS: Final = {
    "comparison": ("nivel.report.compare_page", "write_comparison"),
    "efforts": ("nivel.report.motion_pages", "efforts_html"),
    "linear model": ("nivel.report.linear_page", "linear_html"),
    "linear sweep": ("nivel.report.linear_page", "sweep_html"),
    "mechanism": ("nivel.report.motion_pages", "mechanism_html"),
    "report": ("nivel.report.write", "write_report"),
    "notebook": ("nivel.view.page", "Inline"),
    "scene": ("nivel.view.page", "write_scene"),
}


def page_maker(page: str) -> Any:
    """The function or class that makes the page."""
    module, name = MAKERS[page]
    return getattr(import_module(module), name)


def report_of_remains(result: Result) -> Trust:
    """The trust report of a run that was killed, or still goes on, from what its file holds."""
    trust = import_module("nivel.judge.after.report")
    return trust.assess_remains(result)
