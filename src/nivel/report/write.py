"""Write the report: one HTML file with everything in it."""

import base64
import json
import os
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.files.target import keep_sources, write_file
from nivel.judge.after.report import thresholds_of
from nivel.known import Result
from nivel.lazy import Struct, asdict, nivel
from nivel.looks.diagram import block_diagram
from nivel.looks.viewpoint import upwards
from nivel.machine.machine_record import MachineRecord
from nivel.report.deflections import beam_shapes, load_paths, vibration_table
from nivel.report.element_panels import power_picture
from nivel.report.page import page, text_of
from nivel.report.panel import Group, Panel, Thinning
from nivel.report.panels import panels, peak_reactions
from nivel.report.picture import STYLE, machine_picture
from nivel.report.story import assembly_lines, event_lines, facts, headline, settings_table, timing_table, trust_lines
from nivel.report.strokes import joint_icon
from nivel.results import trust
from nivel.results.frames.stored import understood
from nivel.results.scales import RULES
from nivel.view.page import built, scene_html
from nivel.view.playback import SMALL

OUTPUTS, PARAMETERS = 6, 12  # that are drawn; others stand in the result
CHANGE = 0.01  # of the parameter, for which the change of the curve is told


class Bar(Struct):
    """One parameter. change : of the curve at the end for 1 % more of the parameter, as a share of its range. width, left : of the bar, as
    shares of the drawing."""

    parameter: str
    change: float
    width: float
    left: float


class Tornado(Struct):
    """The bars of one curve, the longest first."""

    name: str
    bars: tuple[Bar, ...]


def tornados(result: Result) -> list[Tornado]:
    """Of the first joint coordinates and sensors, or of the bodies' places; none where a result has no sensitivities."""
    parameters = json.loads(str(result.attributes.get("sensitivities", "{}")))
    if not parameters or not len(result.time):
        return []
    return [_tornado(result, name, parameters) for name in _names(result)[:OUTPUTS]]


def slopes_headline(result: Result) -> str:
    """How far to trust the slopes."""
    return str(result.attributes.get("sensitivities_headline", ""))


def _names(result: Result) -> list[str]:
    sensors = [name for name in result.variables if name.startswith("sensor.") and result.array(name).ndim == 1]
    chosen = [*result.coordinates.get("joint_coordinate_name", ()), *sensors]
    return chosen or [f"{body}.position.{axis}" for body in result.coordinates.get("body", ()) for axis in "xyz"]


def _tornado(result: Result, name: str, parameters: dict[str, dict[str, float]]) -> Tornado:
    values = result.array(name)
    extent = float(np.ptp(values)) or float(np.max(np.abs(values))) or 1.0
    changes = {
        path: CHANGE * (facts["value"] or 1.0) * float(result.array(f"d({name})/d({path})")[-1]) / extent
        for path, facts in parameters.items()
    }
    largest = max(map(abs, changes.values())) or 1.0
    ordered = sorted(changes, key=lambda path: -abs(changes[path]))[:PARAMETERS]
    shares = {path: 0.5 * changes[path] / largest for path in ordered}
    bars = [Bar(path, changes[path], abs(shares[path]), 0.5 + min(0.0, shares[path])) for path in ordered]
    return Tornado(name, tuple(bars))


POINTS = (400, 4000)  # of a curve: a screen is about 1000 wide, and one wants to zoom in
MARKED_EVENTS = 200  # marks in a plot; more cannot be told apart
MOVING = 2  # frames from which on there is a motion
LARGEST_MOTION = 900_000  # characters
ALL_POINTS = 600_000  # of all curves together: keeps the file below about 4 MB


def write_report(result: Result, path: str | os.PathLike[str], operated: str = "") -> Path:
    """Write the report of `result` to `path`; an existing file is replaced. The file needs no network and nothing beside it.

    operated : page of the machine (`nivel.export_page`) as text, in which it is run again.
    """
    target = Path(path)
    keep_sources(target, "report", [result.path] if result.path else [])
    return write_file(target, "report", report_html(result, operated))


@np.errstate(over="ignore", invalid="ignore", divide="ignore")  # a run beyond all bounds is drawn with gaps
def report_html(result: Result, operated: str = "") -> str:
    """The report as text. operated : as of `write_report`."""
    record = _record(result)
    shown = panels(result)
    balance_of = nivel.results.frames.circuit_balance.component_balances if record.get("hydraulics") else None
    balances = balance_of(result, record) if balance_of else []
    motion, motion_left_out = _motion(result)
    names = {
        "page_script": "page.js",
        "spectra_script": "spectra.js",
        "uplot_style": "uplot/uPlot.min.css",
        "uplot_script": "uplot/uPlot.iife.min.js",
        "uplot_licence": "uplot/LICENSE",
    }
    return page(
        "page.html.j2",
        (),
        {"number": number, "quantity": quantity},
        result=result,
        description=record.get("description") or "",
        facts=facts(result),
        headline=headline(result),
        trust=result.trust,
        trust_lines=trust_lines(result.trust),
        assembly=assembly_lines(result),
        events=event_lines(result),
        thresholds=thresholds_of(result, quiet=False),
        rules=RULES,
        picture_style=STYLE,
        picture=_picture(result, record),
        paths=load_paths(result),
        vibrations=vibration_table(result),
        buckling=json.loads(str(result.attributes.get("buckling", "[]"))),
        motion=motion,
        motion_left_out=motion_left_out,
        operated=operated,
        shapes=beam_shapes(result),
        peaks=peak_reactions(result),
        tornados=tornados(result),
        slopes_headline=slopes_headline(result),
        **_diagram(record, str(result.attributes.get("machine_source", ""))),
        balance=balances,
        power=power_picture(result, record, balances),
        **_circuit_pictures(result, record),
        icon=joint_icon,
        panels=shown,
        data=_data(result, shown),
        settings=settings_table(result),
        timing=timing_table(result),
        source=str(result.attributes.get("machine_source", "")),
        **{key: text_of(name) for key, name in names.items()},
    )


