"""Pictures of the examples, drawn by nivel when the site is built."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"


def examples() -> list[Path]:
    """The machine files among the examples that need no other file to be made first."""
    found = sorted(EXAMPLES.rglob("*.yaml"))
    return [path for path in found if "\nbodies:" in path.read_text("utf-8") or "\nbeams:" in path.read_text("utf-8")]


def gallery(pictures: bool) -> tuple[str, dict[str, str]]:
    """The page, and its pictures (SVG) by their paths in the site."""
    import nivel

    lines = [
        "# Gallery",
        "",
        "Every example of the package, as it is assembled. A click on a name shows the whole machine file.",
        "",
        '<div class="grid" markdown>',
    ]
    drawn: dict[str, str] = {}
    for path in examples():
        place = path.relative_to(ROOT).as_posix()
        name = path.stem
        lines += ["", '<figure markdown style="display:inline-block;width:20em;vertical-align:top">']
        if pictures:
            svg = _picture(path)
            if svg:
                drawn[f"pictures/gallery/{name}.svg"] = svg
                lines.append(f"![{name}](pictures/gallery/{name}.svg)")
        lines += [f"<figcaption markdown>[{name}](files/{place}) {_first_sentence(path)}</figcaption>", "</figure>"]
    lines += ["", "</div>", ""]
    del nivel
    return "\n".join(lines), drawn


def _first_sentence(path: Path) -> str:
    """What the first comment of a machine file says it is."""
    comment = re.match(r"((?:# ?.*\n)*)", path.read_text(encoding="utf-8"))
    text = " ".join(line.lstrip("# ").strip() for line in comment[1].splitlines()) if comment else ""
    found = re.match(r"(.+?[.:])(\s|$)", text)
    return (found[1].rstrip(":.") + ".") if found else ""


def _picture(path: Path) -> str:
    """The machine as it is assembled, as a standing SVG document; nothing where it cannot be drawn."""
    import nivel
    from nivel.report.picture import machine_picture

    try:
        posed = nivel.load(path, allow_code=True).with_settings({"start": "as-given"}).start()
    except nivel.NivelError:
        return ""
    return machine_picture(posed.scene, posed["position"], posed["orientation"])


def moving_picture(name: str) -> str:
    """A page on which the motion of an example plays."""
    import nivel
    from nivel.view.export import scene_html

    return scene_html([nivel.load(EXAMPLES / f"{name}.yaml").simulate()])
