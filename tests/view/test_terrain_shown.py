"""Terrain in the viewer: nodes stand where the result says, whichever moment was shown before."""

import numpy as np
import pytest

from browsing import drawn, watched
from nivel.view.page import write_scene
from test_terrain import sledge

HEIGHTS = """() => {
  const { at, columns, heaps } = nivel.app.terrains[0];
  return { z: [...at].filter((_, k) => k % 3 === 2), heap: heaps[0].visible ? heaps[0].scale.toArray() : null };
}"""


def test_ruts_and_loads_of_all_moments_are_shown(browser, tmp_path):
    result = sledge().simulate(verify=False)
    (terrain,) = result.terrains.values()
    write_scene([result], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open((tmp_path / "scene.html").as_uri())
        for moment in (0, 25, len(terrain.time) - 1, 12, 0):  # forwards and back
            time = float(terrain.time[moment])
            page.evaluate(f"nivel.app.goTo({time!r})")
            drawn(page)
            shown = page.evaluate(HEIGHTS)
            assert np.array(shown["z"]) == pytest.approx(terrain.at(time).ravel() - 0.1, abs=1e-5)
            volume = float(terrain.carried[moment, 0])
            if volume > 0.05**3:
                assert 4.0 / 3.0 * np.pi * np.prod(shown["heap"]) == pytest.approx(volume, rel=1e-5)
            else:
                assert shown["heap"] is None
