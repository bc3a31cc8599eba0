"""Remarks on values that no real machine has: each slip of a unit has one, and no example or demo has any."""

from pathlib import Path

import pytest
from everything import EVERYTHING

import nivel
from example_files import EXAMPLES
from nivel import MachineRecord
from nivel.judge.before.unusual import remarks

DEMOS = Path(nivel.__file__).parent / "demos"
GOOD = """\
format: 1
bodies:
  load: {shape: {type: box, size: [20 cm, 20 cm, 20 cm]}, density: 7850, position: [1, 0, 0]}
joints:
  rail: {type: translational, bodies: [ground, load], point: [0, 0, 0], axis: [1, 0, 0]}
fluids:
  oil: {bulk_modulus: 1.4 GPa, viscosity: 46 mm^2/s, density: 870}
hydraulics:
  tank: {type: tank}
  supply: {type: volume, volume: 1 L}
  pump: {type: pump, ports: {A: tank, B: supply}, displacement: 28 cm^3/rev, speed: 1500 rpm}
  relief: {type: relief-valve, ports: {P: supply, T: tank}, opens_at: 250 bar, opening_range: 25 bar, flow: 60 l/min,
    pressure_drop: 5 bar}
  cylinder: {type: cylinder, bodies: [ground, load], points: [[0, 0, 0], [1, 0, 0]], piston: 80 mm, rod: 40 mm,
    stroke: 0.5, retracted_length: 0.8}
  in: {type: check-valve, ports: {A: supply, B: cylinder.A}, flow: 40 l/min, pressure_drop: 5 bar}
  out: {type: orifice, ports: {A: cylinder.B, B: tank}, diameter: 3 mm}
simulation: {duration: 2 ms, step: 1 ms}
"""
# what stands in the file, what is written in its place, the place that the remark names, and words of it
SLIPS = {
    "a pressure a hundred times too high": ("250 bar", "25000 bar", "relief.opens_at", "25000 bar, and 0.01 to 700 bar"),
    "a pressure without its unit": ("opens_at: 250 bar", "opens_at: 250", "relief.opens_at", "`opens_at: 250 bar`"),
    "a flow in SI": ("flow: 60 l/min", "flow: 60", "relief.flow", "3.6e+06 l/min"),
    "a density in g/cm^3": ("density: 870", "density: 0.87", "oil.density", "`density: 870 kg/m^3`"),
    "a body as light as gas": ("density: 7850", "density: 0.785", "load.density", "7850 kg/m^3"),
    "a bulk modulus in MPa": ("1.4 GPa", "14 MPa", "oil.bulk_modulus", "0.014 GPa"),
    "a viscosity without its unit": ("46 mm^2/s", "46", "oil.viscosity", "`viscosity: 46 mm^2/s`"),
    "a speed in rad/s": ("1500 rpm", "15000", "pump.speed", "143239 rpm"),
    "a piston in metres": ("piston: 80 mm", "piston: 80", "cylinder.piston", "80000 mm"),
    "a displacement per turn as a volume": ("28 cm^3/rev", "28 cm^3", "pump.displacement", "175.9 cm^3/rev"),
    "a check valve the wrong way round": ("A: supply, B: cylinder.A", "A: cylinder.A, B: supply", "cylinder", "`cylinder.A`"),
    "a chamber without a line": ("A: cylinder.B, B: tank", "A: supply, B: tank", "cylinder", "`cylinder.B`"),
}  # fmt: skip


def read(tmp_path, text):
    path = tmp_path / "slip.yaml"
    path.write_text(text, encoding="utf-8")
    return nivel.load(path)


@pytest.mark.parametrize(("old", "new", "place", "words"), SLIPS.values(), ids=SLIPS)
def test_a_slip_is_remarked_on_at_its_line(tmp_path, old, new, place, words):
    assert old in GOOD
    text = GOOD.replace(old, new)
    (remark,) = (each for each in read(tmp_path, text).remarks if each.path.partition(".")[2] == place)
    assert words in remark.message
    line = text.splitlines()[remark.line - 1]
    assert new in line if "." in place else line.startswith("  cylinder:")


def test_every_usual_value_has_a_unit_that_is_read():
    """Those of all keys of all kinds."""
    assert len(list(remarks(MachineRecord(**EVERYTHING)))) > 0


def test_what_is_usual_has_no_remark(tmp_path):
    assert not read(tmp_path, GOOD).remarks


@pytest.mark.parametrize("converted", ["28 cm^3/(2*pi)", "28 cm^3/rad", "28e-6/(2*pi)"])
def test_a_displacement_that_was_converted_has_no_remark(tmp_path, converted):
    assert not read(tmp_path, GOOD.replace("28 cm^3/rev", converted)).remarks


@pytest.mark.parametrize(
    "sealed",
    [
        ("A: cylinder.B, B: tank", "A: supply, B: tank", "stroke: 0.5,", "stroke: 0.5, start_B: 20 bar,"),
        ("A: cylinder.B, B: tank", "A: supply, B: tank", "stroke: 0.5,", "stroke: 0.5, acting: single,"),
    ],
    ids=["its pressure is given", "it is open to the air"],
)
def test_a_chamber_that_is_sealed_on_purpose_has_no_remark(tmp_path, sealed):
    assert not read(tmp_path, GOOD.replace(*sealed[:2]).replace(*sealed[2:])).remarks


@pytest.mark.parametrize("folder", [*sorted(EXAMPLES.iterdir()), DEMOS], ids=lambda path: path.name)
def test_examples_and_demos_have_no_remarks(folder):
    for path in folder.glob("*.yaml"):
        text = path.read_text(encoding="utf-8")
        if (
            "model:" in text
            or "\nmachine:" in text
            or "type: fmu" in text
            or "type: c," in text
            or folder.name == "flexible"
        ):
            continue  # studies, models of finite elements, and machines with bodies or units that are made first
        assert not list(remarks(nivel.load(path, allow_code=True).record)), path
