"""Terrain of a result against the cells of the same run made step by step, and against the volume that these have moved."""

import sys

import numpy as np
import pytest

import synthetic_run
from nivel.errors import ModelError
from nivel.integrate.loop.paced import TICKS
from nivel.live.preparation import live_plan, prepared_run
from nivel.live.shared import bytes_of, live_in, soils_in
from nivel.results import Memory
from nivel.results.terrain import STEPS, TerrainHistory, Tracker
from nivel.view.playback import ALONE, playback
from packages import from_bytes, unpacked
from simulating import G, machine

HEIGHTS = {"size": [6, 6], "function": "0.05*x", "points": [121, 121]}
SOIL = {"plane": "yard", "heights": HEIGHTS, "soil": {"cohesion": 1e3}}


def sledge(**simulation):
    """A heavy bucket on a rail that falls a little, over a slope: it cuts, is filled, and pushes the rest."""
    return machine(
        {
            "gravity": [0, 0, -G],
            "bodies": {"bucket": {"mass": 4000, "inertia": [900, 900, 900], "position": [-2, 0.2, 0.2], "velocity": [2, 0, 0]}},
            "markers": {
                "yard": {"body": "ground", "position": [0.4, 0.1, -0.1], "x_axis": [0.6, 0.8, 0], "axis": [0, 0, 1]},
                "left": {"body": "bucket", "position": [0, 0.4, -0.4]},
                "right": {"body": "bucket", "position": [0, -0.4, -0.4]},
                "heart": {"body": "bucket", "position": [-0.4, 0, 0]},
            },
            "joints": {"rail": {"type": "translational", "bodies": ["ground", "bucket"], "point": [-2, 0.2, 0.2], "axis": [1, 0, 0]}},
            "forces": {"dig": {"type": "blade", "edge": ["left", "right"], "capacity": 0.04, "load_at": "heart", **SOIL}},
            "simulation": {"duration": 1.2, "step": 1e-3, "integrator": "rk4", "output_interval": 0.03, **simulation},
        }
    )  # fmt: skip


def test_heights_of_a_result_are_those_of_the_cells_at_all_its_times():
    result = sledge().simulate(verify=False)
    (terrain,) = result.terrains.values()
    sim = sledge().start()
    (soil,) = sim._system.units
    start = soil.record.h.copy()
    assert terrain.step == pytest.approx(0.05 / STEPS)
    assert len(terrain.time) > 40
    assert np.ptp(terrain.carried[:, 0]) > 0.03
    for time, carried in zip(terrain.time, terrain.carried, strict=True):
        sim.advance(round((time - sim.time) / 1e-3) * 1e-3)
        assert (
            np.abs(terrain.at(time).T - soil.record.h).max() <= 0.5 * terrain.step + 1e-6
        )  # heights at the start have 32 bits
        assert carried == pytest.approx(soil.record.volume)
    # what has left the cells is carried: each of the nodes that moved is known to half a step
    moved = terrain.at(9.0) - terrain.at(-1.0)
    doubt = 0.5 * terrain.step * np.count_nonzero(soil.record.h != start) * 0.05**2
    assert moved.sum() * 0.05**2 == pytest.approx(-terrain.carried[-1, 0], abs=doubt)
    assert np.abs(moved).sum() * 0.05**2 > 10.0 * doubt


def test_a_terrain_does_not_depend_on_how_long_chunks_of_the_run_are(monkeypatch):
    whole = sledge().simulate(verify=False).attributes["terrain"]
    monkeypatch.setattr(sys.modules["nivel.analysis.run.dynamics"], "CHUNK", 1e-5)
    assert sledge().simulate(verify=False).attributes["terrain"] == whole


def test_moves_are_kept_to_half_a_step_and_can_be_taken_back():
    random = np.random.default_rng(3)
    start = random.normal(size=(7, 5))
    tracker, shown = Tracker(start, 1.0), np.zeros(35)
    for k in range(20):
        now = start + random.normal(size=(7, 5)) * (random.random((7, 5)) < 0.3)
        nodes, moves = tracker.moves(start if k == 19 else now)
        np.add.at(shown, nodes, moves)
        if k < 19:
            assert np.abs(start.T.ravel() + shown / STEPS - now.T.ravel()).max() <= 0.5 / STEPS + 1e-12
    assert not shown.any()
    assert not len(tracker.moves(start)[0])


