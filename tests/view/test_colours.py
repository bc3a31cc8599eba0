"""Colours by value: what the page shows of beams and flexible bodies is what the result says of their sections and stresses."""

import json
from dataclasses import replace

import numpy as np
import pytest

import nivel
from browsing import drawn, watched
from models import bar, reduced
from needing import needs
from nivel.errors import ModelError
from nivel.flexible.body.body import moving_surface
from nivel.flexible.body.body_file import write_body
from nivel.view.capture import Look, still
from nivel.view.package import STEPS, Block
from nivel.view.page import write_scene
from nivel.view.playback import ALONE, SMALL, playback
from nivel.view.sources import Playback
from packages import from_bytes, unpacked
from test_flexible import MACHINE

STOPS = [(0.16, 0.2, 0.46), (0.15, 0.41, 0.61), (0.14, 0.6, 0.58), (0.52, 0.77, 0.38), (0.98, 0.86, 0.32)]
BEAMS = """
format: 1
gravity: [0, 0, -9.81]
beams:
  boom:
    from: [0, 0, 0]
    to: [1, 0.2, 0]
    section: {type: rectangle, width: 2 cm, height: 3 cm}
    material: {youngs_modulus: 70 GPa, poisson_ratio: 0.3, density: 2700 kg/m^3}
    centroid: [2 mm, 1 mm]
    elements: 5
    order: ORDER
  tail:
    from: [1, 0.2, 0]
    to: [1, 0.2, 0.4]
    section: {type: circle, radius: 8 mm}
    material: {youngs_modulus: 2 GPa, poisson_ratio: 0.3, density: 900 kg/m^3}
    elements: 4
joints:
  clamp: {type: fixed, bodies: [ground, boom.start], point: [0, 0, 0]}
  knee: {type: fixed, bodies: [boom.end, tail.start], point: [1, 0.2, 0]}
forces:
  pull: {type: force, body: tail.end, vector: [3, 5, -20]}
simulation: {duration: 20 ms, step: 0.5 ms, output_interval: 1 ms, integrator: generalised-alpha}
"""
# quantity : variable of `result.sections` and its components
MEANT = {
    "axial force": ("force", [0]),
    "shear force": ("force", [1, 2]),
    "shear force y": ("force", [1]),
    "shear force z": ("force", [2]),
    "torque": ("moment", [0]),
    "bending moment": ("moment", [1, 2]),
    "bending moment y": ("moment", [1]),
    "bending moment z": ("moment", [2]),
    "stretch": ("strain", [0]),
    "shear strain": ("strain", [1, 2]),
    "twist": ("curvature", [0]),
    "curvature": ("curvature", [1, 2]),
}


