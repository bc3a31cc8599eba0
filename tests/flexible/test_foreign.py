"""Matrices of other programs: small files written here by the documented formats, read back as the model they were made of."""

import struct
from pathlib import Path

import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp

from models import bar, block, reduced
from needing import needs
from nivel.errors import ModelError
from nivel.flexible.foreign.matrix import FormatError, fortran_number, read_abaqus
from nivel.flexible.foreign.nastran import read_dmig, read_op4
from nivel.flexible.foreign.read_mesh import read_mesh
from nivel.flexible.model.model_file import parse_model
from nivel.flexible.reduce import source_model

# numbers of the nodes of the files: with holes, and not in the order of the model
NUMBERS = np.array([10, 12, 5, 40, 41])


@pytest.fixture(scope="module")
def beam():
    """A skew beam of four elements and its dense matrices."""
    located = parse_model(bar(tip=(1.0, 0.5, 0.2), elements=4))
    model, _ = source_model(located, lambda *_: None)
    return model, model.stiffness.toarray(), model.mass.matrix.toarray()


def labels():
    return [(int(node), axis) for node in NUMBERS for axis in range(1, 7)]


def text_model(folder, matrices, interfaces="root: {node: 10}, tip: {node: 12}", more=""):
    text = f"format: 1\nmatrices: {{{matrices}}}\ninterfaces: {{{interfaces}}}\nreduction: {{modes: 6}}\n{more}"
    return reduced(text, folder)


def same_body(folder, beam, matrices, **options):
    """The body of the files has the frequencies, mass and inertia of that of the beam."""
    body, _ = text_model(folder, matrices, **options)
    expected, _ = reduced(bar(tip=(1.0, 0.5, 0.2), elements=4, reduction="modes: 6"))
    np.testing.assert_allclose(body.frequencies, expected.frequencies, rtol=1e-6)
    np.testing.assert_allclose(body.inertia, expected.inertia, atol=1e-9 * np.abs(expected.inertia).max())
    assert body.mass == pytest.approx(expected.mass, rel=1e-10)
    np.testing.assert_allclose(body.centre_of_mass, expected.centre_of_mass, atol=1e-10)


def write_nodes(folder, beam, scale=1.0):
    rows = [
        f"{n}, {x[0] * scale!r}, {x[1] * scale!r}, {x[2] * scale!r}"
        for n, x in zip(NUMBERS, beam[0].position, strict=True)
    ]
    (folder / "nodes.csv").write_text(
        "id, x, y, z\n" + "\n".join(rows).replace("np.float64(", "").replace(")", "") + "\n"
    )


def write_inp(folder, beam):
    lines = ["*HEADING", "a beam", "** comment", "*NODE, NSET=ALL"]
    lines += [f"{n}, {x[0]:.16g}, {x[1]:.16g}, {x[2]:.16g}" for n, x in zip(NUMBERS, beam[0].position, strict=True)]
    lines += [
        "*NSET, NSET=ENDS",
        "10, 12",
        "*NSET, NSET=RANGE, GENERATE",
        "40, 41, 1",
        "*ELEMENT, TYPE=B31, ELSET=E",
        "1, 10, 5",
        "*STEP",
        "*END STEP",
    ]
    (folder / "mesh.inp").write_text("\n".join(lines))


def entries(matrix):
    """Entries of the lower triangle that are not zero."""
    return [(i, j, float(matrix[i, j])) for i in range(len(matrix)) for j in range(i + 1) if matrix[i, j] != 0.0]


def test_abaqus_matrix_input(beam, tmp_path):
    """*MATRIX OUTPUT, FORMAT=MATRIX INPUT: row node, direction, column node, direction, value; one triangle."""
    at = labels()
    for name, matrix in zip(("STIF2", "MASS2"), beam[1:], strict=True):
        lines = [f"{at[i][0]},{at[i][1]}, {at[j][0]},{at[j][1]}, {value:.15e}" for i, j, value in entries(matrix)]
        (tmp_path / f"job_{name}.mtx").write_text("\n".join(lines))
    write_inp(tmp_path, beam)
    same_body(tmp_path, beam, "format: abaqus, stiffness: job_STIF2.mtx, mass: job_MASS2.mtx, nodes: mesh.inp")


