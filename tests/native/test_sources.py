"""The digest of an entry's sources changes with every module that its module imports, and with no other."""

import pytest

from nivel.native import sources

FILES = {
    "pack/__init__.py": "",
    "pack/a.py": "from pack.b import x\nfrom pack import c\n",
    "pack/b.py": "x = 1\n",
    "pack/c.py": "def f():\n    from pack.deep.d import y\n    return y\n",
    "pack/deep/__init__.py": "",
    "pack/deep/d.py": "y = 2\n",
    "pack/other.py": "z = 3\n",
}


@pytest.fixture
def digest(tmp_path, monkeypatch):
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(exist_ok=True, parents=True)
        (tmp_path / name).write_text(text)
    monkeypatch.syspath_prepend(tmp_path)

    def of(module, **changes):
        for name, text in changes.items():
            (tmp_path / "pack" / f"{name.replace('_', '/')}.py").write_text(text)
        sources.look_again()
        return sources.fingerprint(module)

    yield of
    sources.look_again()


@pytest.mark.parametrize("module", ["a", "b", "c", "deep_d"])
def test_it_follows_all_imports(digest, module):
    assert digest("pack.a") != digest("pack.a", **{module: "x = y = f = 5\n"})


def test_it_ignores_the_rest(digest):
    assert digest("pack.a") == digest("pack.a", other="z = 4\n")
    assert digest("pack.b") == digest("pack.b", c="x = 4\n")


def test_what_was_installed_into_a_folder_is_not_looked_into(digest, tmp_path, monkeypatch):
    """`pip install --target FOLDER` leaves a `.dist-info` beside what it installs."""
    (tmp_path / "target" / "brought-1.0.dist-info").mkdir(parents=True)
    (tmp_path / "target" / "brought.py").write_text("from . import relative\n")
    monkeypatch.syspath_prepend(tmp_path / "target")
    assert digest("pack.a", b="import brought\n") != digest("pack.a", b="x = 1\n")
    assert "brought" not in sources.modules("pack.a")


def test_kernels_depend_on_the_way_they_are_translated():
    found = sources.modules("nivel.kernels.output.observe")
    assert "nivel.native.with_numba.views" in found
    assert not {"nivel.native.store", "nivel.integrate.radau.radau"} & set(found)


def test_modules_outside_the_package_import_by_full_names(digest):
    assert digest("pack.a", b="import pack.other as o; x = 1\n") != digest("pack.a", other="z = 5\n")
    with pytest.raises(ImportError, match=r"line 2.*full names"):
        digest("pack.a", b="x = 1\nfrom . import other\n")


def test_imports_of_the_package_are_found_without_parsing_it():
    for path in sources.modules("nivel.integrate.loop.loop").values():
        assert set(sources.imports(path.read_text(encoding="utf-8"))) <= set(sources._imported(path))