def history(random, moments=40, size=(6, 9)):
    nodes = [np.sort(random.choice(54, 20, replace=False)) for _ in range(moments)]
    moves = random.integers(-9, 9, 20 * moments)
    differences = np.diff(np.concatenate(nodes), prepend=0)
    ends = 20 * np.arange(1, moments + 1)
    return TerrainHistory(
        0.1, np.zeros(size), np.arange(moments) * 0.1, ends, differences, moves, np.arange(moments)[:, None]
    )


def test_a_thinned_history_has_the_heights_of_its_own_times():
    whole = history(np.random.default_rng(5))
    few = whole.thinned(300)
    assert len(few.nodes) <= 300 < len(whole.nodes)
    assert few.time[-1] == whole.time[-1]
    for time, carried in zip(few.time, few.carried, strict=True):
        assert np.array_equal(few.at(time), whole.at(time))
        assert carried == whole.carried[round(time / 0.1)]


def test_a_page_has_the_terrain_where_it_stands_in_space():
    result = sledge().simulate(verify=False)
    head, arrays = from_bytes(playback([result], ALONE))
    (ground,) = head["stages"][0]["terrains"]
    assert head["stages"][0]["surroundings"] == []
    heights, normal = unpacked(ground["heights"], arrays), np.cross(ground["along"], ground["across"]) / 0.05**2
    # node (i, j) of the plane's marker, whose x axis is turned by atan(4/3)
    i, j = 100, 7
    x, y = -3.0 + 0.05 * i, -3.0 + 0.05 * j
    wanted = np.array([0.4 + 0.6 * x - 0.8 * y, 0.1 + 0.8 * x + 0.6 * y, -0.1 + 0.05 * x])
    place = np.array(ground["corner"]) + i * np.array(ground["along"]) + j * np.array(ground["across"])
    assert place + heights[j, i] * normal == pytest.approx(wanted, abs=1e-6)
    (load,) = ground["loads"]
    assert load == {"slot": 0, "body": 0, "point": [-0.4, 0.0, 0.0], "half": [0.0, 0.4, 0.0]}
    (terrain,) = result.terrains.values()
    course = {name: unpacked(ground[name], arrays) for name in ("nodes", "moves")}
    steps = np.bincount(
        np.cumsum(course["nodes"].astype(np.int32)), course["moves"].astype(np.uint16).view(np.int16), heights.size
    )
    assert heights.ravel() + ground["step"] * steps == pytest.approx(terrain.at(9.0).ravel(), abs=1e-6)


def test_a_live_machine_digs_in_the_memory_that_its_pages_see():
    plan, pace = live_plan(sledge().record, {}, None)
    run = prepared_run(plan, pace)
    memory = bytearray(bytes_of(run.sizes))
    grounds = [(start.copy(), forces, cell) for start, forces, cell in run.grounds]
    ((heights, carried),) = soils_in(memory, run.sizes, grounds)
    (soil,) = run.soils
    soil.move(h=heights, volume=carried)
    live = live_in(memory, run.sizes)
    drive = run.begin(live)
    live.control[TICKS] = 1200
    drive()
    (terrain,) = sledge().simulate(verify=False).terrains.values()
    assert carried[0] == pytest.approx(terrain.carried[-1, 0])
    assert np.abs(heights.T - terrain.at(9.0)).max() <= 0.5 * terrain.step + 1e-6
    nodes, moves = Tracker(grounds[0][0], grounds[0][2]).moves(heights)
    shown = terrain.start.ravel().copy()
    shown[nodes] += moves * terrain.step
    assert shown == pytest.approx(terrain.at(9.0).ravel())


@pytest.mark.parametrize("text", ["{", '{"soil of dig": "AAAA"}', '{"soil of dig": 3}', '["soil"]'])
def test_a_damaged_terrain_is_told(text):
    memory = Memory()
    memory.begin(synthetic_run.header())
    with pytest.raises(ModelError, match="`terrain` cannot be read"):
        _ = memory.close({"outcome": "done", "terrain": text}).terrains