def test_abaqus_coordinates_count_nodes_in_ascending_order(beam, tmp_path):
    """FORMAT=COORDINATE: row, column, value; both triangles here."""
    order = np.argsort(np.repeat(NUMBERS, 6), kind="stable")
    for name, matrix in zip("KM", beam[1:], strict=True):
        turned = matrix[np.ix_(order, order)]
        rows, columns = np.nonzero(turned)
        lines = [f"{i + 1} {j + 1} {turned[i, j]:.15e}" for i, j in zip(rows, columns, strict=True)]
        (tmp_path / f"{name}.mtx").write_text("\n".join(lines))
    write_inp(tmp_path, beam)
    same_body(tmp_path, beam, "format: abaqus, stiffness: K.mtx, mass: M.mtx, nodes: mesh.inp")


def test_calculix_matrix_storage(beam, tmp_path):
    """.dof: node.direction of each row; .sti, .mas: row, column, value of one triangle."""
    (tmp_path / "job.dof").write_text("".join(f"{node}.{axis}\n" for node, axis in labels()))
    for suffix, matrix in zip(("sti", "mas"), beam[1:], strict=True):
        (tmp_path / f"job.{suffix}").write_text("".join(f"{j + 1} {i + 1} {v:20.13e}\n" for i, j, v in entries(matrix)))
    write_inp(tmp_path, beam)
    files = "stiffness: job.sti, mass: job.mas, freedoms: job.dof, nodes: mesh.inp"
    same_body(tmp_path, beam, f"format: calculix, {files}")


@pytest.mark.parametrize("freedoms", [False, True])
def test_matrix_market(beam, tmp_path, freedoms):
    order = np.arange(30) if freedoms else np.argsort(np.repeat(NUMBERS, 6), kind="stable")
    for name, matrix in zip("km", beam[1:], strict=True):
        scipy.io.mmwrite(tmp_path / f"{name}.mtx", sp.coo_array(matrix[np.ix_(order, order)]), symmetry="symmetric")
    write_nodes(tmp_path, beam)
    words = ("x", "y", "z", "rx", "ry", "rz")
    (tmp_path / "rows.csv").write_text("node,direction\n" + "".join(f"{n},{words[a - 1]}\n" for n, a in labels()))
    table = ", freedoms: rows.csv" if freedoms else ""
    same_body(tmp_path, beam, f"format: matrix-market, stiffness: k.mtx, mass: m.mtx, nodes: nodes.csv{table}")


def dmig(name, matrix, *, wide):
    """DMIG entries of a symmetric matrix: a header, then a column entry with its rows as continuations."""
    at = labels()
    lines = [f"DMIG    {name:<8}{0:8d}{6:8d}{2 if wide else 1:8d}{0:8d}"]
    for j in range(len(matrix)):
        rows = [i for i in range(j, len(matrix)) if matrix[i, j] != 0.0]
        if not rows:
            continue
        if wide:
            lines.append(f"DMIG*   {name:<16}{at[j][0]:16d}{at[j][1]:16d}{'':16}")
            for i in rows:
                value = f"{matrix[i, j]:.9E}".replace("E", "D")
                lines.append(f"*       {at[i][0]:16d}{at[i][1]:16d}{value:>16}")
        else:
            fields = [f"{node},{axis},{matrix[i, j]:.16E},," for i in rows for node, axis in (at[i],)]
            lines.append(f"DMIG,{name},{at[j][0]},{at[j][1]},,{fields[0]}")
            lines += [f",{first}{second}" for first, second in zip(fields[1::2], [*fields[2::2], ""], strict=False)]
    return "\n".join(lines) + "\n"


def bulk(beam):
    """GRID entries of 16 columns a field."""
    lines = ["$ nodes"]
    for node, x in zip(NUMBERS, beam[0].position, strict=True):
        lines.append(f"GRID*   {node:16d}{'':16}{x[0]:16.9f}{x[1]:16.9f}\n*       {x[2]:16.9f}")
    return "\n".join(lines) + "\n"


def test_nastran_punch_file_free_format(beam, tmp_path):
    (tmp_path / "model.pch").write_text(dmig("KAAX", beam[1], wide=False) + dmig("MAAX", beam[2], wide=False))
    (tmp_path / "nodes.bdf").write_text(bulk(beam))
    same_body(tmp_path, beam, "format: nastran, stiffness: model.pch, nodes: nodes.bdf")


