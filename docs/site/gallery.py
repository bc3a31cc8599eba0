"""Pictures of the examples, and pages on which they are operated, made by nivel when the site is built."""

from __future__ import annotations

import re
import runpy
import shutil
import subprocess
import tempfile
from contextlib import suppress
from itertools import dropwhile, takewhile
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"


def examples() -> list[Path]:
    """The machine files among the examples; parts of others have no simulation."""
    found = ((path, path.read_text("utf-8")) for path in sorted(EXAMPLES.rglob("*.yaml")))
    return [path for path, text in found if "\nsimulation:" in text and ("\nbodies:" in text or "\nbeams:" in text)]


# bodies of the flexible examples by their models, and what makes a body for a picture quickly
BODIES = {
    "pendulum-bar": {},
    "blade": {},
    "connecting-rod": {},
    "lever": {},
    "lug": {"solid.element_size": "12 mm"},
    "crane-boom": {"solid.element_size": "60 mm", "reduction.modes": 4, "reduction.stiffening": False},
}


def with_bodies(folder: Path) -> Path:
    """A copy of the examples in `folder`, with the bodies that the flexible ones need. The body of a solid needs gmsh: without it its
    machine has no picture."""
    import nivel
    from nivel.flexible.body.body_file import write_body
    from nivel.flexible.reduce import reduce

    copy = folder / "examples"
    shutil.copytree(EXAMPLES, copy)
    for model, changes in BODIES.items():
        path = copy / "flexible" / f"{model}.yaml"
        try:
            write_body(reduce(path, overrides=changes).body, path.with_suffix(".nc"))
        except nivel.NivelError as error:
            print(f"gallery: no picture of machines with {model}: {error}")
    with suppress(OSError, subprocess.CalledProcessError):  # where there is no C compiler, its machine has no picture
        made = runpy.run_path(str(copy / "exchange" / "build_controller.py"))
        made["build"](copy / "exchange" / "controller.fmu")
    return copy


# what a visitor sees first: crane, excavator, robot
FIRST = ("hydraulics/loader-crane.yaml", "hydraulics/excavator.yaml", "control/six-axis-arm.yaml")


def gallery(pictures: bool, machines: bool = False) -> tuple[str, dict[str, str]]:
    """The page, and by their paths in the site its pictures (SVG) and the pages on which machines are operated."""
    lines = [
        "# Gallery",
        "",
        "Every example of the package, as it is assembled. A click on a name shows the whole machine file."
        + (" *Operate it here* opens a page in which the machine moves, with its levers." if machines else ""),
    ]
    drawn = _drawn(pictures, machines)
    first = [EXAMPLES / name for name in FIRST]
    lines += _group(first, drawn)
    rest = [path for path in examples() if path not in first]
    for folder, subject in _subjects().items():
        inside = [path for path in rest if path.relative_to(EXAMPLES).parts[0] == folder]
        if inside:
            lines += [
                "",
                f"## {folder[:1].upper()}{folder[1:].replace('-', ' ')}",
                "",
                f"{subject[:1].upper()}{subject[1:]}.",
            ]
            lines += _group(inside, drawn)
    return "\n".join([*lines, ""]), drawn


def _subjects() -> dict[str, str]:
    """The folders of examples with their subjects, in the order of the table in `examples/README.md`."""
    rows = re.findall(
        r"^\| \[([\w-]+)\]\([\w-]+\) \| (.+?)(?:: .*)? \|$", (EXAMPLES / "README.md").read_text("utf-8"), re.MULTILINE
    )
    return dict(rows)


def _group(machines: list[Path], drawn: dict[str, str]) -> list[str]:
    """Figures of machines, with their names."""
    lines = ["", '<div class="grid" markdown>']
    for path in machines:
        name = path.stem
        lines += ["", '<figure markdown style="display:inline-block;width:20em;vertical-align:top">']
        if (picture := _picture_name(path)) in drawn:
            lines.append(f"![{name}]({picture})")
        lines += [
            f"<figcaption markdown>[{name}](files/{path.relative_to(ROOT).as_posix()}) {_first_sentence(path)}{_trust(path)}",
            *([f'<br><a href="{page}">Operate it here</a>'] if (page := _page_name(path)) in drawn else []),
            "</figcaption>",
            "</figure>",
        ]
    return [*lines, "", "</div>"]


