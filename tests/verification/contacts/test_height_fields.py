"""Ground with heights: a flat field is the plane, a bowl swings a ball with its period; files and what is wrong with them."""

import struct
import zlib

import numpy as np
import pytest

from nivel.errors import ModelError
from nivel.files import read_machine
from nivel.judge.before.unusual import remarks
from nivel.machine.bodies.surface import surface_arrays
from simulating import G, machine, simulate

CONTACT = {"type": "contact", "stiffness": 1e5, "exponent": 1, "restitution": 0.5}
PRISM = [[-0.15, -0.2], [0.2, -0.15], [0.1, 0.2], [-0.1, 0.15]]
SHAPES = {
    "sphere": {"type": "sphere", "radius": 0.1},
    "capsule": {"type": "capsule", "radius": 0.1, "length": 0.3},
    "box": {"type": "box", "size": [0.3, 0.2, 0.2]},
    "cylinder": {"type": "cylinder", "radius": 0.1, "length": 0.3},
    "extrusion": {"type": "extrusion", "outline": PRISM, "length": 0.3},
}
FLAT = {"size": [4, 4], "values": [[0, 0, 0]] * 3}


def dropped(heights):
    """Each shape falls on a tilted plane, a part of it first."""
    bodies = {
        name: {
            "mass": 1,
            "inertia": [0.02, 0.01, 0.015],
            "shape": shape,
            "position": [0.2 * k, 0.1, 0.35],
            "orientation": {"axis": [1, 2, 0.5], "angle": 0.3},
            "velocity": [0.5, 0.2, 0],
        }
        for k, (name, shape) in enumerate(SHAPES.items())
    }
    more = {"friction": 0.3, "friction_model": "coulomb", "friction_transition_speed": 0.1}
    forces = {name: {**CONTACT, **more, "body": name, "plane": "floor", **heights} for name in SHAPES}
    floor = {"body": "ground", "position": [0, 0, -0.1], "axis": [0.1, 0, 1]}
    sections = {"gravity": [0, 0, -G], "bodies": bodies, "markers": {"floor": floor}, "forces": forces}
    return simulate(sections, integrator="rk4", step=2e-4, duration=0.5, output_interval=0.01)


def test_a_flat_field_is_the_plane():
    """All shapes, with their impacts, to round-off that impacts multiply."""
    plane, field = dropped({}), dropped({"heights": FLAT})
    for name in SHAPES:
        assert plane.array(f"force.{name}.normal_force").max() > 5.0
        np.testing.assert_allclose(field.array(f"{name}.position"), plane.array(f"{name}.position"), atol=1e-7)


@pytest.mark.parametrize("on", ["function", "values"])
def test_a_ball_swings_in_a_bowl_with_its_period(on):
    """It slides in z = k r²/2 as its centre does on the parallel surface: near the bottom the radius of curvature is 1/k - R, so
    ω² = g/(1/k - R). Cubics between heights are exact for parabolas, also of few heights."""
    k, radius, start = 1.0, 0.1, 0.005
    omega = np.sqrt(G / (1 / k - radius))
    heights = {"size": [2, 2], "function": "0.5*curvature*(x^2 + y^2)", "points": [5, 9]}
    if on == "values":
        x, y = np.linspace(-1, 1, 5), np.linspace(-1, 1, 9)
        heights = {"size": [2, 2], "values": [[0.5 * k * (a * a + b * b) for a in x] for b in y]}
    sections = {
        "parameters": {"curvature": k},
        "gravity": [0, 0, -G],
        "bodies": {
            "ball": {
                **{"mass": 1, "shape": {"type": "sphere", "radius": radius}},
                "position": [start, 0, radius - G / 1e6 + 0.5 * start**2 / (1 / k - radius)],
                "velocity": [0, 0.6 * start * omega, 0],
            }
        },
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1], "x_axis": [1, 0, 0]}},
        "forces": {
            "rolls": {
                **CONTACT,
                "stiffness": 1e6,
                "restitution": 1,
                "body": "ball",
                "plane": "floor",
                "heights": heights,
            }
        },
    }
    r = simulate(sections, integrator="radau", tolerance=1e-9, duration=3.0, output_interval=0.02)
    np.testing.assert_allclose(r.array("ball.position")[:, 0], start * np.cos(omega * r.time), atol=2e-3 * start)
    np.testing.assert_allclose(r.array("ball.position")[:, 1], 0.6 * start * np.sin(omega * r.time), atol=2e-3 * start)
    assert np.abs(r.array("energy_error")).max() < 1e-6


