"""Circuits without bodies: the same numbers as beside a body, and a verdict on pressures and flows."""

from pathlib import Path

import numpy as np
import pytest

import nivel
from nivel.files import parse_machine

STATION = Path(__file__).parents[2] / "examples" / "hydraulics" / "accumulator-station.yaml"
BODY = """bodies: {stone: {mass: 1, inertia: [1, 1, 1]}}
joints: {rest: {type: revolute, bodies: [ground, stone], point: [0, 0, 0], axis: [0, 0, 1]}}
"""


@pytest.fixture(scope="module")
def text():
    return STATION.read_text(encoding="utf-8")


@pytest.mark.parametrize("integrator", ["extrapolated-euler", "radau"])
def test_a_circuit_alone_does_what_it_does_beside_a_body(text, integrator):
    """The body is at rest and touches nothing of it."""
    results = [
        nivel.Machine.from_record(parse_machine(each)).simulate(
            duration=3.2, verify=False, integrator=integrator, coordinates="absolute"
        )
        for each in (text, text.replace("hydraulics:\n", f"{BODY}hydraulics:\n"))
    ]
    for name in ("hydraulics.line.pressure", "hydraulics.accumulator.flow", "hydraulics.relief.flow"):
        alone, beside = (np.interp(np.linspace(0, 3.2, 50), each.time, each.array(name)) for each in results)
        np.testing.assert_allclose(alone, beside, rtol=1e-9 if integrator != "radau" else 1e-4, atol=1e-9)
        assert np.ptp(alone) > 0.0


@pytest.mark.usefixtures("verified")
def test_its_verdict_speaks_of_pressures_and_flows(text):
    trust = nivel.Machine.from_record(parse_machine(text)).simulate(duration=2.5).trust
    assert trust.verdict == "green"
    assert trust.headline.startswith("pressures within ")
    assert " and flows within " in trust.headline
    assert "bodies" not in trust.headline
    assert any(item.text == "Freedom: a circuit without bodies (green)" for item in trust.items)


def test_its_analyses_and_pages(text, tmp_path):
    """Equilibrium: all of the pump's flow goes over the relief valve; the slowest mode charges the accumulator."""
    station = nivel.Machine.from_record(parse_machine(text))
    rest = station.statics()
    flow = rest.array("hydraulics.relief.flow")[-1]
    # at other densities
    assert flow == pytest.approx(rest.array("hydraulics.pump.flow")[-1], rel=0.02)
    assert flow == pytest.approx(16e-6 * 25, rel=0.02)
    linear = station.linearise()
    assert len(linear.eigenvalues) == 2
    assert (np.real(linear.eigenvalues) < 0).all()
    assert station.check().degrees_of_freedom == 0
    station.simulate(duration=0.1, verify=False, out=tmp_path / "s.nc")
    from nivel.report.write import write_report

    write_report(nivel.Result.open(tmp_path / "s.nc"), tmp_path / "s.html")
    assert "accumulator" in (tmp_path / "s.html").read_text(encoding="utf-8")


def test_a_machine_of_nothing_is_refused():
    with pytest.raises(nivel.ModelError, match="a machine needs at least one body, beam or circuit"):
        parse_machine("format: 1\nname: nothing\nsimulation: {duration: 1}\n")


def test_sweeps_keep_its_pressures_and_the_viewer_says_where_its_plots_are(text, tmp_path):
    station = nivel.Machine.from_record(parse_machine(text))
    found = station.sweep({"hydraulics.relief.opens_at": [120e5, 160e5]}, duration=0.1)
    pressure = found["hydraulics.line.pressure"].to_numpy()
    assert 30e5 < pressure[1, -1] - pressure[0, -1] < 50e5
    from nivel.view.playback import SERVED, playback

    result = station.simulate(duration=0.1, verify=False)
    with pytest.raises(nivel.ModelError, match="a circuit without bodies, which has no picture; its report has plots"):
        playback([result], SERVED)
