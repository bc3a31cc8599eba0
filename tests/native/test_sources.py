"""The digest of an entry's sources changes with everything that its function names, directly or not, and with nothing else."""

import inspect
from types import ModuleType

import pytest

from nivel.analysis.plan.compilation import all_entries
from nivel.native import sources
from nivel.native.entry import Entry
from nivel.native.function import Function
from nivel.native.sources import outline_of

FILES = {
    "pack/__init__.py": "",
    "pack/a.py": "from pack.b import x\nfrom pack import c\n",
    "pack/b.py": "x = 1\n",
    "pack/c.py": "def f():\n    from pack.deep.d import y\n    return y\n",
    "pack/deep/__init__.py": "",
    "pack/deep/d.py": "y = 2\n",
    "pack/other.py": "z = 3\n",
    "pack/spring.py": """
from pack.b import x as preload
from pack.other import z as words
import pack.c as c

COUNT = 2
TABLE = [1]
TABLE.append(COUNT)


class Record:
    text = words


def force(stretch):
    return COUNT * stretch + preload


def number():
    from pack.deep.d import y

    return y


def apply(stretch):
    return force(stretch) + c.f() + number()


def listed():
    return TABLE
""",
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


def edited(old, new):
    text = FILES["pack/spring.py"]
    assert old in text
    return text.replace(old, new)


@pytest.mark.parametrize(
    "changes",
    [
        {"spring": edited("COUNT = 2", "COUNT = 3")},
        {"spring": edited("COUNT * stretch", "COUNT + stretch")},
        {"spring": edited("force(stretch) +", "2 * force(stretch) +")},
        {"spring": edited("from pack.b import x as preload", "from pack.b import w as preload")},
        {"spring": edited("from pack.deep.d import y", "from pack.b import x as y")},
        {"b": "x = 2\n"},
        {"c": "def f():\n    return 3\n"},
        {"deep_d": "y = 3\n"},
    ],
)
def test_it_follows_what_a_function_names(digest, changes):
    assert digest("pack.spring:apply.code") != digest("pack.spring:apply.code", **changes)


@pytest.mark.parametrize(
    "changes",
    [
        {"spring": edited("text = words", "text = 'other words'")},
        {"spring": edited("return TABLE", "return TABLE[0]")},
        {"spring": edited("\n\n\ndef force", "\n\n\nclass Another:\n    pass\n\n\ndef force")},
        {"b": "x = 1\nv = 4\n"},
        {"c": FILES["pack/c.py"] + "\n\ndef g():\n    return 2\n"},
        {"other": "z = 4\n"},
    ],
)
def test_it_ignores_what_stands_beside_a_function(digest, changes):
    assert digest("pack.spring:apply.code") == digest("pack.spring:apply.code", **changes)


def test_it_follows_statements_that_change_a_constant(digest):
    assert digest("pack.spring:listed") != digest("pack.spring:listed", spring=edited("TABLE.append", "TABLE.remove"))
    assert digest("pack.spring:listed") != digest("pack.spring:listed", spring=edited("COUNT = 2", "COUNT = 1"))


ROOMS = ("kernels", "integrate", "motion", "native", "elements")


def test_machine_code_depends_on_no_record():
    """Nothing of a room in which no function is compiled; of `elements` on no class but those of rows, whose fields are places,
    and on the phases of circuits, which decorators name."""
    for entry in all_entries():
        for module, text in sources.parts(entry.name).items():
            assert module.split(".")[1] in ROOMS, (entry.name, module)
            if module.startswith("nivel.elements."):
                classes = [line for line in text.decode().splitlines() if line.startswith("class ")]
                named = [line for line in classes if not line.endswith("(Row):")]
                assert module in ("nivel.elements.rows", "nivel.elements.circuits.kind") or not named, (
                    entry.name,
                    classes,
                )


def reached(function, found):
    """The Python functions that a compiled one names, directly or not."""
    if function in found:
        return
    found.add(function)
    for cell in function.__closure__ or ():
        if isinstance(cell.cell_contents, Function | Entry):
            reached(cell.cell_contents.py_func, found)
    for name in {name for code in _codes(function.__code__) for name in code.co_names}:
        value = function.__globals__.get(name)
        for each in (value, *(vars(value).values() if isinstance(value, ModuleType) else ())):
            if isinstance(each, Function | Entry) and (
                each is value or each.py_func.__name__ in function.__code__.co_names
            ):
                reached(each.py_func, found)


def _codes(code):
    yield code
    for each in code.co_consts:
        if inspect.iscode(each):
            yield from _codes(each)


def test_every_function_that_is_compiled_stands_in_what_its_entry_depends_on():
    """By what Python finds in memory, whatever the files look like."""
    for entry in all_entries():
        texts = sources.parts(entry.name)
        functions = set()
        reached(entry.py_func, functions)
        for function in functions:
            module = str(inspect.getmodule(function.__code__).__name__)
            if module.startswith("nivel.elements."):
                assert inspect.getsource(function) in texts[module].decode(), (entry.name, function)
            else:
                assert module in texts, (entry.name, function)


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
    assert digest("pack.a", b="import pack.other as o; x = o.z\n") != digest("pack.a", other="z = 5\n")
    with pytest.raises(ImportError, match=r"line 2.*full names"):
        digest("pack.a", b="x = 1\nfrom . import other\n")


def test_imports_of_the_package_are_found_without_parsing_it():
    for path in sources.modules("nivel.integrate.loop.loop").values():
        parsed = {target.module for uses in outline_of(path).uses for target in uses.imported.values()}
        assert parsed <= {need.module for need in sources._imported(path)}