def test_nastran_punch_file_large_fields(beam, tmp_path):
    """Ten digits only, as Nastran punches them."""
    (tmp_path / "model.pch").write_text(dmig("KAAX", beam[1], wide=True) + "$ end\n" + dmig("MAAX", beam[2], wide=True))
    found = read_dmig(tmp_path / "model.pch")
    assert set(found) == {"KAAX", "MAAX"}
    for name, matrix in zip(("KAAX", "MAAX"), beam[1:], strict=True):
        got = found[name].ordered(labels()).toarray()
        np.testing.assert_allclose(got, matrix, atol=1e-9 * np.abs(matrix).max())
    numbers = read_mesh(_written(tmp_path / "nodes.bdf", bulk(beam))).numbers
    np.testing.assert_array_equal(numbers, np.sort(NUMBERS))


def _written(path, text):
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    ("text", "value"), [("1.5", 1.5), ("1.5D+06", 1.5e6), ("1.5+6", 1.5e6), ("-2.-3", -2e-3), ("-1.5E2", -150)]
)
def test_numbers_of_nastran(text, value):
    assert fortran_number(text) == value


def op4_text(name, matrix, *, sparse):
    """OUTPUT4 with FORM=FORMATTED: header 4I8,A8; columns 3I8; values 1P,3E23.16."""
    n = len(matrix)
    out = [f"{n:8d}{n:8d}{6:8d}{2:8d}{name:<8}1P,3E23.16"]

    def values(numbers):
        texts = [f"{value:23.16E}" for value in numbers]
        return ["".join(texts[k : k + 3]) for k in range(0, len(texts), 3)]

    for j in range(n):
        rows = np.flatnonzero(matrix[:, j])
        if not sparse:
            part = matrix[rows[0] : rows[-1] + 1, j]
            out += [f"{j + 1:8d}{rows[0] + 1:8d}{2 * len(part):8d}", *values(part)]
            continue
        strings = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1)
        out.append(f"{j + 1:8d}{0:8d}{sum(1 + 2 * len(each) for each in strings):8d}")
        for each in strings:
            out += [f"{65536 * (2 * len(each) + 1) + each[0] + 1:12d}", *values(matrix[each, j])]
    return "\n".join([*out, f"{n + 1:8d}{1:8d}{1:8d}", f"{1.0:23.16E}"]) + "\n"


