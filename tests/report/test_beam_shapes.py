"""The report of a machine with beams: their shapes are drawn, and their nodes do not crowd out what has a name."""

import json
import re

import numpy as np

from nivel.integrate.loop.sink import Header
from nivel.report.deflections import SHAPES, beam_nodes, beam_shapes, stations
from nivel.report.panels import panels
from nivel.report.story import facts
from nivel.results import Memory
from nivel.system.layout import frame_layout
from synthetic_run import header

BODIES = ["bob", "rod.start", "rod.1", "rod.middle", "rod.3", "rod.end"]
TIME = np.linspace(0.0, 2.0, 41)
SCENE = {
    "bodies": [
        {"name": name, "shape": None, "centre_of_mass": [0, 0, 0], "points": [], "mass": 1.0} for name in BODIES
    ],
    "ground_points": [],
    "joints": [],
}


def run(*, beams=("rod",), broken=0):
    """A straight rod of 1 m that turns about Z at 1 rad/s; the bob stands 2 m away. broken : frames at the end that are no numbers."""
    plan = frame_layout(BODIES, [], [], [], [])
    frames = np.zeros((len(TIME), plan.width))
    frames[:, 0] = TIME
    along = np.stack([np.cos(TIME), np.sin(TIME), 0.0 * TIME], axis=1)
    values = np.concatenate(
        [np.broadcast_to([2.0, 0, 0], (len(TIME), 1, 3)), np.linspace(0, 1, 5)[:, None] * along[:, None]], axis=1
    )
    for variable in plan.variables:
        if variable.name == "position":
            frames[:, variable.columns] = values.reshape(len(TIME), -1)
        if variable.name == "orientation":
            frames[:, variable.columns] = np.tile([1.0, 0, 0, 0], len(BODIES))
    frames[len(TIME) - broken :, 1:] = np.nan
    record = {"name": "m", "beams": [{"name": name, "stations": {"middle": 0.5}} for name in beams]}
    attributes = header(
        scene=json.dumps(SCENE), machine_record=json.dumps(record), constraint_units="{}", coordinate_units="{}"
    ).attributes
    memory = Memory()
    memory.begin(Header(plan, attributes))
    memory.take(frames)
    return memory.close({"outcome": "done"})


def shapes(svg):
    """(shapes, nodes, 2) pixels."""
    found = re.findall(r'class="line"[^>]*? d="M([^"]*)"', svg)
    return np.array([[[float(x) for x in point.split()] for point in each.split("L")] for each in found])


def test_nodes_and_stations_are_told_apart():
    result = run()
    assert beam_nodes(result)["rod"].tolist() == [1, 2, 3, 4, 5]
    assert stations(result, "rod") == ["rod.start", "rod.middle", "rod.end"]
    assert beam_nodes(run(beams=())) == {}


def test_a_straight_beam_is_drawn_straight_at_its_times():
    drawn = shapes(beam_shapes(run()))
    assert drawn.shape == (SHAPES, 5, 2)
    np.testing.assert_allclose(drawn[:, 2], 0.5 * (drawn[:, 0] + drawn[:, 4]), atol=0.11)
    assert np.ptp(drawn[:, 0], axis=0).max() < 0.11  # the start rests
    assert len({tuple(end) for end in drawn[:, 4].tolist()}) == SHAPES


def test_frames_that_are_no_numbers_are_left_out():
    drawn = shapes(beam_shapes(run(broken=20)))
    assert len(drawn) == SHAPES
    assert np.isfinite(drawn).all()
    assert beam_shapes(run(broken=len(TIME))) == beam_shapes(run(broken=len(TIME) - 1)) == ""


def test_without_beams_there_are_no_shapes():
    assert beam_shapes(run(beams=())) == ""


def test_positions_are_those_of_named_places():
    (panel,) = (each for each in panels(run()) if each.title == "Body positions")
    assert [group.label for group in panel.groups] == ["rod.middle", "rod.end"]  # the others rest


def test_a_beam_counts_as_one():
    assert facts(run())[:2] == ["1 body", "1 beam"]
    assert facts(run(beams=()))[0] == "6 bodies"
