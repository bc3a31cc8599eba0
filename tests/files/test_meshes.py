"""Meshes from files: every format gives the same solid, and damaged files are refused with what is wrong."""

import base64
import json
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nivel.errors import ModelError
from nivel.files import parse_machine, read_mesh, write_machine
from nivel.files.mesh_file import NotReadError, parse
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.bodies.surface import enclosed, surface_arrays
from solid_meshes import box_mesh

VERTICES, TRIANGLES = box_mesh(2.0, 3.0, 4.0)


def stl_binary():
    corners = VERTICES[TRIANGLES].astype("<f4")
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *each.ravel(), 0) for each in corners)
    return b"solid looks like text".ljust(80) + struct.pack("<I", len(corners)) + rows


def stl_text():
    lines = ["solid box"]
    for each in VERTICES[TRIANGLES]:
        lines += [
            "facet normal 0 0 0",
            "outer loop",
            *(f"vertex {x} {y} {z}" for x, y, z in each),
            "endloop",
            "endfacet",
        ]
    return "\n".join([*lines, "endsolid box"]).encode()


def obj():
    lines = [f"v {x} {y} {z}" for x, y, z in VERTICES] + ["vn 0 0 1"]
    return "\n".join(lines + [f"f {i + 1}//1 {j - 8} {k + 1}/1" for i, j, k in TRIANGLES.astype(int)]).encode()


def gltf_parts():
    points, corners = VERTICES.astype("<f4").tobytes(), TRIANGLES.astype("<u2").tobytes()
    data = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        # the child undoes what the parent does
        "nodes": [
            {"children": [1], "translation": [1, 2, 3], "scale": [2, 2, 2]},
            {"mesh": 0, "matrix": [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, -0.5, -1, -1.5, 1]},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": len(points)},
            {"buffer": 0, "byteOffset": len(points), "byteLength": len(corners)},
        ],
    }
    return data, points + corners


def gltf():
    data, content = gltf_parts()
    data["buffers"] = [{"byteLength": len(content), "uri": "data:;base64," + base64.b64encode(content).decode()}]
    return json.dumps(data).encode()


def glb():
    data, content = gltf_parts()
    data["buffers"] = [{"byteLength": len(content)}]
    text = json.dumps(data).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(content), b"BIN\0") + content
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


FILES = {"a.stl": stl_binary(), "b.STL": stl_text(), "c.obj": obj(), "d.gltf": gltf(), "e.glb": glb()}


@pytest.mark.parametrize("name", FILES)
def test_every_format_gives_the_same_solid(name, tmp_path):
    (tmp_path / name).write_bytes(FILES[name])
    inside = enclosed(*surface_arrays(read_mesh(tmp_path / name).surface))
    assert inside.volume == pytest.approx(24.0)
    np.testing.assert_allclose(inside.centre, 0.0, atol=1e-6)
    np.testing.assert_allclose(np.diag(inside.moments), 24.0 * np.array([25, 20, 13]) / 12, rtol=1e-6)


BEAM = "  beam: {shape: {type: extrusion, outline: [[0, 0], [2, 0], [0, 1]], length: 3}, density: 1000}\n"


def machine(shape, rest="density: 1000"):
    return f"format: 1\nbodies:\n  block: {{shape: {{type: mesh, {shape}}}, {rest}}}\n"


def test_a_machine_file_names_a_mesh_beside_it(tmp_path):
    (tmp_path / "block.stl").write_bytes(FILES["a.stl"])
    read = parse_machine(machine("file: block.stl, unit: 1 cm, position: [1, 0, 0]"), str(tmp_path / "m.yaml"))
    properties = mass_properties(read.bodies[0])
    assert properties.mass == pytest.approx(1000 * 24e-6)
    np.testing.assert_allclose(properties.centre_of_mass, [1, 0, 0], atol=1e-9)
    # written out it needs no file
    again = parse_machine(write_machine(read), str(tmp_path / "elsewhere" / "m.yaml"))
    assert mass_properties(again.bodies[0]).mass == pytest.approx(properties.mass)


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("missing.stl", None, "there is no file"),
        ("part.ply", b"x", "a mesh in .stl, .obj, .dae, .gltf, .glb was expected"),
        ("cut.stl", FILES["a.stl"][:-7], "damaged|no STL|cut short|no triangles|fewer"),
        ("empty.stl", b"", "no STL"),
        ("empty.obj", b"# nothing", "no triangles"),
        ("far.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9", "corner that does not exist"),
        ("nan.obj", b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", "not finite"),
        ("words.obj", b"v one 0 0\nf 1 2 3", "damaged"),
        ("text.glb", b"hello, this is text", "no binary glTF"),
        ("list.gltf", b"[1, 2]", "no glTF"),
        ("cut.glb", FILES["e.glb"][:-30], "cut short"),
        ("open.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", "not closed: 3 edges"),
    ],
)
def test_what_is_wrong_with_a_file_is_said_at_its_place(name, content, said, tmp_path):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(ModelError, match=said) as caught:
        parse_machine(machine(f"file: {name}"), str(tmp_path / "m.yaml"))
    (fault,) = caught.value.faults
    assert fault.line == 3


def test_a_gltf_file_reads_nothing_from_elsewhere(tmp_path):
    data, _ = gltf_parts()
    for uri in ("../secret.bin", "/etc/passwd", "https://example.org/a.bin", "file:///etc/passwd"):
        data["buffers"] = [{"byteLength": 1, "uri": uri}]
        with pytest.raises(NotReadError, match="only files beside it"):
            parse(json.dumps(data).encode(), str(tmp_path / "a.gltf"))


@given(st.sampled_from([".stl", ".obj", ".gltf", ".glb"]), st.binary(max_size=300))
def test_random_bytes_are_refused_in_words(kind, content):
    with pytest.raises(NotReadError):
        parse(content, f"noise{kind}")


@given(st.sampled_from(sorted(FILES)), st.integers(0, 10_000), st.integers(0, 255))
def test_a_changed_byte_is_read_or_refused(name, place, value):
    content = bytearray(FILES[name])
    content[place % len(content)] = value
    try:
        vertices, triangles = parse(bytes(content), name)
    except NotReadError:
        return
    assert triangles.max() < len(vertices)


def test_a_mirrored_part_has_a_mirrored_mesh(tmp_path):
    (tmp_path / "block.obj").write_bytes(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4")
    (tmp_path / "part.yaml").write_text(machine("file: block.obj") + BEAM)
    text = "format: 1\nassemblies:\n  left: {file: part.yaml}\n  right: {file: part.yaml, mirror: y, position: [0, 5, 0]}\n"
    read = parse_machine(text, str(tmp_path / "m.yaml"))
    properties = {body.name: mass_properties(body) for body in read.bodies}
    for each in ("block", "beam"):
        left, right = (
            properties[next(name for name in properties if side in name and each in name)] for side in ("left", "right")
        )
        assert right.mass == pytest.approx(left.mass)
        np.testing.assert_allclose(right.centre_of_mass, left.centre_of_mass * [1, -1, 1], atol=1e-12)
        np.testing.assert_allclose(right.inertia, left.inertia * np.outer([1, -1, 1], [1, -1, 1]), atol=1e-9)