@pytest.fixture(scope="module", params=[1, 2])
def beams(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("beams") / "beams.yaml"
    path.write_text(BEAMS.replace("ORDER", str(request.param)))
    return nivel.load(path).simulate()


@pytest.fixture(scope="module")
def bending(tmp_path_factory):
    """A swinging bar of which stresses are known."""
    folder = tmp_path_factory.mktemp("bending")
    body, _ = reduced(bar(width=0.01, height=0.01, reduction="modes: 6"))
    write_body(body, folder / "bar.nc")
    (folder / "machine.yaml").write_text(MACHINE)
    return nivel.load(folder / "machine.yaml").simulate(), body, folder


def ramp(share):
    """The colour as the renderer counts light; stops are as screens count it."""
    linear = [[c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in stop] for stop in STOPS]
    at = np.clip(share, 0.0, 1.0) * 4
    return np.stack([np.interp(at, range(5), [stop[k] for stop in linear]) for k in range(3)], axis=-1)


def said(result, name, quantity, frame):
    variable, components = MEANT[quantity]
    values = result.sections(name)[variable].values[frame][:, components]
    return values[:, 0] if len(components) == 1 else np.linalg.norm(values, axis=1)


def rounding(result, name, quantity):
    """What rounding of strains to steps can do to a quantity, over that of numbers of 32 bits."""
    sections = result.sections(name)
    strain = np.concatenate([sections["strain"].values, sections["curvature"].values], axis=2)
    step = np.ptp(strain, axis=(0, 1)) / STEPS + 1e-7 * np.abs(strain).max(axis=(0, 1))
    variable, components = MEANT[quantity]
    machine = json.loads(result.attributes["machine_record"])
    assert name in [each["name"] for each in machine["beams"]]
    if variable in ("strain", "curvature"):
        return float(np.linalg.norm(step[[c + 3 * (variable == "curvature") for c in components]]))
    from nivel.machine.machine_record import MachineRecord

    record = MachineRecord.model_validate_json(result.attributes["machine_record"])
    stiffness = next(each for each in record.beams if each.name == name).properties.stiffness
    rows = [c + 3 * (variable == "moment") for c in components]
    return float(np.linalg.norm(np.abs(stiffness[rows]) @ step))


@pytest.mark.full
@pytest.mark.parametrize("frame", [3, 20])
def test_beams_show_what_their_sections_feel(beams, browser, tmp_path, frame):
    file = write_scene([beams], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        page.evaluate(f"nivel.app.goTo({float(beams.time[frame])!r})")
        for quantity in MEANT:
            assert page.evaluate("(name) => nivel.app.colour(name)", quantity)
            for k, name in enumerate(("boom", "tail")):
                shown = page.evaluate(f"Array.from(nivel.app.actor.sections.of({k}).values)")
                expected = said(beams, name, quantity, frame)
                np.testing.assert_allclose(
                    shown, expected, rtol=1e-6, atol=0.51 * rounding(beams, name, quantity), err_msg=quantity
                )


def test_colours_are_those_of_the_values_and_their_ends_those_of_the_motion(beams, browser, tmp_path):
    file = write_scene([beams], tmp_path / "scene.html")
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        assert page.locator(".legend").is_hidden()
        page.get_by_role("button", name="Display", exact=True).click()
        page.get_by_label("Beams by").select_option("bending moment")
        every = [
            said(beams, name, "bending moment", frame).max()
            for name in ("boom", "tail")
            for frame in range(len(beams.time))
        ]
        scale = page.evaluate("nivel.app.colours.scales()[0]")
        assert (scale["quantity"], scale["unit"], scale["low"]) == ("bending moment", "N m", 0)
        assert scale["high"] == pytest.approx(max(every), rel=1e-9)
        assert "bending moment [N m]" in page.locator(".legend").inner_text()
        page.evaluate(f"nivel.app.goTo({float(beams.time[12])!r})")
        swept = "nivel.app.actor.swept[1]"
        colours = np.reshape(page.evaluate(f"Array.from({swept}.mesh.geometry.attributes.color.array)"), (-1, 3))
        corners, steps = page.evaluate(f"[{swept}.corners.length, {swept}.steps]")
        assert steps % 2 == 0
        # points of elements of order 1 are halfway between nodes
        middles = colours[corners * (steps * np.arange(4) + steps // 2)]
        np.testing.assert_allclose(middles, ramp(said(beams, "tail", "bending moment", 12) / max(every)), atol=1e-3)
        page.get_by_label("Beams by").select_option("nothing")
        assert page.locator(".legend").is_hidden()


def per_vertex(values, station_node, nodes):
    """The largest (n,) of the stations (s,) at the node of each vertex."""
    return np.array([values[station_node == node].max() for node in nodes])


def test_flexible_bodies_show_their_stress(bending, browser, tmp_path):
    result, body, _ = bending
    file = write_scene([result], tmp_path / "scene.html")
    recovered = result.recover("bar")
    nodes, stations = moving_surface(body).nodes, recovered.body.stress.station_node
    stress = recovered.von_mises()
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        page.get_by_role("button", name="Display", exact=True).click()
        page.get_by_label("Bodies by").select_option("von Mises stress")
        for frame in (4, 11, 20):
            page.evaluate(f"nivel.app.goTo({float(result.time[frame])!r})")
            shown = np.array(page.evaluate("Array.from(nivel.app.actor.deforming[0].values)"))
            expected = per_vertex(stress[frame], stations, nodes)
            np.testing.assert_allclose(shown, expected, rtol=1e-4, atol=1e-4 * stress.max())
            peak = page.evaluate("nivel.app.actor.deforming[0].stressed.peak")
            assert expected[peak] == pytest.approx(expected.max(), rel=1e-3)
            colours = page.evaluate("Array.from(nivel.app.actor.deforming[0].mesh.geometry.attributes.color.array)")
            np.testing.assert_allclose(np.reshape(colours, (-1, 3)), ramp(shown / stress.max()), atol=1e-4)
        scale = page.evaluate("nivel.app.colours.scales()[0]")
        assert scale["high"] == pytest.approx(stress.max(), rel=1e-9)
        drawn(page)
        assert "von Mises stress [" in page.locator(".legend").inner_text()


def shown_of(result, budget=ALONE):
    return from_bytes(playback([result], budget))[0]["stages"][0]


def test_what_has_no_room_is_left_out_and_said(bending, beams):
    result, *_ = bending
    (looks,) = shown_of(result)["flexible"]
    assert looks["stress"] is not None
    small = shown_of(result, SMALL)
    assert small["flexible"][0]["stress"] is None
    assert "bar has no colours by stress: its modal stresses take 0.0 MB" in small["colourless"][0]
    assert shown_of(beams)["sections"] is not None
    assert "have no room here" in shown_of(beams, SMALL)["colourless"][0]
    # room for fewer frames than there are: some, the first and the last among them
    points = sum(len(each["places"]) for each in shown_of(beams)["sections"]["beams"])
    content, arrays = from_bytes(playback([beams], replace(ALONE, sections=12 * points * 20)))
    time = unpacked(content["stages"][0]["sections"]["time"], arrays)
    assert len(time) == 20
    assert (time[0], time[-1]) == (beams.time[0], beams.time[-1])


def test_bodies_that_know_no_stress_do_not_offer_it(bending, tmp_path):
    _, body, _ = bending
    write_body(replace(body, stress=None), tmp_path / "bar.nc")
    (tmp_path / "machine.yaml").write_text(MACHINE)
    stage = shown_of(nivel.load(tmp_path / "machine.yaml").simulate())
    assert stage["flexible"][0]["stress"] is None
    assert stage["colourless"] == []


def test_a_body_whose_file_is_gone_says_so(bending, tmp_path):
    _, body, _ = bending
    write_body(body, tmp_path / "bar.nc")
    (tmp_path / "machine.yaml").write_text(MACHINE)
    result = nivel.load(tmp_path / "machine.yaml").simulate()
    (tmp_path / "bar.nc").unlink()
    (told,) = shown_of(result)["colourless"]
    assert "the file of the flexible body `bar` is gone" in told


@pytest.mark.full
def test_colours_of_stills_are_those_that_are_there(bending, tmp_path):
    needs("PIL.Image")
    result, *_ = bending
    for name, colours in (("a", ""), ("b", "von Mises stress")):
        still(Playback([result]), tmp_path / f"{name}.png", Look(width=320, height=240, colours=colours), 0.1)
    assert (tmp_path / "a.png").read_bytes() != (tmp_path / "b.png").read_bytes()
    with pytest.raises(ModelError, match="no colours by 'heat'; there are displacement, von Mises stress"):
        still(Playback([result]), tmp_path / "c.png", Look(width=320, height=240, colours="heat"))


def test_steps_of_numbers_that_are_not_finite_or_all_the_same():
    block = Block()
    steps = block.add_steps(np.array([[np.nan, 1.0, 3.0], [2.0, 2.0, 2.0], [np.nan, np.inf, np.nan]]))
    assert steps.low == [1.0, 2.0, 0.0]
    assert steps.step == [2.0 / STEPS, 0.0, 0.0]
    packed = {"kind": "u2", "shape": steps.numbers.shape, "start": steps.numbers.start}
    np.testing.assert_array_equal(unpacked(packed, block.content()), [[0, 0, STEPS], [0, 0, 0], [0, 0, 0]])
