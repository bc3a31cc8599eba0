"""Two faults in one element are both told, and in one file all of them: nobody mends one only to meet the next."""

from itertools import combinations, pairwise

import pytest
from base_machine import FULL, write_files
from test_faults_of_elements import FAULTS

from nivel.errors import ModelError
from nivel.files import parse_machine

# what the element is, or is to be: without it nothing is known of the rest
BASIC = {
    "unknown coupling",
    "unknown force",
    "unknown friction",
    "unknown joint",
    "driver of nothing",
    "joint and driver of one name",
    "sensor of an unknown force",
}
# only a spring that has a stiffness needs a free length, and whether it has one is not known
FOLLOWS = ("spring without free length", "stiffness is a force")
UNIQUE = {name: (FULL.index(old), old, new) for name, (old, new, *_) in FAULTS.items() if FULL.count(old) == 1}


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    """The places of the faults of the full machine with some changes."""
    file = str(write_files(tmp_path_factory.mktemp("full")))

    def read(*names):
        text = FULL
        for at, old, new in sorted((UNIQUE[name] for name in names), reverse=True):
            text = text[:at] + new + text[at + len(old) :]
        with pytest.raises(ModelError) as caught:
            parse_machine(text, file, allow_code=True)
        return {fault.path for fault in caught.value.faults}

    return read


def apart(names):
    places = sorted((UNIQUE[name][0], UNIQUE[name][0] + len(UNIQUE[name][1])) for name in names)
    return all(end <= start for (_, end), (start, _) in pairwise(places))


def test_two_faults_in_one_element_are_both_told(told):
    alone = {name: told(name) for name in UNIQUE if name not in BASIC}
    element = {name: ".".join(FAULTS[name][3].split(".")[:2]) for name in alone}
    pairs = [pair for pair in combinations(alone, 2) if element[pair[0]] == element[pair[1]] and apart(pair)]
    assert len(pairs) > 30
    lost = [pair for pair in pairs if not alone[pair[0]] | alone[pair[1]] <= told(*pair)]
    assert lost == [FOLLOWS]


def test_one_fault_in_every_element_all_told(told):
    chosen = {}
    for name in UNIQUE:
        element = ".".join(FAULTS[name][3].split(".")[:2])
        if name not in BASIC and apart([*chosen.values(), name]):
            chosen.setdefault(element, name)
    names = list(chosen.values())
    assert len(names) > 25
    assert set().union(*(told(name) for name in names)) <= told(*names)