def _picture_name(path: Path) -> str:
    return f"pictures/gallery/{_place(path)}.svg"


def _page_name(path: Path) -> str:
    return f"operate/{_place(path)}.html"


def _place(path: Path) -> str:
    return "-".join(path.relative_to(EXAMPLES).with_suffix("").parts)


def _drawn(pictures: bool, machines: bool) -> dict[str, str]:
    """The pictures of all examples that can be drawn, and the pages of all that a page can carry."""
    if not pictures and not machines:
        return {}
    out = {}
    with tempfile.TemporaryDirectory() as folder:
        copy = with_bodies(Path(folder))
        for path in examples():
            own = copy / path.relative_to(EXAMPLES)
            if pictures:
                out[_picture_name(path)] = _picture(own)
            if machines:
                out[_page_name(path)] = _operated(own)
    return {name: text for name, text in out.items() if text}


def _operated(path: Path) -> str:
    """The page of a machine that is operated; nothing where a page cannot carry it: Python laws, foreign units, chosen steps only."""
    import nivel

    page = path.with_suffix(".html")
    try:
        nivel.export_page(nivel.load(path, allow_code=True), page)
    except nivel.NivelError as error:
        print(f"gallery: {path.stem} is not operated: {error}")
        return ""
    return page.read_text(encoding="utf-8")


def _first_sentence(path: Path) -> str:
    """What the first comment of a machine file says it is, else its description."""
    lines = path.read_text(encoding="utf-8").splitlines()
    comment = [line.lstrip("# ").strip() for line in takewhile(_is_comment, dropwhile(_is_format, lines))]
    found = re.match(r"(.+?[.:])(\s|$)", " ".join(comment))
    if found:
        return found[1].rstrip(":.") + "."
    described = yaml.safe_load("\n".join(lines)).get("description", "")
    return f"{described[:1].upper()}{described[1:].rstrip('.')}." if described else ""


def _is_format(line: str) -> bool:
    return line.startswith("format:")


def _is_comment(line: str) -> bool:
    return line.startswith("#")


def _trust(path: Path) -> str:
    """The line `# Trust: …` of a machine file whose trust report is not green, as it explains it."""
    found = re.search(r"^# (Trust: (?:.*\n# )*?.*?\.)\n", path.read_text(encoding="utf-8"), re.MULTILINE)
    return f"<br>{found[1].replace(chr(10) + '# ', ' ')}" if found else ""


def _picture(path: Path) -> str:
    """The machine as it is assembled, as a standing SVG document; nothing where it cannot be drawn."""
    import nivel
    from nivel.report.picture import machine_picture

    # steps are fixed where a machine is stepped
    for settings in ({"start": "as-given"}, {"start": "as-given", "integrator": "extrapolated-euler"}):
        try:
            posed = nivel.load(path, allow_code=True).with_settings(settings).start()
        except nivel.NivelError:
            continue
        return machine_picture(posed.scene, posed["position"], posed["orientation"])
    return ""


# (time [s], position) of the levers of the loader crane of `nivel demo`, which lifts a load and swings it over its truck
LEVERS = {
    "lift_lever": ((0.4, 0), (0.8, 0.8), (3.4, 0.8), (3.8, 0), (8.2, 0), (8.8, -0.4), (10, -0.4), (10.6, 0)),
    "slew_lever": ((2.6, 0), (4.7, 0.48), (6.3, 0.48), (8.4, 0)),
    "jib_lever": ((6.5, 0), (7.5, -0.6), (10, -0.6), (11, 0)),
}
AT_WORK = 14.0  # s


def crane_at_work() -> str:
    """A page on which the loader crane of `nivel demo` works, as its levers move."""
    import nivel
    from nivel import Table
    from nivel.demos import demo_file
    from nivel.view.page import scene_html

    machine = nivel.load(demo_file("loader-crane")).with_settings({"duration": AT_WORK})
    inputs = {}
    for name, points in LEVERS.items():
        times, positions = zip((0.0, 0.0), *points, (AT_WORK, 0.0), strict=True)
        inputs[name] = Table(times, positions)
    return scene_html([machine.simulate(verify=False, inputs=inputs)])