def png(rows, bits=8, kind=0):
    """A picture in grey of bytes `rows`, from the top; the filters of its lines take turns."""
    data = b""
    for k, row in enumerate(rows):
        above = rows[k - 1] if k else [0] * len(row)
        name = k % 5
        guess = {
            0: lambda i, row=row: 0,
            1: lambda i, row=row: row[i - 1] if i else 0,
            2: lambda i, above=above: above[i],
            3: lambda i, row=row, above=above: ((row[i - 1] if i else 0) + above[i]) // 2,
            4: lambda i, row=row, above=above: paeth(row[i - 1] if i else 0, above[i], above[i - 1] if i else 0),
        }[name]
        data += bytes([name, *((row[i] - guess(i)) % 256 for i in range(len(row)))])
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, kind, 0, 0, 0)
    parts = ((b"IHDR", head), (b"IDAT", zlib.compress(data)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(part)) + name + part + struct.pack(">I", zlib.crc32(name + part)) for name, part in parts
    )


def paeth(left, up, corner):
    """The neighbour that is nearest to left + up - corner."""
    guess = left + up - corner
    return min((left, up, corner), key=lambda each: abs(guess - each))


FILE = """format: 1
bodies: {{ball: {{mass: 1, shape: {{type: sphere, radius: 0.1}}, position: [0, 0, 1]}}}}
markers: {{floor: {{body: ground, axis: [0, 0, 1]}}}}
forces:
  rolls: {{type: contact, body: ball, plane: floor, stiffness: 1e5, restitution: 0.5, heights: {{size: [4 m, 2 m], {0}}}}}
"""


def read(folder, name, content, given):
    (folder / name).write_bytes(content)
    (folder / "machine.yaml").write_text(FILE.format(given), encoding="utf-8")
    return read_machine(folder / "machine.yaml")


def test_heights_of_files(tmp_path):
    """Rows of numbers from the least y, and the grey of a picture from its lowest row, each with a unit."""
    csv = read(tmp_path, "ground.csv", b"# cm\n0, 1, 2\n3; 4; 5\n6 7 8\n", "file: ground.csv, unit: 1 cm")
    np.testing.assert_allclose(csv.forces[0].heights.heights, np.arange(9).reshape(3, 3) / 100)
    rows = [[(40 * i * i + 90 * j) % 256 for j in range(4)] for i in range(7)]
    picture = read(tmp_path, "ground.png", png(rows), "file: ground.png, unit: 2 m")
    np.testing.assert_allclose(picture.forces[0].heights.heights, 2.0 * np.array(rows[::-1]) / 255)


