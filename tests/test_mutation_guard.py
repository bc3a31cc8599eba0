"""The guard of the tests: its mutations are what they are said to be, and its lists name files that are there."""

import ast
from pathlib import Path

import mutations
from mutation_guard import COVER, NAMED, PACKAGE, chosen_cases, covered_by, named_cases

TESTS = Path(__file__).parent
SOURCE = '''
@leaf
def f(x, n):
    """A sum - of 2.0 terms."""
    total = (x[0] + 0.5) * n[k, 1]
    if total <= -1e-30:
        return total
    return x[1] - 2.0 / (total)


def not_compiled(x):
    return x + 1.0
'''


def test_signs_operators_indices_and_numbers_of_compiled_functions_are_changed(tmp_path):
    (tmp_path / "a.py").write_text(SOURCE, encoding="utf-8")
    found = {(each.kind, each.number, each.after) for each in mutations.mutations(tmp_path, "a.py")}
    assert found == {
        ("sign", 5, "total = (x[0] - 0.5) * n[k, 1]"),
        ("operator", 5, "total = (x[0] + 0.5) / n[k, 1]"),
        ("index", 5, "total = (x[1] + 0.5) * n[k, 1]"),
        ("index", 5, "total = (x[0] + 0.5) * n[k, 0]"),
        ("constant", 5, "total = (x[0] + 0.75) * n[k, 1]"),
        ("operator", 6, "if total > -1e-30:"),
        ("sign", 8, "return x[1] + 2.0 / (total)"),
        ("operator", 8, "return x[1] - 2.0 * (total)"),
        ("index", 8, "return x[0] - 2.0 / (total)"),
        ("constant", 8, "return x[1] - 3.0 / (total)"),
    }


def test_a_seed_chooses_the_same_lines_of_all_kinds_and_each_changes_its_line_alone():
    found = mutations.chosen(PACKAGE, 12, seed=3)
    assert found == mutations.chosen(PACKAGE, 12, seed=3) != mutations.chosen(PACKAGE, 12, seed=4)
    assert {each.kind for each in found} == {"sign", "operator", "index", "constant"}
    for each in found:
        before = (PACKAGE / each.file).read_text(encoding="utf-8").splitlines()
        after = mutations.mutated(PACKAGE, each)
        ast.parse(after)
        changed = [k for k, lines in enumerate(zip(before, after.splitlines(), strict=True), 1) if len(set(lines)) > 1]
        assert changed == [each.number]


def test_tests_are_known_for_every_kernel_and_are_there():
    for folder in mutations.FOLDERS:
        for path in (PACKAGE / folder).rglob("*.py"):
            assert covered_by(path.relative_to(PACKAGE).as_posix())
    for name in {each for tests in (*COVER.values(), *(one.tests for one in NAMED)) for each in tests}:
        assert (TESTS / name).exists(), name


def test_lines_spoilt_by_hand_are_there_once_and_remain_programs():
    for each in named_cases():
        ast.parse(each.text)
    assert len(list(chosen_cases(2, seed=1))) == 2
