"""The comparison of seconds of tests names what grew, whatever the speed of the machine."""

import pytest

import seconds

BEFORE = {"a.py": 30.0, "b.py": 60.0, "c.py": 4.0, "d.py": 2.0, "e.py": 9.0, "f.py": 5.0, "g.py": 7.0}


@pytest.mark.parametrize("factor", [0.5, 1.0, 3.0])
def test_a_slower_machine_is_no_growth(factor):
    now = {name: factor * value for name, value in BEFORE.items()}
    assert seconds.speed(now, BEFORE) == pytest.approx(factor)
    assert not seconds.grown(now, BEFORE)


def test_files_that_grew_and_new_ones_are_named_the_most_grown_first():
    now = {**BEFORE, "b.py": 75.0, "new.py": 20.0, "c.py": 9.0}
    assert [name for name, *_ in seconds.grown(now, BEFORE)] == ["new.py", "b.py"]
    assert "grew from 60.0 to 75.0 s: b.py" in "\n".join(seconds.told(now, BEFORE))