def _diagram(record: dict[str, Any], source: str) -> dict[str, str]:
    """The block diagram of the machine for the page, which lays it out by `diagram.js`; without one nothing is loaded for it."""
    boxes = block_diagram(record, source)
    if not boxes:
        return {"blocks": "", "blocks_style": "", "blocks_script": "", "dagre_licence": ""}
    text = json.dumps([asdict(box) for box in boxes], separators=(",", ":")).replace("<", "\\u003c")
    return {
        "blocks": text,
        "blocks_style": built("diagram.css"),
        "blocks_script": built("diagram.js"),
        "dagre_licence": built("DAGRE"),
    }


def _circuit_pictures(result: Result, record: dict[str, Any]) -> dict[str, str]:
    """The diagram of the circuits, and the curves of their valves."""
    if not record.get("hydraulics"):
        return {"circuit": "", "valves": ""}
    pressures = nivel.results.frames.circuit_balance.pressures_at(result, 0) if len(result.time) else {}
    diagram = nivel.looks.circuit.drawing.circuit_diagram(record, pressures)
    return {"circuit": diagram, "valves": nivel.looks.circuit.characteristics.valve_diagram(record)}


def _record(result: Result) -> dict[str, Any]:
    """The machine as it ran, for its diagrams. Raises ModelError where it is none."""
    text = str(result.attributes.get("machine_record", "{}"))
    record = json.loads(text)
    if record.get("control") or record.get("hydraulics"):
        with understood(result, "machine_record"):
            MachineRecord.model_validate_json(text)
    return record


def number(value: float, digits: int = 4) -> str:
    """A number as it stands in a table."""
    return trust.number(value, digits, digits)


quantity = partial(trust.quantity, digits=4, extreme=4)


def _picture(result: Result, record: dict[str, Any]) -> str:
    """The machine in its first frame; up is against gravity, along the nearest axis."""
    if not len(result.time) or "position" not in result.variables:
        return ""
    first = slice(0, 1)
    position, orientation = result.array("position", first)[0], result.array("orientation", first)[0]
    return machine_picture(result.scene, position, orientation, upwards(record.get("gravity")))


def _motion(result: Result) -> tuple[str, str]:
    """The page that plays the motion, to be shown in a frame, or in a sentence why it is left out; both empty where there is none."""
    if len(result.time) < MOVING:
        return "", ""
    try:
        text = scene_html([result], SMALL)
    except ModelError:  # nothing to draw: the report says the rest
        return "", ""
    if len(text) <= LARGEST_MOTION:
        return text, ""
    name = result.path.name if result.path else "RESULT.nc"
    return "", (
        f"The motion is not in this page, where it would take {len(text) / 1e6:.1f} MB: `nivel view {name}` plays it, "
        f"`nivel view {name} --export scene.html` writes it as a page of its own."
    )


def _data(result: Result, shown: list[Panel]) -> str:
    """JSON for the page: arrays as base64 of little-endian floats, the time in 64 bits, the rest in 32."""
    curves = sum(len(group.curves) for panel in shown for group in panel.groups)
    thin = Thinning(result.abscissa, int(np.clip(ALL_POINTS // max(curves, 1), *POINTS)))
    data = {
        "time": _packed(thin.time, "<f8"),
        "thinned": thin.frames,
        "abscissa": "path" if result.is_statics else "time",
        "events": [{"name": name, "time": at} for name, at in result.marks[:MARKED_EVENTS]],
        "panels": [
            {"title": panel.title, "log": panel.log, "groups": [_group(group, thin) for group in panel.groups]}
            for panel in shown
        ],
    }
    return json.dumps(data).replace("<", "\\u003c")


def _group(group: Group, thin: Thinning) -> dict[str, Any]:
    return {
        "label": group.label,
        "unit": group.unit,
        "floor": group.floor,
        "limits": [{"value": value, "tone": tone} for value, tone in group.limits],
        "curves": [{"label": c.label, "tone": c.tone, "values": _packed(thin(c.values), "<f4")} for c in group.curves],
    }


def _packed(values: NDArray[np.float64], kind: str) -> str:
    with np.errstate(over="ignore"):  # beyond 32 bits: drawn as a gap
        return base64.b64encode(values.astype(kind).tobytes()).decode()
