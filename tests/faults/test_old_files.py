"""Machine files of version 0.1 mean what they meant: run as they are, they end where that version ended."""

import json
from pathlib import Path

import numpy as np
import pytest

import nivel

OLD = Path(__file__).parent / "old"
# [m] places of bodies at the end, by name, as version 0.1 computed them from these files
NUMBERS = json.loads((OLD / "numbers.json").read_text(encoding="utf-8"))
CLOSE = 1e-4  # of the size of the machine: both have errors of their steps


@pytest.mark.parametrize("name", NUMBERS)
def test_an_old_file_has_its_old_numbers(name):
    result = nivel.load(OLD / f"{name}.yaml").simulate(duration=NUMBERS[name]["duration"], verify=False)
    wanted = NUMBERS[name]["position"]
    assert set(wanted) == set(result.coordinates["body"])
    found = {body: result.array(f"{body}.position")[-1] for body in wanted}
    size = max(np.ptp(list(wanted.values())), np.abs(list(wanted.values())).max())
    assert all(np.abs(found[body] - wanted[body]).max() <= CLOSE * size for body in wanted)


def test_every_old_file_is_run():
    assert {path.stem for path in OLD.glob("*.yaml")} == set(NUMBERS)