@pytest.mark.parametrize(
    ("content", "given", "said"),
    [
        (b"1,2,3\n4,5\n", "file: ground.csv", "line 2: 3 numbers were expected as in the lines above, got 2"),
        (b"1,2\nhigh,5\n", "file: ground.csv", "line 2: numbers were expected, got `high,5`"),
        (b"1,2\n3,4\n", "file: ground.csv", "at least 3 rows of 3 heights"),
        (png([[0, 0, 0]] * 3, bits=8, kind=3), "file: ground.csv", "without a palette"),
        (png([[]]), "file: ground.csv", "the picture has no points"),
        (png([[0] * 300_000]), "file: ground.csv", "the picture has more than 250000 points"),
        (
            png([[0, 0, 0]] * 3).replace(b"IHDR" + bytes([0, 0, 0, 3]), b"IHDR" + bytes([0, 0, 0, 4])),
            "file: ground.csv",
            "damaged",
        ),
        (png([[0, 0, 0]] * 3)[:-30], "file: ground.csv", "damaged"),
        (b"1,2,3\n1,nan,3\n", "file: ground.csv", "line 2: finite numbers were expected, got `1,nan,3`"),
        ("1,2\n3,4\n".encode("utf-16"), "file: ground.csv", "a CSV file of numbers or a PNG picture was expected"),
        (b"", "file: ground.csv", "there are no numbers in it"),
        (b"", "file: missing.csv", "missing.csv"),
        (b"", "function: 1/x", "has no value everywhere on the rectangle: division by zero"),
        (b"", "function: slope*x", "`slope`"),
        (
            b"",
            "function: 0.5*r^2",
            "`r` is neither a parameter nor a unit; the place on the plane has the names `x` and `y`",
        ),
        (b"", "function: 0.1*u^2", "a length (m) was expected; the place on the plane has the names `x` and `y`"),
        (b"", "function: 2 kg*x", "`2 kg*x` is a mass (kg); a length (m) was expected"),
        (b"", "function: 0.1*x*time", "ground does not change with the time"),
        (b"", "values: [[1, 2, 3], [1, 2], [1, 2, 3]]", "all rows need as many heights"),
        (b"", "function: 0.1*x, unit: 1 mm", "`unit` is the length of one unit of a `file`"),
        (b"", "values: [[1, 2, 3], [1, 2, 3], [1, 2, 3]], unit: 1 mm", "`unit` is the length of one unit of a `file`"),
        (b"1,2,3\n1,2,3\n1,2,3\n", "file: ground.csv, points: [5, 5]", "`points` belongs to a `function`"),
        (b"", "function: 0.1*x, points: 41", "write `points: [41, 41]`"),
        (b"", "unit: 1 m", "`values`, a `file`, a `function` or a `roughness` must be given"),
    ],
)
def test_what_is_wrong_with_heights_is_said(tmp_path, content, given, said):
    with pytest.raises(ModelError, match="heights") as error:
        read(tmp_path, "ground.csv", content, given)
    assert said in str(error.value)


@pytest.mark.parametrize(("radius", "count"), [(0.2, 0), (0.3, 1)])
def test_a_ball_that_is_larger_than_a_valley_is_remarked_on(tmp_path, radius, count):
    """z = 2 y² curves with 1/4 m at its bottom."""
    (tmp_path / "machine.yaml").write_text(
        FILE.format("function: 2*y^2, points: [5, 401]").replace("radius: 0.1", f"radius: {radius}"), encoding="utf-8"
    )
    found = [each for each in remarks(read_machine(tmp_path / "machine.yaml")) if each.place == "forces.rolls.heights"]
    assert len(found) == count
    assert all("curves with a radius of 0.25 m, less than the 0.3 m of `ball`" in each.text for each in found)


def test_an_ellipsoid_refuses_heights():
    sections = {
        "bodies": {"egg": {"mass": 1, "shape": {"type": "ellipsoid", "semi_axes": [1, 2, 3]}}},
        "markers": {"floor": {"body": "ground", "axis": [0, 0, 1]}},
        "forces": {"rolls": {**CONTACT, "body": "egg", "plane": "floor", "heights": FLAT}},
    }
    with pytest.raises(ModelError, match="touches flat planes alone"):
        machine(sections)


def test_the_ground_is_drawn_once():
    """As a mesh of the surroundings, at the place of the plane."""
    bodies = {name: {"mass": 1, "shape": SHAPES["sphere"], "position": [0, 0, k]} for k, name in enumerate("ab", 3)}
    contact = {**CONTACT, "plane": "floor", "heights": {"size": [4, 2], "values": [[0, 0, 0], [0, 1, 0], [0, 0, 0]]}}
    sections = {
        "bodies": bodies,
        "markers": {"floor": {"body": "ground", "position": [0, 0, 0.5], "axis": [0, 0, 1], "x_axis": [1, 0, 0]}},
        "forces": {name: {**contact, "body": name} for name in "ab"},
    }
    drawn = simulate(sections, integrator="rk4", step=1e-3, duration=1e-3)
    (ground,) = drawn.scene["surroundings"]
    assert all("axis" not in force for force in drawn.scene["forces"])
    vertices, triangles = surface_arrays(ground["surface"])
    assert len(triangles) == 8
    np.testing.assert_allclose(vertices[4], [0, 0, 1.5], atol=1e-12)
    np.testing.assert_allclose([vertices.min(axis=0), vertices.max(axis=0)], [[-2, -1, 0.5], [2, 1, 1.5]], atol=1e-12)
