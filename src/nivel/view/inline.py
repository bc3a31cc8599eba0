"""The viewer inside a notebook: a frame with the whole page in it."""

from __future__ import annotations

from html import escape

from nivel.results.result import Result
from nivel.view.export import scene_html


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
