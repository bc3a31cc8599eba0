"""FMU files that would do harm: refused while they are read, with a sentence."""

import io
import stat
import zipfile

import pytest

import nivel
from nivel.files import fmu_file
from nivel.files.fmu_file import read_description, unpack
from units import description


def packed(entries):
    """An archive of (name or ZipInfo, content)."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries:
            archive.writestr(name, content)
    return out.getvalue()


GOOD = ("modelDescription.xml", description())


def link(name, target):
    entry = zipfile.ZipInfo(name)
    entry.external_attr = (stat.S_IFLNK | 0o777) << 16
    return entry, target


def bomb():
    """A kilobyte that says it unpacks to a gigabyte."""
    content = bytearray(packed([GOOD, ("resources/zeros", bytes(1000))]))
    at = content.rindex(b"PK\x01\x02")
    content[at + 24 : at + 28] = (10**9).to_bytes(4, "little")
    return bytes(content)


def damaged():
    """Its first bytes of compressed content are overwritten."""
    content = bytearray(packed([GOOD]))
    at = content.index(b"modelDescription.xml") + len("modelDescription.xml")
    content[at : at + 40] = bytes(range(200, 240))
    return bytes(content)


ENTITIES = '<!DOCTYPE lolz [<!ENTITY lol "lol"><!ENTITY lol2 "&lol;&lol;&lol;">]>' + description().replace(
    'modelName="unit"', 'modelName="&lol2;"'
)
OUTSIDE = '<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]>' + description().replace("unit", "&b;", 1)
DEEP = "<a>" * 1000 + "</a>" * 1000


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (packed([GOOD, ("../outside.so", "x")]), "`../outside.so` in the archive leads out of its folder"),
        (packed([GOOD, ("/etc/x", "x")]), "`/etc/x` in the archive leads out of its folder"),
        (packed([GOOD, ("a/../../x", "x")]), "leads out of its folder"),
        (packed([GOOD, ("C:/x", "x")]), "leads out of its folder"),
        (packed([GOOD, ("a\\..\\x", "x")]), "leads out of its folder"),
        (packed([GOOD, link("binaries", "/usr/lib")]), "is no file, but a link or a device"),
        (packed([GOOD, ("a/b", "x"), ("a//b", "y")]), "stands twice in the archive"),
        (packed([GOOD, ("a" * 300, "x")]), "longer than the name of a file can be"),
        (packed([GOOD, ("a", "x"), ("a/b", "y")]), "`a/b` in the archive is a file and a folder"),
        (packed([GOOD, ("a/b", "x"), ("a", "y")]), "`a` in the archive is a file and a folder"),
        (packed([GOOD, ("a/", ""), ("a/b", "y")])[:-30], "it is not a zip archive, or it is damaged"),
        (damaged(), "`modelDescription.xml` in the archive cannot be read"),
        (bomb(), "unpacked the archive has 1000 MB; up to 500 MB are unpacked"),
        (packed([("modelDescription.xml", ENTITIES)]), "a document type"),
        (packed([("modelDescription.xml", OUTSIDE)]), "a document type"),
        (packed([("modelDescription.xml", DEEP)]), "elements stand inside each other"),
        (packed([("modelDescription.xml", "<a")]), "this is no XML"),
        (packed([("modelDescription.xml", "<a/>")]), "FMUs of FMI 2.0 and 3.0 are read"),
        (packed([("a", "x")]), "there is no modelDescription.xml in it"),
        (b"no archive", "it is not a zip archive"),
        (packed([GOOD])[:-30], "it is not a zip archive, or it is damaged"),
        (
            packed([("modelDescription.xml", description().replace("CoSimulation", "ModelExchange"))]),
            "offers no co-simulation",
        ),
        (
            packed(
                [("modelDescription.xml", description().replace('modelIdentifier="unit"', 'modelIdentifier="../x"'))]
            ),
            "cannot be the name of the binaries",
        ),
        (
            packed(
                [("modelDescription.xml", description().replace('valueReference="3"', f'valueReference="{2**40}"'))]
            ),
            "a value reference, a whole number",
        ),
        (packed([("modelDescription.xml", description().replace('name="v"', 'name="x"'))]), "a name of its own"),
    ],
)
def test_it_is_refused(content, said, tmp_path):
    with pytest.raises(nivel.ModelError) as refused:
        read_description(content, "unit.fmu")
    assert said in str(refused.value)
    if "archive" in said:
        with pytest.raises(nivel.ModelError):
            unpack(content, "unit.fmu", tmp_path / "unit")
    assert not any(tmp_path.parent.glob("outside*"))


def test_too_many_files_are_refused(monkeypatch):
    monkeypatch.setattr(fmu_file, "MOST_FILES", 20)
    content = packed([GOOD, *((f"resources/{k}", "") for k in range(30))])
    with pytest.raises(nivel.ModelError, match="the archive has 31 files; up to 20 are unpacked"):
        read_description(content, "unit.fmu")


def test_a_file_that_is_longer_than_the_archive_says_is_refused(tmp_path):
    """The size stands in the directory of the archive, and bounds what is unpacked."""
    content = bytearray(packed([GOOD, ("resources/zeros", bytes(10**6))]))
    at = content.rindex(b"PK\x01\x02")
    content[at + 24 : at + 28] = (1000).to_bytes(4, "little")
    with pytest.raises(nivel.ModelError, match=r"`resources/zeros` in the archive cannot be read"):
        unpack(bytes(content), "unit.fmu", tmp_path)
    assert not (tmp_path / "resources" / "zeros").exists()


def test_a_good_one_is_read_and_unpacked(tmp_path):
    content = packed([GOOD, ("resources/a/b.txt", "text")])
    found = read_description(content, "unit.fmu")
    assert (found.version, found.identifier, found.token, found.keeps_states) == (3, "unit", "unit", True)
    assert found.variables["plant.i[1]"].reference == 4
    unpack(content, "unit.fmu", tmp_path)
    assert (tmp_path / "resources" / "a" / "b.txt").read_text() == "text"