def op4_binary(name, matrix, *, sparse, big=False, order="<"):
    n = len(matrix)

    def record(content):
        return struct.pack(f"{order}i", len(content)) + content + struct.pack(f"{order}i", len(content))

    out = record(struct.pack(f"{order}4i", n, -n if big else n, 6, 2) + f"{name:<8}".encode())
    for j in range(n):
        rows = np.flatnonzero(matrix[:, j])
        if not sparse:
            part = matrix[rows[0] : rows[-1] + 1, j]
            out += record(
                struct.pack(f"{order}3i", j + 1, rows[0] + 1, 2 * len(part)) + part.astype(f"{order}f8").tobytes()
            )
            continue
        body = b""
        for each in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1):
            length = 2 * len(each)
            words = (length + 1, each[0] + 1) if big else (65536 * (length + 1) + each[0] + 1,)
            body += struct.pack(f"{order}{len(words)}i", *words) + matrix[each, j].astype(f"{order}f8").tobytes()
        out += record(struct.pack(f"{order}3i", j + 1, 0, len(body) // 4) + body)
    return out + record(struct.pack(f"{order}3i", n + 1, 1, 2) + struct.pack(f"{order}d", 1.0))


@pytest.mark.parametrize("sparse", [False, True])
def test_op4_text(beam, tmp_path, sparse):
    path = _written(
        tmp_path / "m.op4", op4_text("KAA", beam[1], sparse=sparse) + op4_text("MAA", beam[2], sparse=sparse)
    )
    found = read_op4(path)
    for name, matrix in zip(("KAA", "MAA"), beam[1:], strict=True):
        np.testing.assert_array_equal(found[name].matrix.toarray(), matrix)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize(("sparse", "big"), [(False, False), (True, False), (True, True)])
def test_op4_binary(beam, tmp_path, sparse, big, order):
    content = b"".join(
        op4_binary(name, matrix, sparse=sparse, big=big, order=order)
        for name, matrix in zip(("KAA", "MAA"), beam[1:], strict=True)
    )
    (tmp_path / "m.op4").write_bytes(content)
    for name, matrix in zip(("KAA", "MAA"), beam[1:], strict=True):
        np.testing.assert_array_equal(read_op4(tmp_path / "m.op4")[name].matrix.toarray(), matrix)


def test_body_from_op4(beam, tmp_path):
    _written(tmp_path / "m.op4", op4_text("KAA", beam[1], sparse=True) + op4_text("MAA", beam[2], sparse=True))
    (tmp_path / "rows.csv").write_text("node,direction\n" + "".join(f"{n},{a}\n" for n, a in labels()))
    (tmp_path / "nodes.bdf").write_text(bulk(beam))
    same_body(tmp_path, beam, "format: op4, stiffness: m.op4, nodes: nodes.bdf, freedoms: rows.csv")


def test_units_of_files_are_turned_into_si(beam, tmp_path):
    """The model in mm, t and N: translations N/mm, turns N mm; masses t."""
    size = np.where(np.tile(np.arange(6) > 2, 5), 1e3, 1.0)
    K = beam[1] * 1e-3 * np.outer(size, size)  # N/m is 1e-3 N/mm; N m is 1e3 N mm
    M = beam[2] * 1e-3 * np.outer(size, size)
    for name, matrix in zip("km", (K, M), strict=True):
        scipy.io.mmwrite(tmp_path / f"{name}.mtx", sp.coo_array(matrix), precision=16)
    (tmp_path / "rows.csv").write_text("node,direction\n" + "".join(f"{n},{a}\n" for n, a in labels()))
    write_nodes(tmp_path, beam, scale=1e3)
    files = "stiffness: k.mtx, mass: m.mtx, nodes: nodes.csv, freedoms: rows.csv, units: {length: mm, mass: t}"
    same_body(tmp_path, beam, f"format: matrix-market, {files}")


@pytest.fixture(scope="module")
def solid(tmp_path_factory):
    """A block of tetrahedra as CalculiX would write it, in mm, t, s and with numbers from 101."""
    needs("gmsh")
    folder = tmp_path_factory.mktemp("solid")
    model, _ = source_model(parse_model(block(length=0.4, size=0.1)), lambda *_: None)
    K, M = sp.coo_array(sp.tril(model.stiffness)), sp.coo_array(sp.tril(model.mass.matrix))
    for suffix, matrix in (("sti", K), ("mas", M)):
        lines = [f"{i + 1} {j + 1} {v * 1e-3:.16e}" for i, j, v in zip(*matrix.coords, matrix.data, strict=True)]
        (folder / f"job.{suffix}").write_text("\n".join(lines))
    ids = np.arange(len(model.position)) + 101
    (folder / "job.dof").write_text("\n".join(f"{n}.{a}" for n in ids for a in (1, 2, 3)))
    lines = [
        "*NODE",
        *(f"{n}, {x[0]:.12g}, {x[1]:.12g}, {x[2]:.12g}" for n, x in zip(ids, model.position * 1e3, strict=True)),
    ]
    lines.append("*ELEMENT, TYPE=C3D10, ELSET=ALL")
    lines += [f"{e + 1}, " + ", ".join(map(str, ids[nodes])) for e, nodes in enumerate(model.solids)]
    root = ids[np.abs(model.position[:, 0]) < 1e-9]
    lines += ["*NSET, NSET=ROOT", *(", ".join(map(str, root[k : k + 8])) for k in range(0, len(root), 8))]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "210000., 0.3", "*DENSITY", "7.85e-9"]
    (folder / "mesh.inp").write_text("\n".join(lines) + "\n")
    return folder


FILES = "format: calculix, stiffness: job.sti, mass: job.mas, freedoms: job.dof, nodes: mesh.inp, units: {length: mm, mass: t}"


def test_solid_of_calculix_is_that_of_nivel(solid):
    """Mesh, node set, material and stress come from the .inp file; exact invariants from the translational mass."""
    body, _ = text_model(solid, FILES, interfaces="root: {set: ROOT}")
    plane = "root: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}"
    expected, _ = reduced(block(length=0.4, size=0.1, interfaces=plane, reduction="modes: 6"))
    np.testing.assert_allclose(body.frequencies, expected.frequencies, rtol=1e-6)
    for name in ("I1", "I2", "I7"):
        np.testing.assert_allclose(getattr(body.invariants, name), getattr(expected.invariants, name), atol=1e-9)
    np.testing.assert_allclose(np.abs(body.invariants.I9), np.abs(expected.invariants.I9), atol=1e-5)
    from nivel.flexible.body.recovery import stress, von_mises

    q = np.zeros((2, len(body.eigenvalues)))
    q[0, 4], q[1, 4] = 1e-3, 1e-3
    mine, theirs = (von_mises(stress(each, q[:1]))[0] for each in (body, expected))
    np.testing.assert_allclose(mine, theirs, rtol=1e-3, atol=1e-4 * theirs.max())


def fault_of(folder, matrices=FILES, interfaces=""):
    with pytest.raises(ModelError) as caught:
        text_model(folder, matrices, interfaces=interfaces)
    return str(caught.value)


def changed(solid, folder, name, change):
    """A copy of the files in which `name` is changed."""
    for path in Path(solid).iterdir():
        text = path.read_text()
        (folder / path.name).write_text(change(text) if path.name == name else text)
    return folder


def test_hole_in_the_numbering_is_named(solid, tmp_path):
    folder = changed(
        solid,
        tmp_path,
        "mesh.inp",
        lambda text: "\n".join(line for line in text.splitlines() if not line.startswith("120, ")),
    )
    message = fault_of(folder)
    assert "120" in message
    assert "hole after 119 (the next is 121)" in message
    assert "take the mesh that the matrices were made with" in message


def test_hole_where_rows_are_counted(beam, tmp_path):
    for name, matrix in zip("km", beam[1:], strict=True):
        scipy.io.mmwrite(tmp_path / f"{name}.mtx", sp.coo_array(matrix[:24, :24]))
    write_nodes(tmp_path, beam)
    message = fault_of(tmp_path, "format: matrix-market, stiffness: k.mtx, mass: m.mtx, nodes: nodes.csv")
    assert "24 rows" in message
    assert "hole after 5 (the next is 10) and 2 more" in message
    assert "`freedoms`" in message


def test_matrix_that_is_not_symmetric_is_refused(beam, tmp_path):
    K = beam[1].copy()
    K[3, 8] += 0.1 * np.abs(K).max()
    for name, matrix in zip("km", (K, beam[2]), strict=True):
        scipy.io.mmwrite(tmp_path / f"{name}.mtx", sp.coo_array(matrix), symmetry="general")
    write_nodes(tmp_path, beam)
    message = fault_of(tmp_path, "format: matrix-market, stiffness: k.mtx, mass: m.mtx, nodes: nodes.csv")
    assert "stiffness matrix is not symmetric" in message
    assert "(4, 9)" in message or "(9, 4)" in message


@pytest.mark.parametrize(("factor", "words"), [(1e9, "too large"), (1e-9, "too small")])
def test_mass_off_by_a_billion_is_named(solid, tmp_path, factor, words):
    def scaled(text):
        return "\n".join(
            f"{line.rsplit(' ', 1)[0]} {float(line.rsplit(' ', 1)[1]) * factor:.16e}" for line in text.splitlines()
        )

    message = fault_of(changed(solid, tmp_path, "job.mas", scaled))
    assert "do not fit together" in message
    assert words in message
    assert "1e9" in message
    assert "units:" in message


def test_forgotten_units_are_named(solid):
    """Everything in mm and t read as SI: waves a thousand times too fast."""
    message = fault_of(solid, FILES.replace(", units: {length: mm, mass: t}", ""))
    assert "Lengths look like millimetres" in message


def test_expected_mass_is_compared(solid):
    with pytest.raises(ModelError, match=r"weighs 31.4 kg and 0.0314 kg were expected, 1e\+03 times"):
        text_model(solid, FILES, interfaces="", more="expected_mass: 31.4 g")


def test_supports_are_named(beam, tmp_path):
    for text, add in (("held by boundary conditions", 1e36), ("holds the body to the ground", 1e3)):
        K = beam[1].copy()
        K[:3, :3] += add * np.eye(3)
        for name, matrix in zip("km", (K, beam[2]), strict=True):
            scipy.io.mmwrite(tmp_path / f"{name}.mtx", sp.coo_array(matrix), symmetry="symmetric")
        write_nodes(tmp_path, beam)
        (tmp_path / "rows.csv").write_text("node,direction\n" + "".join(f"{n},{a}\n" for n, a in labels()))
        message = fault_of(
            tmp_path, "format: matrix-market, stiffness: k.mtx, mass: m.mtx, nodes: nodes.csv, freedoms: rows.csv"
        )
        assert text in message
        assert "10" in message


def test_inverted_elements_are_named(solid, tmp_path):
    def swapped(text):
        lines = text.splitlines()
        at = next(k for k, line in enumerate(lines) if line.startswith("*ELEMENT")) + 1
        parts = lines[at].split(", ")
        parts[1], parts[2] = parts[2], parts[1]
        lines[at] = ", ".join(parts)
        return "\n".join(lines)

    message = fault_of(changed(solid, tmp_path, "mesh.inp", swapped))
    assert "turned inside out" in message


@pytest.mark.parametrize(
    ("name", "change", "words"),
    [
        ("job.dof", lambda text: text.replace("101.1", "101.7", 1), "job.dof:1:1"),
        ("job.dof", lambda text: text.replace("101.2", "101.1", 1), "stands twice"),
        ("job.dof", lambda text: "\n".join(text.splitlines()[:-3]), "different runs"),
        ("job.sti", lambda text: "hello\n" + text, "row, column, value"),
        ("mesh.inp", lambda text: text.replace("*NODE\n101, ", "*NODE\nx101, ", 1), "mesh.inp:2:1"),
        (
            "mesh.inp",
            lambda text: text.replace("102, ", "101, ", 1),
            "elements of the mesh have nodes that do not exist: 102",
        ),
    ],
)
def test_faults_of_files_have_their_place(solid, tmp_path, name, change, words):
    assert words in fault_of(changed(solid, tmp_path, name, change))


def test_missing_files_and_names(beam, tmp_path, solid):
    assert "there is no file" in fault_of(solid, FILES.replace("job.sti", "jbo.sti"))
    assert "`mass` is missing" in fault_of(solid, FILES.replace("mass: job.mas, ", ""))
    assert ".dof" in fault_of(solid, FILES.replace("freedoms: job.dof, ", ""))
    (tmp_path / "model.pch").write_text(dmig("KXX", beam[1], wide=False) + dmig("OTHER", beam[2], wide=False))
    (tmp_path / "nodes.bdf").write_text(bulk(beam))
    assert "Give `mass_name`" in fault_of(tmp_path, "format: nastran, stiffness: model.pch, nodes: nodes.bdf")
    assert "there are KXX, OTHER" in fault_of(
        tmp_path, "format: nastran, stiffness: model.pch, nodes: nodes.bdf, mass_name: MXX"
    )


def test_interface_on_a_node_set_that_does_not_exist(solid):
    assert "did you mean `ROOT`?" in fault_of(solid, interfaces="root: {set: ROOTS}")
    message = fault_of(solid, interfaces="root: {node: 7}")
    assert "no node 7" in message
    assert "from 101 to" in message


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"hello",
        b"\x18\x00\x00\x00",
        b"       3       3       6       2KAA     1P,3E23.16\n",
        b"       3       3       6       2KAA     1P,3E23.16\n       1       1       2\n",
        b"       3       3       6       2KAA     1P,3E23.16\n       1       1 9999999\n 1.0\n",
    ],
)
def test_what_is_no_op4_file(tmp_path, content):
    (tmp_path / "m.op4").write_bytes(content)
    with pytest.raises(FormatError):
        read_op4(tmp_path / "m.op4")


def test_complex_and_mixed_files(tmp_path):
    path = _written(
        tmp_path / "m.pch", "DMIG    KAAX           0       6       3       0\nDMIG,KAAX,1,1,,1,1,2.0,0.0\n"
    )
    with pytest.raises(FormatError, match=r"line 1: .*complex"):
        read_dmig(path)
    path = _written(tmp_path / "m.mtx", "1 1 2.0\n1,1,2,2,3.0\n")
    with pytest.raises(FormatError, match="line 2"):
        read_abaqus(path)
    path = _written(tmp_path / "b.pch", "DMIG,K,0,6,1,0\nDMIG,K,1,1,,1,2,3.0\nDMIG,K,1,2,,1,1,3.0\n")
    with pytest.raises(FormatError, match="one triangle only"):
        read_dmig(path)
