"""STEP: masses and moments of solids are exact, and so are their places."""

import os
import time
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import nivel
from needing import needs
from nivel.cli import main
from nivel.errors import ModelError
from nivel.files import parse_machine
from nivel.files.apart import apart
from nivel.files.step_file import step_solids
from nivel.machine.bodies.surface import enclosed, surface_arrays

gmsh = needs("gmsh")
A, B, C, R, H, BALL, TURN = 0.1, 0.2, 0.4, 0.05, 0.3, 0.15, 0.5


@pytest.fixture(scope="module")
def crane(tmp_path_factory):
    """A box, a cylinder that leans by TURN about x, and a ball, in millimetres."""
    path = tmp_path_factory.mktemp("step") / "crane.step"
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setString("Geometry.OCCTargetUnit", "MM")  # what was read before in this process may have left metres
    gmsh.model.add("parts")
    occ = gmsh.model.occ
    occ.addBox(0, 0, 0, 1e3 * A, 1e3 * B, 1e3 * C)
    pin = occ.addCylinder(500, 0, 0, 0, 0, 1e3 * H, 1e3 * R)
    occ.addSphere(0, 700, 0, 1e3 * BALL)
    occ.rotate([(3, pin)], 500, 0, 0, 1, 0, 0, TURN)
    occ.synchronize()
    gmsh.write(str(path))
    gmsh.finalize()
    text = path.read_text(encoding="utf-8")
    for k, name in enumerate(("boom", "pin 1", "ball"), 1):
        start = text.index("PRODUCT('", text.index(f" 1.{k}'") - 60)
        text = text[:start] + text[start:].replace(text[start + 8 : text.index("',", start)], f"'{name}", 2)
    path.write_text(text, encoding="utf-8")
    return path


def test_import_makes_bodies_with_exact_masses_at_exact_places(crane, tmp_path):
    out = tmp_path / "crane.yaml"
    done = CliRunner().invoke(main, ["import", str(crane), "--out", str(out), "--density", "2700"])
    assert done.exit_code == 0, done.stderr
    machine = nivel.load(out)
    boom, pin, ball = machine.record.bodies
    assert [each.name for each in machine.record.bodies] == ["boom", "pin_1", "ball"]
    m = 2700 * np.pi * R**2 * H
    assert [boom.mass, pin.mass, ball.mass] == pytest.approx(
        [2700 * A * B * C, m, 2700 * 4 / 3 * np.pi * BALL**3], rel=1e-12
    )
    np.testing.assert_allclose(boom.position, [A / 2, B / 2, C / 2], atol=1e-14)
    np.testing.assert_allclose(pin.position, [0.5, -H / 2 * np.sin(TURN), H / 2 * np.cos(TURN)], atol=1e-14)
    np.testing.assert_allclose(ball.position, [0, 0.7, 0], atol=1e-14)
    across, along, c, s = m * (R**2 / 4 + H**2 / 12), m * R**2 / 2, np.cos(TURN), np.sin(TURN)
    i = pin.inertia
    found = [i.xx, i.yy, i.zz, i.yz, i.xy]
    expected = [across, across * c**2 + along * s**2, across * s**2 + along * c**2, (across - along) * c * s, 0]
    np.testing.assert_allclose(found, expected, atol=1e-12 * across)
    vertices, triangles = surface_arrays(boom.looks[0].surface)
    assert enclosed(vertices, triangles).volume == pytest.approx(A * B * C, rel=1e-6)
    np.testing.assert_allclose(enclosed(vertices, triangles).centre, 0.0, atol=1e-7)
    assert "joints: a STEP file has none" in done.stdout


def test_a_part_of_a_file_is_the_shape_of_a_body_with_its_exact_mass(crane):
    text = f"format: 1\nbodies:\n  b: {{shape: {{file: {crane}, part: ball}}, density: 7.85 g/cm^3}}\n"
    body = parse_machine(text, "m.yaml").bodies[0]
    m = 7850 * 4 / 3 * np.pi * BALL**3
    assert body.mass == pytest.approx(m, rel=1e-12)
    np.testing.assert_allclose(body.centre_of_mass, [0, 0.7, 0], atol=1e-14)
    np.testing.assert_allclose([body.inertia.xx, body.inertia.zz], 0.4 * m * BALL**2, rtol=1e-12)
    with pytest.raises(nivel.ModelError, match=r"m\.yaml:3:\d+: .*there is no part `bal`; .* has boom, pin 1, ball"):
        parse_machine(text.replace("part: ball", "part: bal"), "m.yaml")


def test_a_file_that_is_no_step_is_refused(tmp_path):
    path = tmp_path / "a.step"
    path.write_text("hello", encoding="utf-8")
    with pytest.raises(nivel.ModelError, match=r"is no STEP file that can be read|has no solids"):
        nivel.import_model(path)


def test_what_crashes_a_library_is_a_sentence():
    """Where its process ends by a signal, or takes too long; the next call has a new one."""
    with pytest.raises(ModelError, match=r"a\.step cannot be read: the library for it crashed \(SIGABRT\)"):
        apart(os.abort, failed="a.step cannot be read")
    with pytest.raises(ModelError, match=r"a\.step cannot be read: this took longer than 0\.2 s"):
        apart(time.sleep, 60.0, failed="a.step cannot be read", longest=0.2)


@pytest.mark.full
def test_no_damaged_file_ends_the_program(tmp_path):
    """Of such files one in three ends a process that reads it."""
    random, said = np.random.default_rng(1), []
    whole = (Path(__file__).parents[2] / "examples" / "robots" / "lift.step").read_bytes()
    for number in range(30):
        content = bytearray(whole)
        for place in random.integers(len(content) - 60, size=random.choice((1, 3, 10, 40))):
            del content[place : place + random.integers(60)]
        file = tmp_path / f"{number}.step"
        file.write_bytes(content)
        try:
            step_solids(str(file))
        except ModelError as refused:
            said.append(str(refused))
    assert any("the library for it crashed (SIGSEGV)" in each for each in said)
